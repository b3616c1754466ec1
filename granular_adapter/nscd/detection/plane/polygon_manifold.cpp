// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/plane/polygon_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite::nscd {
namespace {

// Separations this close, as a fraction of both radii, count as equal: above rounding, and far
// below anything that matters to a contact.
constexpr double same_share = 1e-9;

// Two corners this close along a side, as a fraction of the smaller radius, are one place with one
// name. Equal grains settle exactly aligned, so the name must not change there; with this margin it
// changes at an offset where grains do not settle.
constexpr double near_share = 0.01;

/// A side, and the lowest corner of the other polygon above it.
struct Axis {
    double separation = -std::numeric_limits<double>::infinity();
    int side = 0;
    int lowest = 0;
};

/// Lowest corner of `other` in the direction of a side's normal; `base` is the height of its
/// centre.
template <int other_corners>
Axis over_side(const PolygonView& other, int side, double nx, double ny, double base) {
    const int n = other_corners > 0 ? other_corners : other.corners;
    double least = nx * other.x[0] + ny * other.y[0];
    int lowest = 0;
    for (int j = 1; j < n; ++j) {
        const double height = nx * other.x[j] + ny * other.y[j];
        if (height < least) least = height, lowest = j;
    }
    return {base + least, side, lowest};
}

/// Raises `best` to the side of `mine` with the largest separation; false as soon as a separation
/// is not below `alert`. Starts with the side that faces the other's centre, which rejects most
/// pairs at once.
template <int my_sides, int other_corners>
bool find_axis(const PolygonView& mine, const PolygonView& other, double ox, double oy,
               double alert, double same, Axis& best) {
    const int n = my_sides > 0 ? my_sides : mine.sides;
    // h = n_k . o - support_k, the height of the other's centre over side k.
    int front = 0;
    double highest = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
        const double base = mine.nx[k] * ox + mine.ny[k] * oy - mine.support[k];
        if (base > highest) highest = base, front = k;
    }
    for (int step = 0, k = front; step < n; ++step, k = k + 1 < n ? k + 1 : 0) {
        const double base = mine.nx[k] * ox + mine.ny[k] * oy - mine.support[k];
        // The lowest corner is at least the inscribed radius below the centre.
        if (base - other.in_radius <= best.separation) continue;
        const Axis axis = over_side<other_corners>(other, k, mine.nx[k], mine.ny[k], base);
        if (!(axis.separation < alert)) return false;
        // Of equal sides the first one found stays, so that rounding does not choose.
        if (axis.separation > best.separation + same) best = axis;
    }
    return true;
}

/// A corner in the frame of the reference side [m].
struct Place {
    double t = 0.0;  ///< along the side
    double h = 0.0;  ///< height above it
    int corner = 0;
};

/// The reference side, and the incident polygon in its frame; `flip`: the reference is the second
/// polygon.
struct Facing {
    const PolygonView& reference;
    const PolygonView& incident;
    int side;
    double ox, oy;  ///< centre of the incident polygon minus that of the reference
    bool flip;
    double nx, ny;
    double length;

    Facing(const PolygonView& mine, const PolygonView& other, int k, double dx, double dy,
           bool flipped)
        : reference(mine),
          incident(other),
          side(k),
          ox(dx),
          oy(dy),
          flip(flipped),
          nx(mine.nx[k]),
          ny(mine.ny[k]),
          length(along(mine.x[mine.after(k)], mine.y[mine.after(k)])) {}

    double along(double x, double y) const {
        return nx * (y - reference.y[side]) - ny * (x - reference.x[side]);
    }

    Place place(int corner) const {
        const double x = ox + incident.x[corner], y = oy + incident.y[corner];
        return {along(x, y), nx * x + ny * y - reference.support[side], corner};
    }

    /// The neighbour of the lowest corner along the side that faces the reference most.
    int other_end(int lowest) const {
        const int before = incident.before(lowest), after = incident.after(lowest);
        if (before == after) return after;
        const auto facing = [&](int k) { return nx * incident.nx[k] + ny * incident.ny[k]; };
        return facing(before) < facing(lowest) ? before : after;
    }

