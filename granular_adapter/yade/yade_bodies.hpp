// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's bodies seen from C++ as plain numbers. Eigen types of YADE's build stay behind this
// border: a header shared by code with other Eigen settings would read shifted members without any
// error.
//
// YADE's attributes `vel`, `angVel` and `inertia` of a state are references into it. Where those of
// a fresh state and the values around them are found as expected (position and orientation before
// the velocity, mass behind it; state_layout.cpp), states are read and written in place, some
// twenty times as fast; otherwise attribute by attribute.
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

    bool operator==(const BodyMotion&) const = default;
};

/// What of a state is no motion. `blocked`: bit 0 to 5 for x, y, z, X, Y, Z.
struct BodyInertia {
    double mass = 0.0;
    std::array<double, 3> inertia{};
    unsigned blocked = 0;

    bool operator==(const BodyInertia&) const = default;
};

/// Where a YADE state keeps its numbers; null: not known.
struct StatePlaces {
    double* velocity =
        nullptr;  ///< before it position (3) and orientation (x, y, z, w); behind: mass
    double* spin = nullptr;
    double* inertia = nullptr;  ///< ten doubles further: the blocked degrees of freedom
};

/// `states` are YADE's `Body.state` objects, in the engine's order.
class BodyStates {
 public:
    BodyStates() = default;
    explicit BodyStates(const boost::python::object& list);

    std::size_t size() const { return states_.size(); }
    BodyMotion read(std::size_t i) const;
    void write(std::size_t i, const BodyMotion& motion) const;
    BodyInertia inertia(std::size_t i) const;

    /// Forgets the states whose entry is zero.
    void keep(const std::vector<std::uint8_t>& mask);

 private:
    std::vector<boost::python::object> states_;
    std::vector<StatePlaces> places_;  ///< empty: by attributes
};

/// The attributes of one state, by name.
BodyMotion read_attributes(const boost::python::object& state);
void write_attributes(boost::python::object state, const BodyMotion& motion);
BodyInertia inertia_attributes(const boost::python::object& state);

/// In place; the places must be known.
BodyMotion read_places(const StatePlaces& places);
void write_places(const StatePlaces& places, const BodyMotion& motion);
BodyInertia inertia_places(const StatePlaces& places);

/// Whether states of this YADE are laid out as StatePlaces says, found out on a state of our own.
bool places_are_known();
StatePlaces places_of(const boost::python::object& state);

}  // namespace turbidite::yade
