// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE registers converters for its Eigen types with Boost.Python, whose registry is shared by the
// whole process.
#include "granular_adapter/yade/bodies/yade_bodies.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/python.hpp>

namespace turbidite::yade {

namespace python = boost::python;
using Vector3 = Eigen::Matrix<double, 3, 1>;
using YadeQuaternion = Eigen::Quaternion<double>;

namespace {

Vec3 vector_of(const python::object& state, const char* name) {
    const Vector3 v = python::extract<Vector3>(state.attr(name));
    return {v.x(), v.y(), v.z()};
}

void set_vector(python::object state, const char* name, const Vec3& v) {
    state.attr(name) = Vector3(v[0], v[1], v[2]);
}

/// The numbers behind an attribute that YADE returns by reference; null if it returns a copy.
double* reference(const python::object& state, const char* name) {
    const python::object first = state.attr(name), second = state.attr(name);
    Vector3& a = python::extract<Vector3&>(first);
    Vector3& b = python::extract<Vector3&>(second);
    return &a == &b ? a.data() : nullptr;
}

}  // namespace

BodyMotion read_attributes(const python::object& state) {
    const YadeQuaternion q = python::extract<YadeQuaternion>(state.attr("ori"));
    return {vector_of(state, "pos"),
            {q.w(), q.x(), q.y(), q.z()},
            {vector_of(state, "vel"), vector_of(state, "angVel")}};
}

void write_attributes(python::object state, const BodyMotion& motion) {
    const auto& q = motion.orientation;
    set_vector(state, "pos", motion.position);
    state.attr("ori") = YadeQuaternion(q[0], q[1], q[2], q[3]);
    set_vector(state, "vel", motion.twist.velocity);
    set_vector(state, "angVel", motion.twist.spin);
}

BodyInertia inertia_attributes(const python::object& state) {
    BodyInertia result{python::extract<double>(state.attr("mass")), vector_of(state, "inertia"), 0};
    const std::string names = python::extract<std::string>(state.attr("blockedDOFs"));
    for (unsigned bit = 0; bit < 6; ++bit)
        if (names.find("xyzXYZ"[bit]) != std::string::npos) result.blocked |= 1u << bit;
    return result;
}

StatePlaces places_of(const python::object& state) {
    return {reference(state, "vel"), reference(state, "angVel"), reference(state, "inertia")};
}

BodyStates::BodyStates(const python::object& list) {
    const auto n = static_cast<std::size_t>(python::len(list));
    states_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) states_.push_back(list[i]);
    // Otherwise each access goes through the attributes of Python, about twenty times as slow.
    if (!places_are_known()) return;
    places_.reserve(n);
    for (const python::object& state : states_) places_.push_back(places_of(state));
}

BodyMotion BodyStates::read(std::size_t i) const {
    return places_.empty() ? read_attributes(states_.at(i)) : read_places(places_.at(i));
}

void BodyStates::write(std::size_t i, const BodyMotion& motion) const {
    if (places_.empty())
        write_attributes(states_.at(i), motion);
    else
        write_places(places_.at(i), motion);
}

BodyInertia BodyStates::inertia(std::size_t i) const {
    return places_.empty() ? inertia_attributes(states_.at(i)) : inertia_places(places_.at(i));
}

void BodyStates::keep(const std::vector<std::uint8_t>& mask) {
    std::vector<python::object> kept;
    std::vector<StatePlaces> places;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (!mask[i]) continue;
        kept.push_back(states_[i]);
        if (!places_.empty()) places.push_back(places_[i]);
    }
    states_ = std::move(kept);
    places_ = std::move(places);
}

}  // namespace turbidite::yade
