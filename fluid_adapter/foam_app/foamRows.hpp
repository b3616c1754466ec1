// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenFOAM's U and p by complete rows of the box, whatever the decomposition (ranks/cell_rows.hpp).
#pragma once

#include "fluid_adapter/fluid_window/box_fluid_step.hpp"
#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class FoamRows final : public RowFields {
 public:
    FoamRows(FluidFields& fields, const BoxCells& box);

    /// In space, with the number i + nx (k + nz j) of every cell of this rank. Sides are at rest.
    FoamRows(FluidFields& fields, const CellGrid& grid, const std::vector<int>& cells);

    bool stay_in_rows() const override { return grid_ ? rows_.stays() : rows_.in_cell_order(); }
    int first_row() const override;
    void read_velocity(const VelocityPointers& u) override;
    void write_velocity(const VelocityPointers& u) override;
    void read_pressure(double* p) override;
    void write_pressure(const double* p, bool floating) override;
    VelocityOnSides side_velocity() const override;

    const CellRows& rows() const { return rows_; }

 private:
    FluidFields& fields_;
    BoxCells box_;                    // in the plane
    const CellGrid* grid_ = nullptr;  // in space
    CellRows rows_;
};

}  // namespace turbidite
