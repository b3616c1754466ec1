// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/shapes/shape.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"
#include "launcher/case/packing.hpp"

namespace turbidite {
namespace {

bool is(const Settings& settings, const char* key, const char* value) {
    return settings.has(key) && settings.text(key) == value;
}

bool is_physical(const Settings& s) {
    return is(s, "scales.kind", "physical");
}
bool needs_reynolds(const Settings& s) {
    return is(s, "fluid.enabled", "true") && !is_physical(s);
}
bool is_polygon(const Settings& s) {
    return is(s, "grains.shape", "polygon");
}
bool needs_count(const Settings& s) {
    return is(s, "grains.generator", "random") && !s.has("grains.file");
}

std::vector<Choice> generator_choices() {
    std::vector<Choice> choices;
    for (const GeneratorEntry& entry : generator_list())
        choices.push_back({entry.name, entry.help});
    return choices;
}

std::vector<Choice> shape_choices() {
    std::vector<Choice> choices;
    for (const ShapeEntry& entry : shape_list()) choices.push_back({entry.kind, entry.description});
    choices.push_back({"sphere", "ball in space", false});
    return choices;
}

std::vector<Choice> solver_choices() {
    std::vector<Choice> choices;
    for (const nscd::SolverEntry& entry : nscd::solver_list())
        choices.push_back({entry.name, entry.description});
    return choices;
}

std::vector<Choice> side_choices() {
    return {{"wall", "no slip; grains stay inside"},
            {"free", "zero gradient of velocity, pressure 0; grains that leave are removed"},
            {"cyclic", "joined to the opposite side"}};
}

constexpr Range positive{.lower = 0.0, .lower_open = true};
constexpr Range not_negative{.lower = 0.0};
constexpr Range exactly_one{.lower = 1.0, .upper = 1.0};
constexpr Range tolerance{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true};

KeySpec side(const std::string& name) {
    return {.name = "domain." + name,
            .type = KeyType::choice,
            .fallback = "wall",
            .choices = side_choices(),
            .help = name + " side of the box"};
}

KeySpec physical(const std::string& name, const std::string& unit, const std::string& help) {
    return {.name = "scales." + name,
            .type = KeyType::real,
            .unit = unit,
            .need = Need::conditional,
            .range = positive,
            .help = help,
            .remedy = "Give its value in SI units.",
            .when = "scales.kind: physical",
            .required = is_physical};
}

std::vector<KeySpec> general_keys() {
    return {
        {.name = "dimension",
         .type = KeyType::choice,
         .fallback = "2",
         .choices = {{"2", "plane; masses and forces per unit length"}, {"3", "space", false}},
         .help = "dimension of space"},
        {.name = "domain.size",
         .type = KeyType::real_list,
         .unit = "D",
         .need = Need::required,
         .range = positive,
         .help = "width and height of the box",
         .allowed = "Width and height of the box in D, both above 0.",
         .remedy = "Write for example size: [12, 24]."},
        side("left"),
        side("right"),
        side("bottom"),
        side("top"),
        {.name = "domain.walls_file",
         .type = KeyType::text,
         .need = Need::optional,
         .help = "CSV file of walls inside the box, at rest or moving (header "
                 "id,x1,y1,x2,y2[,vx,vy][,spin][,px,py][,friction]; lengths in D, velocities in "
                 "u_c, spin in 1/t_c about (px,py); path relative to the case file); dry cases"},
    };
}

std::vector<KeySpec> grains_keys() {
    return {
        {.name = "grains.adapter",
         .type = KeyType::choice,
         .fallback = "yade-nscd",
         .choices = {{"yade-nscd", "contact engine hosted by YADE"},
                     {"standalone-nscd", "the same engine without YADE"},
                     {"yade-md", "YADE's own molecular dynamics, in sub-steps"},
                     {"lammps-md", "LAMMPS granular", false}},
         .help = "the program that moves the grains"},
        {.name = "grains.ranks",
         .type = KeyType::integer,
         .fallback = "1",
         .range = exactly_one,
         .help = "MPI ranks of the grains program",
         .allowed = "The NSCD adapters run on one rank in this version.",
         .remedy = "Use 1."},
        {.name = "grains.shape",
         .type = KeyType::choice,
         .fallback = "disc",
         .choices = shape_choices(),
         .help = "shape of every grain; grains.file may say otherwise grain by grain"},
        {.name = "grains.vertices",
         .type = KeyType::real_list,
         .need = Need::conditional,
         .help = "corners x1, y1, x2, y2, ... of the polygon, in order and in any unit: they are "
                 "moved to the centre of mass and scaled to circumscribed radius 1",
         .allowed = "A list x1, y1, x2, y2, ... of at least three corners of a convex polygon.",
         .remedy = "Write for example vertices: [0, 0, 2, 0, 2, 1, 0, 1].",
         .entries = 0,
         .when = "grains.shape: polygon",
         .required = is_polygon},
        {.name = "grains.radius",
         .type = KeyType::real,
         .unit = "D",
         .need = Need::optional,
         .range = positive,
         .help =
             "circumscribed radius of every grain, or the mean one; 0.5 unless given, triangles "
             "0.75"},
        {.name = "grains.size_ratio",
         .type = KeyType::real,
         .fallback = "1",
         .range = {.lower = 1.0, .upper = 100.0},
         .help =
             "largest radius over the smallest (generator random): radii lie between 2 R/(1 + q) "
             "and 2 R q/(1 + q), uniform, so that grains.radius R stays the mean"},
        {.name = "grains.density_ratio",
         .type = KeyType::real,
         .fallback = "1.5",
         .range = {.lower = 1.0, .lower_open = true},
         .help = "density of the grains over the fluid's",
         .allowed = "Grains must be denser than the fluid: a ratio above 1.",
         .remedy = "Use for example 1.5."},
        {.name = "grains.generator",
         .type = KeyType::choice,
         .fallback = "random",
         .choices = generator_choices(),
         .help = "how the grains are placed"},
        {.name = "grains.region",
         .type = KeyType::real_list,
         .unit = "D",
         .need = Need::optional,
         .range = {.lower = 1.0},
         .help = "width and height of the part of the box that the generator fills, from the lower "
                 "left corner; the whole box unless given",
         .allowed = "Width and height in D, each at least one grain and at most the box's.",
         .remedy = "Write for example region: [25, 50], or remove it to fill the whole box."},
        {.name = "grains.compacity",
         .type = KeyType::real,
         .fallback = "0.9069",
         .range = {.lower = 0.0, .upper = 1.0, .lower_open = true},
         .help = "solid fraction of the lattice (generator lattice)"},
        {.name = "grains.count",
         .type = KeyType::integer,
         .need = Need::conditional,
         .range = {.lower = 1.0},
         .help = "number of grains (generator random)",
         .remedy = "Write for example count: 60.",
         .when = "grains.generator: random without grains.file",
         .required = needs_count},
        {.name = "grains.jitter",
         .type = KeyType::real,
         .unit = "D",
         .fallback = "0",
         .range = not_negative,
         .help = "largest random displacement along each axis; shortened where grains would "
                 "overlap. A lattice is stretched first to make room, by at most 1 % of its "
                 "compacity"},
        {.name = "grains.file",
         .type = KeyType::text,
         .need = Need::optional,
         .help =
             "CSV file of the grains (header id,x,y[,z][,radius][,shape][,angle], lengths in D, "
             "angles in rad; path relative to the case file); overrides the generator"},
        {.name = "grains.script",
         .type = KeyType::text,
         .need = Need::optional,
         .help = "Python file that adds recorders, plots or engines to YADE's scene (yade-nscd, "
                 "yade-md; path relative to the case file; docs/yade.md says what it may touch)"},
        {.name = "random.seed",
         .type = KeyType::integer,
         .fallback = "1",
         .range = not_negative,
         .help = "seed of everything random"},
    };
}

std::vector<KeySpec> fluid_keys() {
    return {
        {.name = "fluid.enabled",
         .type = KeyType::flag,
         .fallback = "true",
         .help = "false: dry grains, no fluid program"},
        {.name = "fluid.ranks",
         .type = KeyType::integer,
         .fallback = "1",
         .range = {.lower = 1.0, .upper = 4096.0},
         .help = "MPI ranks of the fluid program"},
        {.name = "fluid.decomposition",
         .type = KeyType::choice,
         .fallback = "rows",
         .choices = {{"rows", "slabs above each other, which costs least"},
                     {"columns", "slabs side by side"}},
         .help = "how the ranks share the fluid's cells"},
        {.name = "fluid.cells_per_diameter",
         .type = KeyType::integer,
         .fallback = "16",
         .range = {.lower = 2.0, .upper = 1024.0},
         .help = "mesh cells along a grain diameter"},
        {.name = "fluid.reynolds",
         .type = KeyType::real,
         .need = Need::conditional,
         .range = positive,
         .help = "u_c D / nu",
         .remedy = "Write for example reynolds: 36.",
         .when = "a fluid, unless scales.kind is physical",
         .required = needs_reynolds},
        {.name = "fluid.splitting",
         .type = KeyType::choice,
         .fallback = "marchuk-yanenko",
         .choices = {{"marchuk-yanenko", "the paper's"},
                     {"explicit-multiplier", "carries the multipliers into steps 1-3", false},
                     {"implicit-multiplier", "viscosity solved with the multipliers", false}},
         .help = "order of the fluid's fractional steps"},
        {.name = "fluid.hydrodynamic_radius",
         .type = KeyType::real,
         .fallback = "1",
         .range = {.lower = 0.0, .upper = 1.0, .lower_open = true},
         .help = "radius of the rigid disc the fluid sees, over the grain's"},
        {.name = "fluid.points",
         .type = KeyType::choice,
         .fallback = "interior+boundary",
         .choices = {{"interior", "cell centres inside a grain"},
                     {"interior+boundary", "and points on its surface"}},
         .help = "where the rigid motion is imposed"},
        {.name = "fluid.point_spacing",
         .type = KeyType::real,
         .unit = "cells",
         .fallback = "1.5",
         .range = {.lower = 1.4, .upper = 4.0},
         .help = "distance of boundary points",
         .allowed = "Between 1.4 and 4 cells; closer points make the multipliers ill-conditioned.",
         .remedy = "Use 1.5."},
        {.name = "fluid.multiplier_tolerance",
         .type = KeyType::real,
         .unit = "u_c",
         .fallback = "0.0001",
         .range = tolerance,
         .help = "rms slip at which the multipliers stop; joint: at most a tenth of "
                 "coupling.tolerance"},
        {.name = "fluid.multiplier_iterations",
         .type = KeyType::integer,
         .fallback = "200",
         .range = {.lower = 1.0},
         .help = "most iterations of the multiplier problem"},
        {.name = "fluid.transport_scheme",
         .type = KeyType::text,
         .fallback = "Gauss limitedLinearV 1",
         .help = "OpenFOAM scheme of div(phi,U); central ones need a step below 2/Re"},
        {.name = "fluid.pressure_solver",
         .type = KeyType::choice,
         .fallback = "FFT",
         .choices = {{"FFT", "direct, by fast transforms; uniform boxes"},
                     {"GAMG", "OpenFOAM's multigrid"},
                     {"PCG", "conjugate gradients"}},
         .help = "linear solver of the pressure"},
        {.name = "fluid.pressure_tolerance",
         .type = KeyType::real,
         .fallback = "1e-06",
         .range = tolerance,
         .help = "relative tolerance of the pressure (GAMG, PCG)"},
        {.name = "fluid.viscous_solver",
         .type = KeyType::choice,
         .fallback = "FFT",
         .choices = {{"FFT", "direct, by fast transforms; uniform boxes"},
                     {"PCG", "conjugate gradients"}},
         .help = "linear solver of the viscous step"},
        {.name = "fluid.viscous_tolerance",
         .type = KeyType::real,
         .fallback = "1e-08",
         .range = tolerance,
         .help = "relative tolerance of the viscous step (PCG)"},
    };
}

std::vector<KeySpec> contact_keys() {
    return {
        {.name = "contact.friction",
         .type = KeyType::real,
         .fallback = "0.3",
         .range = not_negative,
         .help = "Coulomb friction coefficient, grains and walls; law static-dynamic: of sliding "
                 "contacts",
         .allowed = "A friction coefficient must be zero or positive.",
         .remedy = "Use 0 for smooth grains."},
        {.name = "contact.theta",
         .type = KeyType::real,
         .fallback = "0.5",
         .range = {.lower = 0.5, .upper = 1.0},
         .help = "theta of the time integration, Eqs. 16-18"},
        {.name = "contact.solver",
         .type = KeyType::choice,
         .fallback = "nlgs",
         .choices = solver_choices(),
         .help = "how the contact problem of a window is solved"},
        {.name = "contact.tolerance",
         .type = KeyType::real,
         .fallback = "0.001",
         .range = tolerance,
         .help = "scaled natural map at which the contact solver stops"},
        {.name = "contact.iterations",
         .type = KeyType::integer,
         .fallback = "2000",
         .range = {.lower = 1.0},
         .help = "most sweeps of the contact solver"},
        {.name = "contact.threads",
         .type = KeyType::integer,
         .fallback = "1",
         .range = {.lower = 1.0, .upper = 64.0},
         .help = "threads of the contact solver's sweeps; results do not depend on it"},
        {.name = "contact.recovery_fraction",
         .type = KeyType::real,
         .unit = "per window",
         .fallback = "0.2",
         .range = {.lower = 0.0, .upper = 1.0},
         .help = "part of an overlap that is pushed out in a window"},
        {.name = "contact.recovery_speed",
         .type = KeyType::real,
         .unit = "u_c",
         .fallback = "0.5",
         .range = not_negative,
         .help = "fastest such push"},
        {.name = "contact.dump_interval",
         .type = KeyType::real,
         .unit = "t_c",
         .need = Need::optional,
         .range = positive,
         .help = "between contact problems written to contacts/problem_STEP.dat, for Siconos"},
        {.name = "contact.md_overlap",
         .type = KeyType::real,
         .unit = "D",
         .fallback = "0.001",
         .range = {.lower = 0.0, .upper = 0.1, .lower_open = true},
         .help = "yade-md: overlap that the stiffness is made for"},
        {.name = "contact.md_speed",
         .type = KeyType::real,
         .unit = "u_c",
         .need = Need::optional,
         .range = positive,
         .help = "yade-md: speed of approach that the stiffness is made for; otherwise 2 with a "
                 "fluid, twice the speed of a fall from the top of the packing without",
         .remedy = "Leave it out, or use for example 2."},
        {.name = "contact.md_stiffness",
         .type = KeyType::real,
         .unit = "m g/D",
         .need = Need::optional,
         .range = positive,
         .help = "yade-md: stiffness of two touching grains; otherwise from contact.md_overlap, "
                 "contact.md_speed and the height of the packing",
         .remedy = "Leave it out, or use for example 1e5."},
        {.name = "contact.md_substeps",
         .type = KeyType::real,
         .unit = "per contact time",
         .fallback = "20",
         .range = {.lower = 12.0, .upper = 1000.0},
         .help = "yade-md: least sub-steps in the time that two grains take to bounce",
         .allowed = "Between 12, below which dense packings may grow unstable, and 1000.",
         .remedy = "Use 20."},
    };
}

// Forces are in weights of one grain, m g with the density of the grains: the same physical force
// with and without a fluid.
std::vector<KeySpec> law_keys() {
    return {
        {.name = "contact.law",
         .type = KeyType::choice,
         .fallback = "coulomb",
         .choices = {{"coulomb", "one coefficient"},
                     {"static-dynamic", "contact.static_friction for contacts that stick"}},
         .help = "friction law"},
        {.name = "contact.static_friction",
         .type = KeyType::real,
         .need = Need::conditional,
         .range = not_negative,
         .help = "friction coefficient of contacts that stick, at least contact.friction",
         .remedy = "Write for example static_friction: 0.5.",
         .when = "contact.law: static-dynamic",
         .required = [](const Settings& s) { return is(s, "contact.law", "static-dynamic"); }},
        {.name = "contact.impact",
         .type = KeyType::choice,
         .fallback = "newton",
         .choices = {{"newton", "normal and tangential velocity of a contact are restored"},
                     {"moreau", "the averaged velocity obeys the law; never makes energy"}},
         .help = "impact law; without restitution both are the same"},
        {.name = "contact.restitution",
         .type = KeyType::real,
         .fallback = "0",
         .range = {.lower = 0.0, .upper = 1.0},
         .help = "e: share of the approach velocity with which grains part",
         .allowed = "A restitution lies between 0 (no rebound) and 1 (no loss).",
         .remedy = "Use 0 for grains that do not bounce."},
        {.name = "contact.restitution_tangential",
         .type = KeyType::real,
         .fallback = "0",
         .range = {.lower = 0.0, .upper = 1.0},
         .help = "the same along the contact (impact newton)",
         .allowed = "A restitution lies between 0 and 1.",
         .remedy = "Use 0."},
        {.name = "contact.restitution_speed",
         .type = KeyType::real,
         .unit = "u_c",
         .fallback = "0.001",
         .range = not_negative,
         .help = "grains that approach slower do not bounce"},
        {.name = "contact.rolling_friction",
         .type = KeyType::real,
         .fallback = "0",
         .range = not_negative,
         .help = "slope up to which a disc does not roll: its rolling resistance over R r_n",
         .allowed = "A coefficient of rolling resistance must be zero or positive.",
         .remedy = "Use 0 for grains that roll freely."},
    };
}

bool adheres(const Settings& s) {
    return s.has("contact.adhesion") && !is(s, "contact.adhesion", "none");
}

std::vector<KeySpec> adhesion_keys() {
    return {
        {.name = "contact.adhesion",
         .type = KeyType::choice,
         .fallback = "none",
         .choices = {{"none", "dry"},
                     {"cohesion", "bonds of the first window, broken for ever"},
                     {"wet", "constant pull within contact.adhesion_range"},
                     {"wet-irreversible", "the same, lost beyond the range"},
                     {"capillary", "bridges that form on contact and break at the range"}},
         .help = "what pulls grains together"},
        {.name = "contact.adhesion_force",
         .type = KeyType::real,
         .unit = "m g",
         .need = Need::conditional,
         .range = positive,
         .help = "pull that parts two touching grains of diameter D",
         .remedy = "Write for example adhesion_force: 1.",
         .when = "contact.adhesion",
         .required = adheres},
        {.name = "contact.adhesion_range",
         .type = KeyType::real,
         .unit = "D",
         .need = Need::conditional,
         .range = positive,
         .help = "gap up to which it acts; cohesion: up to which the first window makes bonds",
         .remedy = "Write for example adhesion_range: 0.05; for cohesion 0.001.",
         .when = "contact.adhesion",
         .required = adheres},
        {.name = "contact.adhesion_length",
         .type = KeyType::real,
         .unit = "D",
         .need = Need::conditional,
         .range = positive,
         .help = "decay of a bridge's force over the gap",
         .remedy = "Write for example adhesion_length: 0.02.",
         .when = "contact.adhesion: capillary",
         .required = [](const Settings& s) { return is(s, "contact.adhesion", "capillary"); }},
        {.name = "contact.adhesion_shear",
         .type = KeyType::real,
         .need = Need::conditional,
         .range = positive,
         .help = "strength of a bond in shear over that in traction",
         .remedy = "Write for example adhesion_shear: 1.",
         .when = "contact.adhesion: cohesion",
         .required = [](const Settings& s) { return is(s, "contact.adhesion", "cohesion"); }},
    };
}

/// Those of hub/schemes that couple, and the one to come.
std::vector<Choice> scheme_choices() {
    std::vector<Choice> choices;
    for (const SchemeEntry& scheme : scheme_list())
        if (!scheme.fluid.empty()) choices.push_back({scheme.name, scheme.help});
    choices.push_back({"sub-iterated", "both repeated within a window", false});
    return choices;
}

std::vector<KeySpec> scheme_keys() {
    return {
        {.name = "coupling.scheme",
         .type = KeyType::choice,
         .fallback = "split",
         .choices = scheme_choices(),
         .help = "order of the exchange"},
        {.name = "coupling.positions",
         .type = KeyType::choice,
         .fallback = "corrected",
         .choices = {{"corrected", "grains move with the fluid-corrected velocity"},
                     {"contact", "grains move with the velocity the contacts allow"}},
         .help = "velocity that moves the grains (split; under joint always contact)"},
        {.name = "coupling.md_hold",
         .type = KeyType::flag,
         .fallback = "true",
         .help = "yade-md: grains feel the last window's hydrodynamic impulse in their sub-steps"},
        {.name = "coupling.tolerance",
         .type = KeyType::real,
         .unit = "u_c",
         .fallback = "0.0001",
         .range = tolerance,
         .help = "joint: largest difference between contact and fluid velocity of a grain"},
        {.name = "coupling.iterations",
         .type = KeyType::integer,
         .fallback = "10",
         .range = {.lower = 1.0},
         .help = "joint: most contact solves per window; windows that need more are counted"},
        {.name = "time.step",
         .type = KeyType::real,
         .unit = "t_c",
         .need = Need::required,
         .range = positive,
         .help = "coupling window",
         .allowed = "The time step must be above 0 and finite.",
         .remedy = "Use for example 0.01."},
        {.name = "time.end",
         .type = KeyType::real,
         .unit = "t_c",
         .need = Need::required,
         .range = positive,
         .help = "end of the run; rounded to whole windows"},
        {.name = "output.interval",
         .type = KeyType::real,
         .unit = "t_c",
         .fallback = "0.5",
         .range = positive,
         .help = "between rows of history.csv and pictures; whole windows"},
        {.name = "checkpoint.interval",
         .type = KeyType::real,
         .unit = "t_c",
         .need = Need::optional,
         .range = positive,
         .help = "between checkpoints",
         .available = false},
    };
}

std::vector<KeySpec> scales_keys() {
    return {
        {.name = "scales.kind",
         .type = KeyType::choice,
         .fallback = "avalanche",
         .choices = {{"avalanche", "u_c = sqrt(g D)"},
                     {"sedimentation", "u_c from Eq. 21"},
                     {"physical", "SI values; u_c given or from Eq. 21"}},
         .help = "characteristic velocity"},
        {.name = "scales.compacity",
         .type = KeyType::real,
         .fallback = "0.2",
         .range = {.lower = 0.0, .upper = 1.0, .upper_open = true},
         .help = "phi of Eq. 21 (sedimentation, physical)"},
        physical("diameter", "m", "D"),
        physical("gravity", "m/s2", "g, along -y"),
        physical("fluid_density", "kg/m3", "rho_f"),
        physical("viscosity", "m2/s", "kinematic viscosity nu"),
        {.name = "scales.velocity",
         .type = KeyType::real,
         .unit = "m/s",
         .need = Need::optional,
         .range = positive,
         .help = "u_c (physical); otherwise Eq. 21"},
    };
}

std::vector<KeySpec> limit_keys() {
    return {
        {.name = "limits.stall_soft",
         .type = KeyType::real,
         .unit = "s",
         .fallback = "60",
         .range = positive,
         .help = "waiting after which who waits for whom is printed"},
        {.name = "limits.stall_hard",
         .type = KeyType::real,
         .unit = "s",
         .fallback = "600",
         .range = positive,
         .help = "waiting after which the run ends with code 5"},
        {.name = "limits.penetration",
         .type = KeyType::real,
         .unit = "D",
         .fallback = "0.2",
         .range = positive,
         .help = "overlap of grains beyond which the run ends with code 6"},
    };
}

std::vector<KeySpec> all_keys() {
    std::vector<KeySpec> table;
    for (auto* group : {general_keys, grains_keys, fluid_keys, contact_keys, law_keys,
                        adhesion_keys, scheme_keys, scales_keys, limit_keys})
        for (KeySpec& key : group()) table.push_back(std::move(key));
    return table;
}

std::string bound(const char* open, const char* closed, bool is_open, double value) {
    return fmt::format("{} {}", is_open ? open : closed, value);
}

std::string range_text(const KeySpec& key) {
    const Range& range = key.range;
    std::string text = type_name(key.type);
    if (range.lower == range.upper) return fmt::format("{}", range.lower);
    if (std::isfinite(range.lower)) text += bound(" above", " from", range.lower_open, range.lower);
    if (std::isfinite(range.upper))
        text += bound(" below", " up to", range.upper_open, range.upper);
    else if (std::isfinite(range.lower) && !range.lower_open)
        text += " on";
    return text;
}

std::string choice_names(const KeySpec& key) {
    std::string text;
    for (const Choice& choice : key.choices)
        if (choice.available) text += (text.empty() ? "" : ", ") + choice.name;
    return text;
}

}  // namespace

bool Range::contains(double value) const {
    const bool above = lower_open ? value > lower : value >= lower;
    const bool below = upper_open ? value < upper : value <= upper;
    return above && below;
}

const std::vector<KeySpec>& key_table() {
    static const std::vector<KeySpec> table = all_keys();
    return table;
}

const KeySpec* find_key(const std::string& name) {
    const auto& table = key_table();
    const auto at = std::find_if(table.begin(), table.end(),
                                 [&](const KeySpec& key) { return key.name == name; });
    return at == table.end() ? nullptr : &*at;
}

std::vector<std::string> key_names() {
    std::vector<std::string> names;
    for (const KeySpec& key : key_table()) names.push_back(key.name);
    return names;
}

std::string allowed_values(const KeySpec& key) {
    if (!key.allowed.empty()) return key.allowed;
    if (key.type == KeyType::choice) return "Available: " + choice_names(key) + ".";
    if (key.type == KeyType::flag) return "Either true or false.";
    return fmt::format("It must be {}{}{}.", range_text(key), key.unit.empty() ? "" : ", in ",
                       key.unit);
}

std::string type_name(KeyType type) {
    switch (type) {
        case KeyType::text:
            return "a text";
        case KeyType::choice:
            return "a choice";
        case KeyType::real:
            return "a number";
        case KeyType::integer:
            return "a whole number";
        case KeyType::flag:
            return "true or false";
        case KeyType::real_list:
            return "a list of numbers";
    }
    return "";
}

std::string group_of(const std::string& key) {
    const auto point = key.find('.');
    return point == std::string::npos ? "" : key.substr(0, point);
}

}  // namespace turbidite
