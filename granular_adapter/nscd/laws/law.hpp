// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact law as a change of variables. Whatever the law, the solver solves
//
//     0 <= u_n + b_n  perp  r~_n >= 0,   |r~_t| <= mu r~_n,   r~_t opposite to u_t + b_t if sliding
//     |m| <= rolling r~_n                                     m opposite to the relative spin
//     |m_n| <= torsion r~_n                                   in space, about the normal
//
// and the law supplies b, mu and rolling. An attractive law also supplies the attraction c: the
// bodies feel r = r~ - dt c n, whose known second term is included in the free velocities, so that
// the problem keeps this form and the law is exact. Inside the solver's loop a law costs nothing.
//
// A film of liquid joins the problem as a second relation between u_n and r_n (problem/film.hpp).
//
// The law of a contact consists of parts, one per slot, which add to the terms in turn. Parts see
// velocities and impulses as normal component and tangential magnitude, (x_n, |x_t|), and are
// therefore the same in the plane and in space.
#pragma once

#include <functional>
#include <limits>

#include "granular_adapter/nscd/laws/surface.hpp"
#include "granular_adapter/nscd/names/contact_names.hpp"
#include "granular_adapter/nscd/problem/contact_vector.hpp"
#include "granular_adapter/nscd/problem/film.hpp"

namespace turbidite::nscd {

/// (x_n, |x_t|) of a velocity or an impulse.
struct Magnitudes {
    double n = 0.0;
    double t = 0.0;
};

inline Magnitudes magnitudes(const ContactVector& x) {
    return {x.n, tangential(x)};
}

/// Input of a law part.
struct ContactSituation {
    double gap = 0.0;                                           ///< g(q) [m]
    double step = 0.0;                                          ///< dt [s]
    Surface surface;                                            ///< of the pair
    double radius_a = std::numeric_limits<double>::infinity();  ///< infinite for a wall [m]
    double radius_b = 0.0;                                      ///< [m]
    bool round = true;    ///< one of the two is round: the pair has a single contact point
    double length = 0.0;  ///< of the face that the point represents, else zero [m]
    /// One over the number of the pair's points within the law's range; 0 at the edge of a wall
    /// where another is nearer (common_edges.hpp), and on the other sides of a sphere that just
    /// fits into a round wall: no attraction.
    double share = 1.0;
    Magnitudes approach;    ///< u^-: at the start of the step, wall motion included [m/s]
    Magnitudes free;        ///< u without contact impulses [m/s]
    double mobility = 0.0;  ///< W_nn: change of u_n by a unit impulse; with films only [1/kg]
    double state = 0.0;     ///< this part's state of the contact; 0 for a new contact
    bool initial = false;   ///< first step of a run, in which bonds are formed
};

/// R* = R1 R2/(R1 + R2); R at a wall [m].
inline double reduced_radius(const ContactSituation& s) {
    return 1.0 / (1.0 / s.radius_a + 1.0 / s.radius_b);
}

/// Closed at the start of the step, to rounding.
inline bool touching(const ContactSituation& s) {
    return s.gap <= 1e-9 * s.radius_b;
}

/// A film of liquid (problem/film.hpp); zero: none.
struct FilmTerms {
    /// C: the force is C (1/gap - 1/cutoff) u_n between spheres [N s], C (gap^{-3/2} -
    /// cutoff^{-3/2}) u_n between discs, per depth [N s m^{1/2}]
    double coefficient = 0.0;
    double gap = 0.0;     ///< g_h at the start of the step, > 0 [m]
    double cutoff = 0.0;  ///< g_c: the film acts below this gap [m]
    FilmBetween between = FilmBetween::spheres;
};

struct LawTerms {
    double friction = 0.0;                ///< mu
    double normal_bias = 0.0;             ///< b_n [m/s]
    double rebound_lead = 0.0;            ///< how much a rebound has lowered b_n [m/s]
    double tangential_restitution = 0.0;  ///< e_t: b_t = e_t u_t^-
    double rolling_restitution = 0.0;     ///< e of the relative spin: its bias is e w^-
    double attraction = 0.0;              ///< c, acts on the pair whatever the solver finds [N]
    double rolling = 0.0;                 ///< lever of the rolling resistance [m]
    double torsion = 0.0;                 ///< lever of the torsional resistance [m]
    FilmTerms film;                       ///< of liquid, between round surfaces
};

/// Result of the step for the contact.
struct ContactOutcome {
    LawTerms terms;
    Magnitudes impulse;  ///< r~, without that of a film [N s]
    /// Relative, of |r_t|: what shortening a vector to mu r_n may have lost.
    double rounding = 0.0;

    bool pressed() const { return impulse.n > 0.0; }
    /// Loaded, and strictly inside the friction cone.
    bool sticks() const {
        return pressed() && impulse.t * (1.0 + rounding) < terms.friction * impulse.n;
    }
};

/// Parameters that do not belong to the surfaces, for all parts; each part reads its own.
struct LawSettings {
    double recovery_fraction = 0.2;  ///< fraction of an overlap removed per step, [0, 1]
    double recovery_speed = 0.5;     ///< upper limit of the speed at which it is removed [m/s]
    double restitution_speed = 0.0;  ///< approaches slower than this do not rebound [m/s]
    double adhesion_range = 0.0;     ///< largest gap at which adhesion acts [m]
    /// lambda, decay length of the capillary force with the gap [m]
    double adhesion_length = 0.0;
    double adhesion_shear = 0.0;  ///< shear strength of a bond over its tensile strength
    /// Of the discs or spheres to which Surface::adhesion refers [m]
    double reference_diameter = 1.0;
    double viscosity = 0.0;       ///< eta of the liquid [Pa s]
    double film_cutoff = 0.0;     ///< g_c: films act at smaller gaps [m]
    double film_roughness = 0.0;  ///< thickness of a film between surfaces that touch [m]
    int dimension = 2;            ///< of the contacts
};

/// What a law does in one slot; its functions hold its parameters.
struct LawPart {
    /// Adds to the terms of the earlier slots.
    std::function<void(const ContactSituation&, LawTerms&)> add;

    /// State for the next step; 0 drops the contact. A contact beyond the engine's alert distance
    /// is dropped without this call. Empty: the part has no state.
    std::function<double(const ContactSituation&, const ContactOutcome&)> remember = {};

    double range = 0.0;             ///< largest gap at which the part acts [m]
    bool reads_velocities = false;  ///< `approach` or `free`
};

}  // namespace turbidite::nscd
