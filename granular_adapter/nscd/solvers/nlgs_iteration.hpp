// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One solve of nlgs (nlgs.hpp), for the rows and the operator of any kind of contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "granular_adapter/nscd/problem/measures.hpp"
#include "granular_adapter/nscd/solvers/check_schedule.hpp"
#include "granular_adapter/nscd/solvers/momentum_phases.hpp"
#include "granular_adapter/nscd/sweeps/cell_schedule.hpp"
#include "granular_adapter/nscd/sweeps/momentum.hpp"
#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"
#include "granular_adapter/nscd/sweeps/sweep_pipeline.hpp"

namespace turbidite::nscd {

// Cost of a new layout per group, in updates of a group. A new layout is made when the updates it
// would have saved since the last one add up to its cost.
inline constexpr double layout_cost = 12.0;

// With fewer contacts than this, one thread is faster (docs/performance.md).
inline constexpr std::size_t threaded_contacts = 6000;

/// On several ranks sweeps do not follow each other closely enough for several threads.
inline int useful_threads(const SolverSettings& settings, const ContactProblem& problem) {
    if (problem.ranks || problem.contacts.size() < threaded_contacts) return 1;
    return static_cast<int>(settings.threads);
}

/// What a measuring sweep found.
struct SweepCheck {
    double error = 0.0, size = 0.0;  ///< |natural map|^2 and |r|^2, summed over the contacts
    double loaded = 0.0;             ///< contacts with an impulse
    double visited = 0.0;            ///< groups that sweeps update
    double all = 0.0;                ///< groups

    void add(const SweepCheck& cell) {
        error += cell.error, size += cell.size;
        loaded += cell.loaded, visited += cell.visited, all += cell.all;
    }
};

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
          team_(useful_threads(call.settings, call.problem)),
          phases_(call.settings.momentum_after) {
        result_.impulses = call.guess;
        leave_out_unloaded(result_.impulses);
        result_.converged = false;
    }

    SolverResult run() {
        lay_out();
        while (!result_.converged && result_.iterations < settings_.max_iterations) {
            const std::int64_t before = result_.iterations;
            sweep_until_check();
            const SweepCheck found = check();
            phases_.check(result_.iterations, std::sqrt(found.error / (found.size + floor_)));
            if (looks_good(found) || result_.iterations == settings_.max_iterations)
                look();
            else
                adapt(result_.iterations - before, found);
        }
        return std::move(result_);
    }

