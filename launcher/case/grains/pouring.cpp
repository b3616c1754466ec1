// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/pouring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/sides.hpp"
#include "launcher/case/grains/random_packing.hpp"
#include "launcher/case/grains/space_lattice.hpp"

namespace turbidite {
namespace {

constexpr double loose_fraction = 0.25;  // of the falling grains

/// Ground area on which the grains are poured, x and z [D].
struct Ground {
    double length, depth;
};

Ground ground_of(const Settings& settings) {
    const bool given = settings.has("grains.region");
    const char* key = given ? "grains.region" : "domain.size";
    const auto size = real_list(key, settings.text(key));
    return {size.at(0), size.at(2)};
}

/// Solid volume [D3], and the largest diameter [D].
double solid_volume(const ResolvedCase& resolved) {
    double sum = 0.0;
    for (const PlacedGrain& grain : resolved.packing)
        sum += 4.0 / 3.0 * std::numbers::pi * grain.radius * grain.radius * grain.radius;
    return sum;
}

/// The type of a side while grains are poured: nothing leaves.
std::string type_of(const Settings& settings, const BoxSide& side, bool smaller) {
    const bool cyclic = settings.text(side.key) == "cyclic" && side.axis != 1 && !smaller;
    return cyclic ? "cyclic" : "wall";
}

std::vector<std::string> sides(const Settings& settings, const Ground& ground) {
    const auto box = real_list("domain.size", settings.text("domain.size"));
    std::vector<std::string> changes;
    for (const BoxSide& side : box_sides) {
        const bool smaller = side.axis == 0   ? ground.length < box.at(0)
                             : side.axis == 2 ? ground.depth < box.at(2)
                                              : false;
        changes.push_back(fmt::format("{}={}", side.key, type_of(settings, side, smaller)));
        if (settings.has(std::string(side.key) + "_motion"))
            changes.push_back(fmt::format("{}_motion=~", side.key));
    }
    return changes;
}

}  // namespace

bool is_poured(const Settings& settings) {
    return settings.text("grains.generator") == "poured" && !settings.has("grains.file");
}

std::vector<std::string> pouring_changes(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const Ground ground = ground_of(settings);
    const double height =
        std::ceil(solid_volume(resolved) / (loose_fraction * ground.length * ground.depth)) +
        4.0 * largest_radius(resolved.packing);
    std::vector<std::string> changes = sides(settings, ground);
    const std::string size = list_text({ground.length, height, ground.depth});
    changes.push_back("domain.size=" + size);
    changes.push_back("grains.region=" + size);
    changes.push_back("grains.generator=random");
    changes.push_back("grains.adapter=standalone-nscd");
    changes.push_back("grains.script=~");
    if (settings.has("grains.pour_friction"))
        changes.push_back("contact.friction=" + settings.text("grains.pour_friction"));
    for (const char* plain : {"output.interval=1", "checkpoint.interval=5", "checkpoint.keep=1",
                              "coupling.recording=none", "time.end=10"})
        changes.emplace_back(plain);
    return changes;
}

PackingResult poured_stand_in(const PackingRequest& request) {
    PackingResult result;
    RandomNumbers random(request.seed);
    const std::vector<double> radii = draw_radii(request, random);
    const SpaceLattice& lattice = space_lattice("fcc");
    result.grains = lattice_sites(lattice, request.filled(), radii.front(), lattice.densest());
    if (result.grains.size() < radii.size()) {
        result.refusal = fmt::format(
            "A region of {} x {} x {} D holds {} of them at most. Ask for fewer grains or enlarge "
            "{}.",
            request.filled().width, request.filled().height, request.filled().depth,
            result.grains.size(), request.region ? "grains.region" : "domain.size");
        return result;
    }
    result.grains.resize(radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) result.grains[i].radius = radii[i];
    result.notes.push_back(fmt::format(
        "{} grains are poured before the run, in a dry run of its own that is kept for other runs "
        "of the same packing; the forecast leaves it out",
        request.count));
    return result;
}

}  // namespace turbidite
