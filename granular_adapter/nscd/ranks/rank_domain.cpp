// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/ranks/rank_domain.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "granular_adapter/nscd/detection/broad_phase.hpp"
#include "granular_adapter/nscd/ranks/body_rows.hpp"

namespace turbidite::nscd {
namespace {

// Cells are shared out anew when the busiest rank has this much more to do than the mean, but not
// more often than this many steps: moving bodies costs about as much as a step.
constexpr double uneven = 1.15;
constexpr std::int64_t steps_between_cuts = 20;

/// The body whose rank keeps what is known of a contact; at a wall `first` is the wall's key.
GrainId keeper(const ContactKey& key) {
    return key.wall != 0 ? key.second : key.first;
}

/// Calls each(array) for the arrays of bodies, and those that go with them.
template <class Each>
void each_array(Bodies& bodies, const std::vector<std::vector<Twist>*>& twists,
                Mobilities* mobilities, const Each& each) {
    Bodies::for_each_array(bodies, each);
    for (std::vector<Twist>* twist : twists) each(*twist);
    if (mobilities) std::visit(each, *mobilities);
}

/// Takes the entries for which destination(key) is not negative out of a list, by destination.
template <class Entry, class Destination>
std::vector<std::vector<Entry>> taken_out(std::vector<Entry>& entries, int ranks,
                                          const Destination& destination) {
    std::vector<std::vector<Entry>> parts(static_cast<std::size_t>(ranks));
    std::erase_if(entries, [&](const Entry& entry) {
        const int rank = destination(entry.key);
        if (rank >= 0) parts[static_cast<std::size_t>(rank)].push_back(entry);
        return rank >= 0;
    });
    return parts;
}

/// Sends entries to their destinations, and adds those that arrive.
template <class Entry, class Destination>
void send_on(RankExchange& ranks, std::vector<Entry>& entries, const Destination& destination) {
    const auto leaving = taken_out(entries, ranks.size(), destination);
    for (const std::vector<Entry>& arrived : swapped(ranks, leaving))
        entries.insert(entries.end(), arrived.begin(), arrived.end());
}

template <class Entry>
void sort_by_key(std::vector<Entry>& entries) {
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.key < b.key; });
}

/// Of the entries of all ranks, which several may have, once those that are `kept` here.
template <class Entry, class Kept>
void share_out(RankExchange& ranks, std::vector<Entry>& entries, const Kept& kept) {
    entries = gathered(ranks, entries);
    std::erase_if(entries, [&](const Entry& entry) { return !kept(entry.key); });
    sort_by_key(entries);
    const auto same = [](const Entry& a, const Entry& b) { return a.key == b.key; };
    entries.erase(std::unique(entries.begin(), entries.end(), same), entries.end());
}

/// What is kept of contacts, as lists of entries, changed one after the other on all ranks.
template <class Change>
void change_lists(const RankShare& share, const Change& change) {
    for (ContactMemory* memory : {&share.memory, &share.moments}) {
        std::vector<RememberedContact> contacts = memory->contacts();
        change(contacts);
        memory->replace(std::move(contacts));
    }
    ContactStates::Saved saved = share.states.saved();
    for (std::vector<RememberedState>* states : {&saved.accepted, &saved.found}) {
        change(*states);
        sort_by_key(*states);
    }
    share.states.replace(std::move(saved));
}

}  // namespace

CellSizes RankDomain::sizes(const Bodies& own, const PeriodicBox& box) {
    box_ = box;
    double work = 0.0;
    for (const CellLoad& load : loads_) work += load.work;
    // Three numbers per rank: its bodies, its span, its work.
    const std::vector<double> all =
        gathered(ranks_, std::vector<double>{static_cast<double>(own.size()),
                                             span_of(own.position, box.lower), work});
    double bodies = 0.0, span = 0.0;
    std::vector<double> works;
    for (std::size_t i = 0; i < all.size(); i += 3) {
        bodies += all[i];
        span = std::max(span, all[i + 1]);
        works.push_back(all[i + 2]);
    }
    // Bodies keep their radii: all are gathered anew only when the number of bodies has changed.
    if (static_cast<double>(radii_.size()) != bodies) {
        radii_ = gathered(ranks_, own.radius);
        sizes_ = sizes_of(radii_);
        large_.known = false;
    }
    sizes_.span = span;
    if (++areas_.steps > steps_between_cuts && is_uneven(works)) areas_.cut = false;
    return sizes_;
}

