// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/proximal_newton.hpp"

#include <algorithm>
#include <optional>

#include "granular_adapter/nscd/augmented_system.hpp"
#include "granular_adapter/nscd/check_schedule.hpp"
#include "granular_adapter/nscd/newton_equation.hpp"
#include "granular_adapter/nscd/nlgs.hpp"

namespace turbidite::nscd {
namespace {

constexpr std::int64_t first_sweeps = 200;
// A factorisation costs some hundred sweeps in small packings, two thousand in large ones.
constexpr std::int64_t sweeps_per_step = 500, least_steps = 4;

// Relative weight alpha of the proximal term. A large one is an easy problem and a small move; the
// smallest keeps about nine digits of impulses, which come from velocities divided by alpha.
constexpr double first_weight = 1e-2, least_weight = 1e-6, largest_weight = 1.0, factor = 0.1;

constexpr std::int64_t steps_of_a_point = 10;
constexpr int halvings = 10;
constexpr double enough = 1e-3;  ///< of |G| of a proximal point: more digits do not help
constexpr double useful = 0.1;   ///< a point whose |G| fell less than this is not accepted

using Vector = Eigen::VectorXd;

/// What is known: impulses and their residual.
struct Iterate {
    Impulses impulses;
    double residual = 0.0;
};

/// Proximal points, one from the other, with a weight that falls while they succeed. Their
/// residuals may rise for a while before they fall.
class ProximalPoints {
 public:
    explicit ProximalPoints(const ContactProblem& problem) : problem_(problem), system_(problem) {}

    std::int64_t steps() const { return steps_; }
    const Iterate& best() const { return best_; }

    /// Goes on from these impulses instead of its own.
    void restart(const Iterate& from) {
        best_ = from;
        centre_ = from.impulses;
        y_ = system_.velocities_of(centre_);
        weight_ = {};
    }

    /// Takes `budget` Newton steps, or fewer if the best iterate meets the tolerance before.
    void go_on(double tolerance, std::int64_t budget) {
        const std::int64_t end = steps_ + budget;
        while (steps_ < end && best_.residual > tolerance) {
            const bool found = point(end);
            weight_.learn(found);
            if (!found) continue;
            centre_ = system_.impulses();
            const double residual = natural_map_residual(problem_, centre_);
            if (residual < best_.residual) best_ = {centre_, residual};
        }
    }

 private:
    /// After a failure the weight waits longer and longer before it falls again.
    struct Weight {
        double value = first_weight;
        int patience = 1, wait = 0;

        void learn(bool success) {
            if (!success) {
                value = std::min(largest_weight, value / factor);
                patience = std::min(16, 2 * patience);
                wait = patience;
            } else if (--wait <= 0) {
                value = std::max(least_weight, value * factor);
            }
        }
    };

    /// The proximal point around the centre: its velocities are y_, its impulses the system's.
    /// False, and y_ as before, when Newton steps get stuck between statuses. Takes at least one
    /// step.
    bool point(std::int64_t end) {
        system_.set_weight(weight_.value);
        system_.set_centre(centre_);
        Vector y = y_, g = system_.residual(y);
        const double target = enough * g.norm(), limit = useful * g.norm();
        Progress progress = Progress::some;
        for (std::int64_t taken = 0;
             progress == Progress::some && taken < steps_of_a_point && steps_ < end; ++taken) {
            ++steps_;
            progress = advance(y, g, newton_.solve(system_, weight_.value, g));
            if (g.norm() <= target) progress = Progress::all;
        }
        if (progress != Progress::all && !(g.norm() <= limit)) return false;
        y_ = std::move(y);
        return true;
    }

    /// `all`: the whole step changed no status, so that G, linear between, is zero to rounding.
    enum class Progress { none, some, all };

    /// y -= t step with the largest t of 1, 1/2, ... that makes |G| smaller. Without any the system
    /// is back at y.
    Progress advance(Vector& y, Vector& g, const Vector& step) {
        const std::vector<std::uint8_t> statuses = system_.statuses();
        const double before = g.norm();
        double t = 1.0;
        for (int k = 0; k < halvings; ++k, t *= 0.5) {
            Vector next = system_.residual(y - t * step);
            const bool solved = k == 0 && system_.statuses() == statuses;
            if (!solved && !(next.norm() < (1.0 - 1e-3 * t) * before)) continue;
            y -= t * step;
            g = std::move(next);
            return solved ? Progress::all : Progress::some;
        }
        g = system_.residual(y);
        return Progress::none;
    }

    const ContactProblem& problem_;
    AugmentedSystem system_;
    NewtonEquation newton_;
    Iterate best_;
    Impulses centre_;
    Vector y_;
    Weight weight_;
    std::int64_t steps_ = 0;
};

}  // namespace

SolverResult ProximalNewton::solve(const ContactProblem& problem, const Impulses& guess,
                                   const SolverSettings& settings) const {
    check_settings(settings);
    const Nlgs nlgs;
    std::optional<ProximalPoints> points;
    SolverSettings turn = settings;
    SolverResult result;
    result.impulses = guess;
    std::int64_t used = 0;
    for (std::int64_t sweeps = first_sweeps;; sweeps *= 2) {
        turn.max_iterations = std::min(sweeps, settings.max_iterations - used);
        result = nlgs.solve(problem, result.impulses, turn);
        used += result.iterations;
        if (result.converged || used >= settings.max_iterations) break;
        if (!points) points.emplace(problem);
        if (!(points->best().residual <= 10.0 * result.residual) || points->steps() == 0)
            points->restart({result.impulses, result.residual});
        const std::int64_t before = points->steps();
        points->go_on(settings.tolerance, std::min(std::max(least_steps, sweeps / sweeps_per_step),
                                                   settings.max_iterations - used));
        used += points->steps() - before;
        result.converged = points->best().residual <= settings.tolerance;
        if (result.converged || used >= settings.max_iterations) break;
    }
    if (points && points->best().residual < result.residual) {
        result.impulses = points->best().impulses;
        result.residual = points->best().residual;
    }
    result.iterations = used;
    result.change = change_measures(problem, result.impulses);
    result.velocities = body_velocities(problem, result.impulses);
    return result;
}

}  // namespace turbidite::nscd
