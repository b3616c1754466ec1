// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Several sweeps over the same groups at once, as a pipeline, with bitwise the result of one sweep
// after the other.
//
// Sweep s + 1 may process a stretch as soon as sweep s has processed every stretch that touches one
// of its bodies. Since contacts are ordered in space, sweep s need only be a little ahead. The
// sweeps therefore follow each other closely and find in the cache what the first one loaded from
// memory. Threads take consecutive sweeps. Which thread updates a group, and when, does not change
// what is read and written: results do not depend on the number of threads.
//
// In the order of cells (cell_schedule.hpp) the first stretches of a sweep wait for the last ones
// of the sweep before. There threads share the stretches of each sweep instead
// (stretch_layers.hpp).
#pragma once

#include <array>
#include <atomic>
#include <cstring>
#include <optional>
#include <vector>

#include "granular_adapter/nscd/sweeps/momentum.hpp"
#include "granular_adapter/nscd/sweeps/stretch_layers.hpp"
#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"
#include "granular_adapter/nscd/threads/thread_team.hpp"

namespace turbidite::nscd {

template <class Rows>
class SweepPipeline {
 public:
    using Sums = PassSums<Rows::width>;

    SweepPipeline(const Sweeps<Rows>& sweeps, SweepLayout<Rows>& layout)
        : sweeps_(sweeps), layout_(layout) {}

    /// Runs the given number of sweeps. All of them update the active groups and the reactivated
    /// groups at rest (`awake`). The last one also measures, tests all groups at rest, and sets
    /// which of them are `awake`. `momentum`: that of all of them, or null.
    void run(std::size_t sweeps, ThreadTeam& team, Momentum<Rows>* momentum = nullptr) {
        prepare(sweeps, momentum);
        if (layout_.schedule.by_cells && team.size() > 1)
            run_in_layers(sweeps, team);
        else
            run_in_turns(sweeps, team);
        if (momentum) momentum->advance(sweeps);
    }

    /// The same, sweep after sweep, in the phases of the schedule; `after(phase)` ends each of
    /// them.
    template <class After>
    void run_in_phases(std::size_t sweeps, Momentum<Rows>* momentum, const After& after) {
        prepare(sweeps, momentum);
        const std::vector<std::size_t>& ends = layout_.schedule.phase_ends;
        for (std::size_t sweep = 0; sweep < sweeps; ++sweep) {
            // All bodies at once: another rank may use those of this one before it does.
            if (momentum) momentum->extrapolate_bodies(layout_, momentum->beta(sweep));
            std::size_t at = 0;
            for (std::size_t phase = 0; phase < ends.size(); after(phase++))
                for (; at < ends[phase]; ++at) visit(at, sweep);
        }
        if (momentum) momentum->advance(sweeps);
    }

    /// Sums of the last sweep over active groups, and over groups at rest; of a schedule
    /// by cells one per stretch.
    const Sums& active_sums(std::size_t stretch = 0) const { return active_sums_[stretch]; }
    const Sums& resting_sums(std::size_t stretch = 0) const { return resting_sums_[stretch]; }

 private:
    /// Number of stretches completed by a sweep, in a cache line of its own.
    struct alignas(64) Progress {
        std::atomic<std::size_t> stretches{0};
        Progress() = default;
        Progress(const Progress&) {}
    };

    void run_in_turns(std::size_t sweeps, ThreadTeam& team) {
        progress_ = std::vector<Progress>(sweeps);
        team.run([&](int thread) {
            drive(team.part_begin(sweeps, thread), team.part_begin(sweeps, thread + 1));
        });
    }

    void run_in_layers(std::size_t sweeps, ThreadTeam& team) {
        if (!layers_) layers_.emplace(layout_, team.size());
        ThreadTeam::Meeting meeting(team.size());
        // Of this sweep and of the one before, which no thread is in any more when it is set back.
        std::array<SharedLayers, 2> shared{SharedLayers(*layers_), SharedLayers(*layers_)};
        team.run([&](int thread) {
            for (std::size_t sweep = 0; sweep < sweeps; ++sweep)
                for (std::size_t layer = 0; layer < layers_->layers.size(); ++layer) {
                    if (thread == 0) shared[(sweep + 1) % 2].refill(layer);
                    shared[sweep % 2].each(layer, thread,
                                           [&](std::size_t at) { visit_with_bodies(at, sweep); });
                    meeting.wait();
                }
        });
    }

