// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checkpoints from the coupler's side: every rank writes its state, the coupler its own, then the
// set is read back and put in its place (checkpoint/checkpoint_sets.hpp). A set that cannot be
// written, or that is not what its writers say, is told, and the run goes on: those before it stay.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupler/checkpoint/checkpoint_rule.hpp"
#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/hub/coupler_state.hpp"
#include "coupler/hub/watch.hpp"

namespace turbidite {

class Checkpoints {
 public:
    using Print = std::function<void(const std::string&)>;

    Checkpoints(const Settings& settings, const RunValues& run, std::filesystem::path run_folder,
                std::vector<ParticipantLink*> links, Watch& watch, Print print);

    /// After the handshake: notes who cannot save its state, and says so once.
    void meet_participants();

    /// Without a rule or with a participant that cannot save, there are none at the start and end.
    bool by_rule() const { return rule_.any() && able_; }
    bool due(std::int64_t windows) const { return able_ && rule_.due(windows); }

    /// Between two windows, with the state after so many. What it throws counts as a set that
    /// cannot be written. Returns whether there is a new set.
    bool write(std::int64_t windows, const std::function<CouplerState()>& state);

    /// Before the first window of a resumed run: every rank takes its state from the set.
    void restore(const std::string& name);

    /// Windows done at the last set; -1: there was none.
    std::int64_t last() const { return last_; }

    std::int64_t written() const { return written_; }
    double seconds() const { return seconds_; }  ///< spent in write()

 private:
    template <class Action>
    static std::string fault_of(Action action);
    std::string attempt(const std::function<CouplerState()>& state);
    Manifest described(const CouplerState& state) const;
    std::vector<StoredFile> collect(ParticipantLink& link, std::string& fault);
    std::string sets_left() const;

    const Settings& settings_;
    RunValues run_;
    CheckpointRule rule_;
    std::filesystem::path run_folder_;
    CheckpointSets sets_;
    std::vector<ParticipantLink*> links_;
    Watch& watch_;
    Print print_;
    bool able_ = true;
    std::int64_t written_ = 0;
    std::int64_t last_ = -1;
    double seconds_ = 0.0;
};

}  // namespace turbidite
