// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <boost/python.hpp>

#include "granular_adapter/yade/bodies/yade_forces.hpp"

namespace turbidite::yade {

namespace python = boost::python;
using Vector3 = Eigen::Matrix<double, 3, 1>;

namespace {

std::array<double, 3> plain(const python::object& vector) {
    const Vector3 v = python::extract<Vector3>(vector);
    return {v.x(), v.y(), v.z()};
}

Vector3 eigen(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

Forces::Forces(python::object container)
    : set_force_(container.attr("setPermF")),
      set_torque_(container.attr("setPermT")),
      force_(container.attr("f")),
      torque_(container.attr("t")) {}

void Forces::load(int body, const std::array<double, 3>& force,
                  const std::array<double, 3>& torque) const {
    set_force_(body, eigen(force));
    set_torque_(body, eigen(torque));
}

std::array<double, 3> Forces::force(int body) const {
    return plain(force_(body));
}

std::array<double, 3> Forces::torque(int body) const {
    return plain(torque_(body));
}

}  // namespace turbidite::yade