bool RankDomain::is_uneven(const std::vector<double>& work) const {
    const double all = std::accumulate(work.begin(), work.end(), 0.0);
    // max > 1.15 sum/ranks
    return *std::max_element(work.begin(), work.end()) * ranks_.size() > uneven * all;
}

void RankDomain::check_periods(const Bodies& own, double range, const PeriodicBox& box) {
    // radii_ may be in the order of an earlier distribution of the bodies.
    nscd::check_periods(gathered(ranks_, own.radius), gathered(ranks_, own.fixed), range, box);
}

std::vector<Twist> RankDomain::extremes(const std::vector<Twist>& own) const {
    // The bounding box of all velocities and zero, as in reach.cpp.
    Twist low, high;
    const auto extend = [&](const Twist& twist) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low.velocity[axis] = std::min(low.velocity[axis], twist.velocity[axis]);
            high.velocity[axis] = std::max(high.velocity[axis], twist.velocity[axis]);
        }
    };
    for (const Twist& twist : own) extend(twist);
    for (const Twist& twist : gathered(ranks_, std::vector<Twist>{low, high})) extend(twist);
    return {low, high};
}

void RankDomain::cut(const ParityGrid& grid, const Bodies& own) {
    if (areas_.cut) return;
    // Until a step has counted contacts, bodies stand for them. In a resumed run they are still
    // where the case puts them, so that areas may be cut anew as soon as contacts are counted.
    if (!areas_.counted) {
        loads_.clear();
        std::map<Vec3, double> count;
        for (const Vec3& x : own.position) count[grid.centre(grid.cell(x))] += 1.0;
        for (const auto& [centre, bodies] : count) loads_.push_back({centre, bodies});
    }
    areas_.cuts = RankCuts(gathered(ranks_, loads_), ranks_.size());
    areas_.cut = true;
    areas_.steps = areas_.counted ? 0 : steps_between_cuts - 1;
}

int RankDomain::home(const ParityGrid& grid, const Vec3& position, double radius) const {
    // By the centre of the cell, so that a cell is never divided between ranks.
    return grid.is_large(radius) ? 0 : areas_.cuts.rank(grid.centre(grid.cell(position)));
}

/// Which bodies are large may change with the median radius, when bodies have left. Returns whether
/// it has.
bool RankDomain::find_large_ids(const ParityGrid& grid, const Bodies& own) {
    if (std::exchange(large_.known, true)) return false;
    std::vector<GrainId> mine;
    for (std::size_t i = 0; i < own.size(); ++i)
        if (grid.is_large(own.radius[i])) mine.push_back(own.id[i]);
    const std::vector<GrainId> all = gathered(ranks_, mine);
    std::unordered_set<GrainId> now(all.begin(), all.end());
    const bool changed = now != large_.ids;
    large_.ids = std::move(now);
    return changed;
}

/// Contacts of two bodies of which one is large are of the first rank.
bool RankDomain::is_of_large(const ContactKey& key) const {
    return key.wall == 0 && (large_.ids.count(key.first) > 0 || large_.ids.count(key.second) > 0);
}

