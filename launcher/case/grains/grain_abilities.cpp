// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/grain_abilities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/keys/limit_text.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "coupler/shapes/shortest_period.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"

namespace turbidite {
namespace {

/// Fewer cells show neither a grain's outline nor the flow around it.
double least_cells_across(const Settings& settings) {
    return in_space(settings) ? 6.0 : 4.0;
}

/// Of the diameter that the fluid sees: three quarters of that, so that discs with a smaller radius
/// in the fluid may do with the mesh of the others.
double least_cells_seen(const Settings& settings) {
    return 0.75 * least_cells_across(settings);
}

/// What no grain may be, and what is said of the first that is.
struct GrainRule {
    std::function<bool(const PlacedGrain&)> broken;
    std::function<std::string(const PlacedGrain&)> fault;
    std::string allowed, remedy;
};

std::string or_another_adapter(const std::string& remedy, bool (*able)(const GrainsAdapter&)) {
    return fmt::format("{}, or grains.adapter: {}.", remedy, adapters_that(able));
}

/// What the program that moves the grains cannot do.
std::vector<GrainRule> rules_of_adapter(const GrainsAdapter& adapter, const Settings& settings,
                                        const GrainForms& forms) {
    std::vector<GrainRule> rules;
    const auto moves = [&adapter](const std::string& kind) {
        return std::find(adapter.shapes.begin(), adapter.shapes.end(), kind) !=
               adapter.shapes.end();
    };
    if (moves(settings.text("grains.shape")))  // else the key's own rule has spoken
        rules.push_back(
            {[moves, &forms](const PlacedGrain& g) {
                 return !moves(forms.forms[g.shape].record.kind);
             },
             [&](const PlacedGrain&) { return "its shape is not supported by " + adapter.name; },
             fmt::format("It supports: {}.", fmt::join(adapter.shapes, ", ")),
             or_another_adapter("Use one of these",
                                [](const GrainsAdapter& a) { return a.shapes.size() > 1; })});
    if (!adapter.prescribed_grains)
        rules.push_back(
            {[](const PlacedGrain& g) { return g.prescribed; },
             [](const PlacedGrain&) { return std::string("motion is fixed or driven"); },
             fmt::format("{} supports free grains only.", adapter.name),
             or_another_adapter("Use motion = free",
                                [](const GrainsAdapter& a) { return a.prescribed_grains; })});
    if (!adapter.moved_grains)
        rules.push_back(
            {[](const PlacedGrain& g) { return !g.motion.empty(); },
             [](const PlacedGrain& g) { return "motion = " + g.motion; },
             fmt::format("In {} no grain follows a motion of domain.motions.", adapter.name),
             or_another_adapter("Use motion = free",
                                [](const GrainsAdapter& a) { return a.moved_grains; })});
    return rules;
}

/// What the laws of contact do not hold for.
std::vector<GrainRule> rules_of_contact(const Settings& settings, const GrainForms& forms) {
    std::vector<GrainRule> rules;
    for (const Ruling& objection : {corners_do_not_roll(settings), corners_have_no_films(settings)})
        // Of grains.shape its own rule has spoken.
        if (objection && shape_is_round(settings))
            rules.push_back(
                {[&forms](const PlacedGrain& g) {
                     return !forms.forms[g.shape].record.vertices.empty();
                 },
                 [](const PlacedGrain&) { return std::string("its shape has corners"); },
                 objection->allowed, objection->remedy});
    return rules;
}

/// The last height with equal rows, where grains have to stay below it.
std::optional<double> equal_height(const Settings& settings) {
    if (!rows_are_stretched(settings) || !is(settings, "fluid.allow_coarse", "false"))
        return std::nullopt;
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const auto rows = mesh_rows(settings, size.at(1));
    return rows ? std::optional(rows->equal_height()) : std::nullopt;
}

/// Of a grain, over the fluid's: its own, or grains.density_ratio. Where that has been refused it
/// is not judged again.
std::function<double(const PlacedGrain&)> density_of_grains(const Settings& settings) {
    const char* key = "grains.density_ratio";
    const double ratio =
        settings.has(key) ? settings.real(key) : std::numeric_limits<double>::infinity();
    return [ratio](const PlacedGrain& g) { return g.density.value_or(ratio); };
}

/// A = M - rho_f V(R_h) + the mass of the cells, as 6 x 6, has to be positive definite wherever the
/// sphere is in the mesh. Least rho_r of 221 and 600 random places, shift 0.3: 0.17, 0.23, 0.21,
/// 0.10, 0.07, 0.05 with 6 to 10 and 12 cells across; shift 0: 0.28 at most with 6, 0.12 with 8.
/// With twelve others that touch it and take some cells, of 300 places: 0.34, 0.27, 0.19, 0.12 with
/// 6, 7, 8 and 10. With a larger shift s they take more of R + s h, each a cap of s h, whose share
/// of the moment of inertia is 60 s^2 (1 + 2 s/c)^2/c^2 of twelve: in fcc contact with 8 across 0.3
/// to 0.4 for s = 0.4, to 0.6 for 0.5, 0.7 to 0.9 for 0.7 and 1.5 to 1.8 for 1.
double lightest_of_cells(double across, double shift) {
    const double taken = shift * (1.0 + 2.0 * shift / across), caps = 60.0 * taken * taken;
    return std::max(15.0, 8.4 + caps) / (across * across);
}

/// The same of A + T^T G^-1 T of a disc in the plane, 3 x 3. Least rho_r of its places in the mesh,
/// and of those with some points left out beside others and walls: 0.49, 0.45, 0.33, 0.36, 0.25,
/// 0.18, 0.13 and 0.08 with 4, 5, 6, 7, 8, 10, 12 and 16 cells across (0.08 to 0.12 up to 10 with
/// all points).
double lightest_of_points(double across) {
    return std::min(0.5, 21.0 / (across * across));
}

// Cells inside the surface points are all the inertia that a grain of the fluid's density has. Of
// discs 4 % of the places leave fewer than two of them with 4 cells across, none from 4.4 on.
constexpr double least_neutral = 4.4;

/// Bodies in the plane as thin as this let liquid through, as walls would (inner_walls.cpp).
constexpr double least_thickness = 2.0;

/// Of what the rule of grains.density_ratio says nothing else has to be said.
bool ratio_is_too_small(const Settings& settings) {
    const char* key = "grains.density_ratio";
    return settings.has(key) && settings.real(key) <= least_density(settings);
}

/// In the plane, where grains have points on their surfaces.
std::vector<GrainRule> rules_of_points(const Settings& settings, const GrainForms& forms,
                                       bool joint) {
    // Of what the fluid sees, in cells
    const auto cells = [&settings](const PlacedGrain& g, double length) {
        return length * seen_radius(settings, g.radius) * settings.real("fluid.cells_per_diameter");
    };
    const auto thickness = [=, &forms](const PlacedGrain& g) {
        return cells(g, least_width(g, forms));
    };
    const auto across = [=, &forms](const PlacedGrain& g) {
        return cells(g, mean_diameter(g, forms));
    };
    const auto is_polygon = [&forms](const PlacedGrain& g) {
        return g.radius > 0.0 && !forms.forms[g.shape].outline.empty();
    };
    std::vector<GrainRule> rules;
    rules.push_back(
        {[=](const PlacedGrain& g) { return is_polygon(g) && thickness(g) < least_thickness; },
         [=](const PlacedGrain& g) {
             return fmt::format("{:.3g} cells thick as the fluid sees it", thickness(g));
         },
         fmt::format("A polygon in a fluid is at least {:.0f} cells thick, as walls "
                     "are: liquid passes through thinner ones.",
                     least_thickness),
         "Use more fluid.cells_per_diameter or thicker grains."});
    if (!joint) return rules;
    const auto density = density_of_grains(settings);
    rules.push_back(
        {[=](const PlacedGrain& g) {
             return g.radius > 0.0 && !g.prescribed && density(g) < lightest_of_points(across(g));
         },
         [=](const PlacedGrain& g) {
             return fmt::format("density = {}, {:.3g} cells across", density(g), across(g));
         },
         "A grain as light as this may tie less fluid to it than its volume displaces, beside "
         "others and walls most of all, and no positive mass is left: a density of at least "
         "21/c^2, at most 0.5, with c cells across (0.33 with 8, 0.15 with 12; of polygons c is "
         "four times the area over the circumference).",
         "Use more fluid.cells_per_diameter, or a larger density."});
    const auto is_neutral = [density, &settings](const PlacedGrain& g) {
        return std::abs(density(g) - displaced_volume(settings, g.radius)) < 1e-9;
    };
    if (settings.text("fluid.points") != "interior")
        rules.push_back({[=](const PlacedGrain& g) {
                             return g.radius > 0.0 && !g.prescribed && is_neutral(g) &&
                                    across(g) < least_neutral;
                         },
                         [=](const PlacedGrain& g) {
                             return fmt::format("density = {}, {:.3g} cells across", density(g),
                                                across(g));
                         },
                         fmt::format("A grain of the density of the fluid it displaces is at least "
                                     "{} cells across (of polygons four times the area over the "
                                     "circumference): else it may have no inertia.",
                                     least_neutral),
                         "Use more fluid.cells_per_diameter, fluid.points: interior, or a density "
                         "that is a little larger."});
    return rules;
}

std::vector<GrainRule> rules_of_fluid(const Settings& settings, const GrainForms& forms) {
    std::vector<GrainRule> rules;
    const double cells = settings.real("fluid.cells_per_diameter");
    const double least = least_cells_across(settings);
    const auto across = [cells](const PlacedGrain& g) { return 2.0 * g.radius * cells; };
    // A radius that is not positive has been refused as such.
    const auto is_thin = [=](const PlacedGrain& g) {
        return g.radius > 0.0 && across(g) < least * (1.0 - 1e-12);
    };
    rules.push_back({is_thin,
                     [across](const PlacedGrain& g) {
                         return fmt::format("diameter {:.3g} D, {:.3g} cells", 2.0 * g.radius,
                                            across(g));
                     },
                     fmt::format("A grain in a fluid is at least {:.0f} cells wide.", least),
                     "Use more fluid.cells_per_diameter or larger grains."});
    // Of the cells that it covers, too (FluidWindow::check_rows)
    const auto top = [&settings](const PlacedGrain& g) {
        return g.y + g.radius * std::max(1.0, seen_radius(settings, g.radius));
    };
    if (const auto height = equal_height(settings))
        rules.push_back(
            {[=](const PlacedGrain& g) { return top(g) > *height * (1.0 + 1e-12); },
             [=](const PlacedGrain& g) { return fmt::format("reaches y = {:.4g} D", top(g)); },
             fmt::format("Grains stay where rows of cells are equal, below {} D "
                         "(fluid.stretch_from = {}).",
                         at_most_text(*height, 4), settings.text("fluid.stretch_from")),
             "Use a larger fluid.stretch_from, or fluid.allow_coarse: true."});
    const auto seen = [settings](const PlacedGrain& g) {
        return 2.0 * g.radius * seen_radius(settings, g.radius) *
               settings.real("fluid.cells_per_diameter");
    };
    rules.push_back({[=](const PlacedGrain& g) {
                         return g.radius > 0.0 && !is_thin(g) &&
                                seen(g) < least_cells_seen(settings);
                     },
                     [=](const PlacedGrain& g) {
                         return fmt::format("the fluid sees a diameter of {:.3g} cells", seen(g));
                     },
                     fmt::format("With its hydrodynamic radius a grain is at least {} cells wide.",
                                 least_cells_seen(settings)),
                     "Use more fluid.cells_per_diameter or a larger fluid.hydrodynamic_radius."});
    // Effective mass and inertia must be above zero unless `joint` leaves them to the fluid.
    const auto density = density_of_grains(settings);
    const bool joint = find_scheme(settings.text("coupling.scheme")).needs_inertia();
    const double shift = in_space(settings) ? settings.real("fluid.surface_shift") : 0.0;
    if (!in_space(settings))
        for (GrainRule& rule : rules_of_points(settings, forms, joint))
            rules.push_back(std::move(rule));
    if (joint && in_space(settings))
        rules.push_back(
            {[=](const PlacedGrain& g) {
                 return g.radius > 0.0 && !g.prescribed &&
                        density(g) < lightest_of_cells(across(g), shift);
             },
             [density](const PlacedGrain& g) { return fmt::format("density = {}", density(g)); },
             "A sphere as light as this may hold fewer cells of fluid than its volume "
             "displaces, and no positive mass is left: a density above 15/c^2 with c "
             "cells across (0.23 with 8, 0.1 with 12), with fluid.surface_shift s beyond 0.3 above "
             "(8.4 + 60 s^2 (1 + 2 s/c)^2)/c^2 (with 8: 0.43 for 0.5, 1.6 for 1).",
             "Use more fluid.cells_per_diameter, a smaller fluid.surface_shift, or a larger "
             "density."});
    if (!joint)
        rules.push_back(
            {[settings, density, told = ratio_is_too_small(settings)](const PlacedGrain& g) {
                 const bool judged = !g.prescribed && (g.density || !told);
                 return judged && density(g) <= least_density(settings, g.radius);
             },
             [density](const PlacedGrain& g) { return fmt::format("density = {}", density(g)); },
             "Without coupling.scheme: joint, grains in a fluid must be denser than what it sees "
             "of them.",
             "Use coupling.scheme: joint, or a density above 1 (in space: (1 + fluid.surface_shift "
             "/ cells per radius)^5)."});
    return rules;
}

// Sides of a box in which a round grain has the added mass that it has by itself or beside a wall.
constexpr double wide = 6.0;  // diameters

/// Of a disc, and of a sphere (C_a = 1/2, beside a wall 0.8), with a little to spare.
double lightest_alone(const Settings& settings) {
    return in_space(settings) ? 0.25 : 0.36;
}

bool is_alone(const Settings& settings, const Packing& grains, const GrainForms& forms) {
    if (grains.size() != 1 || !forms.forms[grains[0].shape].outline.empty()) return false;
    const auto size = real_list("domain.size", settings.text("domain.size"));
    return *std::min_element(size.begin(), size.end()) >= wide * 2.0 * grains[0].radius;
}

/// Where pressure does not know the grains, a projection leaves a body the share 1/(1 + C_a) of its
/// velocity, C_a the added mass over rho_f V, and step 5 gives it back what (rho_r - 1) stands for:
/// a factor (rho_r - 1 + 1/(1 + C_a))/rho_r per window, whatever its length. It is below -1 for
/// rho_r < C_a/(2 (1 + C_a)): 1/4 for a disc by itself, 0.35 for one that touches a wall (C_a =
/// pi^2/3 - 1), up to 1/2 for grains among others, images of their own, and long ones
/// (docs/decisions/multipliers.md).
std::vector<GrainRule> rules_of_splitting(const Settings& settings, const Packing& grains,
                                          const GrainForms& forms) {
    if (splitting_of(settings).rigid_grains) return {};
    const double alone = lightest_alone(settings);
    const double least = is_alone(settings, grains, forms) ? alone : 0.5;
    const auto density = density_of_grains(settings);
    return {{[=](const PlacedGrain& g) {
                 return !g.prescribed && density(g) < least * displaced_volume(settings, g.radius);
             },
             [density](const PlacedGrain& g) { return fmt::format("density = {}", density(g)); },
             fmt::format("With fluid.splitting: {} the velocity of a grain as light as this grows "
                         "from window to window, whatever their length: a density of at least {} "
                         "times that of the fluid it displaces{}.",
                         settings.text("fluid.splitting"), least,
                         least > alone
                             ? fmt::format(" ({} for a single round grain in a wide box)", alone)
                             : ""),
             "Use fluid.splitting: explicit-multiplier."}};
}

CaseProblem refused(const StartGrains& start, std::size_t i, const GrainRule& rule) {
    const PlacedGrain& grain = start.grains[i];
    const auto& lines = start.source.lines;
    return {.source = start.source.name,
            .line = i < lines.size() ? lines[i] : 0,
            .key = {},
            .value = {},
            .fault = fmt::format("grain {}: {}", grain.id, rule.fault(grain)),
            .allowed = rule.allowed,
            .remedy = rule.remedy};
}

/// Periods that differ from the shortest one by rounding only are refused as it is.
constexpr double same_period = 1e-9;

/// How far contact laws reach beyond touching, and the key that says so.
struct LawRange {
    double length = 0.0;  ///< [D]
    std::string key;
};

LawRange law_range(const Settings& s) {
    LawRange range;
    const auto at_least = [&range](double length, const char* key) {
        if (length > range.length) range = {length, key};
    };
    if (s.text("contact.adhesion") != "none")
        at_least(s.real("contact.adhesion_range"), "contact.adhesion_range");
    // A cut-off in cells, in D.
    if (has_films(s))
        at_least(s.real("contact.film_cutoff") / s.real("fluid.cells_per_diameter"),
                 "contact.film_cutoff");
    return range;
}

Objection too_short(const ShortestPeriod& shortest, const LawRange& range) {
    const std::string least = at_least_text(shortest.length(range.length), 4);
    if (shortest.pair() == 0.0)
        return {fmt::format("Cyclic sides are at least the largest grain apart, {} D.", least),
                "Make the box larger, or use wall or free sides."};
    if (range.length == 0.0)
        return {fmt::format("Cyclic sides are more than the two largest grains apart, {} D: "
                            "else two grains could touch on both sides.",
                            least),
                "Make the box larger, or use wall or free sides."};
    return {
        fmt::format("Cyclic sides are more than the two largest grains and twice {} = {:.4g} D "
                    "apart, {} D: else two grains could attract each other on both sides.",
                    range.key, range.length, least),
        fmt::format("Make the box larger, use wall or free sides, or a smaller {}.", range.key)};
}

}  // namespace

double seen_radius(const Settings& settings, double radius) {
    const double seen = settings.real("fluid.hydrodynamic_radius");
    if (!in_space(settings)) return seen;
    const double cells = settings.real("fluid.cells_per_diameter") * radius;
    return seen + settings.real("fluid.surface_shift") / cells;
}

double displaced_volume(const Settings& settings, double radius) {
    return std::pow(seen_radius(settings, radius), in_space(settings) ? 3 : 2);
}

double least_density(const Settings& settings, double radius) {
    for (const char* key :
         {"fluid.surface_shift", "fluid.cells_per_diameter", "fluid.hydrodynamic_radius"})
        if (!settings.has(key)) return 1.0;  // of the plane, or refused
    // M > rho_f V(R_h) and, the stronger of both, I > 2/5 rho_f V(R_h) R_h^2; at least 1, since
    // buoyancy acts on V(R).
    return std::max(1.0, std::pow(seen_radius(settings, radius), 5));
}

double least_density(const Settings& settings) {
    const auto given = [&settings](const char* key, double otherwise) {
        return settings.has(key) ? settings.real(key) : otherwise;
    };
    return least_density(
        settings, smallest_radius(given("grains.radius", 0.5), given("grains.size_ratio", 1.0)));
}

CaseProblems check_abilities(const StartGrains& start, const Settings& settings,
                             const GrainForms& forms) {
    const GrainsAdapter& adapter = grains_adapter(settings);
    std::vector<GrainRule> rules;
    const auto add = [&rules](std::vector<GrainRule> more) {
        std::move(more.begin(), more.end(), std::back_inserter(rules));
    };
    add(rules_of_adapter(adapter, settings, forms));
    add(rules_of_contact(settings, forms));
    if (settings.flag("fluid.enabled")) {
        add(rules_of_fluid(settings, forms));
        add(rules_of_splitting(settings, start.grains, forms));
    }
    CaseProblems problems;
    for (const GrainRule& rule : rules) {
        const auto at = std::find_if(start.grains.begin(), start.grains.end(), rule.broken);
        if (at != start.grains.end())
            problems.push_back(refused(start, at - start.grains.begin(), rule));
    }
    return problems;
}

CaseProblems check_periods(const Packing& grains, const Settings& settings,
                           const CaseEntries& entries) {
    ShortestPeriod shortest;
    for (const PlacedGrain& grain : grains) shortest.add(grain.radius, grain.prescribed);
    const LawRange range = law_range(settings);
    const PackingBox box = packing_box(settings);
    const auto fits = [&](bool periodic, double period) {
        return !periodic || shortest.allows(period, range.length, same_period);
    };
    if (fits(box.periodic_x, box.width) && fits(box.periodic_y, box.height) &&
        fits(box.periodic_z, box.depth))
        return {};
    return {problem_with("domain.size", too_short(shortest, range), settings, entries)};
}

}  // namespace turbidite
