// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/plane/central_path_solver.hpp"

#include <algorithm>
#include <array>

#include "granular_adapter/nscd/problem/measures.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/solvers/check_schedule.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "granular_adapter/nscd/solvers/plane/central_path.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::nscd {
namespace {

// In large packings as expensive as a path of fifty factorisations.
constexpr std::int64_t sweeps_per_turn = 8000;
// Initial sizes of the paths (path_system.hpp), used in turn, and the factorisations allowed for
// the first; the limit is raised by `growth` each time all sizes have been tried.
constexpr std::array<double, 4> sizes = {30.0, 10.0, 100.0, 300.0};
constexpr std::int64_t first_budget = 1000, growth = 2, most_growths = 6;
// Sweeps are tried when the residual is below `finishing` or the tolerance, and again below `retry`
// of its last value.
constexpr double finishing = 1e-5, retry = 0.3;
constexpr std::int64_t finishing_sweeps = 200;

/// One solve: the best impulses so far, and the iterations used.
class Search {
 public:
    Search(const ContactProblem& problem, const Impulses& guess, const SolverSettings& settings)
        : problem_(problem), settings_(settings), w_(problem), floor_(rounding_floor(problem, w_)) {
        best_.impulses = guess;
        best_.converged = false;
    }

    std::int64_t left() const { return settings_.max_iterations - used_; }
    bool over() const { return best_.converged || left() <= 0; }

    void sweep() { take_if_better(sweeps_from(best_.impulses, sweeps_per_turn)); }

    void try_all_sizes(const ScaledContacts& contacts, std::int64_t budget) {
        for (const double size : sizes) {
            follow(contacts, size, budget);
            if (over()) return;
            sweep();
        }
    }

    void follow(const ScaledContacts& contacts, double size, std::int64_t budget) {
        CentralPath path(contacts, size);
        std::int64_t counted = 0;
        const auto count = [&] {
            // A factorisation counts as one iteration, as a sweep does.
            used_ += path.factorisations() - counted;
            counted = path.factorisations();
        };
        // A point of the path is inside all cones: open contacts have impulses, and none slides. So
        // it is no result by itself, unless sweeps cannot put it on the cones to the tolerance.
        double finish_below = std::max(finishing, settings_.tolerance);
        const std::int64_t most = std::min(budget, left());
        while (!over() && path.advance(std::min(most, path.factorisations() + left()))) {
            count();
            const double residual = look(contacts, path.point());
            if (over() || residual > finish_below) continue;
            finish_below = retry * residual;
            take_if_better(sweeps_from(latest_.impulses, finishing_sweeps));
        }
        count();
        best_.converged = best_.residual <= settings_.tolerance;
    }

    SolverResult result() {
        best_.iterations = used_;
        // Quad and max take a pass of their own: only for the point that is returned.
        if (on_path_)
            best_.change = measures(problem_, w_, best_.velocities, best_.impulses, floor_).change;
        return std::move(best_);
    }

    const Delassus& delassus() const { return w_; }

 private:
    SolverResult sweeps_from(const Impulses& start, std::int64_t most) {
        SolverSettings turn = settings_;
        turn.max_iterations = std::min(most, left());
        SolverResult result = Nlgs().solve(problem_, start, turn);
        used_ += result.iterations;
        return result;
    }

    void take_if_better(SolverResult result) {
        if (looked_ && !result.converged && !(result.residual < best_.residual)) return;
        best_ = std::move(result);
        looked_ = true;
        on_path_ = false;
    }

    double look(const ScaledContacts& contacts, const PathPoint& point) {
        latest_.impulses.resize(contacts.size());
        for (std::size_t k = 0; k < contacts.size(); ++k)
            // A point of the path is judged by the same measure as sweeps, in the units of the
            // problem.
            latest_.impulses[k] = contacts.physical(k, point.r[k]);
        latest_.velocities = body_velocities(problem_, latest_.impulses);
        latest_.residual =
            natural_map_residual(problem_, w_, latest_.velocities, latest_.impulses, floor_);
        latest_.converged = false;
        // A path does not improve the natural map at every step, so the best point is kept.
        if (latest_.residual < best_.residual) best_ = latest_, on_path_ = true;
        return latest_.residual;
    }

    const ContactProblem& problem_;
    const SolverSettings& settings_;
    Delassus w_;
    double floor_;
    SolverResult best_, latest_;
    bool looked_ = false;
    /// `best_` is a point of a path; its quad and max have not been computed
    bool on_path_ = false;
    std::int64_t used_ = 0;
};

}  // namespace

SolverResult CentralPathSolver::solve(const ContactProblem& problem, const Impulses& guess,
                                      const SolverSettings& settings) const {
    check_settings(settings);
    if (problem.contacts.empty()) return {{}, problem.free, 0, 0.0, {}, true};
    Search search(problem, guess, settings);
    search.sweep();
    if (!search.over()) {
        const ScaledContacts contacts(problem, search.delassus());
        std::int64_t budget = first_budget;
        for (int growths = 0; !search.over(); ++growths) {
            search.try_all_sizes(contacts, budget);
            if (growths < most_growths) budget *= growth;
        }
    }
    return search.result();
}

std::unique_ptr<const ContactSolver> make_central_path() {
    return std::make_unique<CentralPathSolver>();
}

}  // namespace turbidite::nscd
