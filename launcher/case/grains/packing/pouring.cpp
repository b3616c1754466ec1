// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/pouring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"

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

/// On the lowest sites of a lattice; in narrow regions the stand-ins are smaller than the grains.
Packing on_lattice(const PackingRegion& region, const std::vector<double>& radii) {
    const SpaceLattice& lattice = space_lattice("fcc");
    Packing sites;
    double size = 1.0;
    // A stand-in must have its number of grains, not their size: smaller until all have a site.
    for (; sites.size() < radii.size(); size *= 0.97)
        sites =
            lattice_sites(lattice, region, size * radii.front(), lattice.densest(), radii.size());
    const double largest = sites.front().radius;
    for (std::size_t i = 0; i < radii.size(); ++i)
        sites[i].radius = largest * radii[i] / radii.front();
    return sites;
}

std::string too_dense(const PackingRequest& request, double fraction) {
    const PackingRegion region = request.filled();
    return fmt::format(
        "They would fill {:.3g} of {} x {} x {} D; poured packings fill {} at most. Ask for "
        "fewer grains or enlarge {}.",
        fraction, region.width, region.height, region.depth, densest_poured,
        request.region ? "grains.region" : "domain.size");
}

/// As the generator of the pouring run draws them.
std::vector<double> radii_of(const Settings& settings) {
    const GrainForms forms = make_grain_forms(settings);
    RandomNumbers random(static_cast<std::uint64_t>(settings.integer("random.seed")));
    return draw_radii({.box = {},
                       .count = settings.integer("grains.count"),
                       .forms = &forms,
                       .size_ratio = settings.real("grains.size_ratio")},
                      random);
}

/// The type of a side while grains are poured: nothing leaves.
std::string type_of(const Settings& settings, const BoxSide& side, bool smaller) {
    // Ground and top are walls always. A region that ends before the box has walls there, which the
    // run itself does not have.
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

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

/// grains.pour_friction, if given, of all contacts: one law, one coefficient.
std::vector<std::string> own_friction(const Settings& settings) {
    if (!settings.has("grains.pour_friction")) return {};
    const std::string value = settings.text("grains.pour_friction");
    std::vector<std::string> changes{"contact.law=coulomb", "contact.friction=" + value};
    const auto ends = [](const std::string& key, const std::string& name) {
        return key.size() > name.size() &&
               key.compare(key.size() - name.size(), name.size(), name) == 0;
    };
    for (const auto& [key, old] : settings.entries()) {
        if (key.rfind("contact.", 0) != 0) continue;
        if (ends(key, ".static_friction")) changes.push_back(key + "=~");
        if (ends(key, ".friction") && key != "contact.friction")
            changes.push_back(key + "=" + value);
    }
    return changes;
}

/// Falling and coming to rest have the scales of gravity, whatever those of the run are: with
/// another u_c grains in free fall would count as at rest, or windows would be too long.
std::vector<std::string> own_scales(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const Scales& scales = resolved.scales;
    std::vector<std::string> changes{"scales.kind=avalanche"};
    for (const auto& [key, old] : settings.entries())
        if (key.rfind("scales.", 0) == 0 && key != "scales.kind" && key != "scales.compacity")
            changes.push_back(key + "=~");
    // From u_c to sqrt(g D)
    const double factor = scales.velocity / std::sqrt(scales.gravity * scales.diameter);
    for (const char* speed : {"contact.restitution_speed", "contact.recovery_speed"})
        if (settings.has(speed))
            changes.push_back(
                fmt::format("{}={}", speed, real_text(factor * settings.real(speed))));
    return changes;
}

}  // namespace

bool is_poured(const Settings& settings) {
    return settings.text("grains.generator") == "poured" && !settings.has("grains.file");
}

std::vector<std::string> pouring_changes(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const Ground ground = ground_of(settings);
    const std::vector<double> radii = radii_of(settings);
    const double solid = solid_volume(radii);
    // A box in which the grains fill a quarter at random places, and two of the largest on top.
    const double height =
        std::ceil(solid / (loose_fraction * ground.length * ground.depth)) + 4.0 * radii.front();
    std::vector<std::string> changes = sides(settings, ground);
    const std::string size = list_text({ground.length, height, ground.depth});
    changes.push_back("domain.size=" + size);
    changes.push_back("grains.region=" + size);
    changes.push_back("fluid.enabled=false");
    changes.push_back("grains.generator=random");
    // Whatever plays the run: pouring needs no host code.
    changes.push_back("grains.adapter=standalone-nscd");
    // Nor do ranks and threads count: spheres have the same digits on any number.
    changes.push_back("grains.ranks=1");
    changes.push_back("contact.threads=1");
    changes.push_back("grains.script=~");
    // Walls inside would cut grains that begin at random places, and those that move would stir
    // them.
    for (const char* file : {"grains.extra_file", "domain.walls_file"})
        if (settings.has(file)) changes.push_back(std::string(file) + "=~");
    append(changes, own_friction(settings));
    append(changes, own_scales(resolved));
    for (const char* plain :
         {"time.step=0.01", "time.end=10", "output.interval=1", "output.probes=~",
          "output.slices=none", "checkpoint.interval=5", "checkpoint.keep=1",
          "coupling.recording=none",
          // Several ranks may pour, which cannot do all that one can.
          "coupling.scheme=auto", "contact.dump_interval=~", "output.timeline=false"})
        changes.emplace_back(plain);
    return changes;
}

void take_poured_radii(Packing& stand_ins, const Settings& settings) {
    const std::vector<double> radii = radii_of(settings);
    // There are none where they were refused.
    const std::size_t count = std::min(radii.size(), stand_ins.size());
    for (std::size_t i = 0; i < count; ++i) stand_ins[i].radius = radii[i];
}

PackingResult poured_stand_in(const PackingRequest& request) {
    PackingResult result;
    if (const double least = least_solid_fraction(request); least > densest_poured) {
        result.refusal = too_dense(request, least);
        return result;
    }
    RandomNumbers random(request.seed);
    const std::vector<double> radii = draw_radii(request, random);
    const PackingRegion region = request.filled();
    const double fraction = solid_volume(radii) / region.volume();
    if (fraction > densest_poured) {
        result.refusal = too_dense(request, fraction);
        return result;
    }
    result.grains = on_lattice(region, radii);
    result.notes.push_back(fmt::format(
        "{} grains are poured before the run, in a dry run of its own that is kept for other runs "
        "of the same packing; the forecast leaves it out",
        request.count));
    return result;
}

}  // namespace turbidite
