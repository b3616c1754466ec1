// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/python.hpp>

#include "coupler/shapes/shape.hpp"
#include "granular_adapter/yade/yade_grains.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

python::tuple triple(const Vec3& v) {
    return python::make_tuple(v[0], v[1], v[2]);
}

python::list vertex_list(const std::vector<Point2>& outline, double radius) {
    python::list list;
    for (const Point2& point : outline)
        list.append(python::make_tuple(radius * point[0], radius * point[1]));
    return list;
}

python::dict grain_dict(const nscd::Bodies& bodies, std::size_t i) {
    python::dict grain;
    grain["id"] = bodies.id[i];
    grain["material"] = bodies.material[i];
    grain["prescribed"] = bodies.fixed[i] != 0;
    grain["radius"] = bodies.radius[i];
    grain["density"] = bodies.density[i];
    grain["mass"] = bodies.mass[i];
    grain["inertia"] = bodies.inertia[i].zz;
    grain["position"] = triple(bodies.position[i]);
    const Quaternion& q = bodies.orientation[i];
    grain["orientation"] = python::make_tuple(q[0], q[1], q[2], q[3]);
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

python::list grain_list(const nscd::Bodies& bodies, const ShapeTable& shapes) {
    std::vector<std::vector<Point2>> outlines;
    for (const ShapeRecord& shape : shapes) outlines.push_back(make_shape(shape)->outline());
    python::list list;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        python::dict grain = grain_dict(bodies, i);
        const auto shape = static_cast<std::size_t>(bodies.shape[i]);
        if (!shapes.empty()) grain["vertices"] = vertex_list(outlines.at(shape), bodies.radius[i]);
        list.append(grain);
    }
    return list;
}

}  // namespace turbidite::yade
