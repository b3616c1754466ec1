// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweep_train.hpp"

namespace turbidite::nscd {
namespace {

// Rows of a block of discs are 14 KiB: short enough to follow closely, long enough that looking
// after the train costs nothing.
constexpr std::int32_t block_size = 32;

std::vector<SweepBlock> cut(const Schedule& schedule) {
    std::vector<SweepBlock> blocks;
    const auto append = [&](std::int32_t first, std::int32_t end) {
        for (; first < end; first += block_size)
            blocks.push_back({first, std::min(first + block_size, end)});
    };
    append(0, schedule.head);
    append(schedule.head, schedule.all);
    return blocks;
}

/// For every body one more than the last of `groups` groups that touches it.
class LastGroups {
 public:
    LastGroups(const Schedule& schedule, const std::vector<MovedPair>& pairs, std::size_t bodies,
               int width, std::int32_t groups)
        : last_(bodies, 0) {
        for (std::int32_t lane = 0; lane < groups * width; ++lane) {
            const std::int32_t contact = schedule.lanes[static_cast<std::size_t>(lane)];
            if (contact < 0) continue;
            const MovedPair& pair = pairs[static_cast<std::size_t>(contact)];
            for (const std::int32_t body : {pair.a, pair.b})
                if (body >= 0) last_[static_cast<std::size_t>(body)] = lane / width + 1;
        }
    }

    std::int32_t of(const MovedPair& pair) const { return std::max(of(pair.a), of(pair.b)); }

 private:
    std::int32_t of(std::int32_t body) const {
        return body < 0 ? 0 : last_[static_cast<std::size_t>(body)];
    }

    std::vector<std::int32_t> last_;
};

}  // namespace

std::vector<SweepBlock> make_blocks(const Schedule& schedule, const std::vector<MovedPair>& pairs,
                                    std::size_t bodies, int width) {
    const LastGroups head(schedule, pairs, bodies, width, schedule.head);
    const LastGroups all(schedule, pairs, bodies, width, schedule.all);
    std::vector<SweepBlock> blocks = cut(schedule);
    for (SweepBlock& block : blocks)
        for (std::int32_t lane = block.first * width; lane < block.last * width; ++lane) {
            const std::int32_t contact = schedule.lanes[static_cast<std::size_t>(lane)];
            if (contact < 0) continue;
            const MovedPair& pair = pairs[static_cast<std::size_t>(contact)];
            block.after_head = std::max(block.after_head, head.of(pair));
            block.after_all = std::max(block.after_all, all.of(pair));
        }
    return blocks;
}

}  // namespace turbidite::nscd
