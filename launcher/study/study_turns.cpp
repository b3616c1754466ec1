// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/study_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "coupler/protocol/failure.hpp"
#include "launcher/study/study_record.hpp"

namespace turbidite {
namespace {

/// The other writes the mesh of a run, or the figures of the whole study.
constexpr std::chrono::minutes for_the_others{20};

}  // namespace

StudyTurns::StudyTurns(const std::vector<PlannedRun>& plan, std::filesystem::path out, bool again)
    : plan_(&plan), out_(std::move(out)), again_(again) {
    for (const PlannedRun& run : plan)
        if (state_of(run, out_) == RunState::failed) had_failed_.insert(&run);
}

std::shared_ptr<RunLock> StudyTurns::lock() const {
    auto lock = RunLock::take(out_, for_the_others);
    if (!lock)
        throw Failure(ExitCode::bad_input,
                      fmt::format("{} is kept by another `turbidite study` for more than {} "
                                  "minutes\n  Look whether that one still works.",
                                  out_.string(), for_the_others.count()));
    return lock;
}

bool StudyTurns::is_to_come(const PlannedRun& run) const {
    return given_.count(&run) == 0 && is_left(run);
}

bool StudyTurns::is_left(const PlannedRun& run) const {
    const RunState state = state_of(run, out_);
    return state == RunState::missing || state == RunState::begun ||
           (state == RunState::kept && again_) ||
           (state == RunState::failed && had_failed_.count(&run) > 0);
}

bool StudyTurns::is_free(const PlannedRun& run) const {
    return is_left(run) && !RunLock::is_held(out_ / run.path());
}

std::vector<const PlannedRun*> StudyTurns::to_come() const {
    std::vector<const PlannedRun*> runs;
    for (const PlannedRun& run : *plan_)
        if (is_to_come(run)) runs.push_back(&run);
    return runs;
}

const PlannedRun* StudyTurns::free_run() const {
    for (const PlannedRun& run : *plan_)
        if (given_.count(&run) == 0 && is_free(run)) return &run;
    return nullptr;
}

// A job that was killed may keep its folder for a moment.
const PlannedRun* StudyTurns::next() {
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + RunLock::for_the_killed;
    const PlannedRun* run = free_run();
    for (; run == nullptr && !to_come().empty() && Clock::now() < deadline; run = free_run())
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (run != nullptr) given_.insert(run);
    return run;
}

std::size_t StudyTurns::played_by_others() const {
    return static_cast<std::size_t>(
        std::count_if(plan_->begin(), plan_->end(),
                      [&](const PlannedRun& run) { return RunLock::is_held(out_ / run.path()); }));
}

}  // namespace turbidite