void RankDomain::settle(const ParityGrid& grid, const RankShare& share) {
    cut(grid, share.bodies);
    const int me = ranks_.rank();
    const bool anew = find_large_ids(grid, share.bodies);
    std::vector<std::vector<std::int32_t>> leaving(static_cast<std::size_t>(ranks_.size()));
    std::vector<std::int32_t> staying;
    std::unordered_map<GrainId, int> moved;
    const Bodies& bodies = share.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const int rank = home(grid, bodies.position[i], bodies.radius[i]);
        if (rank == me) {
            staying.push_back(static_cast<std::int32_t>(i));
            continue;
        }
        leaving[static_cast<std::size_t>(rank)].push_back(static_cast<std::int32_t>(i));
        moved.emplace(bodies.id[i], rank);
    }
    // All ranks or none: what follows is collective.
    if (!any(ranks_, !moved.empty()) && !anew) return;
    const auto visit = [&](const auto& each) {
        each_array(share.bodies, share.twists, share.mobilities, each);
    };
    std::vector<RankExchange::Bytes> rows;
    for (const auto& chosen : leaving)
        rows.push_back(chosen.empty() ? RankExchange::Bytes() : rows_of(chosen, visit));
    take_rows(staying, visit);
    for (const RankExchange::Bytes& arrived : ranks_.swap(std::move(rows)))
        append_rows(arrived, visit);
    // Which way a body came does not show in the order.
    take_rows(order_of_ids(bodies), visit);
    if (anew) {
        // Where an entry lies says nothing any more of who will find its contact.
        const std::unordered_set<GrainId> own(bodies.id.begin(), bodies.id.end());
        const auto kept = [&](const ContactKey& key) {
            return is_of_large(key) ? me == 0 : own.count(keeper(key)) > 0;
        };
        return change_lists(share, [&](auto& entries) { share_out(ranks_, entries, kept); });
    }
    // Contacts of large bodies are on the first rank, and stay there.
    const auto destination = [&](const ContactKey& key) {
        const auto at = moved.find(keeper(key));
        return at == moved.end() || is_of_large(key) ? -1 : at->second;
    };
    change_lists(share, [&](auto& entries) { send_on(ranks_, entries, destination); });
}

/// Their places are needed to find who is near.
void RankDomain::find_large(const ParityGrid& grid, const Bodies& own) {
    large_.places.clear();
    if (std::none_of(radii_.begin(), radii_.end(),
                     [&](double radius) { return grid.is_large(radius); }))
        return;
    std::vector<Large> mine;
    for (std::size_t i = 0; i < own.size(); ++i)
        if (grid.is_large(own.radius[i])) mine.push_back({own.position[i], own.radius[i]});
    large_.places = gathered(ranks_, mine);
}

