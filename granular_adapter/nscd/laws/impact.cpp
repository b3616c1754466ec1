// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/impact.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turbidite::nscd {
namespace {

/// u_n >= speed, unless the terms already require more.
void demand_speed(double speed, LawTerms& terms) {
    if (!(-speed < terms.normal_bias)) return;
    terms.rebound_lead = terms.normal_bias + speed;
    terms.normal_bias = -speed;
}

}  // namespace

double speed_lost(const ContactSituation& s, const FilmTerms& film) {
    if (film.coefficient == 0.0) return 0.0;
    // g_h = g + roughness, so that `closed` is the roughness, where surfaces touch. Beyond the
    // cut-off the film takes nothing: the way through it begins there.
    const double closed = film.gap - std::max(s.gap, 0.0), from = std::min(film.gap, film.cutoff);
    if (from <= closed) return 0.0;
    if (film.between == FilmBetween::spheres)
        // W C (ln(g/g_closed) - (g - g_closed)/g_c)
        return s.mobility * film.coefficient *
               (std::log(from / closed) - (from - closed) / film.cutoff);
    // W C (2/sqrt(g_closed) - 2/sqrt(g) - (g - g_closed)/g_c^{3/2})
    return s.mobility * film.coefficient *
           (2.0 / std::sqrt(closed) - 2.0 / std::sqrt(from) -
            (from - closed) * Film::power(film.cutoff));
}

double approach_at_touch(const ContactSituation& s, const FilmTerms& film) {
    // Approach is negative, and the film takes at most all of it.
    return s.approach.n < 0.0 ? std::min(s.approach.n + speed_lost(s, film), 0.0) : s.approach.n;
}

bool in_impact(const ContactSituation& s, const LawTerms& terms, double threshold) {
    // Closed, or closed by the free motion within the step: g + dt u_free <= 0.
    return approach_at_touch(s, terms.film) < -threshold &&
           (touching(s) || s.gap + s.step * s.free.n <= 0.0);
}

void demand_rebound(const ContactSituation& s, double restitution, LawTerms& terms) {
    // The film takes its part again on the way back to the gap at which the window began.
    const double rebound =
        -restitution * approach_at_touch(s, terms.film) - speed_lost(s, terms.film);
    if (rebound > 0.0) demand_speed(rebound, terms);
}

void allow_return(const ContactSituation& s, double restitution, double threshold,
                  LawTerms& terms) {
    if (s.approach.n <= threshold) return;
    terms.normal_bias = std::max(terms.normal_bias, restitution * s.approach.n);
}

void end_approach(LawTerms& terms) {
    demand_speed(0.0, terms);
}

bool never_bounces(const SurfaceTable& surfaces) {
    const auto& pairs = surfaces.all_pairs();
    return std::all_of(pairs.begin(), pairs.end(), [](const Surface& pair) {
        return pair.restitution == 0.0 && pair.restitution_tangential == 0.0;
    });
}

double bounce_threshold(const LawSettings& settings) {
    if (settings.restitution_speed >= 0.0) return settings.restitution_speed;
    throw std::invalid_argument(
        "the approach speed below which contacts do not rebound must be zero or positive");
}

}  // namespace turbidite::nscd
