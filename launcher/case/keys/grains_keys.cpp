// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains and their initial positions.
#include <fmt/format.h>
#include "coupler/shapes/shape.hpp"
#include "launcher/case/grains/grain_abilities.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"
#include "launcher/case/grains/start_grains.hpp"

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_value.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

bool is_polygon(const Settings& s) {
    return is(s, "grains.shape", "polygon");
}
/// A generator that places grains.count grains.
bool counts(const Settings& s) {
    return is(s, "grains.generator", "random") || is(s, "grains.generator", "poured");
}
bool needs_count(const Settings& s) {
    return counts(s) && !s.has("grains.file");
}

std::vector<Choice> generator_choices() {
    std::vector<Choice> choices;
    for (const GeneratorEntry& entry : generator_list())
        choices.push_back({entry.name, entry.help});
    return choices;
}

std::vector<Choice> lattice_choices() {
    std::vector<Choice> choices;
    for (const SpaceLattice& lattice : space_lattices())
        choices.push_back({lattice.name, lattice.help});
    return choices;
}

std::vector<Choice> shape_choices() {
    std::vector<Choice> choices;
    for (const ShapeEntry& entry : shape_list()) choices.push_back({entry.kind, entry.description});
    return choices;
}

Ruling region_in_box(const Settings& s) {
    const std::vector<double> region = real_list("grains.region", s.text("grains.region"));
    const std::vector<double> box = real_list("domain.size", s.text("domain.size"));
    bool fits = region.size() == box.size();
    for (std::size_t axis = 0; fits && axis < box.size(); ++axis) fits = region[axis] <= box[axis];
    if (fits) return std::nullopt;
    return Objection{
        fmt::format("The region lies in the box, domain.size = {} D.", s.text("domain.size")),
        "Make it smaller, or remove it to fill the whole box."};
}

Ruling cylinder_in_box(const Settings& s) {
    if (is_in_box(real_list("grains.cylinder", s.text("grains.cylinder")), packing_box(s)))
        return std::nullopt;
    return Objection{
        fmt::format("The cylinder has an axis and a radius above 0, and lies in the box, "
                    "domain.size = {} D.",
                    s.text("domain.size")),
        "Make it smaller, or enlarge the box."};
}

Ruling cylinder_is_the_only_region(const Settings& s) {
    if (s.has("grains.region"))
        return Objection{"Grains fill a cylinder or a box, but grains.region is given too.",
                         "Remove one of them."};
    if (!is(s, "grains.generator", "poured")) return std::nullopt;
    return Objection{"Grains are poured into boxes in this version.",
                     "Use grains.generator: random or lattice, and let them fall in the run."};
}

Ruling vertices_are_convex(const Settings& s) {
    const std::string fault =
        outline_fault(real_list("grains.vertices", s.text("grains.vertices")));
    if (fault.empty()) return std::nullopt;
    return Objection{fault + ".", "The corners of a convex polygon in order, each once."};
}

bool is_lattice(const Settings& s) {
    return s.text("grains.generator") == "lattice" && !s.has("grains.file");
}

Objection lattice_objection(const Settings& s, const char* what) {
    return {fmt::format("The lattice has {} of diameter D only, not {}.",
                        in_space(s) ? "spheres" : "discs", what),
            "Use grains.generator: random, or give the grains in grains.file."};
}

Ruling lattice_has_discs(const Settings& s) {
    const bool round = is(s, "grains.shape", "disc") || is(s, "grains.shape", "sphere");
    if (!is_lattice(s) || round) return std::nullopt;
    return lattice_objection(s, "other shapes");
}
Ruling lattice_has_radius(const Settings& s) {
    if (!is_lattice(s) || s.real("grains.radius") == 0.5) return std::nullopt;
    return lattice_objection(s, "other radii");
}
Ruling lattice_has_one_size(const Settings& s) {
    if (!is_lattice(s) || s.real("grains.size_ratio") == 1.0) return std::nullopt;
    return lattice_objection(s, "several sizes");
}

// Without the fluid's responses grains move with the inertia (1 - rho_f/rho_s) M, which must be
// positive.
Ruling light_grains_need_joint(const Settings& s) {
    const double least = least_density(s);
    if (s.real("grains.density_ratio") > least || !s.flag("fluid.enabled") ||
        find_scheme(s.text("coupling.scheme")).needs_inertia())
        return std::nullopt;
    return Objection{"With coupling.scheme: " + s.text("coupling.scheme") +
                         fmt::format(" grains in a fluid must be denser than what it sees of them: "
                                     "a ratio above {}.",
                                     real_text(least)),
                     "Use coupling.scheme: joint, which takes any density, or a larger ratio."};
}

// Eq. 21 gives the fluid's own density no velocity.
Ruling weighs_something(const Settings& s) {
    const bool eq_21 = s.text("scales.kind") == "sedimentation" ||
                       (s.text("scales.kind") == "physical" && !s.has("scales.velocity"));
    if (!eq_21 || s.real("grains.density_ratio") != 1.0) return std::nullopt;
    return Objection{"Eq. 21 gives no velocity scale to grains of the fluid's density.",
                     "Use another ratio, scales.kind: avalanche, or scales.kind: physical with "
                     "scales.velocity."};
}

