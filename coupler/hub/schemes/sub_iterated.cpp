// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `sub-iterated` (not in the paper): steps 4 and 5 of `split`, repeated until they agree, for codes
// that cannot take an inertia from the fluid but can repeat a window. Such a code spends an impulse
// of the fluid during its sub-steps (announced_impulse): in the first round that of the last
// window, in the others what this window's multipliers turn out to be.
//
//     grains   from t^n with J_h: U^{n+4/5}, contact impulses J
//     fluid    step 5 with the same J: U'                    c M (U' - U^{n+4/5}) = dt lambda - J_h
//
// U' = U^{n+4/5} where J_h is what the multipliers exert, so J_h is a fixed point; in terms of
// velocities x = J_h/(c M) the iteration is x <- x + (U' - U^{n+4/5}), and a quasi-Newton method
// makes it fast (hub/quasi_newton.hpp). The coupler sends the velocity that each grain should come
// to, U^{n+4/5} plus the change of x; what that takes in impulses is the adapter's affair.
//
//     fluid    window { → constraint → response } → accept → kicks
//     grains   window { → contact_input → motion } → kick → state    contact_input is empty at
//     first
#include <Eigen/Cholesky>
#include <unordered_map>

#include "coupler/hub/quasi_newton.hpp"
#include "coupler/hub/schemes/exchanges.hpp"
#include "coupler/protocol/largest.hpp"
#include "coupler/protocol/run_values.hpp"

namespace turbidite {
namespace {

using Responses = std::vector<FreeResponse>;
using Six = Eigen::Matrix<double, 6, 1>;

Six six(const Vec3& linear, const Vec3& angular) {
    return (Six() << linear[0], linear[1], linear[2], angular[0], angular[1], angular[2])
        .finished();
}

/// U' of a grain: the velocity of a response is U' - A^-1 J (FreeResponse).
Six with_impulse(const FreeResponse& response, const GrainState& grain) {
    const Six free = six(response.velocity, response.angular_velocity);
    Eigen::Matrix<double, 6, 6> inertia;
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = i; j < 6; ++j)
            inertia(i, j) = inertia(j, i) =
                response
                    .inertia[upper_entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j))];
    if (inertia.isZero(0.0)) return free;  // prescribed motion
    // (U', omega') = (velocity, angular velocity) + A^-1 (J, K), with the impulses of the same
    // round.
    return free + inertia.llt().solve(six(grain.contact_impulse, grain.contact_angular_impulse));
}

/// U' - U^{n+4/5} of all grains; angular velocities times R, so that all are lengths per time.
Eigen::VectorXd disagreement(const Motion& motion, const Responses& responses) {
    std::unordered_map<GrainId, const FreeResponse*> of;
    for (const FreeResponse& response : responses) of[response.id] = &response;
    Eigen::VectorXd all(6 * static_cast<Eigen::Index>(motion.grains.size()));
    for (std::size_t g = 0; g < motion.grains.size(); ++g) {
        const GrainState& grain = motion.grains[g];
        Six off =
            with_impulse(*of.at(grain.id), grain) - six(grain.velocity, grain.angular_velocity);
        off.tail<3>() *= grain.radius;
        all.segment<6>(6 * static_cast<Eigen::Index>(g)) = off;
    }
    return all;
}

/// The velocities to come to.
Responses targets(const Motion& motion, const Eigen::VectorXd& change) {
    Responses result;
    for (std::size_t g = 0; g < motion.grains.size(); ++g) {
        const GrainState& grain = motion.grains[g];
        const Six by = change.segment<6>(6 * static_cast<Eigen::Index>(g));
        FreeResponse target;
        target.id = grain.id;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto axis = static_cast<std::size_t>(k);
            target.velocity[axis] = grain.velocity[axis] + by[k];
            target.angular_velocity[axis] = grain.angular_velocity[axis] + by[3 + k] / grain.radius;
        }
        result.push_back(target);
    }
    return result;
}

class SubIterated final : public Scheme {
 public:
    explicit SubIterated(const Settings& settings)
        : tolerance_(settings.real("coupling.tolerance") * run_values(settings).velocity),
          most_rounds_(settings.integer("coupling.iterations")) {}

    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        context.fluid->send_all(Kind::window, window);  // steps 1-3 begin
        context.grains.send_all(Kind::window, window);
        WindowResult result;
        result.joint = JointReport{};
        QuasiNewton iteration;
        // Empty lists in the first round: grains begin with the impulse that they hold already.
        std::vector<Responses> inputs(static_cast<std::size_t>(context.grains.ranks()));
        for (;;) {
            const Responses corrected = play_contact_round(window, before, inputs, context, result);
            const Eigen::VectorXd off = disagreement(result.motion, corrected);
            JointReport& report = *result.joint;
            report.mismatch = largest_of(off);
            report.converged = report.mismatch <= tolerance_;
            if (report.converged || report.rounds >= most_rounds_) break;
            // The next x less the present one, on top of the U^{n+4/5} that the present one has led
            // to.
            inputs = context.plan.by_owner(targets(result.motion, iteration.step(off)));
        }
        send_accept(context);
        finish_window(window, before, context, result);
        return result;
    }

 private:
    /// The first response of a window has no mismatch, so it is measured here.
    static double largest_of(const Eigen::VectorXd& off) {
        double result = 0.0;
        for (Eigen::Index g = 0; g < off.size(); g += 6)
            result = largest(result, off.segment<3>(g).norm() + off.segment<3>(g + 3).norm());
        return result;
    }

    double tolerance_;  ///< [m/s]
    std::int64_t most_rounds_;
};

}  // namespace

SchemeEntry sub_iterated_scheme() {
    return {.name = "sub-iterated",
            .help = "split, repeated until contacts and fluid agree",
            .fluid = {{Kind::window, from_coupler},
                      {Kind::constraint, from_coupler, Times::per_round},
                      {Kind::response, to_coupler, Times::per_round},
                      {Kind::accept, from_coupler},
                      {Kind::kicks, to_coupler}},
            .grains = {{Kind::window, from_coupler},
                       {Kind::contact_input, from_coupler, Times::per_round},
                       {Kind::motion, to_coupler, Times::per_round},
                       {Kind::kick, from_coupler},
                       {Kind::state, to_coupler}},
            .slip_per_mismatch = 0.1,
            .repeats = true,
            .usual_rounds = 4.0,
            .make = [](const Settings& settings) -> std::unique_ptr<Scheme> {
                return std::make_unique<SubIterated>(settings);
            }};
}

}  // namespace turbidite
