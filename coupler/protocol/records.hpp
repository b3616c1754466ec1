// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Grain data exchanged by the participants, as named fields with units.
///
/// Units are the run's: SI for `scales.kind: physical`, otherwise D = u_c = rho_f = 1.
/// In two dimensions masses, forces and impulses are per unit length out of the plane, z components
/// of vectors are zero, and only the z component of angular quantities is used.
///
/// Valid C++17: the OpenFOAM adapter includes this header.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "coupler/rigid/vec3.hpp"

namespace turbidite {

/// Number of a grain, unique in a run.
using GrainId = std::int64_t;

/// A rigid body at one instant.
///
/// `position` is the detection configuration q of the theta-scheme (Topin 2011, Eq. 17 shifted by
/// (1 - theta) dt U): all participants, including the fluid, see the grain there.
struct GrainState {
    GrainId id = 0;
    std::int32_t shape = 0;     ///< index into ShapeTable
    std::int32_t material = 0;  ///< 0: coefficients of `contact`; 1: first of run.materials
    bool prescribed = false;    ///< keeps its velocity and spin whatever forces act on it
    double radius = 0.0;        ///< circumscribed radius R [m]
    double density = 0.0;       ///< rho_s [kg/m3]
    Vec3 position{};            ///< q [m]
    /// (w, x, y, z) of length 1, body axes to world axes; in the plane a turn about z.
    Quaternion orientation{1.0, 0.0, 0.0, 0.0};
    Vec3 velocity{};                   ///< U of the centre [m/s]
    Vec3 angular_velocity{};           ///< omega, world axes [rad/s]
    Vec3 contact_impulse{};            ///< sum of the window's contact impulses J_c [N s]
    Vec3 contact_angular_impulse{};    ///< their moment about the centre [N m s]
    Vec3 announced_impulse{};          ///< J_h: fluid impulse already spent in sub-steps [N s]
    Vec3 announced_angular_impulse{};  ///< its moment about the centre [N m s]
};

/// What step 5 does to a grain over one window (Topin 2011, Equations 9 and 10).
///
/// The fluid fills in velocities and multiplier impulses; the hub adds force and torque
/// (hub/kick_rule).
struct Kick {
    GrainId id = 0;
    Vec3 velocity{};                    ///< corrected U^{n+1} [m/s]
    Vec3 angular_velocity{};            ///< corrected omega^{n+1} [rad/s]
    Vec3 multiplier_impulse{};          ///< dt * integral of lambda over the grain [N s]
    Vec3 multiplier_angular_impulse{};  ///< dt * integral of r x lambda [N m s]
    Vec3 force{};                       ///< F_h, buoyancy excluded [N]
    Vec3 torque{};                      ///< T_h [N m]
};

/// Place of entry (i, j), i <= j, of a symmetric 6 x 6 matrix that is stored as its upper triangle
/// by rows.
constexpr std::size_t upper_entry(std::size_t i, std::size_t j) {
    return i * 6 - i * (i + 1) / 2 + j;
}

/// Scheme `joint`: response of a grain in the fluid to impulses in this window. With contact
/// impulse J and angular impulse K, (U, omega) = (velocity, angular_velocity) + inertia^-1 (J, K).
///
/// The first response of a window is for free grains. Later ones follow a contact solve that found
/// (U, omega) and (J, K): the fluid has applied the impulses to its coupled system and found (U',
/// omega'). Velocities are then (U', omega') - inertia^-1 (J, K) with the same inertia, so that the
/// next contact solve is exact where (J, K) do not change.
struct FreeResponse {
    GrainId id = 0;
    Vec3 velocity{};          ///< U^F [m/s]
    Vec3 angular_velocity{};  ///< omega^F [rad/s]
    /// Effective inertia, symmetric 6 x 6 (upper_entry): translation first. All zero for a grain
    /// whose motion is prescribed: (U, omega) is then that motion, and inertia^-1 stands for zero.
    /// [kg], [kg m], [kg m2]
    std::array<double, 21> inertia{};
    /// Mismatch between contacts and fluid: |U' - U| + R |omega' - omega| of the last contact
    /// solve; zero in the first response [m/s].
    double mismatch = 0.0;
};

/// A shape known to both sides by its index.
struct ShapeRecord {
    std::string kind;              ///< disc, triangle, polygon or sphere
    std::vector<double> vertices;  ///< x,y[,z] of unit circumradius; empty for round shapes
};
/// GrainState::shape counts in it.
using ShapeTable = std::vector<ShapeRecord>;

/// The message that opens a window.
struct Window {
    std::int64_t index = 0;     ///< from 0 on; goes on in a resumed run
    double time = 0.0;          ///< t^n at its start [s]
    double step = 0.0;          ///< dt [s]
    bool write_output = false;  ///< fields and series are due at its end
};

/// Report of the contact side. Values an adapter does not have stay empty: codes with springs have
/// no residual. No number is negative or not finite; film_work may be negative.
struct ContactReport {
    std::int64_t contacts = 0;       ///< with an impulse
    std::int64_t iterations = 0;     ///< sweeps of the contact solver; sub-steps of native_substeps
    std::optional<double> residual;  ///< scaled natural map
    bool converged = true;           ///< within the tolerance of the contact solver
    double max_penetration = 0.0;    ///< deepest overlap of the window, 0 or more [m]
    std::int64_t removed = 0;        ///< grains that left through a free side in this window
    double wall_seconds = 0.0;       ///< time in the adapter's own work
    /// Quad: the change by one more update of every contact, relative, quadratic mean.
    std::optional<double> quad;
    /// Max: the largest such change.
    std::optional<double> max;
    /// With the state: how far the velocities at the end of the window are from the contact
    /// conditions, max |min(u_n + b_n, W_nn r_n)| over the contact points [m/s].
    std::optional<double> contact_violation = {};
    /// With the state: work of films of liquid between surfaces that the cells of the fluid do not
    /// resolve, on the grains over the window; it is part of that of the contact impulses [J].
    std::optional<double> film_work = {};
};

/// Bits of ContactRecord::status; none set: sticking.
struct ContactStatus {
    static constexpr std::int32_t sliding = 1;  ///< friction is at its limit
    static constexpr std::int32_t rolling = 2;  ///< the rolling moment is at its limit
    static constexpr std::int32_t film = 4;     ///< a film of liquid keeps the surfaces apart
};

/// One contact point with an impulse, as found in the window: at q^n for adapters that solve once,
/// in the last sub-step for others.
///
/// A pair that touches along an edge has several records, distinguished by `feature`. With several
/// grains ranks, one of them reports the contact. With attraction (cohesion) the product of impulse
/// and normal is negative.
struct ContactRecord {
    GrainId a = 0;           ///< the smaller id; undefined at a wall
    GrainId b = 0;           ///< the larger id, or the grain at the wall
    std::int32_t wall = -1;  ///< of a: 0 left, 1 right, 2 bottom, 3 top, others follow; -1: a grain
    std::int32_t feature = 0;  ///< which of the pair's points
    std::int32_t status = 0;   ///< bits of ContactStatus
    double gap = 0.0;          ///< negative: overlap [m]
    double length = 0.0;       ///< of the face that the point stands for; 0 for points [m]
    Vec3 point{};              ///< [m]
    Vec3 normal{};             ///< unit, from a to b
    Vec3 branch{};   ///< centre of b minus that of a, nearest image; at a wall minus `point` [m]
    Vec3 impulse{};  ///< on b over the window, -impulse on a [N s]
    Vec3 rolling_impulse{};  ///< moment on b besides that of `impulse`, its negative on a [N m s]
};

/// The sorting order of contacts; records that are equivalent in it are the same contact.
inline bool contact_before(const ContactRecord& x, const ContactRecord& y) {
    const auto key = [](const ContactRecord& c) {
        return std::make_tuple(c.wall, c.wall < 0 ? c.a : 0, c.b, c.feature);
    };
    return key(x) < key(y);
}

/// What a grains rank sends: its grains and the report of the contact side.
struct Motion {
    std::vector<GrainState> grains;  ///< in any order
    ContactReport report;
    /// Sent with the state at the end of windows with output, by adapters that can report contacts,
    /// on all ranks or none; otherwise empty, which is not the same as no contacts.
    std::optional<std::vector<ContactRecord>> contacts = {};
};

/// Corrections of pressure and viscosity with rigid grains, of a whole window, and what the last
/// one left: with explicit-multiplier before the contacts of the window.
struct SplittingReport {
    std::int64_t pressure_iterations = 0;
    std::int64_t viscous_iterations = 0;
    double divergence = 0.0;        ///< rms of div u after the last of them [1/s]
    double viscous_residual = 0.0;  ///< rms of the viscous acceleration that is missing [m/s2]
    bool converged = true;          ///< all that iterate to a tolerance, and none broke down
};

/// Report of the fluid side.
struct FluidReport {
    std::int64_t multiplier_iterations = 0;  ///< of all solves of the window
    double multiplier_residual = 0.0;        ///< rms slip at the points [m/s]
    bool multipliers_converged = true;  ///< all solves of the window, within the iteration limit
    double divergence = 0.0;            ///< max |div phi| after step 1 [1/s]
    double final_divergence =
        0.0;  ///< after step 5 (large by nature), in windows with output [1/s]
    /// |change of fluid momentum + dt sum(lambda) - boundary impulses| over the largest of them:
    /// zero to solver tolerance.
    double momentum_defect = 0.0;
    double courant = 0.0;                           ///< largest Courant number of the window
    std::optional<SplittingReport> splitting = {};  ///< empty with marchuk-yanenko
    Vec3 mean_velocity{};       ///< of the whole box, cells in grains included [m/s]
    double wall_seconds = 0.0;  ///< time in the adapter's own work, all steps
    /// p/rho_f [m2/s2], u, v, in space w [m/s] at each point of output.probes, in windows with
    /// output.
    std::vector<double> probes = {};
};

/// Answer of a fluid rank to a Motion: kicks of the grains whose centre it owns.
struct Kicks {
    std::vector<Kick> kicks;  ///< in any order
    FluidReport report;
};

/// Where a fluid rank must know every grain [m]: its own part of space, and as far beyond it as its
/// stencils reach.
struct Box {
    Vec3 lower{};  ///< corner
    Vec3 upper{};  ///< opposite corner
};

}  // namespace turbidite