    ManifoldPoint point(double t, double h, int corner, bool of_incident) const {
        ManifoldPoint p;
        // corner + t (e_z x n) + (h/2) n, relative to the centre of the first polygon.
        p.x = reference.x[side] - ny * t + 0.5 * h * nx + (flip ? -ox : 0.0);
        p.y = reference.y[side] + nx * t + 0.5 * h * ny + (flip ? -oy : 0.0);
        p.nx = flip ? -nx : nx;
        p.ny = flip ? -ny : ny;
        p.gap = h;
        p.corner = corner;
        p.of_second = of_incident != flip;
        p.turns_with = flip ? 2 : 1;
        return p;
    }

    /// Corners this close along the side are one place [m].
    double near() const { return near_share * std::min(reference.radius, incident.radius); }

    int end_corner(bool far) const { return far ? reference.after(side) : side; }

    /// The end of the overlap at (t, h) as a contact point; `place` is the incident corner, over
    /// the reference or beyond its end. Of the corners there, it is named by the one that lies
    /// inside the other polygon's side.
    ManifoldPoint end_point(double t, double h, const Place& place, bool clipped) const {
        const bool far = place.t > 0.5 * length;
        const bool one_place = std::abs(place.t - (far ? length : 0.0)) < near();
        const bool by_incident = one_place ? flip : !clipped;
        return point(t, h, by_incident ? place.corner : end_corner(far), by_incident);
    }
};

/// Fraction of the way from a to b at which the incident side is nearest to an end of the
/// reference.
double nearest_share(const Place& a, const Place& b, double end) {
    // The s in [0, 1] that minimises |a + s (b - a) - (end, 0)|^2.
    const double t = b.t - a.t, h = b.h - a.h;
    return std::clamp(((end - a.t) * t - a.h * h) / (t * t + h * h), 0.0, 1.0);
}

/// A point beyond the end of the reference, with the polygons apart: the normal is along the line
/// from that end to (t, h). Named by the first polygon's corner.
ManifoldPoint beyond_end(const Facing& f, double end, double t, double h, int end_corner,
                         int incident_corner) {
    const double along = t - end, distance = std::sqrt(along * along + h * h);
    ManifoldPoint p = f.point(end + 0.5 * along, h, f.flip ? incident_corner : end_corner, f.flip);
    const double sign = (f.flip ? -1.0 : 1.0) / distance;
    p.nx = sign * (h * f.nx - along * f.ny);
    p.ny = sign * (h * f.ny + along * f.nx);
    p.gap = distance;
    p.turns_with = 0;
    return p;
}

/// Height of the incident side at t.
double height_at(const Place& a, const Place& b, double t) {
    return a.h + (b.h - a.h) * (t - a.t) / (b.t - a.t);
}

/// Overlap of the incident side, from the lowest corner p to q, with the reference side [0,
/// length].
struct Overlap {
    double start = 0.0;    ///< where the overlap begins: at p or at an end of the reference
    bool outside = false;  ///< p lies beyond an end of the reference
    bool beyond = false;
    bool shared = false;  ///< the overlap is not empty
};

Overlap overlap(const Place& p, const Place& q, double length, double same) {
    const bool before = p.t<-same, beyond = p.t> length + same;
    if (before) return {0.0, true, false, q.t > same};
    if (beyond) return {length, true, true, q.t < length - same};
    return {p.t, false, false, std::abs(q.t - p.t) > same};
}

ManifoldPoint first_point(const Facing& f, const Place& p, const Place& q, const Overlap& o) {
    if (!o.outside) return f.end_point(p.t, p.h, p, false);
    const int end_corner = f.end_corner(o.beyond);
    // 0 or 1: the nearest place of the incident side is one of its corners.
    const double share = p.h > 0.0 ? nearest_share(p, q, o.start) : 0.5;
    // Sides that lie flat on each other to rounding: the end of the overlap is the contact point.
    if (o.shared && share > 0.0 && share < 1.0)
        return f.end_point(o.start, height_at(p, q, o.start), p, true);
    if (!(p.h > 0.0)) return f.end_point(o.start, p.h, p, false);
    return beyond_end(f, o.start, p.t + share * (q.t - p.t), p.h + share * (q.h - p.h), end_corner,
                      share < 1.0 ? p.corner : q.corner);
}

/// The other end of the overlap.
ManifoldPoint second_point(const Facing& f, const Place& p, const Place& q) {
    const bool ahead = q.t > p.t;
    const double end = ahead ? f.length : 0.0;
    if (ahead ? q.t > end : q.t < end) return f.end_point(end, height_at(p, q, end), q, true);
    return f.end_point(q.t, q.h, q, false);
}

