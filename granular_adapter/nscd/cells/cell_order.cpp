// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/cells/cell_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace turbidite::nscd {
namespace {

constexpr std::size_t parities = 9;  // with the class of large bodies

using Place = CellOrder::Place;

/// Ids before places in storage. Only points of one body at two images of a wall may be equal but
/// for their numbers, which follow the order of the walls on every rank.
bool is_before(const Place& p, const Place& q) {
    return std::tie(p.cell, p.layer, p.wall, p.first, p.second, p.feature, p.point) <
           std::tie(q.cell, q.layer, q.wall, q.first, q.second, q.feature, q.point);
}

/// Each thread sorts a part; no two places are equal, so that parts do not matter.
void sort(std::vector<Place>& places, ThreadTeam& team) {
    const auto begin_of = [&](int part) {
        return places.begin() + static_cast<std::ptrdiff_t>(team.part_begin(places.size(), part));
    };
    team.run([&](int thread) { std::sort(begin_of(thread), begin_of(thread + 1), is_before); });
    for (int part = 1; part < team.size(); ++part)
        std::inplace_merge(places.begin(), begin_of(part), begin_of(part + 1), is_before);
}

}  // namespace

CellOrder::CellOrder(const CellScene& scene)
    : CellOrder(scene, ParityGrid(cell_sizes(scene.bodies, scene.box), scene.box, scene.reach,
                                  scene.share)) {
    // One rank: a single phase, in the order of the places of the cells.
    by_parity_ = false;
    phases_.resize(1);
}

CellOrder::CellOrder(const CellScene& scene, const ParityGrid& grid)
    : scene_(scene), grid_(grid), by_parity_(true), phases_(parities) {
    const double weight = norm(scene.gravity);
    layered_ = weight > 0.0 && scene.band > 0.0;
    if (layered_) down_ = (1.0 / weight) * scene.gravity;
}

bool CellOrder::is_large(std::int32_t body) const {
    return body >= 0 && grid_.is_large(scene_.bodies.radius[static_cast<std::size_t>(body)]);
}

CellOrder::Cell CellOrder::cell(const ContactPoint& point) const {
    // A large body touches more than its neighbouring cells: its contacts belong to none.
    if (is_large(point.a) || is_large(point.b)) return {0, 0, 0, true};
    const std::int32_t owner = point.a >= 0 ? point.a : point.b;  // a has the lower id
    return grid_.cell(scene_.bodies.position[static_cast<std::size_t>(owner)]);
}

double CellOrder::layer(const ContactPoint& point) const {
    if (!layered_) return 0.0;
    const Vec3& centre = scene_.bodies.position[static_cast<std::size_t>(point.b)];
    // Depth of the point along gravity, in bands; from b, since a may be a wall.
    return std::floor((dot(down_, centre) + dot(down_, point.arm_b)) / scene_.band);
}

CellOrder::Place CellOrder::place(const ContactPoint& point) const {
    const auto id = [this](std::int32_t body) {
        return scene_.bodies.id[static_cast<std::size_t>(body)];
    };
    // Keys of walls may equal ids of bodies: `wall` tells them apart.
    const GrainId first =
        point.wall < 0 ? id(point.a) : scene_.walls[static_cast<std::size_t>(point.wall)].key;
    const Cell own = cell(point);
    return {own.place(),
            layer(point),
            first,
            id(point.b),
            point.wall >= 0 ? 1 : 0,
            point.feature,
            by_parity_ ? own.parity() : 0,
            0};
}

void CellOrder::add(Place place) {
    place.point = count_++;
    phases_[static_cast<std::size_t>(place.phase)].push_back(place);
}

void CellOrder::take_phase(const std::vector<Place>& places, std::vector<std::int32_t>& order) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        order.push_back(places[i].point);
        // The cell ends where the next contact is of another one.
        if (i + 1 < places.size() && places[i + 1].cell == places[i].cell) continue;
        cells_.place.push_back(places[i].cell);
        cells_.end.push_back(static_cast<std::int32_t>(order.size()));
    }
    phase_ends_.push_back(cells_.size());
}

std::vector<std::int32_t> CellOrder::take(ThreadTeam& team) {
    std::vector<std::int32_t> order;
    order.reserve(static_cast<std::size_t>(count_));
    cells_ = {}, phase_ends_ = {};
    for (std::vector<Place>& places : phases_) {
        sort(places, team);
        take_phase(places, order);
        places.clear();
    }
    count_ = 0;
    return order;
}

}  // namespace turbidite::nscd
