// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/sweeps/cell_schedule.hpp"

#include <array>
#include <bit>

namespace turbidite::nscd {
namespace {

constexpr int words = 4;
constexpr int most_groups = 64 * words;  // of a stretch

/// A set of groups of the present stretch.
struct Groups {
    std::array<std::uint64_t, words> bits{};

    void add(int group) {
        if (group >= 0 && group < most_groups)
            bits[static_cast<std::size_t>(group / 64)] |= std::uint64_t{1} << group % 64;
    }
    /// The first group that is in none of the sets; most_groups if there is none.
    static int first_outside(const Groups& a, const Groups& b, const Groups& c) {
        for (std::size_t i = 0; i < words; ++i)
            if (const std::uint64_t free = ~(a.bits[i] | b.bits[i] | c.bits[i]); free != 0)
                return static_cast<int>(i) * 64 + std::countr_zero(free);
        return most_groups;
    }
};

/// The groups of one kind, active or at rest.
class CellGroups {
 public:
    CellGroups(std::size_t bodies, const ScheduleSettings& settings)
        : width_(settings.width), distance_(settings.distance), near_(bodies) {}

    /// False if the present stretch is full.
    bool place(std::int32_t contact, const MovedPair& pair) {
        // Any order within a cell will do: the first group with a free lane and neither body in or
        // near it.
        const int group = Groups::first_outside(full_, near(pair.a), near(pair.b));
        if (group == most_groups) return false;
        make_room(group);
        int& count = count_[static_cast<std::size_t>(group)];
        lanes_[static_cast<std::size_t>((first_ + group) * width_ + count)] = contact;
        if (++count == width_) full_.add(group);
        for (const std::int32_t body : {pair.a, pair.b})
            if (body >= 0) keep_apart(near_[static_cast<std::size_t>(body)].groups, group);
        return true;
    }

    void end_stretch() {
        first_ = groups();
        count_.fill(0);
        full_ = {};
        ++stretch_;
    }

    std::int32_t groups() const { return static_cast<std::int32_t>(lanes_.size()) / width_; }
    std::vector<std::int32_t> take_lanes() { return std::move(lanes_); }

 private:
    /// Groups that a contact of a body must not enter, of the stretch in which it was used last.
    struct Near {
        std::int64_t stretch = -1;
        Groups groups;
    };

    const Groups& near(std::int32_t body) {
        static const Groups none;
        if (body < 0) return none;
        Near& own = near_[static_cast<std::size_t>(body)];
        // Groups are numbered from the beginning of a stretch: those of an earlier one mean nothing
        // here, and resetting all bodies at each stretch would take longer.
        if (own.stretch != stretch_) own = {stretch_, {}};
        return own.groups;
    }

    void keep_apart(Groups& groups, int group) const {
        // Groups nearer than `distance` on both sides.
        for (int by = 1 - distance_; by < distance_; ++by) groups.add(group + by);
    }

    void make_room(int group) {
        const auto lanes = static_cast<std::size_t>((first_ + group + 1) * width_);
        if (lanes > lanes_.size()) lanes_.resize(lanes, -1);
    }

    int width_, distance_;
    std::int32_t first_ = 0;  ///< group of the present stretch
    std::int64_t stretch_ = 0;
    std::array<int, most_groups> count_{};  ///< contacts in each group
    Groups full_;
    std::vector<Near> near_;
    std::vector<std::int32_t> lanes_;
};

/// Appends contacts cell by cell.
class CellSchedule {
 public:
    CellSchedule(const std::vector<MovedPair>& pairs, const std::vector<std::uint8_t>& active,
                 std::size_t bodies, const ScheduleSettings& settings)
        : pairs_(pairs), active_(active), moving_(bodies, settings), resting_(bodies, settings) {
        schedule.by_cells = true;
    }

    void add_cell(std::int32_t first, std::int32_t last) {
        for (std::int32_t k = first; k < last; ++k)
            // A cell with more contacts than a stretch can hold goes on in another stretch.
            if (!place(k)) end_stretch(), place(k);
        end_stretch();
        schedule.cell_ends.push_back(schedule.stretches.size());
    }

    std::vector<std::int32_t> take_resting() { return resting_.take_lanes(); }
    std::vector<std::int32_t> take_active() { return moving_.take_lanes(); }

    Schedule schedule;

 private:
    bool place(std::int32_t k) {
        const auto at = static_cast<std::size_t>(k);
        return (active_[at] != 0 ? moving_ : resting_).place(k, pairs_[at]);
    }

    void end_stretch() {
        last_ = {{last_.active.last, moving_.groups()}, {last_.resting.last, resting_.groups()}};
        schedule.stretches.push_back(last_);
        moving_.end_stretch(), resting_.end_stretch();
    }

    const std::vector<MovedPair>& pairs_;
    const std::vector<std::uint8_t>& active_;
    CellGroups moving_, resting_;
    Stretch last_;
};

}  // namespace

Schedule make_cell_schedule(const std::vector<MovedPair>& pairs,
                            const std::vector<std::uint8_t>& active, std::size_t bodies,
                            const ScheduleSettings& settings, const ContactCells& cells,
                            const std::vector<std::size_t>& phase_ends) {
    CellSchedule laid(pairs, active, bodies, settings);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        laid.add_cell(cells.first(cell), cells.end[cell]);
    Schedule schedule = std::move(laid.schedule);
    for (const std::size_t cell : phase_ends)
        schedule.phase_ends.push_back(cell == 0 ? 0 : schedule.cell_ends[cell - 1]);
    schedule.lanes = laid.take_active();
    complete(schedule, laid.take_resting(), pairs, bodies, settings.width);
    return schedule;
}

}  // namespace turbidite::nscd
