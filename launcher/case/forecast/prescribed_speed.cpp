// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/prescribed_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "coupler/keys/key_spec.hpp"
#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "coupler/protocol/scene/space_walls.hpp"

namespace turbidite {
namespace {

constexpr std::int64_t most_windows = 1000;

/// Beginnings of the windows that are looked at.
std::vector<double> times_of(const Settings& settings, double step) {
    const std::int64_t windows = settings.integer("run.windows");
    const std::int64_t count = std::min(windows, most_windows);
    std::vector<double> times;
    for (std::int64_t n = 0; n < count; ++n) {
        // By the golden ratio: at equal distances a period that divides them would show one phase.
        double whole = 0.0;
        const double share = std::modf(0.6180339887498949 * static_cast<double>(n), &whole);
        const double window = count == windows ? static_cast<double>(n)
                                               : std::floor(share * static_cast<double>(windows));
        times.push_back(step * window);
    }
    return times;
}

/// A point of a body by its arm from the pivot, and how far others of a round surface are from it.
struct Point {
    Vec3 arm{};
    double radius = 0.0;
};

/// Of the body's points at t = 0: |w x arm| stays, since motions turn about one axis.
double speed(const Twist& twist, const Point& point) {
    return norm(twist.velocity) + norm(cross(twist.spin, point.arm)) +
           norm(twist.spin) * point.radius;
}

std::vector<Point> points_of(const SpaceWall& wall) {
    const Vec3 place = wall.place - wall.pivot;
    if (wall.kind == SpaceWallKind::plate)
        return {{place}, {place + wall.a}, {place + wall.b}, {place + wall.a + wall.b}};
    const double radius = std::max(wall.radius, wall.radius2);
    // The axis of a ring is a direction only.
    if (wall.kind == SpaceWallKind::ring) return {{place, radius}};
    return {{place, radius}, {place + wall.a, radius}};
}

/// The windows of a run and the largest speed found in them.
class Fastest {
 public:
    explicit Fastest(const Settings& settings)
        : step_(settings.real("run.step")), times_(times_of(settings, step_)) {}

    void add(const PrescribedMotion& motion, const std::vector<Point>& points) {
        for (const double time : times_) {
            const Twist twist = motion.rate(time, step_);
            for (const Point& point : points) speed_ = std::max(speed_, speed(twist, point));
        }
    }

    double speed_of_all() const { return speed_; }

 private:
    double step_;
    std::vector<double> times_;
    double speed_ = 0.0;
};

/// Sides of the box, also those through which fluid enters: they do not turn.
void add_sides(Fastest& fastest, const Settings& settings) {
    const int sides = first_plate(in_space(settings) ? 3 : 2);
    for (const char* key : {"run.wall_motions", "run.inflow_motions"})
        for (const Moved& moved : motions_of(settings, key))
            if (moved.what < sides) fastest.add(*moved.motion, {{}});
}

void add_walls(Fastest& fastest, const Settings& settings) {
    if (in_space(settings)) {
        for (const SpaceWall& wall : space_walls_of(settings))
            fastest.add(*wall.motion, points_of(wall));
        return;
    }
    for (const Plate& plate : plates_of(settings))
        fastest.add(*plate.motion, {{plate.from - plate.pivot}, {plate.to - plate.pivot}});
}

void add_grains(Fastest& fastest, const ResolvedCase& resolved) {
    const std::vector<Moved> motions = motions_of(resolved.settings, "run.grain_motions");
    if (motions.empty()) return;
    std::unordered_map<std::int64_t, double> radii;
    for (const GrainState& grain : resolved.population) radii[grain.id] = grain.radius;
    for (const Moved& moved : motions) fastest.add(*moved.motion, {{{}, radii[moved.what]}});
}

}  // namespace

double fastest_prescribed(const ResolvedCase& resolved) {
    Fastest fastest(resolved.settings);
    add_sides(fastest, resolved.settings);
    add_walls(fastest, resolved.settings);
    add_grains(fastest, resolved);
    return fastest.speed_of_all();
}

}  // namespace turbidite
