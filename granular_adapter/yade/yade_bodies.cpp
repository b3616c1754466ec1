// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE registers converters for its Eigen types with Boost.Python; the registry is shared by the
// whole process.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/python.hpp>

#include "granular_adapter/yade/yade_bodies.hpp"

namespace turbidite::yade {

namespace python = boost::python;
using Vector3 = Eigen::Matrix<double, 3, 1>;
using Quaternion = Eigen::Quaternion<double>;

namespace {

std::array<double, 3> vector_of(const python::object& state, const char* name) {
    const Vector3 v = python::extract<Vector3>(state.attr(name));
    return {v.x(), v.y(), v.z()};
}

void set_vector(python::object state, const char* name, const std::array<double, 3>& v) {
    state.attr(name) = Vector3(v[0], v[1], v[2]);
}

}  // namespace

BodyStates::BodyStates(const python::object& list) {
    const auto n = static_cast<std::size_t>(python::len(list));
    states_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) states_.push_back(list[i]);
}

BodyMotion BodyStates::read(std::size_t i) const {
    const python::object& state = states_.at(i);
    const Quaternion q = python::extract<Quaternion>(state.attr("ori"));
    return {vector_of(state, "pos"),
            {q.w(), q.x(), q.y(), q.z()},
            vector_of(state, "vel"),
            vector_of(state, "angVel")};
}

void BodyStates::write(std::size_t i, const BodyMotion& motion) const {
    python::object state = states_.at(i);
    const auto& q = motion.orientation;
    set_vector(state, "pos", motion.position);
    state.attr("ori") = Quaternion(q[0], q[1], q[2], q[3]);
    set_vector(state, "vel", motion.velocity);
    set_vector(state, "angVel", motion.angular_velocity);
}

void BodyStates::keep(const std::vector<std::uint8_t>& mask) {
    std::vector<python::object> kept;
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (mask[i]) kept.push_back(states_[i]);
    states_ = std::move(kept);
}

}  // namespace turbidite::yade
