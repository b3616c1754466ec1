// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/grain_roster.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace turbidite {
namespace {

constexpr int nobody = -1;

const std::string every_grain_once =
    "Each grain of the run must be sent exactly once; one that left is counted in report.removed "
    "of \"state\".";
const std::string is_it_outside =
    "Every grain must be answered by the rank that owns its centre: is it outside the fluid's "
    "domain?";

std::int64_t announced_in(const std::vector<Motion>& shares, Kind kind) {
    std::int64_t removed = 0;
    // Grains leave with the state only: in `motion` all of them must be there, whatever its report
    // says.
    if (kind == Kind::state)
        for (const Motion& share : shares) removed += share.report.removed;
    return removed;
}

const std::vector<GrainState>& records_of(const Motion& share) {
    return share.grains;
}
const std::vector<Kick>& records_of(const Kicks& share) {
    return share.kicks;
}
const std::vector<FreeResponse>& records_of(const std::vector<FreeResponse>& share) {
    return share;
}

}  // namespace

GrainRoster::GrainRoster(const std::vector<GrainState>& population) {
    // All of rank 0 until the grains have been heard of for the first time.
    remember({Motion{population, {}}});
}

void GrainRoster::remember(const std::vector<Motion>& shares) {
    present_.clear();
    places_.clear();
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (const GrainState& grain : shares[rank].grains) {
            places_.emplace(grain.id, present_.size());
            present_.push_back({grain.id, grain.shape, grain.material, grain.prescribed,
                                grain.radius, grain.density, static_cast<int>(rank)});
        }
}

template <class Shares>
bool GrainRoster::unchanged(const Shares& shares) const {
    std::size_t at = 0;
    for (const auto& share : shares)
        for (const auto& record : records_of(share))
            // All ranks one after the other, against the last message: one comparison per grain, no
            // look-up. Where this holds, ids, bodies and their number are right.
            if (at == present_.size() || !present_[at++].fits(record)) return false;
    return at == present_.size();
}

/// The same grains in the same order may have changed their ranks: the last of one has become the
/// first of the next.
void GrainRoster::note_ranks(const std::vector<Motion>& shares) {
    if (shares.size() < 2) return;
    std::size_t at = 0;
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (std::size_t n = shares[rank].grains.size(); n > 0; --n)
            present_[at++].rank = static_cast<int>(rank);
}

template <class Shares>
GrainRoster::Seen GrainRoster::tally(const Shares& shares, const Arrival& arrival) const {
    // By id, in any order and from any rank: grains may change their rank between two messages.
    Seen seen(present_.size(), nobody);
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (const auto& record : records_of(shares[rank])) {
            const int sender = static_cast<int>(rank);
            const auto place = places_.find(record.id);
            if (place == places_.end())
                arrival.refuse(sender, fmt::format("grain {} is not in the run", record.id),
                               every_grain_once);
            int& first = seen[place->second];
            if (first != nobody)
                arrival.refuse(
                    sender,
                    fmt::format("grain {} was sent twice, first by rank {}", record.id, first),
                    every_grain_once);
            first = sender;
        }
    return seen;
}

std::string GrainRoster::Entry::difference(const GrainState& grain) const {
    const auto instead = [](const char* quantity, auto now, auto known) {
        return fmt::format("{} {:.10g} instead of {:.10g}", quantity, static_cast<double>(now),
                           static_cast<double>(known));
    };
    if (grain.shape != shape) return instead("shape", grain.shape, shape);
    if (grain.material != material) return instead("material", grain.material, material);
    if (grain.prescribed != prescribed) return instead("prescribed", grain.prescribed, prescribed);
    if (!keeps(radius, grain.radius)) return instead("radius", grain.radius, radius);
    return instead("density", grain.density, density);
}

void GrainRoster::check_bodies(const std::vector<Motion>& shares, const Arrival& arrival) const {
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
        for (const GrainState& grain : shares[rank].grains) {
            // Of the last message that was remembered, which had passed the same comparison.
            const Entry& known = present_[places_.at(grain.id)];
            if (known.is_the_same_body(grain)) continue;
            arrival.refuse(
                static_cast<int>(rank),
                fmt::format("grain {} has {}, the population's", grain.id, known.difference(grain)),
                "A grain keeps its shape, material, radius and density, and whether its "
                "motion is prescribed.");
        }
}

void GrainRoster::check_missing(const Seen& seen, const std::vector<Motion>& shares,
                                const Arrival& arrival) const {
    const std::int64_t announced = announced_in(shares, arrival.kind());
    const std::int64_t missing = std::count(seen.begin(), seen.end(), nobody);
    // More missing than announced: one got lost. Fewer: a grain was announced and sent all the
    // same.
    if (missing == announced) return;
    const auto first = std::find(seen.begin(), seen.end(), nobody);
    if (first == seen.end())
        arrival.refuse(
            fmt::format("{} grains were announced as removed, none is missing", announced),
            every_grain_once);
    const Entry& lost = present_[first - seen.begin()];
    // The rank that had it last is the one to ask; nobody has sent it this time.
    arrival.refuse(lost.rank,
                   fmt::format("{} of {} grains are missing, {} announced as removed; the first "
                               "one missing is grain {}",
                               missing, present_.size(), announced, lost.id),
                   every_grain_once);
}

std::vector<Leaver> GrainRoster::check(const std::vector<Motion>& shares, const Arrival& arrival) {
    // The announcement counts even if all grains are there.
    if (unchanged(shares) && announced_in(shares, arrival.kind()) == 0) {
        note_ranks(shares);
        return {};
    }
    // Unknown and doubled ids first: what follows looks every grain up.
    const Seen seen = tally(shares, arrival);
    check_bodies(shares, arrival);
    check_missing(seen, shares, arrival);
    std::vector<Leaver> gone = leavers(seen);
    // The order and the ranks of this message are what the next one is compared with.
    remember(shares);
    return gone;
}

std::vector<Leaver> GrainRoster::leavers(const Seen& seen) const {
    std::vector<Leaver> gone;
    for (std::size_t at = 0; at < seen.size(); ++at)
        if (seen[at] == nobody) gone.push_back({present_[at].id, present_[at].rank});
    return gone;
}

template <class Shares>
void GrainRoster::check_answers(const Shares& shares, const Arrival& arrival) const {
    // Holds where one fluid rank answers in the order in which it got the grains.
    if (unchanged(shares)) return;
    const Seen seen = tally(shares, arrival);
    const auto missing = std::count(seen.begin(), seen.end(), nobody);
    if (missing == 0) return;
    const auto first = std::find(seen.begin(), seen.end(), nobody);
    arrival.refuse(fmt::format("no answer for {} of {} grains; the first one is grain {}", missing,
                               present_.size(), present_[first - seen.begin()].id),
                   is_it_outside);
}

void GrainRoster::check(const std::vector<Kicks>& shares, const Arrival& arrival) const {
    check_answers(shares, arrival);
}

void GrainRoster::check(const std::vector<std::vector<FreeResponse>>& shares,
                        const Arrival& arrival) const {
    check_answers(shares, arrival);
}

}  // namespace turbidite
