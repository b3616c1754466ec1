// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The box, its sides, walls inside it.
#include <fmt/format.h>

#include <utility>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

const std::vector<Choice> side_choices = {
    {"wall", "no slip; grains stay inside"},
    {"free", "zero gradient of velocity, pressure 0; grains that leave are removed"},
    {"cyclic", "joined to the opposite side"},
    {"inflow", "fluid enters with the velocity of the side's motion; for grains a plate at rest"}};

std::string side_help(const BoxSide& side) {
    const std::string help = std::string(side.name) + " side of the box";
    if (is_planar(side)) return help;
    return help + (side.inward > 0.0 ? ", at z = 0" : ", at z = its depth");
}

KeySpec side_type(const BoxSide& side) {
    KeySpec key{.name = side.key,
                .type = KeyType::choice,
                .fallback = "wall",
                .choices = side_choices,
                .help = side_help(side)};
    return is_planar(side) ? key : of_space(key);
}

constexpr auto every_side = std::make_index_sequence<box_sides.size()>();
constexpr auto every_planar_side = std::make_index_sequence<planar_sides>();

/// Told of the first of a pair.
template <std::size_t side>
Ruling both_are_cyclic(const Settings& s) {
    const char *one = box_sides[side].key, *other = box_sides[opposite(side)].key;
    if (side > opposite(side) || is(s, one, "cyclic") == is(s, other, "cyclic"))
        return std::nullopt;
    return Objection{fmt::format("Cyclic sides come in pairs, but {} = {}.", other, s.text(other)),
                     "Make both cyclic, or neither."};
}

/// An inflow is a side of the fluid, with a velocity.
template <std::size_t side>
Ruling inflow_has_a_velocity(const Settings& s) {
    const std::string key = box_sides[side].key;
    if (!is(s, key.c_str(), "inflow")) return std::nullopt;
    if (!s.flag("fluid.enabled"))
        return Objection{"Without a fluid nothing enters.",
                         "Use wall, which an inflow is for the grains."};
    if (s.has(key + "_motion")) return std::nullopt;
    return Objection{
        fmt::format("The fluid enters with the velocity of the motion that {}_motion names.", key),
        fmt::format("Describe one below domain.motions, for example stream: {{kind: constant, "
                    "velocity: {}}}, and set {}_motion: stream.",
                    in_space(s) ? "[1, 0, 0]" : "[1, 0]", key)};
}

template <std::size_t side>
std::string without_inflow(const Settings& s) {
    const std::string key = box_sides[side].key;
    return s.text(key) == "inflow" ? "" : fmt::format("with {}: {}", key, s.text(key));
}

template <std::size_t side>
KeySpec side_profile() {
    return {.name = std::string(box_sides[side].key) + "_profile",
            .type = KeyType::choice,
            .fallback = "uniform",
            .choices = {{"uniform", "the velocity of the motion everywhere"},
                        {"parabolic", "6 s (1 - s) of it, s from 0 to 1 along the side"}},
            .help = std::string("profile of the fluid that enters through the ") +
                    box_sides[side].name + " side; its mean is the velocity of the motion",
            .idle = without_inflow<side>};
}

Ruling whole_cells(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const double cells = s.real("fluid.cells_per_diameter");
    std::vector<double> lengths = real_list("domain.size", s.text("domain.size"));
    if (s.real("fluid.stretch_ratio") > 1.0) lengths.erase(lengths.begin() + 1);  // any height
    for (const double length : lengths) {
        const double count = length * cells;
        const double whole = std::max(1.0, std::round(count));
        if (std::abs(count - whole) > 1e-6)
            return Objection{fmt::format("With {} cells per diameter, {} D are {} cells; the mesh "
                                         "needs whole ones.",
                                         s.text("fluid.cells_per_diameter"), real_text(length),
                                         real_text(count)),
                             fmt::format("Use {} D.", real_text(whole / cells))};
        if (whole < fewest_cells)
            return Objection{
                fmt::format("With {} cells per diameter, {} D are {} cells; the mesh needs {}.",
                            s.text("fluid.cells_per_diameter"), real_text(length), real_text(whole),
                            fewest_cells),
                fmt::format("Use {} D or more.", real_text(fewest_cells / cells))};
    }
    return std::nullopt;
}

KeySpec side_motion(const BoxSide& side) {
    KeySpec key{.name = std::string(side.key) + "_motion",
                .type = KeyType::text,
                .need = Need::optional,
                .help = "name of the motion of the " + std::string(side.name) +
                        " side, described below domain.motions: of a wall (in a fluid only along "
                        "itself), or of the fluid that enters through an inflow"};
    return is_planar(side) ? key : of_space(key);
}

KeySpec motion_part(const char* name, KeyType type, const char* unit, const char* help) {
    return {.name = std::string("domain.motions.NAME.") + name,
            .type = type,
            .unit = unit,
            .need = Need::optional,
            .help = help};
}

/// x and y, in space also z.
KeySpec motion_vector(const char* name, const char* unit, const char* help) {
    KeySpec key = motion_part(name, KeyType::real_list, unit, help);
    key.allowed = "A list of two numbers, x and y; with dimension: 3 of three.";
    key.in_space = {.entries = 3, .allowed = "A list of three numbers: x, y, z."};
    return key;
}

