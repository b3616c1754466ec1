// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where a separable solve finds its values. Transforms need complete rows (all x of some y), the
// solves across them complete columns (all y of some modes of x). On several ranks these are two
// distributions with a transpose between them; on one rank they are the same array. Valid C++17.
#pragma once

#include <memory>

namespace turbidite {

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

    /// Rows and columns are one array and nothing moves.
    virtual bool in_place() const { return false; }
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
    bool in_place() const override { return true; }

 private:
    struct Release {
        void operator()(double* values) const;
    };
    int columns_, rows_;
    std::unique_ptr<double[], Release> values_;  // aligned for FFTW
};

}  // namespace turbidite
