// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's bodies seen from C++ as plain numbers. Eigen types of YADE's build stay behind this
// border: a header shared by code with other Eigen settings would read shifted members without any
// error.
#pragma once

#include <array>
#include <boost/python/object.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace turbidite::yade {

/// One body's motion; orientation as w, x, y, z.
struct BodyMotion {
    std::array<double, 3> position{};
    std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};
    std::array<double, 3> velocity{};
    std::array<double, 3> angular_velocity{};
};

/// `states` are YADE's `Body.state` objects, in the engine's order.
class BodyStates {
 public:
    BodyStates() = default;
    explicit BodyStates(const boost::python::object& list);

    std::size_t size() const { return states_.size(); }
    BodyMotion read(std::size_t i) const;
    void write(std::size_t i, const BodyMotion& motion) const;

    /// Forgets the states whose entry is zero.
    void keep(const std::vector<std::uint8_t>& mask);

 private:
    std::vector<boost::python::object> states_;
};

}  // namespace turbidite::yade
