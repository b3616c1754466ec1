// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact law, written as a change of variables: whatever the law, the solver sees
//
//     0 <= u_n + b_n  perp  r~_n >= 0,   |r~_t| <= mu r~_n,   r~_t opposite to u_t + b_t if sliding
//     |m| <= rolling r~_n                                     m opposite to the relative spin
//
// and the law says what b, mu and rolling are. A law that pulls names the attraction c: the bodies
// feel r = r~ - dt c n, whose known part is put into the free velocities, so that the problem above
// stays the same and the law exact. A law costs nothing in the solver's loop.
//
// The law of a contact is made of parts, one per slot, which add to the terms one after another.
// Parts know of velocities and impulses the normal component and the size of the tangential one,
// (x_n, |x_t|), so that they are the same in the plane and in space.
#pragma once

#include <limits>

#include "granular_adapter/nscd/laws/surface.hpp"
#include "granular_adapter/nscd/names/contact_names.hpp"
#include "granular_adapter/nscd/problem/contact_vector.hpp"

namespace turbidite::nscd {

/// (x_n, |x_t|) of a velocity or an impulse.
struct Magnitudes {
    double n = 0.0;
    double t = 0.0;
};

inline Magnitudes magnitudes(const ContactVector& x) {
    return {x.n, tangential(x)};
}

/// What a part may look at.
struct ContactSituation {
    double gap = 0.0;                                           ///< g(q) [m]
    double step = 0.0;                                          ///< dt [s]
    Surface surface;                                            ///< of the pair
    double radius_a = std::numeric_limits<double>::infinity();  ///< infinite at a wall [m]
    double radius_b = 0.0;                                      ///< [m]
    bool round = true;     ///< one of the two is a disc: a point stands for the whole contact
    double length = 0.0;   ///< of the face that the point stands for, else zero [m]
    double share = 1.0;    ///< one over the pair's points within the law's range
    Magnitudes approach;   ///< u^-: at the start of the step, wall motion included [m/s]
    Magnitudes free;       ///< u without contact impulses [m/s]
    double state = 0.0;    ///< what this part remembered; 0: a contact it does not know
    bool initial = false;  ///< first step of a run, in which bonds are made
};

/// R1 R2/(R1 + R2); R at a wall [m].
inline double reduced_radius(const ContactSituation& s) {
    return 1.0 / (1.0 / s.radius_a + 1.0 / s.radius_b);
}

/// Closed at the start of the step, or apart by what rounding leaves.
inline bool touching(const ContactSituation& s) {
    return s.gap <= 1e-9 * s.radius_b;
}

struct LawTerms {
    double friction = 0.0;                ///< mu
    double normal_bias = 0.0;             ///< b_n [m/s]
    double tangential_restitution = 0.0;  ///< e_t: b_t = e_t u_t^-
    double attraction = 0.0;  ///< c, pulls the pair together whatever the solver finds [N]
    double rolling = 0.0;     ///< lever of the rolling resistance [m]
};

/// What became of the contact in the step.
struct ContactOutcome {
    LawTerms terms;
    Magnitudes impulse;  ///< r~ [N s]

    bool pressed() const { return impulse.n > 0.0; }
    /// Pressed and inside the cone.
    bool sticks() const { return pressed() && impulse.t < terms.friction * impulse.n; }
};

/// Parameters of all parts that are not the surfaces'; each part reads its own.
struct LawSettings {
    double recovery_fraction = 0.2;   ///< part of an overlap that one step takes back, [0, 1]
    double recovery_speed = 0.5;      ///< but never faster than this [m/s]
    double restitution_speed = 0.0;   ///< slower approaches do not bounce [m/s]
    double adhesion_range = 0.0;      ///< gap up to which adhesion acts [m]
    double adhesion_length = 0.0;     ///< lambda, decay of the capillary force over the gap [m]
    double adhesion_shear = 0.0;      ///< strength of a bond in shear over that in traction
    double reference_diameter = 1.0;  ///< of the discs that Surface::adhesion speaks of [m]
};

class LawPart {
 public:
    virtual ~LawPart() = default;

    /// Adds to what earlier slots said.
    virtual void add(const ContactSituation& situation, LawTerms& terms) const = 0;

    /// The state for the next step; 0 forgets the contact. A contact beyond the engine's alert
    /// distance is forgotten without a question.
    virtual double remember(const ContactSituation&, const ContactOutcome&) const { return 0.0; }

    /// True if remember() may answer anything but 0.
    virtual bool remembers() const { return false; }

    /// Largest gap at which the part acts [m].
    virtual double range() const { return 0.0; }

    /// True if the part reads `approach` or `free`.
    virtual bool reads_velocities() const { return false; }

    /// True if no pair of these surfaces can feel it: it is then left out.
    virtual bool idle() const { return false; }
};

}  // namespace turbidite::nscd
