// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/contact_schedule.hpp"

#include <algorithm>
#include <bit>

namespace turbidite::nscd {
namespace {

/// The groups that still take contacts: 64 at most, one bit each.
class Placement {
 public:
    Placement(std::size_t bodies, const ScheduleSettings& settings)
        : settings_(settings), ready_(bodies, 0) {}

    void place(std::int32_t contact, const MovedPair& pair) {
        const std::int32_t group = first_free(std::max(ready(pair.a), ready(pair.b)));
        if (group >= groups()) {
            lanes_.resize(static_cast<std::size_t>(group + 1) * width(), -1);
            count_.resize(static_cast<std::size_t>(group) + 1, 0);
        }
        const auto at = static_cast<std::size_t>(group);
        lanes_[at * width() + count_[at]] = contact;
        if (++count_[at] == width()) open_ &= ~(std::uint64_t{1} << (group - first_));
        const std::int32_t next = group + settings_.distance;
        if (pair.a >= 0) ready_[static_cast<std::size_t>(pair.a)] = next;
        if (pair.b >= 0) ready_[static_cast<std::size_t>(pair.b)] = next;
    }

    /// What comes now shares no group with what came before.
    void close() {
        first_ = groups();
        open_ = ~std::uint64_t{0};
    }

    std::int32_t groups() const { return static_cast<std::int32_t>(count_.size()); }
    std::vector<std::int32_t> take_lanes() { return std::move(lanes_); }

 private:
    std::size_t width() const { return static_cast<std::size_t>(settings_.width); }
    std::int32_t ready(std::int32_t body) const {
        return body < 0 ? 0 : ready_[static_cast<std::size_t>(body)];
    }

    std::int32_t first_free(std::int32_t earliest) {
        earliest = std::max(earliest, first_);
        if (earliest >= first_ + 64) advance(earliest - 63);
        if (const std::uint64_t later = open_ >> (earliest - first_); later != 0)
            return earliest + std::countr_zero(later);
        advance(first_ + 1);
        return first_ + 63;
    }

    void advance(std::int32_t first) {
        const std::int32_t by = first - first_;
        open_ = by >= 64 ? ~std::uint64_t{0} : (open_ >> by) | ~(~std::uint64_t{0} >> by);
        first_ = first;
    }

    ScheduleSettings settings_;
    std::vector<std::int32_t> ready_;  ///< of each body: its next contact's first group
    std::vector<std::int32_t> lanes_;
    std::vector<std::uint8_t> count_;  ///< contacts in each group
    std::int32_t first_ = 0;           ///< oldest open group
    std::uint64_t open_ = ~std::uint64_t{0};
};

}  // namespace

Schedule make_schedule(const std::vector<MovedPair>& pairs, const std::vector<std::int32_t>& order,
                       std::size_t head, std::size_t bodies, const ScheduleSettings& settings) {
    Placement placement(bodies, settings);
    Schedule schedule;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == head) {
            schedule.head = placement.groups();
            placement.close();
        }
        placement.place(order[i], pairs[static_cast<std::size_t>(order[i])]);
    }
    schedule.all = placement.groups();
    if (head >= order.size()) schedule.head = schedule.all;
    schedule.lanes = placement.take_lanes();
    return schedule;
}

}  // namespace turbidite::nscd