/// The ranks that have a body, in their order; large ones are on the first rank alone.
std::vector<int> RankDomain::holders(const ParityGrid& grid, const Bodies& bodies,
                                     std::size_t body) const {
    const Vec3& x = bodies.position[body];
    const double radius = bodies.radius[body];
    if (grid.is_large(radius)) return {0};
    std::vector<int> found;
    grid.each_cell_near(x, [&](const ParityGrid::Cell& cell) {
        found.push_back(areas_.cuts.rank(grid.centre(cell)));
    });
    for (const Large& other : large_.places)
        // A large body reaches beyond the distance d of the cells, so its pairs are looked for one
        // by one; a little farther, so that rounding misses none.
        if (norm(box_.minimum_image(other.position - x)) < 1.001 * grid.bound(radius, other.radius))
            found.push_back(0);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void RankDomain::add_copies(const ParityGrid& grid, Bodies& bodies,
                            const std::vector<std::vector<Twist>*>& twists,
                            Mobilities* mobilities) {
    const int me = ranks_.rank();
    find_large(grid, bodies);
    own_ = bodies.size();
    lent_.assign(static_cast<std::size_t>(ranks_.size()), {});
    borrowed_.clear();
    // A rank with a copy of a body may have contacts of it: its cells are within d, or it has a
    // large body that is near.
    for (std::size_t i = 0; i < own_; ++i)
        for (const int rank : holders(grid, bodies, i))
            if (rank != me)
                lent_[static_cast<std::size_t>(rank)].push_back(static_cast<std::int32_t>(i));
    const auto visit = [&](const auto& each) { each_array(bodies, twists, mobilities, each); };
    std::vector<RankExchange::Bytes> rows;
    for (const auto& chosen : lent_)
        rows.push_back(chosen.empty() ? RankExchange::Bytes() : rows_of(chosen, visit));
    for (const RankExchange::Bytes& arrived : ranks_.swap(std::move(rows)))
        borrowed_.push_back(append_rows(arrived, visit));
    number_shared(grid, bodies);
}

void RankDomain::number_shared(const ParityGrid& grid, const Bodies& bodies) {
    const int me = ranks_.rank();
    holders_.assign(bodies.size(), {});
    shared_.clear();
    const auto number = [&](std::size_t i) {
        // A body may be lent to several ranks: it is numbered once.
        if (!shared_.emplace(bodies.id[i], static_cast<std::int32_t>(i)).second) return;
        holders_[i] = holders(grid, bodies, i);
        std::erase(holders_[i], me);
    };
    for (const auto& of_rank : lent_)
        for (const std::int32_t i : of_rank) number(static_cast<std::size_t>(i));
    for (std::size_t i = own_; i < bodies.size(); ++i) number(i);
}

void RankDomain::follow(Bodies& bodies) const {
    struct Place {
        Vec3 position;
        Quaternion orientation;
        Twist twist;
    };
    std::vector<std::vector<Place>> lent;
    for (const auto& of_rank : lent_) {
        lent.emplace_back();
        for (const std::int32_t i : of_rank) {
            const auto at = static_cast<std::size_t>(i);
            // No ids: both sides know the order from add_copies().
            lent.back().push_back({bodies.position[at], bodies.orientation[at], bodies.twist[at]});
        }
    }
    std::size_t at = own_;
    for (const std::vector<Place>& of_rank : swapped(ranks_, lent))
        for (const Place& place : of_rank) {
            bodies.position[at] = place.position;
            bodies.orientation[at] = place.orientation;
            bodies.twist[at++] = place.twist;
        }
}

/// By body, the other ranks that have contacts of it or own it.
std::vector<std::vector<int>> RankDomain::users(const Bodies& bodies,
                                                const OrderedPoints& found) const {
    std::vector<std::uint8_t> used(bodies.size(), 0);
    // The owner moves the body, and so needs its velocity even where all contacts are on other
    // ranks.
    std::fill_n(used.begin(), own_, 1);
    for (const ContactPoint& point : found.points)
        for (const std::int32_t body : {point.a, point.b})
            if (body >= 0) used[static_cast<std::size_t>(body)] = 1;
    std::vector<std::vector<GrainId>> sent_ids(static_cast<std::size_t>(ranks_.size()));
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (used[i] != 0)
            for (const int rank : holders_[i])
                sent_ids[static_cast<std::size_t>(rank)].push_back(bodies.id[i]);
    std::vector<std::vector<int>> users(bodies.size());
    int rank = 0;
    for (const std::vector<GrainId>& ids : swapped(ranks_, sent_ids)) {
        for (const GrainId id : ids)
            if (const auto at = shared_.find(id); at != shared_.end())
                users[static_cast<std::size_t>(at->second)].push_back(rank);
        ++rank;
    }
    return users;
}

/// What goes to other ranks after each phase, told to them by ids.
std::vector<PhaseWays> RankDomain::ways(const Bodies& bodies, const OrderedPoints& found,
                                        const std::vector<std::int32_t>& contact_ends) const {
    const auto ranks = static_cast<std::size_t>(ranks_.size());
    const std::vector<std::vector<int>> users = this->users(bodies, found);
    std::vector<PhaseWays> ways(contact_ends.size());
    std::vector<std::vector<GrainId>> sent_ids(ranks);
    std::vector<std::size_t> sent_in(bodies.size(), contact_ends.size());
    std::size_t k = 0;
    for (std::size_t phase = 0; phase < ways.size(); ++phase) {
        ways[phase].sent.resize(ranks), ways[phase].received.resize(ranks);
        for (; k < static_cast<std::size_t>(contact_ends[phase]); ++k)
            for (const std::int32_t body : {found.points[k].a, found.points[k].b}) {
                if (body < 0) continue;
                const auto i = static_cast<std::size_t>(body);
                // Once in a phase, after all of its contacts of this phase.
                if (users[i].empty() || sent_in[i] == phase) continue;
                sent_in[i] = phase;
                for (const int rank : users[i])
                    ways[phase].sent[static_cast<std::size_t>(rank)].push_back(body);
            }
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            const std::vector<std::int32_t>& sent = ways[phase].sent[rank];
            // By phase the number of bodies and their ids, in the order in which their values will
            // travel. Indices mean nothing to another rank.
            sent_ids[rank].push_back(static_cast<GrainId>(sent.size()));
            for (const std::int32_t i : sent)
                sent_ids[rank].push_back(bodies.id[static_cast<std::size_t>(i)]);
        }
    }
    std::size_t rank = 0;
    for (const std::vector<GrainId>& list : swapped(ranks_, sent_ids)) {
        auto at = list.begin();
        for (PhaseWays& phase : ways)
            for (GrainId left = *at++; left > 0; --left)
                phase.received[rank].push_back(shared_.at(*at++));
        ++rank;
    }
    return ways;
}

