// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checkpoints.hpp"

#include <fmt/format.h>

#include <utility>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/received.hpp"

namespace turbidite {

Checkpoints::Checkpoints(const Settings& settings, const RunValues& run,
                         std::filesystem::path run_folder, std::vector<ParticipantLink*> links,
                         Watch& watch, Print print)
    : settings_(settings),
      run_(run),
      rule_(settings, run),
      run_folder_(std::move(run_folder)),
      sets_(run_folder_),
      links_(std::move(links)),
      watch_(watch),
      print_(std::move(print)) {}

void Checkpoints::meet_participants() {
    for (const ParticipantLink* link : links_)
        for (int rank = 0; rank < link->ranks(); ++rank) {
            if (link->hello(rank).capabilities.saves_state) continue;
            // Told once, and only where the case has asked for checkpoints.
            if (rule_.any() && able_)
                print_(
                    fmt::format("turbidite: {} cannot save its state; the run has no checkpoints",
                                link->program()));
            able_ = false;
        }
}

bool Checkpoints::write(std::int64_t windows, const std::function<CouplerState()>& state) {
    if (!able_) return false;
    const auto start = CheckpointRule::Clock::now();
    const std::string fault = attempt(state);
    if (fault.empty()) {
        ++written_;
        last_ = windows;
    } else {
        sets_.remove_unfinished();
        print_(fmt::format("turbidite: warning: no checkpoint after window {}: {}. {}", windows,
                           fault, sets_left()));
    }
    // After a failure as well: a full disk is not tried again in every window.
    rule_.written();
    seconds_ += std::chrono::duration<double>(CheckpointRule::Clock::now() - start).count();
    return fault.empty();
}

std::string Checkpoints::sets_left() const {
    const std::vector<std::string> names = sets_.names();
    if (names.empty()) return "There is none yet.";
    return fmt::format("The last one is {}.", CheckpointSets::folder(names.front()));
}

/// Why an action on files failed; empty if it did not.
template <class Action>
std::string Checkpoints::fault_of(Action action) {
    try {
        action();
        return {};
    } catch (const std::exception& error) {
        return error.what();
    }
}

/// Why the set could not be written; empty if it is in its place.
std::string Checkpoints::attempt(const std::function<CouplerState()>& state_now) {
    std::string folder;
    CouplerState state;
    std::string fault = fault_of([&] {
        state = state_now();
        sets_.remove_unfinished();
        folder = sets_.begin(state.windows);
    });
    if (!fault.empty()) return fault;
    Manifest manifest = described(state);
    // All are asked before any answer is waited for: programs write at the same time.
    for (ParticipantLink* link : links_) link->send_all(Kind::save, CheckpointPlace{folder});
    for (ParticipantLink* link : links_)
        // Answers of all are taken even after a fault: they are due, and the run goes on.
        (link->role() == Role::fluid ? manifest.fluid : manifest.grains) = collect(*link, fault);
    if (!fault.empty()) return fault;
    return fault_of([&] {
        // The coupler's part last: only commit() makes a set of the files, by a rename.
        manifest.coupler = store(run_folder_ / folder, "coupler", encode(state));
        sets_.commit(manifest);
        sets_.keep_newest(rule_.keep());
    });
}

Manifest Checkpoints::described(const CouplerState& state) const {
    Manifest manifest;
    manifest.case_hash = settings_.text("run.hash");
    manifest.windows = state.windows;
    // [t_c], for those who read the file.
    manifest.time = static_cast<double>(state.windows) * run_.step / run_.time;
    manifest.settings = settings_;
    return manifest;
}

/// Waits for all ranks; the first fault that one of them tells becomes `fault`.
std::vector<StoredFile> Checkpoints::collect(ParticipantLink& link, std::string& fault) {
    watch_.wait_for(link, Kind::saved);
    std::vector<StoredFile> files;
    for (const SavedPart& part : link.take<SavedPart>(Kind::saved)) {
        const int rank = static_cast<int>(files.size());
        if (!part.fault.empty() && fault.empty())
            fault = link.rank_name(rank) + ": " + received_text(part.fault);
        files.push_back(part.file);
    }
    return files;
}

void Checkpoints::restore(const std::string& name) {
    const Manifest manifest = sets_.manifest(name);
    const std::string folder = CheckpointSets::folder(name);
    for (ParticipantLink* link : links_)
        link->send_all(Kind::restore,
                       RestoreOrder{folder, manifest.windows, manifest.parts(link->role())});
    for (ParticipantLink* link : links_) {
        watch_.wait_for(*link, Kind::restored);
        link->discard(Kind::restored);
        // Both ends count from here: the next envelope has this index.
        link->go_on_after(manifest.windows);
    }
    rule_.written();
}

}  // namespace turbidite