/// Not where they were poured before.
bool are_from_a_file(const Settings& s) {
    return s.has("grains.file") && !is(s, "grains.generator", "poured");
}

std::string beside_a_file(const Settings& s) {
    return are_from_a_file(s) ? "with grains.file" : "";
}
std::string without_lattice(const Settings& s) {
    if (are_from_a_file(s)) return "with grains.file";
    return is(s, "grains.generator", "lattice") ? "" : "without grains.generator: lattice";
}
std::string without_random(const Settings& s) {
    if (are_from_a_file(s)) return "with grains.file";
    return counts(s) ? "" : "without grains.generator: random";
}
std::string without_pouring(const Settings& s) {
    if (are_from_a_file(s)) return "with grains.file";
    return is(s, "grains.generator", "poured") ? "" : "without grains.generator: poured";
}
std::string without_chance(const Settings& s) {
    if (are_from_a_file(s)) return "with grains.file";
    const bool still = is(s, "grains.generator", "lattice") && s.real("grains.jitter") == 0.0;
    return still ? "with grains.generator: lattice and no grains.jitter" : "";
}
/// A grains file may name the polygon for individual grains.
std::string without_polygons(const Settings& s) {
    return is_polygon(s) || s.has("grains.file") ? "" : "without grains.shape: polygon";
}

void poured_without_walls(const Settings& s, std::vector<std::string>& notes) {
    if (is(s, "grains.generator", "poured") && s.has("domain.walls_file") && !are_from_a_file(s))
        notes.push_back(
            "grains are poured into grains.region without the walls of domain.walls_file, and the "
            "run is refused if these cut grains: leave room for them beside or above the packing");
}

}  // namespace

