// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/contact_schedule.hpp"

#include <algorithm>
#include <bit>

namespace turbidite::nscd {
namespace {

/// The open groups, which still accept contacts: at most 64, one bit each.
class Placement {
 public:
    Placement(std::size_t bodies, const ScheduleSettings& settings)
        : settings_(settings), ready_(bodies, 0) {}

    void place(std::int32_t contact, const MovedPair& pair) {
        // Not before the group after which both bodies are free: contacts of one body keep their
        // order.
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

    std::int32_t groups() const { return static_cast<std::int32_t>(count_.size()); }
    std::vector<std::int32_t> take_lanes() { return std::move(lanes_); }

 private:
    std::size_t width() const { return static_cast<std::size_t>(settings_.width); }
    std::int32_t ready(std::int32_t body) const {
        return body < 0 ? 0 : ready_[static_cast<std::size_t>(body)];
    }

    std::int32_t first_free(std::int32_t earliest) {
        earliest = std::max(earliest, first_);
        // Only 64 groups are open: older ones are closed as they are, with empty lanes.
        if (earliest >= first_ + 64) advance(earliest - 63);
        if (const std::uint64_t later = open_ >> (earliest - first_); later != 0)
            return earliest + std::countr_zero(later);
        // All open groups from `earliest` on are full: a new one, the last of the 64.
        advance(first_ + 1);
        return first_ + 63;
    }

    void advance(std::int32_t first) {
        const std::int32_t by = first - first_;
        // The groups that enter at the end are open.
        open_ = by >= 64 ? ~std::uint64_t{0} : (open_ >> by) | ~(~std::uint64_t{0} >> by);
        first_ = first;
    }

    ScheduleSettings settings_;
    std::vector<std::int32_t> ready_;  ///< by body: first group that its next contact may enter
    std::vector<std::int32_t> lanes_;
    std::vector<std::uint8_t> count_;  ///< contacts in each group
    std::int32_t first_ = 0;           ///< oldest open group
    std::uint64_t open_ = ~std::uint64_t{0};
};

/// By body, the number of stretches up to the last one that touches it.
class LastStretches {
 public:
    LastStretches(const Schedule& schedule, const std::vector<MovedPair>& pairs, std::size_t bodies,
                  int width)
        : schedule_(schedule), pairs_(pairs), width_(width), last_(bodies, 0) {
        for (std::size_t s = 0; s < schedule.stretches.size(); ++s)
            each_body(schedule.stretches[s],
                      [&](std::size_t body) { last_[body] = static_cast<std::int32_t>(s) + 1; });
    }

    /// Stretch::after of stretch s; at least s + 1, the stretch itself.
    std::int32_t of(std::size_t s) const {
        auto last = static_cast<std::int32_t>(s) + 1;
        each_body(schedule_.stretches[s],
                  [&](std::size_t body) { last = std::max(last, last_[body]); });
        return last;
    }

 private:
    template <class Visit>
    void each_body(const Stretch& stretch, const Visit& visit) const {
        for (const GroupRange& range : {stretch.active, stretch.resting})
            for (std::int32_t i = range.first * width_; i < range.last * width_; ++i) {
                const std::int32_t contact = schedule_.lanes[static_cast<std::size_t>(i)];
                if (contact < 0) continue;
                const MovedPair& pair = pairs_[static_cast<std::size_t>(contact)];
                for (const std::int32_t body : {pair.a, pair.b})
                    if (body >= 0) visit(static_cast<std::size_t>(body));
            }
    }

    const Schedule& schedule_;
    const std::vector<MovedPair>& pairs_;
    std::int32_t width_;
    std::vector<std::int32_t> last_;
};

}  // namespace

Schedule make_schedule(const std::vector<MovedPair>& pairs, const std::vector<std::uint8_t>& active,
                       std::size_t bodies, const ScheduleSettings& settings) {
    Placement moving(bodies, settings), resting(bodies, settings);
    Schedule schedule;
    Stretch last;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        (active[k] != 0 ? moving : resting).place(static_cast<std::int32_t>(k), pairs[k]);
        if ((k + 1) % static_cast<std::size_t>(settings.stretch) != 0 && k + 1 != pairs.size())
            continue;
        // Groups that are still open may get contacts of later stretches; they belong to the
        // stretch in which they began.
        last = {{last.active.last, moving.groups()}, {last.resting.last, resting.groups()}};
        schedule.stretches.push_back(last);
    }
    schedule.lanes = moving.take_lanes();
    complete(schedule, resting.take_lanes(), pairs, bodies, settings.width);
    return schedule;
}

void complete(Schedule& schedule, const std::vector<std::int32_t>& resting,
              const std::vector<MovedPair>& pairs, std::size_t bodies, int width) {
    const auto groups = [width](const std::vector<std::int32_t>& lanes) {
        return static_cast<std::int32_t>(lanes.size() / static_cast<std::size_t>(width));
    };
    schedule.active = groups(schedule.lanes);
    schedule.all = schedule.active + groups(resting);
    schedule.lanes.insert(schedule.lanes.end(), resting.begin(), resting.end());
    for (Stretch& stretch : schedule.stretches)
        // Groups at rest come after all active ones in `lanes`.
        for (std::int32_t* end : {&stretch.resting.first, &stretch.resting.last})
            *end += schedule.active;
    const LastStretches touching(schedule, pairs, bodies, width);
    for (std::size_t s = 0; s < schedule.stretches.size(); ++s)
        schedule.stretches[s].after = touching.of(s);
}

}  // namespace turbidite::nscd