KeySpec motion_axis() {
    KeySpec key = motion_part("axis", KeyType::real_list, "",
                              "direction about which spin and turn are, with any length; "
                              "[0, 0, 1] unless given");
    key.entries = 3;
    return of_space(key);
}

KeyTable motion_keys() {
    KeySpec kind = motion_part("kind", KeyType::choice, "", "kind of the motion NAME");
    kind.choices = {{"constant", "velocity and spin"},
                    {"harmonic", "A (sin(2 pi t/T + phase) - sin(phase)), from rest at t = 0"},
                    {"table", "linear between the rows, constant after the last"}};
    KeySpec period = motion_part("period", KeyType::real, "t_c", "T of a harmonic motion");
    period.range = positive;
    KeySpec table = motion_part("table", KeyType::real_list, "t_c, D, D",
                                "rows of time, x, y, one after the other; the first is 0, 0, 0. In "
                                "space rows of time, x, y, z");
    table.entries = 0;
    table.allowed = "A list of numbers, three for each row.";
    table.in_space.allowed = "A list of numbers, four for each row.";
    return {kind,
            motion_vector("velocity", "u_c", "of a constant motion"),
            motion_part("spin", KeyType::real, "1/t_c", "of a constant motion, about the pivot"),
            motion_axis(),
            motion_vector("amplitude", "D", "A of a harmonic motion"),
            motion_part("turn", KeyType::real, "rad", "A of a harmonic turn about the pivot"),
            period,
            motion_part("phase", KeyType::real, "rad", "of a harmonic motion; 0 unless given"),
            table};
}

template <std::size_t... side>
KeyTable profile_keys(std::index_sequence<side...>) {
    return {side_profile<side>()...};
}

template <std::size_t... side>
KeyTable side_keys(KeyTable table, std::index_sequence<side...>) {
    table.insert(table.end() - 1, {side_type(box_sides[side])...});  // before the walls inside
    table.push_back({.name = "domain.material",
                     .type = KeyType::text,
                     .need = Need::optional,
                     .help = "material of the sides of the box, a name below contact.materials; "
                             "that with the coefficients of contact.* unless given"});
    for (KeyTable more : {KeyTable{side_motion(box_sides[side])...},
                          profile_keys(every_planar_side), motion_keys()})
        for (KeySpec& key : more) table.push_back(std::move(key));
    return table;
}

template <std::size_t... side>
std::vector<Rule> pair_rules(std::index_sequence<side...>) {
    return {{box_sides[side].key, {box_sides[opposite(side)].key}, both_are_cyclic<side>}...};
}

template <std::size_t... side>
std::vector<Rule> inflow_rules(std::index_sequence<side...>) {
    return {{box_sides[side].key, {"fluid.enabled"}, inflow_has_a_velocity<side>}...};
}

std::vector<Rule> side_rules() {
    std::vector<Rule> rules = pair_rules(every_side);
    for (Rule& rule : inflow_rules(every_side)) rules.push_back(std::move(rule));
    rules.push_back({"domain.size",
                     {"fluid.enabled", "fluid.cells_per_diameter", "fluid.stretch_ratio"},
                     whole_cells});
    return rules;
}

}  // namespace

KeyGroup domain_keys() {
    return {
        .keys = side_keys(
            {
                {.name = "dimension",
                 .type = KeyType::choice,
                 .fallback = "2",
                 .choices = {{"2", "plane; masses and forces per unit length"},
                             {"3", "space: spheres"}},
                 .help = "dimension of space"},
                {.name = "domain.size",
                 .type = KeyType::real_list,
                 .unit = "D",
                 .need = Need::required,
                 .range = positive,
                 .help = "width and height of the box; in space length (x), height (y, upwards) "
                         "and depth (z)",
                 .allowed = "Width and height of the box in D, both above 0.",
                 .remedy = "Write for example size: [12, 24].",
                 .in_space = {.entries = 3,
                              .allowed = "In space length, height and depth of the box in D, "
                                         "all above 0.",
                              .remedy = "Write for example size: [60, 24, 12.8]."}},
                {.name = "domain.walls_file",
                 .type = KeyType::text,
                 .need = Need::optional,
                 .help = "CSV file of walls inside the box, at rest or moving (header "
                         "id,x1,y1,x2,y2[,thickness][,vx,vy][,spin][,px,py][,friction][,motion]"
                         "; lengths "
                         "in D, "
                         "velocities in u_c, spin in 1/t_c about (px,py); path relative to the "
                         "case file). "
                         "In a fluid they are at least two cells thick. In space "
                         "id,kind,x,y,z,ax,ay,az[,bx,by,bz][,r1][,r2][,thickness][,vx,vy,vz]"
                         "[,wx,wy,wz][,px,py,pz][,friction][,material][,motion], kind plate, "
                         "cylinder, cone or ring (docs/spheres.md)"},
            },
            every_side),
        .rules = side_rules()};
}

}  // namespace turbidite
