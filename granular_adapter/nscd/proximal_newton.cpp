// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/proximal_newton.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "granular_adapter/nscd/augmented_system.hpp"
#include "granular_adapter/nscd/check_schedule.hpp"
#include "granular_adapter/nscd/nlgs.hpp"

namespace turbidite::nscd {
namespace {

constexpr std::int64_t first_sweeps = 200;
// A factorisation costs some hundred sweeps in small packings, two thousand in large ones.
constexpr std::int64_t sweeps_per_step = 500, least_steps = 4;

// Relative weight alpha of the proximal term. A large one is an easy problem and a small move; the
// smallest keeps nine digits of impulses, which come from velocities divided by alpha.
constexpr double first_weight = 1e-2, least_weight = 1e-5, largest_weight = 1.0, factor = 0.1;

constexpr std::int64_t steps_of_a_point = 10;
constexpr int halvings = 10;
constexpr double enough = 1e-3;  ///< of |G| of a proximal point: more digits do not help
constexpr double useful = 0.1;   ///< a point whose |G| fell less than this is not accepted
constexpr double rounding = 1e-13;

using Vector = Eigen::VectorXd;

/// J^-1, factorised again only when J has changed.
class Factorisation {
 public:
    Vector solve(AugmentedSystem& system, double weight, const Vector& right) {
        if (weight != weight_ || system.statuses() != statuses_) {
            const Eigen::SparseMatrix<double>& jacobian = system.jacobian();
            if (statuses_.empty()) lu_.analyzePattern(jacobian);
            lu_.factorize(jacobian);
            if (lu_.info() != Eigen::Success)
                throw std::runtime_error("proximal-newton: the factorisation failed: " +
                                         lu_.lastErrorMessage());
            weight_ = weight;
            statuses_ = system.statuses();
        }
        return lu_.solve(right);
    }

 private:
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::AMDOrdering<int>> lu_;
    std::vector<std::uint8_t> statuses_;
    double weight_ = 0.0;
};

/// What is known: impulses and their residual.
struct Iterate {
    Impulses impulses;
    double residual = 0.0;
};

/// Proximal points, one from the other, with a weight that falls while they succeed.
class ProximalPoints {
 public:
    explicit ProximalPoints(const ContactProblem& problem) : problem_(problem), system_(problem) {}

    std::int64_t steps() const { return steps_; }

    /// The best iterate found from `start` within `budget` Newton steps.
    Iterate improve(const Iterate& start, double tolerance, std::int64_t budget) {
        const std::int64_t end = steps_ + budget;
        Iterate best = start;
        Impulses centre = start.impulses;
        Vector y = system_.velocities_of(centre);
        Weight weight;
        while (steps_ < end && best.residual > tolerance) {
            std::optional<Vector> found = point(centre, y, weight.value, end);
            weight.learn(found.has_value());
            if (!found) continue;
            y = *std::move(found);
            centre = system_.impulses();
            const double residual = natural_map_residual(problem_, centre);
            if (residual < best.residual) best = {centre, residual};
        }
        return best;
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

    /// y of the proximal point around `centre`, with its impulses in the system; nothing when Newton
    /// steps get stuck between statuses. Counts at least one step.
    std::optional<Vector> point(const Impulses& centre, Vector y, double weight, std::int64_t end) {
        system_.set_weight(weight);
        system_.set_centre(centre);
        Vector g = system_.residual(y);
        const double start = g.norm(), target = std::max(rounding, enough * start);
        std::int64_t taken = 0;
        do {
            ++steps_, ++taken;
            if (!advance(y, g, factorisation_.solve(system_, weight, g))) break;
        } while (g.norm() > target && taken < steps_of_a_point && steps_ < end);
        if (!(g.norm() <= std::max(rounding, useful * start))) return std::nullopt;
        return y;
    }

    /// y -= t step with the largest t of 1, 1/2, ... that makes |G| smaller; false without any, and
    /// the system is back at y.
    bool advance(Vector& y, Vector& g, const Vector& step) {
        const double before = g.norm();
        double t = 1.0;
        for (int k = 0; k < halvings; ++k, t *= 0.5) {
            Vector next = system_.residual(y - t * step);
            const double after = next.norm();
            if (!(after < (1.0 - 1e-3 * t) * before || after <= rounding)) continue;
            y -= t * step;
            g = std::move(next);
            return true;
        }
        g = system_.residual(y);
        return false;
    }

    const ContactProblem& problem_;
    AugmentedSystem system_;
    Factorisation factorisation_;
    std::int64_t steps_ = 0;
};

}  // namespace

SolverResult ProximalNewton::solve(const ContactProblem& problem, const Impulses& guess,
                                   const SolverSettings& settings) const {
    check_settings(settings);
    const Nlgs nlgs;
    std::optional<ProximalPoints> newton;
    SolverSettings turn = settings;
    SolverResult result;
    result.impulses = guess;
    std::int64_t used = 0;
    for (std::int64_t sweeps = first_sweeps;; sweeps *= 2) {
        turn.max_iterations = std::min(sweeps, settings.max_iterations - used);
        result = nlgs.solve(problem, result.impulses, turn);
        used += result.iterations;
        if (result.converged || used >= settings.max_iterations) break;
        if (!newton) newton.emplace(problem);
        const std::int64_t before = newton->steps();
        const std::int64_t budget = std::min(std::max(least_steps, sweeps / sweeps_per_step),
                                             settings.max_iterations - used);
        Iterate best =
            newton->improve({result.impulses, result.residual}, settings.tolerance, budget);
        used += newton->steps() - before;
        result.impulses = std::move(best.impulses);
        result.residual = best.residual;
        result.converged = result.residual <= settings.tolerance;
        if (result.converged || used >= settings.max_iterations) break;
    }
    result.iterations = used;
    result.change = change_measures(problem, result.impulses);
    result.velocities = body_velocities(problem, result.impulses);
    return result;
}

}  // namespace turbidite::nscd