 private:
    void leave_out_unloaded(Impulses& r) const {
        for (std::size_t k = 0; k < r.size(); ++k) {
            // A guess may have a tangential part without a normal one, which no solution has; only
            // films pull.
            if (r[k].n > 0.0 || (r[k].n < 0.0 && film_of(problem_, k))) continue;
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
        const auto read = [&](PlainSum& sum, std::size_t k) {
            const Contact& contact = problem_.contacts[k];
            sum.value += floor.term(contact, w_.block(k).nn);
            pairs_.push_back(moved.of(contact));
            active[k] = is_active(k) ? 1 : 0;
        };
        floor_ = sum_over_contacts<PlainSum>(problem_, read).value;
        return active;
    }

    Schedule schedule(const std::vector<std::uint8_t>& active) const {
        const ScheduleSettings shape{.width = Rows::width};
        const std::size_t bodies = w_.bodies().size();
        if (problem_.cells.empty() && !problem_.ranks)
            return make_schedule(pairs_, active, bodies, shape);
        return make_cell_schedule(
            pairs_, active, bodies, shape, problem_.cells,
            problem_.ranks ? problem_.ranks->cell_ends() : std::vector<std::size_t>());
    }

    /// The contact has an impulse, or closes, or its film acts, at the velocities of the initial
    /// guess.
    bool is_active(std::size_t k) const {
        if (result_.impulses[k].n != 0.0) return true;
        const Contact& c = problem_.contacts[k];
        const double u = contact_velocity(c, result_.velocities).n + c.bias.n;
        const Film* const film = film_of(problem_, k);
        return u < 0.0 || (film && film->acts(u));
    }

    void sweep_until_check() {
        std::size_t count = 1;
        while (!check_due(++result_.iterations, settings_)) ++count;
        if (!phases_.with_momentum()) momentum_.restart();
        auto* const momentum = phases_.with_momentum() ? &momentum_ : nullptr;
        if (problem_.ranks)
            pipeline_->run_in_phases(count, momentum,
                                     [this](std::size_t phase) { exchange(phase); });
        else
            pipeline_->run(count, team_, momentum);
    }

    /// Takes over what other ranks have done to bodies.
    void exchange(std::size_t phase) {
        const auto body_of = [this](std::int32_t body) -> typename Rows::Body* {
            const std::int32_t slot = layout_->slots[static_cast<std::size_t>(body)];
            return slot < 0 ? nullptr : &layout_->bodies[static_cast<std::size_t>(slot)];
        };
        problem_.ranks->exchange(
            phase,
            [&](std::int32_t body, double* to) {
                if (const auto* from = body_of(body)) copy_rates(*from, to);
            },
            [&](std::int32_t body, const double* from) {
                if (auto* to = body_of(body)) set_rates(*to, from);
            });
    }

    SweepCheck check() const {
        const Schedule& schedule = layout_->schedule;
        if (!schedule.by_cells)
            return check_of({0, schedule.active}, {schedule.active, schedule.all}, 0);
        std::vector<SweepCheck> of_cells(schedule.cell_ends.size());
        for (std::size_t cell = 0, s = 0; cell < of_cells.size(); ++cell)
            for (; s < schedule.cell_ends[cell]; ++s)
                of_cells[cell].add(
                    check_of(schedule.stretches[s].active, schedule.stretches[s].resting, s));
        return sum_over_cells(problem_, of_cells);
    }

    /// Of these groups, whose sums the pipeline keeps at `place`.
    SweepCheck check_of(const GroupRange& active, const GroupRange& resting,
                        std::size_t place) const {
        const auto& in_active = pipeline_->active_sums(place);
        const auto& in_resting = pipeline_->resting_sums(place);
        const auto awake = [&](std::int32_t group) {
            return layout_->awake.begin() + (group - layout_->schedule.active);
        };
        const std::int32_t moving = active.last - active.first;
        return {
            total(in_active.error) + total(in_resting.error),
            total(in_active.size) + total(in_resting.size),
            total(in_active.loaded) + total(in_resting.loaded),
            static_cast<double>(moving + std::count(awake(resting.first), awake(resting.last), 1)),
            static_cast<double>(moving + resting.last - resting.first)};
    }

    bool looks_good(const SweepCheck& found) const {
        return found.error <= settings_.tolerance * settings_.tolerance * (found.size + floor_);
    }

    /// The reported residual, computed from one consistent state.
    void look() {
        layout_->collect(result_.impulses);
        result_.velocities = body_velocities(problem_, w_.bodies(), result_.impulses);
        const Measures found = measures(problem_, w_, result_.velocities, result_.impulses, floor_);
        result_.residual = found.residual;
        result_.change = found.change;
        result_.converged = result_.residual <= settings_.tolerance;
        if (result_.converged || !may_have_momentum()) return;
        // What momentum has rounded would in the end hide what is left of the error.
        layout_->set_velocities(result_.velocities);
    }

    bool may_have_momentum() const { return result_.iterations > settings_.momentum_after; }

    /// Makes a new layout once the updates spent on groups without impulse have cost as much: in
    /// total at most twice the cost of knowing the future (the ski-rental rule).
    void adapt(std::int64_t sweeps, const SweepCheck& found) {
        const double unloaded = found.visited - found.loaded / Rows::width;
        // What the last new layout could not save is no reason for the next.
        const bool first_look = std::exchange(fresh_, false);
        if (first_look && may_have_momentum()) unavoidable_ = unloaded;
        wasted_ += static_cast<double>(sweeps) * std::max(unloaded - unavoidable_, 0.0);
        // Momentum knows the impulses by their place.
        if (wasted_ < layout_cost * found.all || phases_.with_momentum()) return;
        layout_->rearrange(schedule(layout_->loaded(pairs_.size())));
        pipeline_.emplace(sweeps_, *layout_);
        momentum_ = {};
        wasted_ = 0.0;
        fresh_ = true;
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
    MomentumPhases phases_;
    Momentum<Rows> momentum_;
    bool fresh_ = false;        ///< nothing was measured since the last new layout
    double unavoidable_ = 0.0;  ///< groups that the last new layout has beyond its loaded contacts
    double wasted_ = 0.0;       ///< updates of groups without impulse since the last layout
};

}  // namespace turbidite::nscd
