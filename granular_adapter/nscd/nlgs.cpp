// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/nlgs.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "granular_adapter/nscd/check_schedule.hpp"
#include "granular_adapter/nscd/delassus.hpp"
#include "granular_adapter/nscd/residual.hpp"
#include "granular_adapter/nscd/sweep_layout.hpp"
#include "granular_adapter/nscd/sweep_train.hpp"

namespace turbidite::nscd {
namespace {

// A tail below this share of the contacts is not worth a second order of contacts.
constexpr double least_tail = 0.1;
// When more contacts of the tail than this share of the head have an impulse, each sweep takes all:
// impulses that change in one sweep of eight would cost more sweeps than the rest saves.
constexpr double most_awake = 0.02;
// Contacts in the head without impulse, or in the tail with one, that are worth a new layout.
constexpr double least_misplaced = 0.1;
// More rows than this do not stay in the cache: sweeps must overlap (sweep_train.hpp), which head
// and tail one after the other do not. An awake tail is then put back to where it belongs in the
// order.
constexpr std::size_t cached_contacts = 20000;

// Fewer contacts than this are swept faster by one thread (docs/performance.md).
constexpr std::size_t threaded_contacts = 4000;

int useful_threads(const SolverSettings& settings, std::size_t contacts) {
    return contacts < threaded_contacts ? 1 : static_cast<int>(settings.threads);
}

/// Which contacts come first: those with an impulse or about to have one, or all of them.
struct Order {
    std::vector<std::int32_t> contacts;
    std::size_t head = 0;

    explicit Order(std::size_t count) : contacts(count), head(count) {
        std::iota(contacts.begin(), contacts.end(), 0);
    }

    template <class Active>
    void split(const Active& active) {
        const auto tail = std::stable_partition(contacts.begin(), contacts.end(), active);
        const auto first = static_cast<std::size_t>(tail - contacts.begin());
        if (static_cast<double>(contacts.size() - first) <
            least_tail * static_cast<double>(contacts.size()))
            std::iota(contacts.begin(), contacts.end(), 0);
        else
            head = first;
    }
};

/// What solve() is asked.
struct Call {
    const ContactProblem& problem;
    const Delassus& w;
    const Impulses& guess;
    const SolverSettings& settings;
    Instructions instructions;
};

template <class Rows>
class Iteration {
 public:
    explicit Iteration(const Call& call)
        : problem_(call.problem),
          w_(call.w),
          settings_(call.settings),
          sweeps_(sweeps<Rows>(call.instructions)),
          pairs_(moved_pairs(call.problem)),
          team_(useful_threads(call.settings, call.guess.size())),
          floor_(rounding_floor(call.problem, call.w)) {
        result_.impulses = call.guess;
        result_.converged = false;
    }

    SolverResult run() {
        lay_out(true);
        while (!result_.converged && result_.iterations < settings_.max_iterations) {
            sweep_until_check();
            if (looks_good() || result_.iterations == settings_.max_iterations)
                look();
            else
                adapt();
        }
        result_.change = change_measures(problem_, w_, result_.velocities, result_.impulses);
        return std::move(result_);
    }

 private:
    bool split() const { return layout_->schedule.head < layout_->schedule.all; }

    void lay_out(bool may_split) {
        result_.velocities = body_velocities(problem_, result_.impulses);
        Order order(pairs_.size());
        if (may_split) order.split([this](std::int32_t k) { return active(k); });
        const ScheduleSettings shape{.width = Rows::width};
        layout_.emplace(
            problem_, w_, pairs_, result_.impulses, result_.velocities,
            make_schedule(pairs_, order.contacts, order.head, problem_.bodies.size(), shape));
        train_.emplace(sweeps_, layout_->rows, layout_->bodies, layout_->schedule,
                       make_blocks(layout_->schedule, pairs_, problem_.bodies.size(), Rows::width));
        laid_out_at_ = result_.iterations;
        head_ = order.head;
        awake_ = false;
    }

    /// Has an impulse, or closes with the present velocities.
    bool active(std::int32_t contact) const {
        const auto k = static_cast<std::size_t>(contact);
        if (result_.impulses[k][0] > 0.0) return true;
        const Contact& c = problem_.contacts[k];
        return contact_velocity(c, result_.velocities)[0] + c.bias[0] < 0.0;
    }

    void sweep_until_check() {
        std::vector<Wagon> wagons;
        do wagons.push_back({!split() || awake_, false});
        while (!check_due(++result_.iterations, settings_));
        wagons.back() = {true, true};
        train_->run(wagons, team_);
    }

    bool looks_good() const {
        const auto& head = train_->head_sums();
        const auto& tail = train_->tail_sums();
        const double error = total(head.error) + total(tail.error);
        const double size = total(head.size) + total(tail.size);
        return error <= settings_.tolerance * settings_.tolerance * (size + floor_);
    }

    /// The published residual, of one consistent state.
    void look() {
        layout_->collect(result_.impulses);
        result_.velocities = body_velocities(problem_, result_.impulses);
        result_.residual =
            natural_map_residual(problem_, w_, result_.velocities, result_.impulses, floor_);
        result_.converged = result_.residual <= settings_.tolerance;
    }

    /// The tail stays alone while it sleeps; awake it is swept with the head. A layout costs as
    /// much as a few sweeps, so contacts are told apart anew only after as many sweeps as before.
    void adapt() {
        const double head = total(train_->head_sums().loaded);
        const double tail = total(train_->tail_sums().loaded);
        const double misplaced = static_cast<double>(head_) - head + tail;
        awake_ = tail > most_awake * head;
        if (result_.iterations >= 2 * laid_out_at_ && misplaced > least_misplaced * head_)
            lay_out_again(true);
        else if (awake_ && pairs_.size() > cached_contacts)
            lay_out_again(false);
    }

    void lay_out_again(bool may_split) {
        layout_->collect(result_.impulses);
        lay_out(may_split);
    }

    const ContactProblem& problem_;
    const Delassus& w_;
    const SolverSettings& settings_;
    Sweeps<Rows> sweeps_;
    std::vector<MovedPair> pairs_;
    ThreadTeam team_;
    double floor_;
    SolverResult result_;
    std::optional<SweepLayout<Rows>> layout_;
    std::optional<SweepTrain<Rows>> train_;
    std::int64_t laid_out_at_ = 0;  ///< sweep
    std::size_t head_ = 0;          ///< contacts of the head
    bool awake_ = false;            ///< the tail
};

template <class Rows>
SolverResult iterate(const Call& call) {
    return Iteration<Rows>(call).run();
}

}  // namespace

SolverResult Nlgs::solve(const ContactProblem& problem, const Impulses& guess,
                         const SolverSettings& settings) const {
    check_settings(settings);
    if (problem.contacts.empty()) return {{}, problem.free, 0, 0.0, {}, true};
    const Delassus w(problem);
    const Call call{problem, w, guess, settings, instructions_};
    if (w.diagonal())
        return w.rolling() ? iterate<RollingDiscRows<4>>(call) : iterate<DiscRows<4>>(call);
    return w.rolling() ? iterate<GeneralRollingRows<1>>(call) : iterate<GeneralRows<4>>(call);
}

}  // namespace turbidite::nscd
