// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Lubrication below the grid: the film of liquid between two spheres or discs, or one and a wall,
// whose gap the cells of the fluid no longer resolve, resists approaching and parting with
//
//     spheres    F = -C (1/g_h - 1/g_c) u_n,                 C = 6 pi eta R*^2
//     discs      F = -C (g_h^{-3/2} - g_c^{-3/2}) u_n,       C = 3 sqrt(2) pi eta R*^{3/2}
//                                                            (Jeffrey and Onishi 1981; per depth)
//     R* = R1 R2/(R1 + R2),   g_h < g_c
//
// g_h = g + roughness: surfaces touch when their asperities meet, at a film of that thickness. The
// cut-off g_c is where the cells begin to resolve the film. Its impulse is taken inside the contact
// problem (problem/film.hpp), so that any step is stable.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

std::optional<LawPart> make_lubrication(const LawSettings& settings, const SurfaceTable&) {
    const double viscosity = settings.viscosity, cutoff = settings.film_cutoff;
    const double roughness = settings.film_roughness;
    demand_positive("lubrication", "viscosity of the liquid", viscosity);
    demand_positive("lubrication", "cut-off", cutoff);
    demand_positive("lubrication", "roughness", roughness);
    const bool discs = settings.dimension == 2;
    const auto add = [=](const ContactSituation& s, LawTerms& terms) {
        const double radius = reduced_radius(s), eta = viscosity;
        const double sphere = 6.0 * std::numbers::pi * eta * radius * radius;
        const double disc =
            3.0 * std::numbers::sqrt2 * std::numbers::pi * eta * radius * std::sqrt(radius);
        terms.film = {discs ? disc : sphere, std::max(s.gap, 0.0) + roughness, cutoff,
                      discs ? FilmBetween::discs : FilmBetween::spheres};
    };
    return LawPart{.add = add, .range = cutoff};
}

}  // namespace turbidite::nscd
