// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Prescribed motions of the sides of the box, of walls inside it and of grains, from the resolved
/// case (written by launcher/case/wall_motion), for grains and fluid alike:
///
///     run.wall_motions     `WALL KIND NUMBERS...` in run units, separated by `;`
///     run.inflow_motions   the same for the fluid that enters through sides `inflow`
///     run.grain_motions    `ID KIND NUMBERS...` of grains that follow a motion
///
///     constant VX VY SPIN              in space  VX VY VZ WX WY WZ
///     harmonic X Y ANGLE PERIOD PHASE            X Y Z AX AY AZ PERIOD PHASE
///     table T X Y ANGLE ...                      T X Y Z AX AY AZ ...
///
/// A turn of space keeps its axis: (AX, AY, AZ) is its direction times an angle. A motion is a
/// displacement d(t) and an angle a(t) about a pivot, of a grain its centre, both zero at t = 0:
///
///     constant   d = v t                                             a = w t
///     harmonic   d = A (sin(2 pi t/T + phase) - sin(phase))          a likewise
///     table      linear between its entries; constant after the last
///
/// In a window a wall or grain has the mean velocity of its motion, (d(t + dt) - d(t))/dt, so that
/// it is at its prescribed position at the end of every window, and so has the fluid there. Valid
/// C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite {

/// Where a wall or grain is to be, as a function of time.
class PrescribedMotion {
 public:
    virtual ~PrescribedMotion() = default;
    virtual Shift at(double time) const = 0;  ///< since t = 0

    /// Mean velocity and spin of the window [time, time + step].
    virtual Twist rate(double time, double step) const;
};

/// A motion and what follows it.
struct Moved {
    /// The key of a wall: 0 left, 1 right, 2 bottom, 3 top, in space 4 front, 5 back, then the
    /// walls inside the box. Or the id of a grain.
    std::int64_t what = 0;
    std::shared_ptr<const PrescribedMotion> motion;
};

/// The motions under a key; none if it is missing or empty. Throws std::invalid_argument if the
/// text has another format.
std::vector<Moved> motions_of(const Settings& settings, const char* key);

/// At constant rates from t = 0 on.
std::shared_ptr<const PrescribedMotion> constant_motion(const Twist& rate);

}  // namespace turbidite
