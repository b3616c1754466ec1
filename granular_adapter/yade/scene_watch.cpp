// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/scene_watch.hpp"

#include <boost/python.hpp>

namespace turbidite::yade {

namespace python = boost::python;

namespace {

/// -1 if YADE has erased the body.
long id_of(const python::object& body) {
    static PyObject* const name = PyUnicode_InternFromString("id");
    const python::handle<> id(PyObject_GetAttr(body.ptr(), name));
    return PyLong_AsLong(id.get());
}

}  // namespace

SceneWatch::SceneWatch(std::size_t count, const python::object& bodies, const BodyStates& states)
    : count_(count) {
    for (python::ssize_t i = 0; i < python::len(bodies); ++i) {
        bodies_.push_back(bodies[i]);
        ids_.push_back(id_of(bodies_.back()));
    }
    for (std::size_t i = 0; i < states.size(); ++i) inertias_.push_back(states.inertia(i));
}

bool SceneWatch::changed(std::size_t count, const BodyStates& states) const {
    if (count != count_) return true;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (id_of(bodies_[i]) != ids_[i]) return true;
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!(states.inertia(i) == inertias_[i])) return true;
    return false;
}

}  // namespace turbidite::yade
