// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fields of the whole box for ParaView, RUN/fluid/fields: one file per output (slice_file.hpp),
// into which every rank writes its own layers in place, row by row, so that nobody has a field a
// second time. Valid C++17.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/fluid_window/slice_file.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {

struct WrittenField {
    std::string name;
    int components = 1;
    /// In a cell of this rank, which has this place in the grid.
    std::function<double(int cell, const CellIndex& at, int component)> value;
};

class FieldSeries {
 public:
    /// `step`: of a window [s].
    FieldSeries(std::filesystem::path fluid_folder, double step);

    /// By all ranks, after so many windows. Throws Failure (participant failed), on all of them,
    /// when the disk is full.
    void write(const StoredField& field, const RankGroup& ranks,
               const std::vector<WrittenField>& fields, std::int64_t windows) const;

 private:
    std::filesystem::path folder_;
    double step_;
};

}  // namespace turbidite
