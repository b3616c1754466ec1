// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/scene_watch.hpp"

#include <boost/python.hpp>
#include <limits>

namespace turbidite::yade {

namespace python = boost::python;

namespace {

/// -1 for an id if YADE has erased the body.
long whole_number(const python::object& body, PyObject* name) {
    const python::handle<> value(PyObject_GetAttr(body.ptr(), name));
    return PyLong_AsLong(value.get());
}

/// Of the body's material; NaN without one that has it.
double friction_angle(const python::object& body) {
    static PyObject* const material = PyUnicode_InternFromString("mat");
    static PyObject* const angle = PyUnicode_InternFromString("frictionAngle");
    const python::handle<> of(PyObject_GetAttr(body.ptr(), material));
    const python::handle<> value(python::allow_null(PyObject_GetAttr(of.get(), angle)));
    if (!value) {
        PyErr_Clear();
        return std::numeric_limits<double>::quiet_NaN();
    }
    return PyFloat_AsDouble(value.get());
}

}  // namespace

SceneWatch::Mark SceneWatch::mark_of(const python::object& body) {
    static PyObject* const id = PyUnicode_InternFromString("id");
    static PyObject* const mask = PyUnicode_InternFromString("mask");
    return {whole_number(body, id), whole_number(body, mask), friction_angle(body)};
}

SceneWatch::SceneWatch(std::size_t count, const python::object& bodies, const BodyStates& states)
    : count_(count) {
    for (python::ssize_t i = 0; i < python::len(bodies); ++i) {
        bodies_.push_back(bodies[i]);
        marks_.push_back(mark_of(bodies_.back()));
    }
    for (std::size_t i = 0; i < states.size(); ++i) inertias_.push_back(states.inertia(i));
}

bool SceneWatch::changed(std::size_t count, const BodyStates& states) const {
    if (count != count_) return true;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (!(mark_of(bodies_[i]) == marks_[i])) return true;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!(states.inertia(i) == inertias_[i])) return true;
    return false;
}

}  // namespace turbidite::yade
