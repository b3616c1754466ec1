// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/corner_turn.hpp"

namespace turbidite::nscd {
namespace {

/// One of the two bodies of a contact: where the step takes it, and the arm to its own surface
/// point.
struct Partner {
    Partner(const Shift& shift, const Vec3& arm, bool round)
        : shift(shift.displacement), turn(rotation(shift.angle)), arm(arm), round(round) {}

    Vec3 shift;  ///< of its centre [m]
    Rotation turn;
    Vec3 arm;
    bool round;
};

class Shortfall {
 public:
    Shortfall(const SolvedStep& step, const NarrowPhase& shapes) : step_(step), shapes_(shapes) {}

    double operator()(std::size_t k) const {
        const ContactPoint& p = step_.points[k];
        if (p.turns_with == 0) return 0.0;
        // As in the header, O (`owner`) has the side and I is the other; n points from O to I.
        const bool on_a = p.turns_with == 1;
        const Partner a = partner_a(p), b = partner_b(p);
        const Partner &owner = on_a ? a : b, &other = on_a ? b : a;
        const Vec3 normal = on_a ? p.normal : -1.0 * p.normal, turned = owner.turn(normal);
        // D' = g n + dt (v_I - v_O) + (R_I - 1) s_I - (R_O - 1) s_O
        Vec3 apart =
            p.gap * normal + other.shift - owner.shift - (owner.turn(owner.arm) - owner.arm);
        // The surface point of a disc is always the one that faces the side: s_I = -|s_I| n before
        // the step and -|s_I| n' after it, however the disc itself turns.
        apart = apart + (other.round ? norm(other.arm) * (normal - turned)
                                     : other.turn(other.arm) - other.arm);
        // g + dt u_n - n' . D'
        return foreseen(k) - dot(turned, apart);
    }

 private:
    /// g + dt u_n, with walls moving at their own velocity.
    double foreseen(std::size_t k) const {
        const ContactPoint& p = step_.points[k];
        const Contact& contact = step_.contacts[k];
        // The velocity of bodies only: the problem has the motion of walls in its bias, which is
        // not read here since it also contains the law's b_n and the shortfalls of earlier rounds.
        double speed = contact_velocity(contact, step_.velocities).n;
        if (p.wall >= 0)
            speed -= dot(p.normal, velocity_at(wall(p), step_.bodies.position[p.b] + p.arm_b));
        return p.gap + step_.dt * speed;
    }

    const Wall& wall(const ContactPoint& p) const {
        return step_.walls[static_cast<std::size_t>(p.wall)];
    }

    bool is_round(std::int32_t body) const {
        return !shapes_.has_corners(step_.bodies.shape[static_cast<std::size_t>(body)]);
    }

    // Contact points lie half-way across the gap; at walls on the surface of the body.
    Partner partner_a(const ContactPoint& p) const {
        // The surface of the wall is at x_b + arm_b - g n. A wall moves and turns about its pivot,
        // which stands for the centre of a body.
        if (p.wall >= 0) {
            const Vec3 place = step_.bodies.position[p.b] + p.arm_b - p.gap * p.normal;
            return {step_.dt * wall(p).twist, place - wall(p).pivot, false};
        }
        return {step_.dt * step_.velocities[p.a], p.arm_a - 0.5 * p.gap * p.normal, is_round(p.a)};
    }
    Partner partner_b(const ContactPoint& p) const {
        const Vec3 arm = p.wall >= 0 ? p.arm_b : p.arm_b + 0.5 * p.gap * p.normal;
        return {step_.dt * step_.velocities[p.b], arm, is_round(p.b)};
    }

    const SolvedStep& step_;
    const NarrowPhase& shapes_;
};

}  // namespace

std::vector<double> gap_shortfalls(const SolvedStep& step, const NarrowPhase& shapes) {
    const Shortfall shortfall(step, shapes);
    std::vector<double> result;
    result.reserve(step.points.size());
    for (std::size_t k = 0; k < step.points.size(); ++k) result.push_back(shortfall(k));
    return result;
}

}  // namespace turbidite::nscd