    void prepare(std::size_t sweeps, Momentum<Rows>* momentum) {
        last_sweep_ = sweeps - 1, momentum_ = momentum;
        if (momentum) momentum->prepare(layout_);
        active_sums_.assign(layout_.schedule.by_cells ? stretches().size() : 1, {});
        resting_sums_ = active_sums_;
    }
    std::size_t place_of_sums(std::size_t stretch) const {
        return layout_.schedule.by_cells ? stretch : 0;
    }

    const std::vector<Stretch>& stretches() const { return layout_.schedule.stretches; }
    std::size_t done(std::size_t sweep) const {
        return progress_[sweep].stretches.load(std::memory_order_relaxed);
    }
    bool finished(std::size_t sweep) const { return done(sweep) == stretches().size(); }

    bool clear(std::size_t sweep) const {
        return sweep == 0 || progress_[sweep - 1].stretches.load(std::memory_order_acquire) >=
                                 static_cast<std::size_t>(stretches()[done(sweep)].after);
    }

    void advance(std::size_t sweep) {
        const std::size_t at = done(sweep);
        visit_with_bodies(at, sweep);
        progress_[sweep].stretches.store(at + 1, std::memory_order_release);
    }

    Rows* row(std::int32_t group) { return layout_.rows.data() + group; }
    std::uint8_t& awake(std::int32_t group) {
        return layout_.awake[static_cast<std::size_t>(group - layout_.schedule.active)];
    }

    /// The first reactivated group of the range, or its end; most are not.
    std::int32_t next_awake(const GroupRange& range) {
        if (range.first >= range.last) return range.last;
        const std::uint8_t* const from = &awake(range.first);
        const auto* const found = static_cast<const std::uint8_t*>(
            std::memchr(from, 1, static_cast<std::size_t>(range.last - range.first)));
        return found == nullptr ? range.last
                                : range.first + static_cast<std::int32_t>(found - from);
    }

    void visit_with_bodies(std::size_t at, std::size_t sweep) {
        if (momentum_) momentum_->extrapolate_bodies(layout_, at, momentum_->beta(sweep));
        visit(at, sweep);
    }

    void visit(std::size_t at, std::size_t sweep) {
        if (momentum_)
            momentum_->extrapolate_groups(layout_, stretches()[at], momentum_->beta(sweep));
        if (sweep == last_sweep_)
            measure(at);
        else
            update(at);
    }

    void update(std::size_t at) {
        const Stretch& stretch = stretches()[at];
        typename Rows::Body* const bodies = layout_.bodies.data();
        sweeps_.plain(row(stretch.active.first), row(stretch.active.last), bodies);
        for (std::int32_t group = next_awake(stretch.resting); group < stretch.resting.last;
             group = next_awake({group + 1, stretch.resting.last}))
            sweeps_.plain(row(group), row(group) + 1, bodies);
    }

    void measure(std::size_t at) {
        const Stretch& stretch = stretches()[at];
        typename Rows::Body* const bodies = layout_.bodies.data();
        sweeps_.measured(row(stretch.active.first), row(stretch.active.last), bodies,
                         active_sums_[place_of_sums(at)]);
        if (stretch.resting.first < stretch.resting.last)
            sweeps_.asked(row(stretch.resting.first), row(stretch.resting.last), bodies,
                          resting_sums_[place_of_sums(at)], &awake(stretch.resting.first));
    }

    /// Runs the sweeps [first, last) in one thread: one stretch of each in turn, as far as the
    /// sweeps before them allow.
    void drive(std::size_t first, std::size_t last) {
        ThreadTeam::Patience patience;
        while (first < last) {
            bool moved = false;
            for (std::size_t sweep = first; sweep < last; ++sweep) {
                if (finished(sweep)) continue;
                if (!clear(sweep)) break;
                advance(sweep);
                moved = true;
            }
            while (first < last && finished(first)) ++first;
            if (moved)
                patience = {};
            else
                patience.wait();
        }
    }

    Sweeps<Rows> sweeps_;
    SweepLayout<Rows>& layout_;
    std::vector<Progress> progress_;
    std::optional<StretchLayers> layers_;
    std::size_t last_sweep_ = 0;
    Momentum<Rows>* momentum_ = nullptr;
    std::vector<Sums> active_sums_, resting_sums_;
};

}  // namespace turbidite::nscd
