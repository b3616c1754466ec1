// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenFOAM's U and p by complete rows of the box, whatever the decomposition (ranks/cell_rows.hpp).
#pragma once

#include "fluid_adapter/fluid_window/box_fluid_step.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"
#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class FoamRows : public RowFields {
 public:
    int first_row() const override;
    void read_velocity(const VelocityPointers& u) override;
    void write_velocity(const VelocityPointers& u) override;
    void read_pressure(double* p) override;
    void write_pressure(const double* p, bool floating) override;

    const CellRows& rows() const { return rows_; }

 protected:
    FoamRows(FluidFields& fields, const CellRows& rows) : fields_(fields), rows_(rows) {}

    FluidFields& fields_;

 private:
    CellRows rows_;
};

class PlaneRows final : public FoamRows {
 public:
    PlaneRows(FluidFields& fields, const BoxCells& box);

    /// Halos of step 5 count cells in their order.
    bool stay_in_rows() const override { return rows().in_cell_order(); }
    VelocityOnSides side_velocity() const override;

 private:
    BoxCells box_;
};

class SpaceRows final : public FoamRows {
 public:
    /// `cells`: the number i + nx (k + nz j) of every cell of this rank.
    SpaceRows(FluidFields& fields, const CellGrid& grid, const std::vector<int>& cells);

    bool stay_in_rows() const override { return rows().stays(); }
    VelocityOnSides side_velocity() const override;

 private:
    const CellGrid& grid_;
};

}  // namespace turbidite
