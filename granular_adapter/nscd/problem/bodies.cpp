// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/bodies.hpp"

#include <stdexcept>
#include <string>

namespace turbidite::nscd {
namespace {

[[noreturn]] void refuse(const Body& body, const std::string& fault) {
    throw std::invalid_argument("body " + std::to_string(body.id) + ": " + fault);
}

void demand_positive(const Body& body, double value, const std::string& name) {
    if (!(value > 0.0))  // also NaN
        refuse(body, name + " = " + std::to_string(value) + " must be positive");
}

void demand_inertia(const Body& body) {
    const Symmetric3& i = body.inertia;
    if (!positive_definite(i))
        refuse(body, "inertia = " + std::to_string(i.xx) + ", " + std::to_string(i.yy) + ", " +
                         std::to_string(i.zz) + " about its axes must be positive definite");
}

}  // namespace

void Bodies::add(const Body& body) {
    demand_positive(body, body.radius, "radius");
    demand_positive(body, body.mass, "mass");
    demand_inertia(body);
    id.push_back(body.id);
    shape.push_back(body.shape);
    material.push_back(body.material);
    radius.push_back(body.radius);
    density.push_back(body.density);
    mass.push_back(body.mass);
    inertia.push_back(body.inertia);
    weight_mass.push_back(body.weight_mass);
    position.push_back(body.position);
    orientation.push_back(body.orientation);
    twist.push_back(body.twist);
    fixed.push_back(body.fixed);
    rotation_blocked.push_back(body.rotation_blocked);
    for (auto* zero : {&force, &torque, &contact_impulse, &contact_angular_impulse})
        zero->push_back(Vec3{});
}

void Bodies::keep(const std::vector<std::uint8_t>& mask) {
    for_each_array(*this, [&mask](auto& array) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < mask.size(); ++i)
            if (mask[i]) array[kept++] = array[i];
        array.resize(kept);
    });
}

}  // namespace turbidite::nscd
