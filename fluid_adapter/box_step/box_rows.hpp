// SPDX-License-Identifier: GPL-2.0-or-later
//
// The layers of a box that belong to a rank, and what lies beyond them: layers of another rank,
// layers from the opposite end of a cyclic box, or a side of the box. A layer is all cells with the
// same y; where only its place counts it is called a row. Valid C++17.
#pragma once

#include <memory>

#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class BoxRows {
 public:
    /// How many rows beyond its own a rank sees; also the fewest rows a rank may have.
    static constexpr int beyond = 2;

    virtual ~BoxRows() = default;

    virtual int first() const = 0;  ///< index in the box of this rank's first row
    virtual int count() const = 0;  ///< number of this rank's rows

    /// Whether there are rows, and not a side, below the first row; above the last row.
    virtual bool open_below() const = 0;
    virtual bool open_above() const = 0;

    /// Arrays for a separable solve over these rows.
    virtual std::unique_ptr<Pencils> pencils() const = 0;

    /// Fills `outside`: the two rows below the first one, then the two above the last one, as far
    /// as these exist. `edges`: this rank's first two and last two rows. Both arrays hold their
    /// rows contiguously. Every rank calls it.
    virtual void exchange(const double* edges, double* outside) = 0;
};

/// The whole box on one rank.
class AllRows final : public BoxRows {
 public:
    explicit AllRows(const SeparableOperator& plane)
        : columns_(plane.layer()), rows_(plane.y.cells), periodic_(plane.y.periodic()) {}

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
