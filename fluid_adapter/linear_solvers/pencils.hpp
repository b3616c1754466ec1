// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where a separable solve keeps its values. Transforms need complete rows, here those of a matrix
// with a row per layer (all x and z of some y), the tridiagonal solves its complete columns (all y
// of some modes). On several ranks these are two distributions with a transpose between them; on
// one rank they are the same array. Valid C++17.
#pragma once

#include <cstddef>
#include <memory>

namespace turbidite {

/// Zero-initialised arrays with the alignment FFTW prefers.
struct ReleaseAligned {
    void operator()(double* values) const;
};
using AlignedValues = std::unique_ptr<double[], ReleaseAligned>;
AlignedValues aligned_values(std::size_t count);

/// The arrays of one field in both distributions.
class Pencils {
 public:
    virtual ~Pencils() = default;

    virtual int row_count() const = 0;  ///< number of complete rows on this rank
    virtual double* rows() = 0;         ///< these rows, contiguous

    virtual int first_mode() const = 0;  ///< index of this rank's first mode
    virtual int mode_count() const = 0;  ///< number of complete columns on this rank
    virtual double* columns() = 0;       ///< for every y, the values of these modes, contiguous

    /// Transposes between the two distributions. Collective.
    virtual void to_columns() = 0;
    virtual void to_rows() = 0;

    /// Broadcasts a value from the rank that holds mode 0.
    virtual double from_mode_zero(double value) const = 0;

    /// Whether rows and columns are the same array, so that no transpose is needed.
    virtual bool in_place() const { return false; }
};

/// The whole grid on one rank: rows and columns are the same array.
class WholeGrid final : public Pencils {
 public:
    WholeGrid(int columns, int rows);

    int row_count() const override { return rows_; }
    double* rows() override { return values_.get(); }
    int first_mode() const override { return 0; }
    int mode_count() const override { return columns_; }
    double* columns() override { return values_.get(); }
    void to_columns() override {}
    void to_rows() override {}
    double from_mode_zero(double value) const override { return value; }
    bool in_place() const override { return true; }

 private:
    int columns_, rows_;
    AlignedValues values_;
};

}  // namespace turbidite
