// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where a separable solve finds its values. Transforms need complete rows (all x of some y), the
// solves across them complete columns (all y of some modes of x). On several ranks these are two
// distributions with a transpose between them; on one rank they are the same array. Valid C++17.
#pragma once

#include <cstddef>
#include <memory>

namespace turbidite {

/// Zeros, aligned as FFTW likes them.
struct ReleaseAligned {
    void operator()(double* values) const;
};
using AlignedValues = std::unique_ptr<double[], ReleaseAligned>;
AlignedValues aligned_values(std::size_t count);

class Pencils {
 public:
    virtual ~Pencils() = default;

    virtual int row_count() const = 0;  ///< complete rows of this rank
    virtual double* rows() = 0;         ///< they, one after the other

    virtual int first_mode() const = 0;
    virtual int mode_count() const = 0;  ///< complete columns of this rank
    virtual double* columns() = 0;       ///< for every y, the values of these modes side by side

    virtual void to_columns() = 0;
    virtual void to_rows() = 0;

    /// The value given on the rank that holds mode 0, on every rank.
    virtual double from_mode_zero(double value) const = 0;
};

/// The whole grid on one rank: rows and columns are one array and nothing moves.
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

 private:
    int columns_, rows_;
    AlignedValues values_;
};

}  // namespace turbidite
