// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects changes of a scene since it was laid out: bodies added or erased, and other masks,
// friction angles, masses, moments of inertia or blocked degrees of freedom.
#pragma once

#include <boost/python/object.hpp>
#include <vector>

#include "granular_adapter/yade/bodies/yade_bodies.hpp"

namespace turbidite::yade {

class SceneWatch {
 public:
    SceneWatch() = default;

    /// `count`: len(O.bodies); `bodies`: all of them; `states`: those of the engine's bodies.
    /// Records their present values.
    SceneWatch(std::size_t count, const boost::python::object& bodies, const BodyStates& states);

    /// Compares with the present len(O.bodies) and the same `states`.
    bool changed(std::size_t count, const BodyStates& states) const;

 private:
    struct Mark {
        long id, mask;
        double friction_angle;
        bool operator==(const Mark&) const = default;
    };
    static Mark mark_of(const boost::python::object& body);

    std::size_t count_ = 0;
    std::vector<boost::python::object> bodies_;
    std::vector<Mark> marks_;
    std::vector<BodyInertia> inertias_;
};

}  // namespace turbidite::yade
