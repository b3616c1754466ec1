// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One value per component of a velocity: two in the plane, three in space. Valid C++17.
#pragma once

#include <array>
#include <initializer_list>

namespace turbidite {

template <class T>
class Components {
 public:
    explicit Components(int size = 2) : size_(size) {}
    Components(std::initializer_list<T> values) : size_(0) {
        for (const T& value : values) values_[size_++] = value;
    }

    int size() const { return size_; }
    T& operator[](int axis) { return values_[axis]; }
    const T& operator[](int axis) const { return values_[axis]; }
    T* begin() { return values_.data(); }
    T* end() { return values_.data() + size_; }
    const T* begin() const { return values_.data(); }
    const T* end() const { return values_.data() + size_; }

 private:
    std::array<T, 3> values_{};
    int size_;
};

/// A velocity over a rank's own cells, an array per component, which are not copied [m/s].
using VelocityPointers = Components<double*>;

}  // namespace turbidite
