// SPDX-License-Identifier: LGPL-2.1-or-later
//
// State of all bodies, as one array per quantity with one entry per body:
//
//     position      q, the detection configuration of the theta-scheme [m]
//     mass          inertia in the contact problem: M when dry, c M when immersed [kg]
//     inertia       moments about body axes, dry or immersed alike [kg m2]
//     weight_mass   weight over g: M when dry, M - rho_f V when immersed [kg]
//     force,torque  loads other than weight and contacts, constant over a step [N, N m]
//
// In two dimensions z components of vectors are zero and only the z component of spin is used, and
// of the moments zz alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/rigid/rigid_motion.hpp"
#include "coupler/rigid/symmetric3.hpp"

namespace turbidite::nscd {

/// One body, for Bodies::add.
struct Body {
    GrainId id = 0;
    std::int32_t shape = 0;     ///< index into the ShapeTable
    std::int32_t material = 0;  ///< index into the SurfaceTable
    double radius = 0.0;        ///< circumscribed [m]
    double density = 0.0;       ///< [kg/m3]
    double mass = 0.0;
    Symmetric3 inertia;
    double weight_mass = 0.0;
    Vec3 position{};
    Quaternion orientation{1.0, 0.0, 0.0, 0.0};
    Twist twist;
    bool fixed = false;             ///< takes part in contacts, but never accelerates
    bool rotation_blocked = false;  ///< translates only, never rotates
};

/// Plain arrays: hosts may overwrite any value between two steps.
struct Bodies {
    std::vector<GrainId> id;
    std::vector<std::int32_t> shape;
    std::vector<std::int32_t> material;
    std::vector<double> radius;
    std::vector<double> density;
    std::vector<double> mass;
    std::vector<Symmetric3> inertia;
    std::vector<double> weight_mass;
    std::vector<Vec3> position;
    std::vector<Quaternion> orientation;
    std::vector<Twist> twist;
    std::vector<Vec3> force;
    std::vector<Vec3> torque;
    std::vector<std::uint8_t> fixed;
    std::vector<std::uint8_t> rotation_blocked;
    std::vector<Vec3> contact_impulse;          ///< sum over the contacts of the last step [N s]
    std::vector<Vec3> contact_angular_impulse;  ///< the same about the centre [N m s]

    std::size_t size() const { return id.size(); }

    /// About world axes: R I R^T.
    Symmetric3 world_inertia(std::size_t i) const {
        if (inertia[i].isotropic()) return inertia[i];
        return turned(inertia[i], rotation(orientation[i]));
    }

    /// Zero for fixed bodies; about world axes [1/kg, 1/(kg m2)].
    double inverse_mass(std::size_t i) const { return fixed[i] ? 0.0 : 1.0 / mass[i]; }
    Symmetric3 inverse_inertia(std::size_t i) const {
        return fixed[i] || rotation_blocked[i] ? Symmetric3() : inverse(world_inertia(i));
    }

    /// Throws std::invalid_argument naming the body and the value if mass or radius is not
    /// positive, or the inertia not positive definite.
    void add(const Body& body);

    /// Removes every body whose entry is zero; the order of the others stays.
    void keep(const std::vector<std::uint8_t>& mask);

    /// Calls visit(array) for every array, always in the same order: a new state variable is one
    /// more line here, and is then included in removal and restart.
    template <class Self, class Visit>
    static void for_each_array(Self& self, Visit&& visit) {
        visit(self.id), visit(self.shape), visit(self.material), visit(self.radius),
            visit(self.density);
        visit(self.mass), visit(self.inertia), visit(self.weight_mass);
        visit(self.position), visit(self.orientation), visit(self.twist);
        visit(self.force), visit(self.torque), visit(self.fixed), visit(self.rotation_blocked);
        visit(self.contact_impulse), visit(self.contact_angular_impulse);
    }
};

}  // namespace turbidite::nscd
