// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The values of a run that several programs need, read from its settings once by each: units,
/// physics, windows, periods. Keys that only one program knows are read by that program.
///
/// Valid C++17.
#pragma once

#include <cstdint>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// As run_values() reads them.
struct RunValues {
    int dimension = 2;  ///< 2: the plane, per unit length; 3: space

    double diameter = 1.0;  ///< D [m]
    double velocity = 1.0;  ///< u_c [m/s]
    double time = 1.0;      ///< t_c = D/u_c [s]

    double gravity = 0.0;  ///< g, along -y [m/s2]
    /// m g in air of a disc of diameter D, per unit length [N/m]; in space of a sphere [N].
    double grain_weight = 0.0;

    bool wet = false;                  ///< with a fluid
    double fluid_density = 0.0;        ///< rho_f; 0 when dry [kg/m3]
    double viscosity = 0.0;            ///< nu; 0 when dry [m2/s]
    double hydrodynamic_radius = 1.0;  ///< R_h/R without the shift; 1 when dry
    double surface_shift = 0.0;        ///< R_h - hydrodynamic_radius R; 0 in the plane [m]
    Vec3 acceleration{};               ///< uniform body force on the fluid over rho_f [m/s2]

    double step = 0.0;              ///< dt, the length of a window [s]
    std::int64_t windows = 0;       ///< of the whole run
    std::int64_t output_every = 1;  ///< windows from one output to the next
    std::int64_t fields_every = 1;  ///< and from one output of the fluid's fields to the next

    Vec3 size{};    ///< of the domain, from the origin; in the plane without a depth [m]
    Vec3 period{};  ///< period of the domain per axis; 0: not cyclic [m]
};

/// Reads run.* (run.surface_shift may be missing), fluid.enabled, fluid.hydrodynamic_radius,
/// domain.left, domain.bottom and, in space, domain.front. Throws std::out_of_range or
/// std::invalid_argument naming a key that is missing or of another type.
RunValues run_values(const Settings& settings);

}  // namespace turbidite
