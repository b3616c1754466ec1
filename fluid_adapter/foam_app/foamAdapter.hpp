// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fluid participant on OpenFOAM: the functions of an adapter, by the steps of a window (Topin
// 2011, section 2.1.2). No OpenFOAM type appears here, so that tests can use it.
#pragma once

#include <filesystem>
#include <memory>

#include "fluid_adapter/fluid_window/fluid_timings.hpp"
#include "fluid_adapter/fluid_window/window_adapter.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class FoamStore;
struct FluidRank;

class FoamAdapter final : public WindowAdapter {
 public:
    /// `directory`: the OpenFOAM case.
    explicit FoamAdapter(std::filesystem::path directory);
    ~FoamAdapter() override;

    /// Passes the fluid's own communicator, as a Fortran handle. Called before the other functions,
    /// and not at all with a single process. With several ranks OpenFOAM is put into parallel mode,
    /// for which the world must be this communicator (coupler/transport/world_isolation.hpp).
    void share(int communicator);

    Hello describe() const override;
    Box initialise(const Settings& settings, const ShapeTable& shapes) override;
    SavedState save() const override;
    void restore(const SavedState& state) override;
    void restore_from(const std::vector<SavedState>& of_ranks) override;

    /// Timings of the last window.
    const FluidTimings& timings() const;

    /// Adds (x, y) to u everywhere [m/s]: an initial stream, or a uniform body force times dt.
    void add_velocity(double x, double y);

    /// u in cell (i, j) of the grid, which this rank must own [m/s].
    Vec3 velocity(int i, int j, int k = 0) const;

    /// p over rho_f in the same cell [m2/s2]. Collective, as is save().
    double pressure(int i, int j, int k = 0) const;

 private:
    FluidRank of_this_rank() const;

    std::filesystem::path directory_;
    RankGroup ranks_;
    std::unique_ptr<FoamStore> store_;
};

}  // namespace turbidite
