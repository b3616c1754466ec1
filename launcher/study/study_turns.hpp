// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Several `turbidite study` may play one study from one folder at the same time: each takes the
// next run that is neither done nor being played. What they share is locked by the run folders
// (RunLock), and by the study's folder while a run is chosen or a common file is written.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <vector>

#include "launcher/job/folder/run_lock.hpp"
#include "launcher/study/study_plan.hpp"

namespace turbidite {

class StudyTurns {
 public:
    /// `plan` must outlive it. `out`: the study's folder, which must exist.
    /// `again`: those that are kept (RunState) are to come as well.
    StudyTurns(const std::vector<PlannedRun>& plan, std::filesystem::path out, bool again = false);

    /// Keeps the others from choosing and writing as long as it lives. Throws Failure (exit code 2)
    /// if another keeps it for minutes.
    std::shared_ptr<RunLock> lock() const;

    /// The first run that is not done, that nobody plays and that was not given before. A run that
    /// had failed is played again, one that fails meanwhile is not. Null if there is none.
    const PlannedRun* next();

    /// Whether it is still to be played and nobody plays it, given or not.
    bool is_free(const PlannedRun& run) const;

    /// Those that are not done and were not given before, also if others play them now.
    std::vector<const PlannedRun*> to_come() const;

    /// Runs that other processes play now.
    std::size_t played_by_others() const;

 private:
    bool is_to_come(const PlannedRun& run) const;
    bool is_left(const PlannedRun& run) const;
    const PlannedRun* free_run() const;

    const std::vector<PlannedRun>* plan_;
    std::filesystem::path out_;
    bool again_;
    std::set<const PlannedRun*> given_;
    std::set<const PlannedRun*> had_failed_;
};

}  // namespace turbidite
