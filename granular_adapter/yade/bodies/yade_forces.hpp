// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's force container (O.forces) as plain numbers, for the reason given in yade_bodies.hpp.
#pragma once

#include <array>
#include <boost/python/object.hpp>

namespace turbidite::yade {

class Forces {
 public:
    explicit Forces(boost::python::object container);

    /// Sets the permanent force and torque of a body, which YADE applies in every step until they
    /// are set again [N], [N m].
    void load(int body, const std::array<double, 3>& force,
              const std::array<double, 3>& torque) const;

    /// Force and torque on a body in the last step, including permanent ones, without gravity [N],
    /// [N m].
    std::array<double, 3> force(int body) const;
    std::array<double, 3> torque(int body) const;

 private:
    boost::python::object set_force_, set_torque_, force_, torque_;
};

}  // namespace turbidite::yade
