// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `joint` (not in the paper): contacts are solved with the combined inertia of the grains and the
// fluid coupled to them by the multipliers.
//
//     fluid    step 5 for free grains: U^F and effective inertia A of each
//     grains   contact problem with U = U^F + A^-1 J
//     fluid    applies J to grains and fluid together: U', momentum exact
//
// U' is U where A is exact. Where it is not (grains that share fluid cells), contacts are solved
// again from U^F = U' - A^-1 J as long as the largest |U' - U| + R |omega' - omega| exceeds
// coupling.tolerance: a fixed-point iteration whose error shrinks by |1 - A_true^-1 A| per round.
// At the end grains take the velocities U' and move with U, which satisfies all contacts.
//
//     fluid    window → bodies → response { → constraint → response } → accept → kicks
//     grains   window { → contact_input → motion } → kick → state
#include "coupler/hub/schemes/exchanges.hpp"
#include "coupler/protocol/largest.hpp"
#include "coupler/protocol/run_values.hpp"

namespace turbidite {
namespace {

using Responses = std::vector<FreeResponse>;

double largest_mismatch(const Responses& responses) {
    double result = 0.0;
    for (const FreeResponse& response : responses) result = largest(result, response.mismatch);
    return result;
}

class Joint final : public Scheme {
 public:
    explicit Joint(const Settings& settings)
        : tolerance_(settings.real("coupling.tolerance") * run_values(settings).velocity),
          most_rounds_(settings.integer("coupling.iterations")) {}

    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        context.fluid->send_all(Kind::window, window);  // steps 1-3 begin
        context.grains.send_all(Kind::window, window);
        // With U^n: the fluid lets the grains fall for this window as if there were no contacts.
        context.fluid->send_each(Kind::bodies, context.plan.by_place(before));
        WindowResult result;
        result.joint = JointReport{};
        Responses responses = receive_responses(window, context);
        // At least one round. A window that uses up coupling.iterations goes on: U' keeps the
        // momentum of grains and fluid and violates contacts a little, which the next window
        // corrects.
        do responses = play_round(window, before, std::move(responses), context, result);
        while (!result.joint->converged && result.joint->rounds < most_rounds_);
        send_accept(context);
        finish_window(window, before, context, result);
        return result;
    }

 private:
    /// One contact solve and the fluid's response.
    Responses play_round(const Window& window, const Motion& before, Responses responses,
                         SchemeContext& context, WindowResult& result) const {
        Responses corrected = play_contact_round(
            window, before, context.plan.by_owner(std::move(responses)), context, result);
        JointReport& report = *result.joint;
        report.mismatch = largest_mismatch(corrected);
        report.converged = report.mismatch <= tolerance_;
        return corrected;
    }

    double tolerance_;  ///< [m/s]
    std::int64_t most_rounds_;
};

}  // namespace

SchemeEntry joint_scheme() {
    return {.name = "joint",
            .help = "contacts solved with the fluid's effective inertia",
            .fluid = {{Kind::window, from_coupler},
                      {Kind::bodies, from_coupler},
                      {Kind::response, to_coupler},
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
            .usual_rounds = 2.0,
            .make = [](const Settings& settings) -> std::unique_ptr<Scheme> {
                return std::make_unique<Joint>(settings);
            }};
}

}  // namespace turbidite
