// SPDX-License-Identifier: GPL-2.0-or-later
//
// A layer of values with room for two more beyond both ends of its rows and, in space, for two more
// rows before the first and after the last. Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

namespace turbidite {

class PaddedLayer {
 public:
    static constexpr int beyond = 2;

    PaddedLayer(int columns, int rows)
        : length_(columns + 2 * beyond),
          before_(rows > 1 ? beyond : 0),
          values_(length_ * (rows + 2 * before_)) {}

    /// Row k: values [-beyond, columns + beyond).
    double* row(int k) { return values_.data() + (k + before_) * length_ + beyond; }
    const double* row(int k) const { return values_.data() + (k + before_) * length_ + beyond; }

 private:
    std::size_t length_;
    int before_;
    std::vector<double> values_;
};

}  // namespace turbidite
