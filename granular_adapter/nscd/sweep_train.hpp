// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Several sweeps at once over the same groups, with the result of one after the other, bit for bit.
//
// Sweep s + 1 may update a group as soon as sweep s has updated every group that touches one of its
// bodies. As contacts come in an order of space, that is a short way ahead; so sweeps follow each
// other closely, like the wagons of a train, and find in the cache what the first one fetched from
// memory. Threads take successive wagons. Who updates a group when changes nothing in what is read
// and written: results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "granular_adapter/nscd/contact_schedule.hpp"
#include "granular_adapter/nscd/sweep_rows.hpp"
#include "granular_adapter/nscd/thread_team.hpp"

namespace turbidite::nscd {

/// Consecutive groups, [first, last), and how many groups of the sweep before must be done first:
/// when that one is over the head, or over all.
struct SweepBlock {
    std::int32_t first = 0, last = 0;
    std::int32_t after_head = 0, after_all = 0;
};

/// Blocks of the head, then of the rest. `bodies`: one more than the largest body of `pairs`.
std::vector<SweepBlock> make_blocks(const Schedule& schedule, const std::vector<MovedPair>& pairs,
                                    std::size_t bodies, int width);

/// One sweep of a train.
struct Wagon {
    bool whole = true;      ///< all groups, or the head
    bool measured = false;  ///< at most one in a train
};

template <class Rows>
class SweepTrain {
 public:
    using Sums = PassSums<Rows::width>;

    SweepTrain(const Sweeps<Rows>& sweeps, std::vector<Rows>& rows, std::vector<PlaneBody>& bodies,
               const Schedule& schedule, std::vector<SweepBlock> blocks)
        : sweeps_(sweeps),
          rows_(rows),
          bodies_(bodies),
          blocks_(std::move(blocks)),
          head_(static_cast<std::size_t>(std::count_if(
              blocks_.begin(), blocks_.end(),
              [&](const SweepBlock& block) { return block.last <= schedule.head; }))) {}

    /// Runs the wagons, the first one in front.
    void run(const std::vector<Wagon>& wagons, ThreadTeam& team) {
        wagons_ = &wagons;
        sums_head_ = sums_tail_ = {};
        progress_ = std::vector<Progress>(wagons.size());
        const auto share = [&](int thread) {
            return wagons.size() * static_cast<std::size_t>(thread) /
                   static_cast<std::size_t>(team.size());
        };
        team.run([&](int thread) { drive(share(thread), share(thread + 1)); });
    }

    /// Of the measured wagon; groups of the head, and of the rest.
    const Sums& head_sums() const { return sums_head_; }
    const Sums& tail_sums() const { return sums_tail_; }

 private:
    /// Blocks done by a wagon; a cache line of its own.
    struct alignas(64) Progress {
        std::atomic<std::size_t> blocks{0};
        std::atomic<std::int32_t> groups{0};
        Progress() = default;
        Progress(const Progress&) {}
    };

    std::size_t extent(std::size_t wagon) const {
        return (*wagons_)[wagon].whole ? blocks_.size() : head_;
    }

    bool finished(std::size_t wagon) const {
        return progress_[wagon].blocks.load(std::memory_order_relaxed) == extent(wagon);
    }

    bool clear(std::size_t wagon) const {
        if (wagon == 0) return true;
        const SweepBlock& next = blocks_[progress_[wagon].blocks.load(std::memory_order_relaxed)];
        const std::int32_t needed = (*wagons_)[wagon - 1].whole ? next.after_all : next.after_head;
        return progress_[wagon - 1].groups.load(std::memory_order_acquire) >= needed;
    }

    void advance(std::size_t wagon) {
        Progress& progress = progress_[wagon];
        const std::size_t at = progress.blocks.load(std::memory_order_relaxed);
        const SweepBlock& block = blocks_[at];
        Rows* const first = rows_.data() + block.first;
        Rows* const last = rows_.data() + block.last;
        if ((*wagons_)[wagon].measured)
            sweeps_.measured(first, last, bodies_.data(), at < head_ ? sums_head_ : sums_tail_);
        else
            sweeps_.plain(first, last, bodies_.data());
        progress.blocks.store(at + 1, std::memory_order_relaxed);
        progress.groups.store(block.last, std::memory_order_release);
    }

    /// The wagons [first, last) by one thread: a block each in turn, as far as those before allow.
    void drive(std::size_t first, std::size_t last) {
        ThreadTeam::Patience patience;
        while (first < last) {
            bool moved = false;
            for (std::size_t wagon = first; wagon < last; ++wagon) {
                if (finished(wagon)) continue;
                if (!clear(wagon)) break;
                advance(wagon);
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
    std::vector<Rows>& rows_;
    std::vector<PlaneBody>& bodies_;
    std::vector<SweepBlock> blocks_;
    std::size_t head_;  ///< blocks of the head
    const std::vector<Wagon>* wagons_ = nullptr;
    std::vector<Progress> progress_;
    Sums sums_head_, sums_tail_;
};

}  // namespace turbidite::nscd
