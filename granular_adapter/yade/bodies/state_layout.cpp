// SPDX-License-Identifier: GPL-3.0-or-later
//
// Determines by experiment how YADE's State lies in memory: YADE packages no headers, and the
// layout would depend on the flags of its build. A state is set through attributes and read in
// place, then the other way round; states are accessed in place only if all bits agree.
#include <boost/python.hpp>
#include <cstring>

#include "granular_adapter/yade/bodies/yade_bodies.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

// Distances in doubles from the references given by YADE.
constexpr int position_before_velocity = 7;
constexpr int orientation_before_velocity = 4;  // x, y, z, w
constexpr int mass_behind_velocity = 3;
constexpr int blocked_behind_inertia = 10;

/// Different in every component; the quaternion is a unit quaternion.
BodyMotion sample(double sign) {
    return {{1.5 * sign, -2.25, 3.125},
            {0.1, 0.5 * sign, -0.7, 0.5},
            {{4.5, 5.25 * sign, -6.125}, {7.5, -8.25, 9.125 * sign}}};
}

bool attributes_arrive(python::object state, const StatePlaces& places, double sign) {
    write_attributes(state, sample(sign));
    state.attr("mass") = 17.5 * sign;
    state.attr("blockedDOFs") = sign > 0.0 ? "xyZ" : "zXY";
    places.inertia[1] = 21.5;
    return read_places(places) == sample(sign) &&
           inertia_places(places) == inertia_attributes(state);
}

bool places_arrive(const python::object& state, const StatePlaces& places, double sign) {
    write_places(places, sample(sign));
    return read_attributes(state) == sample(sign);
}

bool probe() {
    const python::object state = python::import("yade.wrapper").attr("State")();
    const StatePlaces places = places_of(state);
    if (!places.velocity || !places.spin || !places.inertia) return false;
    // Both ways and with two sets of numbers, so that no value agrees by chance.
    return attributes_arrive(state, places, 1.0) && attributes_arrive(state, places, -1.0) &&
           places_arrive(state, places, 1.0) && places_arrive(state, places, -1.0);
}

}  // namespace

bool places_are_known() {
    static const bool known = probe();
    return known;
}

BodyMotion read_places(const StatePlaces& places) {
    BodyMotion motion;
    const double* x = places.velocity - position_before_velocity;
    const double* q = places.velocity - orientation_before_velocity;
    std::memcpy(motion.position.data(), x, sizeof motion.position);
    motion.orientation = {q[3], q[0], q[1], q[2]};
    std::memcpy(motion.twist.velocity.data(), places.velocity, sizeof motion.twist.velocity);
    std::memcpy(motion.twist.spin.data(), places.spin, sizeof motion.twist.spin);
    return motion;
}

void write_places(const StatePlaces& places, const BodyMotion& motion) {
    double* q = places.velocity - orientation_before_velocity;
    const auto& w = motion.orientation;
    std::memcpy(places.velocity - position_before_velocity, motion.position.data(),
                sizeof motion.position);
    q[0] = w[1], q[1] = w[2], q[2] = w[3], q[3] = w[0];
    std::memcpy(places.velocity, motion.twist.velocity.data(), sizeof motion.twist.velocity);
    std::memcpy(places.spin, motion.twist.spin.data(), sizeof motion.twist.spin);
}

BodyInertia inertia_places(const StatePlaces& places) {
    BodyInertia result;
    result.mass = places.velocity[mass_behind_velocity];
    std::memcpy(result.inertia.data(), places.inertia, sizeof result.inertia);
    std::memcpy(&result.blocked, places.inertia + blocked_behind_inertia, sizeof result.blocked);
    return result;
}

}  // namespace turbidite::yade