double common_length(const Facing& f, const Place& q, const Overlap& o) {
    return std::abs(std::clamp(q.t, 0.0, f.length) - o.start);
}

/// If the overlap is shorter than near_share, both ends lie at one corner of the reference and
/// would get one name: the first point is then named by the lowest incident corner.
void name_apart(const Facing& f, const Place& p, Manifold& manifold) {
    ManifoldPoint& one = manifold.points[0];
    const ManifoldPoint& other = manifold.points[1];
    if (one.corner != other.corner || one.of_second != other.of_second) return;
    one.corner = p.corner;
    one.of_second = !f.flip;
}

bool is_named(const Manifold& manifold, const ManifoldPoint& point) {
    for (int i = 0; i < manifold.count; ++i) {
        const ManifoldPoint& other = manifold.points[static_cast<std::size_t>(i)];
        if (other.corner == point.corner && other.of_second == point.of_second) return true;
    }
    return false;
}

/// The end of the overlap of the reference with the incident side that goes on from `from`, away
/// from corner `behind`, as a point of no length.
void add_further(const Facing& f, const Place& from, int behind, double direction, double alert,
                 double same, Manifold& manifold) {
    const double end = direction > 0.0 ? f.length : 0.0;
    // With no part of the reference ahead there is none.
    if (!(direction * (end - from.t) > f.near())) return;
    const int after = f.incident.after(from.corner);
    const Place to = f.place(after == behind ? f.incident.before(from.corner) : after);
    // A side that turns back is of the far half of the polygon.
    if (!(direction * (to.t - from.t) > same)) return;
    const ManifoldPoint point = direction * (to.t - end) > 0.0
                                    ? f.end_point(end, height_at(from, to, end), to, true)
                                    : f.end_point(to.t, to.h, to, false);
    if (point.gap < alert && !is_named(manifold, point))
        manifold.points[static_cast<std::size_t>(manifold.count++)] = point;
}

Manifold clip(const Facing& f, int lowest, double alert, double same) {
    const Place p = f.place(lowest), q = f.place(f.other_end(lowest));
    const Overlap o = overlap(p, q, f.length, same);
    Manifold manifold;
    manifold.points[0] = first_point(f, p, q, o);
    if (!(manifold.points[0].gap < alert)) return manifold;
    manifold.count = 1;
    const double length = common_length(f, q, o);
    // Sides that share no length touch in one point.
    if (!o.shared || !(length > same)) return manifold;
    manifold.points[1] = second_point(f, p, q);
    if (manifold.points[1].gap < alert) {
        manifold.count = 2;
        name_apart(f, p, manifold);
        for (ManifoldPoint& point : manifold.points) point.length = 0.5 * length;
    }
    // A plate has no further corners.
    if (f.incident.corners < 3) return manifold;
    const double direction = q.t > p.t ? 1.0 : -1.0;
    add_further(f, q, p.corner, direction, alert, same, manifold);
    if (!o.outside) add_further(f, p, q.corner, -direction, alert, same, manifold);
    return manifold;
}

template <int n>
Manifold detect(const PolygonView& first, const PolygonView& second, double ox, double oy,
                double alert) {
    const double same = same_share * (first.radius + second.radius);
    Axis mine;
    if (!find_axis<n, n>(first, second, ox, oy, alert, same, mine)) return {};
    Axis theirs;
    // Sides of the second polygon that cannot exceed the first's best by `same` are skipped.
    theirs.separation = mine.separation;
    if (!find_axis<n, n>(second, first, -ox, -oy, alert, same, theirs)) return {};
    if (theirs.separation > mine.separation)
        return clip(Facing(second, first, theirs.side, -ox, -oy, true), theirs.lowest, alert, same);
    return clip(Facing(first, second, mine.side, ox, oy, false), mine.lowest, alert, same);
}

}  // namespace

Manifold polygon_manifold(const PolygonView& first, const PolygonView& second, double ox, double oy,
                          double alert) {
    if (first.sides == 3 && second.sides == 3) return detect<3>(first, second, ox, oy, alert);
    return detect<0>(first, second, ox, oy, alert);
}

}  // namespace turbidite::nscd
