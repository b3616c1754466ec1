// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The convection schemes of OpenFOAM 1912, and their stability with forward Euler (step 2). Where a
// scheme is linear interpolation, a wave of small wave number k grows by 1 + (u k dt)2/2 in a step
// and viscosity takes 1 - nu k2 dt of it:
//
//     dt <= 2 nu/u2
//
// Without an upwind part there is no other damping. A limiter that stays within the range of the
// neighbours keeps the solution bounded for any dt with u dt <= h.
#pragma once

#include <string>
#include <vector>

namespace turbidite {

enum class SchemeKind {
    central,   ///< grows without bound beyond the limit
    biased,    ///< upwind part or loose limiter: grows too, but slowly or far beyond the limit
    limited,   ///< stays bounded
    by_field,  ///< depends on other schemes or fields; unknown
};

struct TransportScheme {
    std::string name;
    SchemeKind kind;
    int words = 0;  ///< that must follow the name
};

const std::vector<TransportScheme>& transport_scheme_list();

/// A parsed fluid.transport_scheme: "[bounded] Gauss NAME ...".
struct SchemeChoice {
    const TransportScheme* scheme = nullptr;  ///< null if it is invalid
    std::string fault;                        ///< why it is invalid
    std::string remedy;                       ///< what to do, with the nearest valid scheme
};
SchemeChoice read_transport_scheme(const std::string& text);

/// Whether steps on rows of a box know the scheme: Gauss limitedLinearV, linear, LUST or
/// linearUpwind, not bounded.
bool is_scheme_on_rows(const std::string& text);

}  // namespace turbidite
