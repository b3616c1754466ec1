// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's force container (O.forces) seen from C++ as plain numbers; see yade_bodies.hpp for why.
#pragma once

#include <array>
#include <boost/python/object.hpp>

namespace turbidite::yade {

class Forces {
 public:
    explicit Forces(boost::python::object container);

    /// Permanent force and torque of a body, which YADE adds in every step until they are set
    /// again.
    void load(int body, const std::array<double, 3>& force,
              const std::array<double, 3>& torque) const;

    /// What acted on a body in the last step, permanent ones included, gravity not [N], [N m].
    std::array<double, 3> force(int body) const;
    std::array<double, 3> torque(int body) const;

 private:
    boost::python::object set_force_, set_torque_, force_, torque_;
};

}  // namespace turbidite::yade
