// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid: mesh, ranks, multipliers, transport, linear solvers.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/keys/limit_text.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/fluid_cut.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/transform_length.hpp"
#include "launcher/case/keys/fluid_program.hpp"
#include "launcher/case/keys/key_groups.hpp"
#include "launcher/case/keys/transport_schemes.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {
namespace {

bool needs_reynolds(const Settings& s) {
    return is(s, "fluid.enabled", "true") && !is(s, "scales.kind", "physical");
}

/// u_c D/nu, or nothing unless the keys it depends on are all valid.
std::optional<double> reynolds_of(const Settings& s) {
    const bool physical = s.text("scales.kind") == "physical";
    const std::vector<const char*> needed =
        physical ? std::vector<const char*>{"scales.diameter",      "scales.gravity",
                                            "scales.fluid_density", "scales.viscosity",
                                            "grains.density_ratio", "scales.compacity"}
                 : std::vector<const char*>{"fluid.reynolds", "grains.density_ratio",
                                            "scales.compacity"};
    for (const char* key : needed)
        if (!s.has(key)) return std::nullopt;
    return make_scales(s).reynolds;
}

Ruling transport_scheme_is_known(const Settings& s) {
    const SchemeChoice choice = read_transport_scheme(s.text("fluid.transport_scheme"));
    if (choice.scheme) return std::nullopt;
    return Objection{choice.fault, choice.remedy};
}

// Speeds of jets between settling grains, as reached in sedimentation-discs.yaml [u_c].
constexpr double usual_peak = 6.0;
constexpr double highest_peak = 8.0;

// Transport is cut into parts with at most this Courant number, up to a largest number of parts
// (fluid_adapter/box_step/transport/transport_parts.hpp).
constexpr double cells_per_part = 2.0 / 3.0;
constexpr double most_parts = 1000.0;

Ruling transport_can_be_cut(const Settings& s) {
    const double cells = s.real("fluid.cells_per_diameter");
    const double largest = cells_per_part * most_parts / (highest_peak * cells);
    if (!s.flag("fluid.enabled") || s.real("time.step") <= largest * (1.0 + 1e-12))
        return std::nullopt;
    return Objection{
        fmt::format(
            "Transport is cut into at most {:.0f} parts per window, in each of which the "
            "fastest jets (up to {:.0f} u_c) cross {:.2g} of a cell: at {} cells per diameter "
            "the step must be at most {} t_c.",
            most_parts, highest_peak, cells_per_part, s.text("fluid.cells_per_diameter"),
            at_most_text(largest, 3)),
        "Use a smaller step or fewer cells."};
}

/// The largest stable step [t_c] of a scheme of this kind for a fluid speed of `peak` [u_c], if the
/// step of the case exceeds it: 2 nu/u2 (transport_schemes.hpp), for a part of a window. If cells
/// are so small that no part exceeds it, any step is stable.
std::optional<double> step_limit_exceeded(const Settings& s, SchemeKind kind, double peak) {
    const SchemeChoice choice = read_transport_scheme(s.text("fluid.transport_scheme"));
    if (!s.flag("fluid.enabled") || !choice.scheme || choice.scheme->kind != kind)
        return std::nullopt;
    if (is(s, "fluid.time_scheme", "second-order")) return std::nullopt;  // stable with all of them
    const std::optional<double> reynolds = reynolds_of(s);
    if (!reynolds) return std::nullopt;
    const double limit = 2.0 / (*reynolds * peak * peak);
    const double longest_part = cells_per_part / (peak * s.real("fluid.cells_per_diameter"));
    if (std::min(s.real("time.step"), longest_part) <= limit * (1.0 + 1e-12)) return std::nullopt;
    return limit;
}

Ruling scheme_is_stable(const Settings& s) {
    const auto limit = step_limit_exceeded(s, SchemeKind::central, usual_peak);
    if (!limit) return std::nullopt;
    return Objection{
        fmt::format("Explicit transport with central differences is unstable for steps above 2 "
                    "nu/u^2, and jets between grains reach u = {:.0f} to {:.0f} u_c: at most 2/(36 "
                    "Re) = {} t_c, but time.step = {}.",
                    usual_peak, highest_peak, at_most_text(*limit, 3), s.text("time.step")),
        "Use fluid.time_scheme: second-order, Gauss limitedLinearV 1, which stays bounded, or a "
        "smaller step."};
}

/// Between walls, a uniform force changes the pressure and nothing else.
Ruling acceleration_is_along_cyclic_sides(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const std::vector<double> force = real_list("fluid.acceleration", s.text("fluid.acceleration"));
    for (std::size_t side = 0; side < side_count(static_cast<int>(force.size())); side += 2) {
        const char *one = box_sides[side].key, *other = box_sides[opposite(side)].key;
        // Front and back are not in the plane, and not here where their value was refused.
        if (force.at(side / 2) != 0.0 && s.has(one) && !is(s, one, "cyclic"))
            return Objection{
                fmt::format("{} is {}: a uniform force drives a flow between cyclic sides only.",
                            one, s.text(one)),
                fmt::format("Use {} and {}: cyclic, or 0 for this component.", one, other)};
    }
    return std::nullopt;
}

Ruling ranks_have_cells(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const std::vector<double> size = real_list("domain.size", s.text("domain.size"));
    const bool rows = s.text("fluid.decomposition") == "rows";
    const double cells = s.real("fluid.cells_per_diameter");
    const double layers = rows ? fluid_rows(s) : size.at(0) * cells;
    const double most = std::max(1.0, std::floor(layers / double{least_layers}));
    if (static_cast<double>(s.integer("fluid.ranks")) <= most) return std::nullopt;
    return Objection{fmt::format("A rank needs at least {} {} of cells, but there are {}.",
                                 real_text(double{least_layers}), s.text("fluid.decomposition"),
                                 real_text(layers)),
                     fmt::format("Use {} or fewer.", real_text(most))};
}

Ruling rows_can_stretch(const Settings& s) {
    if (!s.flag("fluid.enabled") || s.real("fluid.stretch_ratio") <= 1.0) return std::nullopt;
    const double top = real_list("domain.size", s.text("domain.size")).at(1);
    if (is(s, "domain.bottom", "cyclic"))
        return Objection{"Rows of cells cannot be stretched between cyclic sides.",
                         "Set fluid.stretch_ratio: 1, or use walls or free sides."};
    if (mesh_rows(s, top)) return std::nullopt;
    const double room = least_stretched_room(s), highest = top - room;
    if (std::isinf(room))
        return Objection{fmt::format("Rows that grow by a ratio of {} are as good as equal.",
                                     s.text("fluid.stretch_ratio")),
                         "Set fluid.stretch_ratio: 1, or a larger ratio."};
    if (highest >= s.real("fluid.stretch_from"))
        return Objection{
            fmt::format("A domain that ends at {} D has more rows than any mesh.", real_text(top)),
            "Use a smaller domain.size."};
    if (!(highest > 0.0))
        return Objection{fmt::format("Rows need {:.3g} D to grow by a ratio of {}, and the domain "
                                     "is {} D high.",
                                     room, s.text("fluid.stretch_ratio"), real_text(top)),
                         "Set fluid.stretch_ratio: 1, or a larger ratio."};
    return Objection{
        fmt::format("Rows need {:.3g} D to grow by a ratio of {}, and the domain ends at {} D.",
                    room, s.text("fluid.stretch_ratio"), real_text(top)),
        fmt::format("Use {} or less, a larger fluid.stretch_ratio, or fluid.stretch_ratio: 1.",
                    at_most_text(highest, 4))};
}

std::string sentence(const std::string& text) {
    return text.empty() ? "" : " " + text + ".";
}

Ruling mesh_fits_in_memory(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const double cells = fluid_cells(s), needed = fluid_memory(s), limit = memory_limit(s);
    if (needed <= limit && cells <= most_cells) return std::nullopt;
    const bool too_many = cells > most_cells;
    return Objection{
        too_many ? fmt::format("The mesh would have {:.2g} cells; {} counts up to {:.0e}.", cells,
                               has_openfoam(s) ? "OpenFOAM" : "the box program", most_cells)
                 : fmt::format("The mesh of {:.3g} million cells takes about {:.3g} GB, and there "
                               "are {:.3g} GB{}.",
                               cells / 1e6, needed, limit,
                               s.has("limits.memory") ? " (limits.memory)" : " in this machine"),
        fmt::format("Use a smaller domain.size, fewer cells or fluid.stretch_ratio{}.{}",
                    too_many ? "" : ", or set limits.memory for a larger machine",
                    too_many ? "" : sentence(hint_of_box(s)))};
}

Ruling reynolds_follows(const Settings& s) {
    if (s.text("scales.kind") != "physical") return std::nullopt;
    return Objection{
        "With scales.kind: physical the Reynolds number follows from scales.viscosity.",
        "Remove it."};
}

constexpr const char* papers_splitting = splittings[0].name;

std::vector<Choice> splitting_choices() {
    std::vector<Choice> choices;
    for (const Splitting& splitting : splittings)
        choices.push_back({splitting.name, splitting.help});
    return choices;
}

/// What splittings other than the paper's need, beside their own names.
struct Needed {
    const char* key;
    const char* value;
    const char* why;
};
std::vector<Needed> needed_with_rigid_grains() {
    return {{"coupling.scheme", scheme_with_inertia().name,
             "it carries contact impulses from window to window"},
            {"fluid.pressure_solver", "FFT", "that solve is its preconditioner"},
            {"fluid.viscous_solver", "FFT", "it works on the rows of a box"},
            {"fluid.decomposition", "rows", "it works on complete rows of cells"}};
}

Ruling splitting_has_what_it_needs(const Settings& s) {
    if (!s.flag("fluid.enabled") || !splitting_of(s).rigid_grains) return std::nullopt;
    for (const Needed& needed : needed_with_rigid_grains())
        if (!is(s, needed.key, needed.value))
            return Objection{
                fmt::format("This splitting needs {} = {}: {}; it is {}.", needed.key, needed.value,
                            needed.why, s.text(needed.key)),
                fmt::format("Set {}: {}, or use {}.", needed.key, needed.value, papers_splitting)};
    const std::string& scheme = s.text("fluid.transport_scheme");
    // In space no splitting has other schemes (space_keys.cpp).
    if (in_space(s) || is_scheme_on_rows(scheme)) return std::nullopt;
    return Objection{
        fmt::format("This splitting works on rows of a box, which know Gauss limitedLinearV, "
                    "linear, LUST and linearUpwind; fluid.transport_scheme = {}.",
                    scheme),
        fmt::format("Use Gauss limitedLinearV 1, or {}.", papers_splitting)};
}

std::string unless(bool used, const Settings& s, const std::string& reason) {
    if (const std::string dry = without_fluid(s); !dry.empty()) return dry;
    return used ? "" : reason;
}
std::string without_fluid_ranks(const Settings& s) {
    return unless(s.integer("fluid.ranks") > 1, s, "with fluid.ranks: 1");
}
std::string without_iterative_pressure(const Settings& s) {
    return unless(!is(s, "fluid.pressure_solver", "FFT"), s, "with fluid.pressure_solver: FFT");
}
std::string without_iterative_viscosity(const Settings& s) {
    return unless(!is(s, "fluid.viscous_solver", "FFT"), s, "with fluid.viscous_solver: FFT");
}
std::string without_iterated_multipliers(const Settings& s) {
    return unless(!in_space(s), s, "with dimension: 3, where multipliers are in closed form");
}
std::string with_splitting(const Settings& s) {
    return "with fluid.splitting: " + s.text("fluid.splitting");
}
std::string without_iterated_splitting(const Settings& s) {
    return unless(splitting_of(s).iterated, s, with_splitting(s));
}
std::string without_rigid_grains(const Settings& s) {
    return unless(splitting_of(s).rigid_grains, s, with_splitting(s));
}
bool rows_stretch(const Settings& s) {
    return is(s, "fluid.enabled", "true") && s.has("fluid.stretch_ratio") &&
           s.real("fluid.stretch_ratio") > 1.0;
}
std::string without_stretched_rows(const Settings& s) {
    return unless(rows_stretch(s), s, "with fluid.stretch_ratio: 1");
}
std::string without_boundary_points(const Settings& s) {
    return unless(!is(s, "fluid.points", "interior"), s, "with fluid.points: interior");
}

/// In the plane pores between grains that touch are closed, and so is the wedge around a contact,
/// which nothing can then open. With this many cells between grains that touch they part wherever
/// they lie in the mesh (docs/splittings.md).
constexpr double cells_to_part = 0.6;

void tell_closed_contacts(const Settings& s, std::vector<std::string>& notes) {
    if (!s.flag("fluid.enabled") || !splitting_of(s).rigid_grains || in_space(s)) return;
    const double cells = s.real("fluid.cells_per_diameter"),
                 between = (1.0 - s.real("fluid.hydrodynamic_radius")) * cells;
    if (between >= cells_to_part - 1e-9) return;
    notes.push_back(fmt::format(
        "fluid.splitting = {}: grains that touch leave {:.2g} cells of fluid between them; below "
        "{} "
        "pressure may hold them together and on walls, the more the shorter the step. With "
        "fluid.hydrodynamic_radius up to {:.2f} they part, with {} too",
        s.text("fluid.splitting"), between, cells_to_part,
        std::floor(100.0 * (1.0 - cells_to_part / cells)) / 100.0, papers_splitting));
}

/// The one that corrects until a tolerance.
std::string iterated_splitting() {
    const auto at = std::find_if(splittings.begin(), splittings.end(),
                                 [](const Splitting& splitting) { return splitting.iterated; });
    return at->name;
}

/// Only a splitting that corrects pressure after the contacts turns the fluid around a grain round
/// with it; with the others this fluid takes back a part of the rebound in the windows after it.
void tell_weak_rebounds(const Settings& s, std::vector<std::string>& notes) {
    if (!s.flag("fluid.enabled") || splitting_of(s).iterated) return;
    const std::string key = positive_coefficient(s, "restitution");
    if (key.empty()) return;
    notes.push_back(fmt::format(
        "{} = {} with fluid.splitting = {}: rebounds come out too weak, since pressure learns of "
        "impacts only in the next window; with {} they do not, at some four times the cost where "
        "grains touch (docs/splittings.md)",
        key, s.text(key), s.text("fluid.splitting"), iterated_splitting()));
}

// nu dt/h2 up to which nothing is told: the velocity of a settling disc is 15 % off at 0.4, that of
// a sphere 23 % at 1.1 (docs/validation.md, docs/spheres-in-liquid.md).
constexpr double leaks_from = 0.2;

// nu dt/h2 from which a single correction of viscosity leaves a part of it: a steady flow is 2 to 6
// % off and unsteady at 64, 4 to 19 % at 128, up to 95 % at 1280.
constexpr double too_viscous = 10.0;

/// nu dt/h2; none without a Reynolds number.
std::optional<double> diffused_in_a_window(const Settings& s) {
    const std::optional<double> reynolds = reynolds_of(s);
    if (!reynolds) return std::nullopt;
    const double cells = s.real("fluid.cells_per_diameter");
    return s.real("time.step") * cells * cells / *reynolds;
}

/// A correction that is not iterated.
void tell_missing_viscosity(const Settings& s, std::vector<std::string>& notes) {
    if (!s.flag("fluid.enabled")) return;
    const Splitting& splitting = splitting_of(s);
    const double diffused = diffused_in_a_window(s).value_or(0.0);
    if (!splitting.rigid_grains || splitting.iterated || diffused <= too_viscous) return;
    notes.push_back(fmt::format(
        "fluid.splitting = {}: nu dt/h2 = time.step cells^2/Re = {:.2g} is more than "
        "one correction of viscosity can do, and flow is too fast and unsteady, by some "
        "5 % at 60 and 20 % at 130; use time.step <= {:.2g}, or {}",
        s.text("fluid.splitting"), diffused, s.real("time.step") * too_viscous / diffused,
        iterated_splitting()));
}

// Of pressure, over rho_f u_c^2: what probes and pictures begin to show.
constexpr double noise = 0.1;

/// An error of pressure whose divergence is below the tolerance: the longest wave of the box, k =
/// pi/L, has k^2 p dt/rho_f.
void tell_noise_of_pressure(const Settings& s, std::vector<std::string>& notes) {
    if (!s.flag("fluid.enabled") || !splitting_of(s).iterated) return;
    const auto size = real_list("domain.size", s.text("domain.size"));
    const double longest = *std::max_element(size.begin(), size.end()) / M_PI;
    const double tolerance = s.real("fluid.splitting_tolerance");
    const double error = tolerance * longest * longest / s.real("time.step");
    if (error <= noise) return;
    notes.push_back(fmt::format(
        "fluid.splitting_tolerance = {:.2g}: pressure may be off by up to tolerance "
        "(L/pi)^2/time.step = {:.2g} rho_f u_c2, otherwise in every window (forces on grains "
        "hardly feel it); for pictures and probes of p use fluid.splitting_tolerance <= {:.1g}",
        tolerance, error, tolerance * noise / error));
}

/// Without a correction with rigid grains, liquid leaks through them in viscous windows.
void tell_leakage(const Settings& s, std::vector<std::string>& notes) {
    if (!s.flag("fluid.enabled") || splitting_of(s).rigid_grains) return;
    const double diffused = diffused_in_a_window(s).value_or(0.0);
    if (diffused <= leaks_from) return;
    notes.push_back(fmt::format(
        "fluid.splitting = {}: with nu dt/h2 = time.step cells^2/Re = {:.2g} liquid leaks through "
        "grains, and they settle too fast, by some 20 % at 1; with a shorter step it leaks less, "
        "and with explicit-multiplier (contact dynamics) hardly (docs/splittings.md)",
        s.text("fluid.splitting"), diffused));
}

void fluid_notes(const Settings& s, std::vector<std::string>& notes) {
    tell_closed_contacts(s, notes);
    tell_leakage(s, notes);
    tell_missing_viscosity(s, notes);
    tell_noise_of_pressure(s, notes);
    tell_weak_rebounds(s, notes);
    const std::string& scheme = s.text("fluid.transport_scheme");
    if (const auto limit = step_limit_exceeded(s, SchemeKind::central, highest_peak))
        notes.push_back(
            fmt::format("fluid.transport_scheme = {}: where jets between grains reach {:.0f} u_c "
                        "it is unstable "
                        "beyond 2/(64 Re) = {:.3g} t_c, and time.step = {}",
                        scheme, highest_peak, *limit, s.text("time.step")));
    if (const auto limit = step_limit_exceeded(s, SchemeKind::biased, usual_peak))
        notes.push_back(fmt::format(
            "fluid.transport_scheme = {}: where jets between grains reach {:.0f} u_c its explicit "
            "transport may grow beyond 2/(36 Re) = {:.3g} t_c, and time.step = {}; Gauss "
            "limitedLinearV 1 stays bounded",
            scheme, usual_peak, *limit, s.text("time.step")));
    if (s.flag("fluid.enabled") && s.text("fluid.pressure_solver") == "FFT")
        for (std::string& slow : slow_transforms(s)) notes.push_back(std::move(slow));
}

/// Ranks and cells.
std::vector<KeySpec> mesh_keys() {
    return {
        {.name = "fluid.enabled",
         .type = KeyType::flag,
         .fallback = "true",
         .help = "false: dry grains, no fluid program"},
        program_key(),
        {.name = "fluid.ranks",
         .type = KeyType::integer,
         .fallback = "1",
         .range = {.lower = 1.0, .upper = 4096.0},
         .help = "MPI ranks of the fluid program",
         .idle = without_fluid},
        {.name = "fluid.decomposition",
         .type = KeyType::choice,
         .fallback = "rows",
         .choices = {{"rows", "slabs stacked along y, cut by work; the cheapest"},
                     {"columns", "slabs side by side"}},
         .help = "decomposition of the fluid's cells among its ranks",
         .idle = without_fluid_ranks},
        {.name = "fluid.cells_per_diameter",
         .type = KeyType::integer,
         .fallback = "16",
         .range = {.lower = 2.0, .upper = 1024.0},
         .help = "mesh cells per grain diameter; spheres need 6 or more",
         .idle = without_fluid},
        {.name = "fluid.stretch_ratio",
         .type = KeyType::real,
         .fallback = "1",
         .range = {.lower = 1.0, .upper = 1.2},
         .help = "largest ratio of the heights of neighbouring rows of cells above "
                 "fluid.stretch_from; 1: all rows are equal",
         .idle = without_fluid},
        {.name = "fluid.stretch_from",
         .type = KeyType::real,
         .unit = "D",
         .need = Need::conditional,
         .range = positive,
         .help = "height up to which cells are squares; above, rows grow. Grains stay "
                 "below, unless fluid.allow_coarse",
         .remedy = "Write for example stretch_from: 55.",
         .when = "fluid.stretch_ratio above 1",
         .required = rows_stretch,
         .idle = without_stretched_rows},
        {.name = "fluid.stretch_largest",
         .type = KeyType::real,
         .unit = "cells",
         .fallback = "16",
         .range = {.lower = 2.0, .upper = 1000.0},
         .help = "largest height of a stretched row over that of the others",
         .idle = without_stretched_rows},
        {.name = "fluid.allow_coarse",
         .type = KeyType::flag,
         .fallback = "false",
         .help = "true: grains may reach stretched rows, where fewer cells resolve them; "
                 "false: that ends the run with code 6",
         .idle = without_stretched_rows},
    };
}

/// What flows, and in which steps.
std::vector<KeySpec> flow_keys() {
    return {
        {.name = "fluid.reynolds",
         .type = KeyType::real,
         .need = Need::conditional,
         .range = positive,
         .help = "u_c D / nu",
         .remedy = "Write for example reynolds: 36.",
         .when = "a fluid, unless scales.kind is physical",
         .required = needs_reynolds,
         .idle = without_fluid},
        {.name = "fluid.splitting",
         .type = KeyType::choice,
         .fallback = papers_splitting,
         .choices = splitting_choices(),
         .help = "order of the fluid's fractional steps",
         .idle = without_fluid},
        {.name = "fluid.splitting_tolerance",
         .type = KeyType::real,
         .unit = "u_c/D",
         .fallback = "0.001",
         .range = open_unit_interval,
         .help = "rms divergence that a window may end with, and, in u_c2/D, rms viscous "
                 "acceleration that may be missing",
         .idle = without_iterated_splitting},
        {.name = "fluid.splitting_iterations",
         .type = KeyType::integer,
         .fallback = "200",
         .range = {.lower = 1.0, .upper = 10000.0},
         .help = "largest number of iterations of pressure, and of viscosity, per contact "
                 "solve; explicit-multiplier: of viscosity",
         .idle = without_rigid_grains},
        {.name = "fluid.acceleration",
         .type = KeyType::real_list,
         .unit = "u_c/t_c",
         .fallback = "[0, 0]",
         .help = "uniform body force on the fluid over rho_f, along cyclic sides: minus the "
                 "gradient of the mean pressure; part of the force on a grain",
         .allowed = "A list of two numbers; with dimension: 3 of three.",
         .remedy = "Write for example acceleration: [0.1, 0].",
         .idle = without_fluid,
         .in_space = {.entries = 3,
                      .allowed = "A list of three numbers.",
                      .remedy = "Write for example acceleration: [0.1, 0, 0].",
                      .fallback = "[0, 0, 0]"}},
    };
}

/// How rigid motion is imposed.
std::vector<KeySpec> multiplier_keys() {
    return {
        {.name = "fluid.hydrodynamic_radius",
         .type = KeyType::real,
         .fallback = "1",
         .range = {.lower = 0.0, .upper = 1.0, .lower_open = true},
         .help = "size of the rigid body in the fluid over that of the grain, whatever its shape",
         .idle = without_fluid},
        {.name = "fluid.points",
         .type = KeyType::choice,
         .fallback = "interior+boundary",
         .choices = {{"interior", "cell centres inside a grain"},
                     {"interior+boundary", "and points on its surface"}},
         .help = "points where rigid motion is imposed; in space interior",
         .idle = without_fluid,
         .in_space = {.fallback = "interior"}},
        of_space({.name = "fluid.surface_shift",
                  .type = KeyType::real,
                  .unit = "cells",
                  .fallback = "0.3",
                  .range = {.lower = 0.0, .upper = 1.0},
                  .help = "how far the fluid sees the surface of a grain outside of it: a "
                          "calibration, since cells whose centres lie inside a sphere are a sphere "
                          "that is a little too small; right while U h/nu is below 3, too large "
                          "above 6",
                  .idle = without_fluid}),
        {.name = "fluid.point_spacing",
         .type = KeyType::real,
         .unit = "cells",
         .fallback = "1.5",
         .range = {.lower = 1.4, .upper = 4.0},
         .help = "distance of boundary points",
         .allowed = "Between 1.4 and 4 cells; closer points make the multipliers ill-conditioned.",
         .remedy = "Use 1.5.",
         .idle = without_boundary_points},
        {.name = "fluid.multiplier_tolerance",
         .type = KeyType::real,
         .unit = "u_c",
         .fallback = "0.0001",
         .range = open_unit_interval,
         .help = "rms slip at which the multipliers stop; joint: at most a tenth of "
                 "coupling.tolerance",
         .idle = without_iterated_multipliers},
        {.name = "fluid.multiplier_iterations",
         .type = KeyType::integer,
         .fallback = "200",
         .range = {.lower = 1.0},
         .help = "largest number of iterations of the multiplier problem",
         .idle = without_iterated_multipliers},
    };
}

/// Discretisation and linear solvers.
std::vector<KeySpec> scheme_keys() {
    return {
        {.name = "fluid.transport_scheme",
         .type = KeyType::text,
         .fallback = "Gauss LUST grad(U)",
         .help = "OpenFOAM scheme of div(phi,U); in first order central ones need a step below "
                 "2/(36 Re), and Gauss limitedLinearV 1 stays bounded at any",
         .idle = without_fluid},
        {.name = "fluid.time_scheme",
         .type = KeyType::choice,
         .fallback = "second-order",
         .choices = {{"first-order",
                      "explicit transport and implicit viscosity by Euler's "
                      "methods, as in the paper"},
                     {"second-order",
                      "Runge-Kutta transport with the flux at the middle of "
                      "the window; viscosity in its stages, or L-stable"}},
         .help = "time integration of transport and viscosity",
         .idle = without_fluid},
        {.name = "fluid.functions",
         .type = KeyType::text,
         .need = Need::optional,
         .help = "file of OpenFOAM function objects, as between the braces of functions in "
                 "controlDict (path relative to the case file; docs/function-objects.md)",
         .idle = without_fluid},
        {.name = "fluid.pressure_solver",
         .type = KeyType::choice,
         .fallback = "FFT",
         .choices = {{"FFT", "direct, with fast transforms; boxes"},
                     {"GAMG", "OpenFOAM's multigrid"},
                     {"PCG", "conjugate gradients"}},
         .help = "linear solver of the pressure",
         .idle = without_fluid},
        {.name = "fluid.pressure_tolerance",
         .type = KeyType::real,
         .fallback = "1e-06",
         .range = open_unit_interval,
         .help = "relative tolerance of the pressure (GAMG, PCG)",
         .idle = without_iterative_pressure},
        {.name = "fluid.viscous_solver",
         .type = KeyType::choice,
         .fallback = "FFT",
         .choices = {{"FFT", "direct, with fast transforms; boxes"},
                     {"PCG", "conjugate gradients"}},
         .help = "linear solver of the viscous step",
         .idle = without_fluid},
        {.name = "fluid.viscous_tolerance",
         .type = KeyType::real,
         .fallback = "1e-08",
         .range = open_unit_interval,
         .help = "relative tolerance of the viscous step (PCG)",
         .idle = without_iterative_viscosity},
    };
}

std::vector<Rule> rules() {
    std::vector<Rule> rules = program_rules();
    const std::vector<Rule> others = {
        {"time.step", {"fluid.enabled", "fluid.cells_per_diameter"}, transport_can_be_cut},
        {"fluid.acceleration",
         {"fluid.enabled", "domain.left", "domain.bottom"},
         acceleration_is_along_cyclic_sides},
        {"fluid.transport_scheme", {}, transport_scheme_is_known},
        {"fluid.transport_scheme",
         {"fluid.enabled", "fluid.cells_per_diameter", "fluid.time_scheme", "time.step",
          "scales.kind"},
         scheme_is_stable},
        {"fluid.ranks",
         {"fluid.enabled", "fluid.decomposition", "domain.size", "fluid.cells_per_diameter",
          "fluid.stretch_ratio", "fluid.stretch_largest"},
         ranks_have_cells},
        {"fluid.stretch_from",
         {"fluid.enabled", "domain.size", "domain.bottom", "fluid.cells_per_diameter",
          "fluid.stretch_ratio", "fluid.stretch_largest"},
         rows_can_stretch},
        {"fluid.cells_per_diameter", keys_of_memory(), mesh_fits_in_memory, true},
        {"fluid.splitting",
         {"dimension", "fluid.enabled", "coupling.scheme", "fluid.pressure_solver",
          "fluid.viscous_solver", "fluid.decomposition", "fluid.time_scheme",
          "fluid.transport_scheme"},
         splitting_has_what_it_needs},
        {"fluid.reynolds", {"scales.kind"}, reynolds_follows}};
    rules.insert(rules.end(), others.begin(), others.end());
    return rules;
}

}  // namespace

std::string without_fluid(const Settings& s) {
    return s.flag("fluid.enabled") ? "" : "without a fluid";
}

KeyGroup fluid_keys() {
    std::vector<KeySpec> keys;
    for (const auto& part : {mesh_keys(), flow_keys(), multiplier_keys(), scheme_keys()})
        keys.insert(keys.end(), part.begin(), part.end());
    return {.keys = keys, .rules = rules(), .notes = fluid_notes};
}

}  // namespace turbidite
