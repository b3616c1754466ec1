// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/python.hpp>

#include "granular_adapter/yade/yade_grains.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

python::tuple triple(const Vec3& v) {
    return python::make_tuple(v[0], v[1], v[2]);
}

python::dict grain_dict(const nscd::Bodies& bodies, std::size_t i) {
    python::dict grain;
    grain["id"] = bodies.id[i];
    grain["radius"] = bodies.radius[i];
    grain["density"] = bodies.density[i];
    grain["mass"] = bodies.mass[i];
    grain["inertia"] = bodies.inertia[i];
    grain["position"] = triple(bodies.position[i]);
    grain["velocity"] = triple(bodies.twist[i].velocity);
    grain["angular_velocity"] = triple(bodies.twist[i].spin);
    return grain;
}

}  // namespace

python::dict settings_dict(const Settings& settings) {
    python::dict dict;
    for (const auto& [key, value] : settings.entries()) dict[key] = value;
    return dict;
}

python::list grain_list(const nscd::Bodies& bodies) {
    python::list list;
    for (std::size_t i = 0; i < bodies.size(); ++i) list.append(grain_dict(bodies, i));
    return list;
}

}  // namespace turbidite::yade