/// Of all ranks, from the numbers of this one up to the end of each phase.
std::vector<double> RankDomain::contacts_of_phases(const std::vector<std::int32_t>& ends) const {
    std::vector<double> own, all(ends.size());
    for (std::size_t phase = 0; phase < ends.size(); ++phase)
        own.push_back(static_cast<double>(ends[phase] - (phase == 0 ? 0 : ends[phase - 1])));
    const std::vector<double> of_ranks = gathered(ranks_, own);
    for (std::size_t i = 0; i < of_ranks.size(); ++i) all[i % ends.size()] += of_ranks[i];
    return all;
}

const RankPlan& RankDomain::plan(const ParityGrid& grid, const Bodies& bodies,
                                 const OrderedPoints& found) {
    std::vector<std::int32_t> all_ends;
    for (const std::size_t cells : found.phase_ends)
        all_ends.push_back(cells == 0 ? 0 : found.cells.end[cells - 1]);
    const std::vector<double> in_phase = contacts_of_phases(all_ends);
    // A phase without contacts on any rank would only cost an exchange per sweep: that of large
    // bodies where there are none, and in the plane those of odd parity along z.
    std::vector<std::size_t> cell_ends;
    std::vector<std::int32_t> contact_ends;
    for (std::size_t phase = 0; phase < all_ends.size(); ++phase) {
        if (in_phase[phase] == 0.0) continue;
        cell_ends.push_back(found.phase_ends[phase]);
        contact_ends.push_back(all_ends[phase]);
    }
    // The work of a cell is its number of contacts in this step.
    areas_.counted = true;
    loads_.clear();
    for (std::size_t cell = 0; cell < found.cells.size(); ++cell) {
        const std::int32_t first = found.cells.first(cell), end = found.cells.end[cell];
        const ContactPoint& point = found.points[static_cast<std::size_t>(first)];
        // The body with the lower id, whose cell the contact is in.
        const auto body = static_cast<std::size_t>(point.a >= 0 ? point.a : point.b);
        loads_.push_back(
            {grid.centre(grid.cell(bodies.position[body])), static_cast<double>(end - first)});
    }
    const double contacts = std::accumulate(in_phase.begin(), in_phase.end(), 0.0);
    plan_.reset();
    plan_ = std::make_unique<RankPlan>(ranks_, ways(bodies, found, contact_ends), contact_ends,
                                       std::move(cell_ends), static_cast<std::size_t>(contacts));
    return *plan_;
}

}  // namespace turbidite::nscd