KeyGroup grains_keys() {
    return {
        .keys =
            {
                {.name = "grains.shape",
                 .type = KeyType::choice,
                 .fallback = "disc",
                 .choices = shape_choices(),
                 .help =
                     "shape of every grain for which grains.file gives no other; in space sphere",
                 .in_space = {.fallback = "sphere"}},
                {.name = "grains.vertices",
                 .type = KeyType::real_list,
                 .need = Need::conditional,
                 .help = "corners x1, y1, x2, y2, ... of the polygon, in order and in any unit: "
                         "they are "
                         "moved to the centre of mass and scaled to circumscribed radius 1",
                 .allowed =
                     "A list x1, y1, x2, y2, ... of at least three corners of a convex polygon.",
                 .remedy = "Write for example vertices: [0, 0, 2, 0, 2, 1, 0, 1].",
                 .entries = 0,
                 .when = "grains.shape: polygon",
                 .required = is_polygon,
                 .idle = without_polygons},
                {.name = "grains.radius",
                 .type = KeyType::real,
                 .unit = "D",
                 .need = Need::optional,
                 .range = positive,
                 .help = "circumscribed radius of every grain, or the mean one; 0.5 unless given, "
                         "triangles "
                         "0.75"},
                {.name = "grains.size_ratio",
                 .type = KeyType::real,
                 .fallback = "1",
                 .range = {.lower = 1.0, .upper = 100.0},
                 .help = "largest radius over the smallest (generators random and poured): radii "
                         "lie between 2 R/(1 + q) "
                         "and 2 R q/(1 + q), uniform by number, so that grains.radius R stays "
                         "the mean",
                 .idle = without_random},
                {.name = "grains.density_ratio",
                 .type = KeyType::real,
                 .fallback = "1.5",
                 .range = positive,
                 .help = "density of the grains over that of the fluid",
                 .allowed =
                     "A ratio above 0. In a fluid without coupling.scheme: joint above 1, in space "
                     "above (R_h/R)^5, 1.44 at D/8; with joint in space above 15/c^2, c cells "
                     "across, and more with fluid.surface_shift above 0.3; with fluid.splitting: "
                     "marchuk-yanenko at least 0.5 V(R_h)/V(R), 0.36 for a single disc and 0.25 "
                     "for a "
                     "single sphere in a box of 6 diameters; with joint in the plane at least "
                     "21/c^2, at most 0.5.",
                 .remedy = "Use for example 1.5."},
                {.name = "grains.generator",
                 .type = KeyType::choice,
                 .fallback = "random",
                 .choices = generator_choices(),
                 .help = "how the grains are placed",
                 .idle = beside_a_file},
                {.name = "grains.region",
                 .type = KeyType::real_list,
                 .unit = "D",
                 .need = Need::optional,
                 .range = {.lower = 1.0},
                 .help = "width and height of the part of the box that the generator fills, from "
                         "the lower "
                         "left corner; the whole box unless given. In space length, height and "
                         "depth, from the lower left front corner",
                 .allowed = "Width and height in D, each at least one grain and at most the box's.",
                 .remedy =
                     "Write for example region: [25, 50], or remove it to fill the whole box.",
                 .idle = beside_a_file,
                 .in_space = {.entries = 3,
                              .allowed = "Length, height and depth in D, each at least one grain "
                                         "and at most the box's.",
                              .remedy = "Write for example region: [20, 20, 10], or remove it to "
                                        "fill the whole box."}},
                of_space({.name = "grains.cylinder",
                          .type = KeyType::real_list,
                          .unit = "D",
                          .need = Need::optional,
                          .help =
                              "x1, y1, z1, x2, y2, z2, R: the generator (lattice, random) fills "
                              "the cylinder of radius R around the axis from point 1 to point 2, "
                              "in the place of grains.region",
                          .allowed = "Seven numbers: the ends of the axis and the radius.",
                          .remedy = "Write for example cylinder: [10, 0, 10, 10, 40, 10, 10].",
                          .entries = 7,
                          .idle = beside_a_file}),
                of_space({.name = "grains.lattice",
                          .type = KeyType::choice,
                          .fallback = "fcc",
                          .choices = lattice_choices(),
                          .help = "lattice of the spheres (generator lattice)",
                          .idle = without_lattice}),
                {.name = "grains.compacity",
                 .type = KeyType::real,
                 .fallback = "0.9069",
                 .range = {.lower = 0.0, .upper = 1.0, .lower_open = true},
                 .help =
                     "solid fraction of the lattice (generator lattice); in space the lattice is "
                     "stretched uniformly, and is the densest of its kind unless given",
                 .idle = without_lattice,
                 .in_space = {.fallback = ""}},
                {.name = "grains.count",
                 .type = KeyType::integer,
                 .need = Need::conditional,
                 .range = {.lower = 1.0},
                 .help = "number of grains (generators random and poured)",
                 .remedy = "Write for example count: 60.",
                 .when = "grains.generator: random or poured, without grains.file",
                 .required = needs_count,
                 .idle = without_random},
                of_space({.name = "grains.pour_friction",
                          .type = KeyType::real,
                          .need = Need::optional,
                          .range = not_negative,
                          .help = "friction of grains and walls while grains are poured (generator "
                                  "poured); contact.friction unless given. 0 gives dense packings, "
                                  "about 0.64, 0.5 loose ones, about 0.58",
                          .idle = without_pouring}),
                {.name = "grains.jitter",
                 .type = KeyType::real,
                 .unit = "D",
                 .fallback = "0",
                 .range = not_negative,
                 .help =
                     "largest random displacement along each axis; shortened where grains would "
                     "overlap. A lattice of the plane is stretched first to make room, by at most "
                     "1 % of its compacity; one of space has the room that grains.compacity leaves",
                 .idle = beside_a_file},
                {.name = "grains.file",
                 .type = KeyType::text,
                 .need = Need::optional,
                 .help = "CSV file of the grains (header "
                         "id,x,y[,z][,radius][,shape][,angle][,vx][,vy][,spin]"
                         "[,density][,material][,motion], in space id,x,y,z[,radius][,shape]"
                         "[,qw,qx,qy,qz][,vx][,vy][,vz][,wx][,wy][,wz][,density][,material]"
                         "[,motion]; lengths in D, angles in rad, velocities "
                         "in u_c, spin in 1/t_c, density over the "
                         "fluid's, motion free, fixed, driven or of domain.motions; path relative "
                         "to the case file); "
                         "overrides the generator"},
                {.name = "grains.extra_file",
                 .type = KeyType::text,
                 .need = Need::optional,
                 .help = "CSV file of grains, as grains.file, that are added to those that the "
                         "generator places or pours, and to those of run --from",
                 .idle = beside_a_file},
                {.name = "grains.script",
                 .type = KeyType::text,
                 .need = Need::optional,
                 .help = "Python file that adds recorders, plots or engines to YADE's scene "
                         "(yade-nscd, "
                         "yade-md; path relative to the case file; docs/yade.md says what it may "
                         "touch)"},
                {.name = "grains.overlap",
                 .type = KeyType::real,
                 .unit = "D",
                 .fallback = "0",
                 .range = not_negative,
                 .help = "largest accepted overlap of grains at the start; run --from sets "
                         "limits.penetration"},
                {.name = "random.seed",
                 .type = KeyType::integer,
                 .fallback = "1",
                 .range = not_negative,
                 .help = "seed of all random numbers",
                 .idle = without_chance},
            },
        .rules = {{"grains.vertices", {}, vertices_are_convex},
                  {"grains.shape", {"grains.generator"}, lattice_has_discs},
                  {"grains.radius", {"grains.generator"}, lattice_has_radius},
                  {"grains.size_ratio", {"grains.generator"}, lattice_has_one_size},
                  {"grains.region", {"domain.size"}, region_in_box},
                  {"grains.cylinder",
                   {"domain.size", "domain.left", "domain.bottom"},
                   cylinder_in_box},
                  {"grains.cylinder", {"grains.generator"}, cylinder_is_the_only_region},
                  {"grains.density_ratio",
                   {"fluid.enabled", "coupling.scheme"},
                   light_grains_need_joint},
                  {"grains.density_ratio", {"scales.kind"}, weighs_something}},
        .notes = poured_without_walls};
}

}  // namespace turbidite
