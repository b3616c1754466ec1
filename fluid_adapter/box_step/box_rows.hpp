// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which rows of a box a rank has, and what lies beyond them: another rank's rows, the rows at the
// other end of a cyclic box, or a side. Valid C++17.
#pragma once

#include <memory>

#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class BoxRows {
 public:
    /// How many rows beyond its own a rank sees, and the fewest it may have.
    static constexpr int beyond = 2;

    virtual ~BoxRows() = default;

    virtual int first() const = 0;  ///< of this rank's rows, in the box
    virtual int count() const = 0;

    /// Rows, not a side, lie below the first one and above the last one.
    virtual bool open_below() const = 0;
    virtual bool open_above() const = 0;

    /// Arrays of these rows for a separable solve.
    virtual std::unique_ptr<Pencils> pencils() const = 0;

    /// `edges`: this rank's first two and last two rows, one after the other. Fills, where rows
    /// lie, `outside`: the two below the first row, then the two above the last one. Every rank
    /// calls it.
    virtual void exchange(const double* edges, double* outside) = 0;
};

/// The whole box on one rank.
class AllRows final : public BoxRows {
 public:
    explicit AllRows(const PlaneOperator& plane)
        : columns_(plane.x.cells), rows_(plane.y.cells), periodic_(plane.y.periodic()) {}

    int first() const override { return 0; }
    int count() const override { return rows_; }
    bool open_below() const override { return periodic_; }
    bool open_above() const override { return periodic_; }
    std::unique_ptr<Pencils> pencils() const override {
        return std::make_unique<WholeGrid>(columns_, rows_);
    }
    void exchange(const double* edges, double* outside) override;

 private:
    int columns_, rows_;
    bool periodic_;
};

}  // namespace turbidite
