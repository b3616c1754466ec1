// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A square of fluid in plain arrays that records what a window asks of its store.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fluid_adapter/box_app/array_store.hpp"

namespace turbidite {

class WatchedRows final : public ArrayRows {
 public:
    using ArrayRows::ArrayRows;
    void write_velocity(const VelocityPointers& u) override { seen_x = u[0][0]; }

    double seen_x = 0.0;  ///< u_x of the first cell, when it was last asked for
};

/// n x n cells of edge h between walls, or cyclic; nu; rho_f = 1.
inline ArrayBox square_box(int n, double h, double viscosity, bool rigid_grains, Side side) {
    ArrayBox box;
    box.grid = grid_of_cubes({n, n, 1}, h, {side, side, side});
    box.viscosity = viscosity;
    box.rigid_grains = rigid_grains;
    return box;
}

class WatchedStore final : public ArrayStore {
 public:
    WatchedStore(int n, double h, double viscosity, bool rigid_grains, Side side = Side::wall)
        : WatchedStore(square_box(n, h, viscosity, rigid_grains, side)) {}
    explicit WatchedStore(const ArrayBox& box) : WatchedStore(box, new WatchedRows(box.grid)) {}

    double equal_height() const override { return resolved_height; }
    MovedSides begin(const Window&) override {
        ++windows;
        return sides;
    }
    bool observed() const override { return looks; }
    void show(const std::vector<ImmersedGrain>&) override {
        ++shown;
        shown_x = rows_->seen_x;
    }
    void interpolate_flux() override { ++fluxes; }
    void write(const std::vector<ImmersedGrain>& grains) override { written = grains.size(); }
    void log(const std::string& line) const override { lines.push_back(line); }

    const WatchedRows& rows() const { return *rows_; }

    double resolved_height = std::numeric_limits<double>::infinity();
    bool looks = false;
    double shown_x = 0.0;  ///< u_x of the first cell, as those who look saw it
    MovedSides sides;
    int windows = 0, fluxes = 0, shown = 0;
    std::size_t written = 0;
    mutable std::vector<std::string> lines;

 private:
    WatchedStore(const ArrayBox& box, WatchedRows* rows)
        : ArrayStore(box, std::unique_ptr<RowFields>(rows)), rows_(rows) {}

    const WatchedRows* rows_;
};

}  // namespace turbidite
