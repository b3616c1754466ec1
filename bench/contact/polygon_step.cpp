// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench-polygons: times contact detection between triangles that fill the plane.
//
// The plane is tiled with equilateral triangles, alternately up and down, each shrunk by 1 % and
// rotated by up to half a degree: every triangle faces three others side by side and nine at its
// corners. Timed are the placing of all corners and the narrow phase on every pair from the broad
// phase, i.e. with circumscribed circles closer than the alert distance of a step at rest (0.02 of
// both radii). All of these pairs need a test of the shapes; `near` counts those that are within
// the alert distance.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <random>

#include "bench/timing/step_clock.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/rigid/vec3.hpp"
#include "coupler/shapes/shape.hpp"
#include "granular_adapter/nscd/detection/broad_phase.hpp"
#include "granular_adapter/nscd/detection/narrow_phase.hpp"

namespace turbidite::bench {
namespace {

constexpr double radius = 0.75, alert_share = 0.02, shrink = 0.01, most_turn = 0.01;

struct Options {
    int rows = 60, warm_up = 1, steps = 1;
    std::filesystem::path result;
};

nscd::Body triangle(GrainId id, double x, double y, double angle) {
    nscd::Body body;
    body.id = id;
    body.radius = radius;
    body.inertia = body.density = body.mass = body.weight_mass = 1.0;  // no body moves
    body.position = {x, y, 0.0};
    body.orientation = {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
    return body;
}

/// `rows` rows of 2 `rows` triangles; the height of a row is 3/2 of the tile's radius.
nscd::Bodies tiling(int rows) {
    const double tile = radius * (1.0 + shrink), half_side = 0.5 * std::sqrt(3.0) * tile;
    std::mt19937_64 random(1);
    nscd::Bodies bodies;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < 2 * rows; ++column) {
            const bool down = (row + column) % 2 != 0;
            const double part = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
            bodies.add(triangle(row * 2 * rows + column, half_side * column,
                                1.5 * tile * row + (down ? 0.5 * tile : 0.0),
                                (down ? std::numbers::pi : 0.0) + most_turn * part));
        }
    return bodies;
}

/// Returns the number of pairs whose shapes are within the alert distance; appends their points.
double detect(const nscd::NarrowPhase& narrow, const nscd::Bodies& bodies,
              const std::vector<nscd::Pair>& pairs, std::vector<nscd::ContactPoint>& points) {
    using namespace nscd;
    const PlacedShapes placed = narrow.place(bodies);
    double near = 0.0;
    for (const Pair& pair : pairs) {
        const std::size_t before = points.size();
        const Vec3 offset = bodies.position[pair.b] - bodies.position[pair.a];
        narrow.pair({bodies, pair.a, pair.b, offset, 2.0 * alert_share * radius, &placed}, points);
        near += points.size() > before ? 1.0 : 0.0;
    }
    return near;
}

Sample run(const Options& options) {
    const nscd::Bodies bodies = tiling(options.rows);
    const ShapeTable shapes = {{"triangle", {}}};
    const nscd::NarrowPhase narrow(shapes);
    StepClock clock, broad;
    std::vector<nscd::ContactPoint> points;
    std::vector<nscd::Pair> pairs;
    double near = 0.0;
    for (int n = 0; n < options.warm_up + options.steps; ++n) {
        broad.start();
        pairs =
            nscd::candidate_pairs(bodies.position, bodies.radius, 2.0 * alert_share * radius, {});
        broad.stop();
        points.clear();
        clock.start();
        near = detect(narrow, bodies, pairs, points);
        if (n >= options.warm_up) clock.stop();
    }
    Sample sample;
    sample.processor = clock.processor();
    sample.wall = clock.wall();
    sample.parts = {{"broad", broad.wall()}};
    const auto count = static_cast<double>(pairs.size());
    sample.counts = {{"triangles", static_cast<double>(bodies.size())},
                     {"pairs", count},
                     {"near", near},
                     {"points", static_cast<double>(points.size())},
                     {"rate", count / sample.processor}};
    return sample;
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"A worker of `turbidite bench contact`", "turbidite-bench-polygons"};
    app.add_option("--rows", options.rows,
                   "rows of triangles; each row has twice as many triangles");
    app.add_option("--warm-up", options.warm_up, "detections before the timed ones");
    app.add_option("--steps", options.steps, "timed detections");
    app.add_option("--result", options.result, "file to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        turbidite::bench::write_sample(turbidite::bench::run(options), options.result);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-polygons: %s\n", error.what());
        return static_cast<int>(turbidite::ExitCode::participant_failed);
    }
    return 0;
}
