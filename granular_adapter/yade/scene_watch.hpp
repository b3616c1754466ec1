// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a scene is still the one that was laid out: bodies added or erased, masses, moments or
// blocked degrees of freedom changed.
#pragma once

#include <boost/python/object.hpp>
#include <vector>

#include "granular_adapter/yade/yade_bodies.hpp"

namespace turbidite::yade {

class SceneWatch {
 public:
    SceneWatch() = default;

    /// `count`: len(O.bodies); `bodies`: all of them; `states` of those that are bodies of the
    /// engine. Remembers how they are now.
    SceneWatch(std::size_t count, const boost::python::object& bodies, const BodyStates& states);

    /// With len(O.bodies) now and the same `states`.
    bool changed(std::size_t count, const BodyStates& states) const;

 private:
    std::size_t count_ = 0;
    std::vector<boost::python::object> bodies_;
    std::vector<long> ids_;
    std::vector<BodyInertia> inertias_;
};

}  // namespace turbidite::yade
