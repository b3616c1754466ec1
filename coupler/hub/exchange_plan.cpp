// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/exchange_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "coupler/protocol/even_shares.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/largest.hpp"

namespace turbidite {
namespace {

// Does [centre - radius, centre + radius] meet [lower, upper], directly or as a periodic image?
bool meets(double centre, double radius, double lower, double upper, double period) {
    const auto overlaps = [&](double c) { return c + radius >= lower && c - radius <= upper; };
    // Positions may run on across a cyclic side: the image within a period of the box's middle.
    if (period > 0.0) centre -= period * std::round((centre - 0.5 * (lower + upper)) / period);
    return overlaps(centre) ||
           (period > 0.0 && (overlaps(centre - period) || overlaps(centre + period)));
}

// The cube around the grain's sphere against the box: some grains too many near corners, none
// too few.
bool touches(const GrainState& grain, const Box& box, const Vec3& period) {
    for (int axis = 0; axis < 3; ++axis)
        if (!meets(grain.position[axis], grain.radius, box.lower[axis], box.upper[axis],
                   period[axis]))
            return false;
    return true;
}

std::optional<double> largest_given(std::optional<double> a, std::optional<double> b) {
    return a && b ? largest(*a, *b) : a ? a : b;
}

std::optional<double> sum_given(std::optional<double> a, std::optional<double> b) {
    return a && b ? *a + *b : a ? a : b;
}

// Counts and work add up, since every contact, film and grain is reported by one rank. Sweeps are
// made by all ranks together, and their times run in parallel: the largest. NaN survives (largest).
void add(ContactReport& total, const ContactReport& share) {
    total.contacts += share.contacts;
    total.iterations = std::max(total.iterations, share.iterations);
    total.residual = largest_given(total.residual, share.residual);
    total.quad = largest_given(total.quad, share.quad);
    total.max = largest_given(total.max, share.max);
    total.contact_violation = largest_given(total.contact_violation, share.contact_violation);
    total.film_work = sum_given(total.film_work, share.film_work);
    total.converged = total.converged && share.converged;
    total.max_penetration = largest(total.max_penetration, share.max_penetration);
    total.removed += share.removed;
    total.wall_seconds = std::max(total.wall_seconds, share.wall_seconds);
}

// Nothing, and not an empty list, where no rank reports contacts: columns that need them stay
// empty.
std::optional<std::vector<ContactRecord>> all_contacts(const std::vector<Motion>& shares) {
    std::optional<std::vector<ContactRecord>> all;
    for (const Motion& share : shares) {
        if (!share.contacts) continue;
        if (!all) all.emplace();
        all->insert(all->end(), share.contacts->begin(), share.contacts->end());
    }
    if (all) std::sort(all->begin(), all->end(), contact_before);
    return all;
}

/// A grain of a share.
struct Source {
    GrainId id;
    std::size_t rank, at;
};

bool lower_id(const Source& a, const Source& b) {
    return a.id < b.id;
}

/// The grains of all shares in the order of their ids, which most ranks keep already.
std::vector<Source> in_order_of_ids(const std::vector<Motion>& shares) {
    std::vector<Source> all;
    for (std::size_t rank = 0; rank < shares.size(); ++rank) {
        const auto before = static_cast<std::ptrdiff_t>(all.size());
        for (std::size_t at = 0; at < shares[rank].grains.size(); ++at)
            all.push_back({shares[rank].grains[at].id, rank, at});
        // The shares so far are in order; the new one is put in order by itself, then both are
        // merged.
        const auto middle = all.begin() + before;
        if (!std::is_sorted(middle, all.end(), lower_id))
            std::stable_sort(middle, all.end(), lower_id);
        std::inplace_merge(all.begin(), middle, all.end(), lower_id);
    }
    return all;
}

/// Puts the same grains as before into the order of before: a program may return them in any order,
/// and what is told apart by its place, as by fluids within a window, must not be mixed up. Other
/// grains stay as they are, one that comes twice as well.
void put_in_order(std::vector<GrainState>& grains, const GrainIndex& before) {
    if (grains.size() != before.size() || before.fits(grains)) return;
    std::vector<GrainState> ordered(grains.size());
    std::vector<std::uint8_t> taken(grains.size(), 0);
    for (const GrainState& grain : grains) {
        const std::size_t place = before.place(grain.id);
        if (place == GrainIndex::nowhere || std::exchange(taken[place], 1) != 0) return;
        ordered[place] = grain;
    }
    grains = std::move(ordered);
}

ContactReport report_of(const std::vector<Motion>& shares) {
    ContactReport report;
    for (const Motion& share : shares) add(report, share.report);
    return report;
}

}  // namespace

ExchangePlan::ExchangePlan(std::vector<Box> fluid_boxes, Vec3 period)
    : boxes_(std::move(fluid_boxes)), period_(period) {}

Motion ExchangePlan::gather(std::vector<Motion> shares) {
    auto contacts = all_contacts(shares);
    // Before the first share is moved from, below.
    const ContactReport report = report_of(shares);
    owners_ = shares.size();
    // A single rank keeps its own order, without a copy of the grains.
    Motion all = owners_ == 1 ? std::move(shares.front()) : merged(shares);
    if (owners_ == 1) {
        owner_.assign(all.grains.size(), 0);
        put_in_order(all.grains, index_);
    }
    all.report = report;
    all.contacts = std::move(contacts);
    if (const auto twice = index_.follow(all.grains))
        throw PhysicsRefused("grain " + std::to_string(*twice) + " was sent twice");
    return all;
}

/// The grains of several ranks, and who owns them.
Motion ExchangePlan::merged(const std::vector<Motion>& shares) {
    Motion all;
    owner_.clear();
    for (const Source& source : in_order_of_ids(shares)) {
        all.grains.push_back(shares[source.rank].grains[source.at]);
        owner_.push_back(static_cast<int>(source.rank));
    }
    return all;
}

std::vector<MotionShare> ExchangePlan::by_place(const Motion& motion) const {
    std::vector<MotionShare> routed(boxes_.size(), MotionShare{&motion, {}});
    for (std::size_t at = 0; at < motion.grains.size(); ++at)
        // Places, not copies: a grain near a border goes to every rank that needs it.
        for (std::size_t rank = 0; rank < boxes_.size(); ++rank)
            if (touches(motion.grains[at], boxes_[rank], period_))
                routed[rank].places.push_back(static_cast<std::uint32_t>(at));
    return routed;
}

void ExchangePlan::refuse_missing(const std::vector<bool>& answered) const {
    const auto first = std::find(answered.begin(), answered.end(), false);
    throw PhysicsRefused("the fluid sent no answer for " +
                         std::to_string(std::count(answered.begin(), answered.end(), false)) +
                         " grains, among them " +
                         std::to_string(index_.id(first - answered.begin())) +
                         ": is it outside the fluid's domain?");
}

template <class Record>
std::vector<std::vector<Record>> ExchangePlan::by_owner(std::vector<Record> records) const {
    const std::vector<int> owners = owners_of(records);
    std::vector<std::vector<Record>> routed(owners_);
    if (owners_ == 1)
        // A single rank takes its records in the order of the fluid's ranks: participants find them
        // by id.
        routed[0] = std::move(records);
    else
        for (std::size_t i = 0; i < records.size(); ++i) routed[owners[i]].push_back(records[i]);
    return routed;
}

/// Of each record; throws unless every grain is answered once.
template <class Record>
std::vector<int> ExchangePlan::owners_of(const std::vector<Record>& records) const {
    // Two fluid ranks could both think that they own a centre, or neither: hence the count per
    // grain.
    std::vector<bool> answered(index_.size(), false);
    std::vector<int> owners;
    owners.reserve(records.size());
    std::size_t at = GrainIndex::nowhere;
    for (const Record& record : records) {
        // The guess: the place after that of the record before. nowhere + 1 is 0, the first place.
        at = index_.place(record.id, at + 1);
        if (at == GrainIndex::nowhere || answered[at])
            throw PhysicsRefused(
                "the fluid answered for grain " + std::to_string(record.id) +
                (at != GrainIndex::nowhere ? " twice" : ", which no grains rank owns"));
        owners.push_back(owner_[at]);
        answered[at] = true;
    }
    if (records.size() < index_.size()) refuse_missing(answered);
    return owners;
}

template std::vector<std::vector<Kick>> ExchangePlan::by_owner(std::vector<Kick>) const;
template std::vector<std::vector<FreeResponse>> ExchangePlan::by_owner(
    std::vector<FreeResponse>) const;

std::vector<Motion> shares_of(const std::vector<GrainState>& population, int ranks) {
    std::vector<Motion> shares(static_cast<std::size_t>(ranks));
    if (ranks == 1) {
        shares[0].grains = population;
        return shares;
    }
    // In the order of x, as the ranks of a resumed run find their shares by the same rule.
    const std::vector<int> rank = even_shares(population, ranks);
    for (std::size_t i = 0; i < population.size(); ++i)
        shares[static_cast<std::size_t>(rank[i])].grains.push_back(population[i]);
    for (Motion& share : shares)
        std::stable_sort(
            share.grains.begin(), share.grains.end(),
            [](const GrainState& a, const GrainState& b) { return a.position[0] < b.position[0]; });
    return shares;
}

}  // namespace turbidite
