// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact of soft grains: linear spring and dashpot without attraction, tangential ones weaker
// by a constant share, Coulomb friction. With the reduced mass m_r of two grains, or the mass of a
// grain at a wall,
//
//     k = m_r w^2,  c = 2 zeta m_r w      so that all contacts of round grains last pi/w undamped
#pragma once

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Ratio of tangential to normal stiffness and damping for which both directions oscillate with the
/// same period: an impulse moves the contact point of a disc three times as far along the contact
/// as across it, that of a sphere 1 + m R^2/I = 7/2 times, outside of a fluid.
constexpr double tangential_share_of_discs = 1.0 / 3.0;
constexpr double tangential_share_of_spheres = 2.0 / 7.0;

/// The parameters of all contacts (launcher/case/grains/soft_contact.hpp).
struct SoftLaw {
    /// Reads run.md_frequency, run.md_damping, run.md_tangential_share (without it the share of dry
    /// grains), contact.friction, and run.dimension in space.
    explicit SoftLaw(const Settings& settings);

    double frequency;  ///< w [1/s]
    double damping;    ///< zeta, [0, 1]
    double friction;   ///< mu
    bool in_space;
    double tangential_share;
};

}  // namespace turbidite
