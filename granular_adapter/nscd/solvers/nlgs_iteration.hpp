// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One solve of nlgs (nlgs.hpp), for the rows and the operator of any kind of contact.
#pragma once

#include <algorithm>
#include <optional>

#include "granular_adapter/nscd/problem/measures.hpp"
#include "granular_adapter/nscd/solvers/check_schedule.hpp"
#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"
#include "granular_adapter/nscd/sweeps/sweep_pipeline.hpp"

namespace turbidite::nscd {

// Cost of a new layout per group, in updates of a group. A new layout is made when the updates it
// would have saved since the last one add up to its cost.
inline constexpr double layout_cost = 12.0;

// With fewer contacts than this, one thread is faster (docs/performance.md).
inline constexpr std::size_t threaded_contacts = 6000;

inline int useful_threads(const SolverSettings& settings, std::size_t contacts) {
    return contacts < threaded_contacts ? 1 : static_cast<int>(settings.threads);
}

/// Arguments of a solve.
template <ContactOperator W>
struct NlgsCall {
    const ContactProblem& problem;
    const W& w;
    const Impulses& guess;
    const SolverSettings& settings;
    Instructions instructions;
};

template <class Rows, ContactOperator W>
class NlgsIteration {
 public:
    explicit NlgsIteration(const NlgsCall<W>& call)
        : problem_(call.problem),
          w_(call.w),
          settings_(call.settings),
          sweeps_(sweeps<Rows>(call.instructions)),
          team_(useful_threads(call.settings, call.guess.size())) {
        result_.impulses = call.guess;
        leave_out_unloaded(result_.impulses);
        result_.converged = false;
    }

    SolverResult run() {
        lay_out();
        while (!result_.converged && result_.iterations < settings_.max_iterations) {
            const std::int64_t before = result_.iterations;
            sweep_until_check();
            if (looks_good() || result_.iterations == settings_.max_iterations)
                look();
            else
                adapt(result_.iterations - before);
        }
        return std::move(result_);
    }

 private:
    static void leave_out_unloaded(Impulses& r) {
        for (std::size_t k = 0; k < r.size(); ++k) {
            if (r[k].n > 0.0) continue;
            r[k] = {};
            if (!r.moments.empty()) r.moments[k] = {};
        }
    }

    void lay_out() {
        result_.velocities = body_velocities(problem_, w_.bodies(), result_.impulses);
        const std::vector<std::uint8_t> active = read_contacts();
        layout_.emplace(problem_, w_, pairs_, result_.impulses, result_.velocities,
                        schedule(active));
        pipeline_.emplace(sweeps_, *layout_);
    }

    /// Sets pairs and floor, and returns which contacts are active: one pass, since the contacts of
    /// a large problem are in no cache.
    std::vector<std::uint8_t> read_contacts() {
        const std::size_t count = problem_.contacts.size();
        const RoundingFloor floor(problem_);
        const MovedBodies moved(w_.bodies());
        std::vector<std::uint8_t> active(count);
        pairs_.reserve(count);
        for (std::size_t k = 0; k < count; ++k) {
            const Contact& contact = problem_.contacts[k];
            floor_ += floor.term(contact, w_.block(k).nn);
            pairs_.push_back(moved.of(contact));
            active[k] = is_active(k) ? 1 : 0;
        }
        return active;
    }

    Schedule schedule(const std::vector<std::uint8_t>& active) const {
        const ScheduleSettings shape{.width = Rows::width};
        return make_schedule(pairs_, active, w_.bodies().size(), shape);
    }

    /// The contact has an impulse, or closes at the velocities of the initial guess.
    bool is_active(std::size_t k) const {
        if (result_.impulses[k].n > 0.0) return true;
        const Contact& c = problem_.contacts[k];
        return contact_velocity(c, result_.velocities).n + c.bias.n < 0.0;
    }

    void sweep_until_check() {
        std::size_t count = 1;
        while (!check_due(++result_.iterations, settings_)) ++count;
        pipeline_->run(count, team_);
    }

    bool looks_good() const {
        const auto& active = pipeline_->active_sums();
        const auto& resting = pipeline_->resting_sums();
        const double error = total(active.error) + total(resting.error);
        const double size = total(active.size) + total(resting.size);
        return error <= settings_.tolerance * settings_.tolerance * (size + floor_);
    }

    /// The reported residual, computed from one consistent state.
    void look() {
        layout_->collect(result_.impulses);
        result_.velocities = body_velocities(problem_, w_.bodies(), result_.impulses);
        const Measures found = measures(problem_, w_, result_.velocities, result_.impulses, floor_);
        result_.residual = found.residual;
        result_.change = found.change;
        result_.converged = result_.residual <= settings_.tolerance;
    }

    /// Makes a new layout once the updates spent on groups without impulse have cost as much: in
    /// total at most twice the cost of knowing the future (the ski-rental rule).
    void adapt(std::int64_t sweeps) {
        const double loaded =
            total(pipeline_->active_sums().loaded) + total(pipeline_->resting_sums().loaded);
        const auto awake = std::count(layout_->awake.begin(), layout_->awake.end(), 1);
        const double visited = layout_->schedule.active + static_cast<double>(awake);
        wasted_ += static_cast<double>(sweeps) * (visited - loaded / Rows::width);
        if (wasted_ < layout_cost * layout_->schedule.all) return;
        layout_->rearrange(schedule(layout_->loaded(pairs_.size())));
        wasted_ = 0.0;
    }

    const ContactProblem& problem_;
    const W& w_;
    const SolverSettings& settings_;
    Sweeps<Rows> sweeps_;
    std::vector<MovedPair> pairs_;
    ThreadTeam team_;
    double floor_ = 0.0;
    SolverResult result_;
    std::optional<SweepLayout<Rows>> layout_;
    std::optional<SweepPipeline<Rows>> pipeline_;
    double wasted_ = 0.0;  ///< updates of groups without impulse since the last layout
};

}  // namespace turbidite::nscd
