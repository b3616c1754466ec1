// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's bodies as plain numbers. No header exposes the Eigen types of YADE's build: in code with
// other Eigen settings their members would be read at wrong offsets without any error.
//
// YADE's attributes `vel`, `angVel` and `inertia` of a state are references into it. If a new state
// has the expected values around them (position and orientation before the velocity, mass after it;
// state_layout.cpp), states are read and written in place, about twenty times as fast; otherwise
// attribute by attribute.
#pragma once

#include <array>
#include <boost/python/object.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite::yade {

/// Place and motion of one body, as a whole what YADE's State has.
struct BodyMotion {
    Vec3 position{};
    Quaternion orientation{1.0, 0.0, 0.0, 0.0};
    Twist twist{};

    bool operator==(const BodyMotion&) const = default;
};

/// The other properties of a state. `blocked`: bits 0 to 5 for x, y, z, X, Y, Z.
struct BodyInertia {
    double mass = 0.0;
    std::array<double, 3> inertia{};
    unsigned blocked = 0;

    bool operator==(const BodyInertia&) const = default;
};

/// Addresses of the numbers in a YADE state; null if unknown.
struct StatePlaces {
    double* velocity =
        nullptr;  ///< before it position (3) and orientation (x, y, z, w); after it the mass
    double* spin = nullptr;
    double* inertia = nullptr;  ///< ten doubles after it: the blocked degrees of freedom
};

/// `states`: YADE's `Body.state` objects, in the engine's order.
class BodyStates {
 public:
    BodyStates() = default;
    explicit BodyStates(const boost::python::object& list);

    std::size_t size() const { return states_.size(); }
    BodyMotion read(std::size_t i) const;
    void write(std::size_t i, const BodyMotion& motion) const;
    BodyInertia inertia(std::size_t i) const;

    /// Drops the states whose entry is zero.
    void keep(const std::vector<std::uint8_t>& mask);

 private:
    std::vector<boost::python::object> states_;
    std::vector<StatePlaces> places_;  ///< empty: access by attributes
};

/// Reads one state by its attributes.
BodyMotion read_attributes(const boost::python::object& state);
void write_attributes(boost::python::object state, const BodyMotion& motion);
BodyInertia inertia_attributes(const boost::python::object& state);

/// Reads one state in place; its addresses must be known.
BodyMotion read_places(const StatePlaces& places);
void write_places(const StatePlaces& places, const BodyMotion& motion);
BodyInertia inertia_places(const StatePlaces& places);

/// Whether this YADE's states have the layout of StatePlaces; tested on a state created for this.
bool places_are_known();
StatePlaces places_of(const boost::python::object& state);

}  // namespace turbidite::yade
