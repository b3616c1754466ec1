// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid participant on plain arrays, in space, without OpenFOAM. Valid C++17.
#pragma once

#include <filesystem>
#include <memory>

#include "fluid_adapter/fluid_window/window_adapter.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class BoxStore;

class BoxAdapter final : public WindowAdapter {
 public:
    /// `folder`: for what the fluid writes.
    explicit BoxAdapter(std::filesystem::path folder);
    ~BoxAdapter() override;

    /// The fluid's own communicator; not called with a single process.
    void share(MPI_Comm communicator) { ranks_ = RankGroup(communicator); }

    Hello describe() const override;
    Box initialise(const Settings& settings, const ShapeTable& shapes) override;
    void save_to(PieceWriter& file) const override;
    void restore_own(PieceReader& file) override;
    void restore_parts(std::vector<PieceReader>& of_ranks) override;

 private:
    std::filesystem::path folder_;
    RankGroup ranks_;
    std::unique_ptr<BoxStore> store_;
};

}  // namespace turbidite
