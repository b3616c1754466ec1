// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The box, its sides, walls inside it.
#include <fmt/format.h>

#include "coupler/keys/key_value.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

std::vector<Choice> side_choices() {
    return {{"wall", "no slip; grains stay inside"},
            {"free", "zero gradient of velocity, pressure 0; grains that leave are removed"},
            {"cyclic", "joined to the opposite side"},
            {"inflow",
             "fluid enters with the velocity of the side's motion; for grains a plate at rest"}};
}

KeySpec side(const std::string& name) {
    return {.name = "domain." + name,
            .type = KeyType::choice,
            .fallback = "wall",
            .choices = side_choices(),
            .help = name + " side of the box"};
}

bool is_cyclic(const Settings& s, const char* key) {
    return s.text(key) == "cyclic";
}

Ruling opposite_sides(const Settings& s, const char* one, const char* other) {
    if (is_cyclic(s, one) == is_cyclic(s, other)) return std::nullopt;
    return Objection{fmt::format("Cyclic sides come in pairs, but {} = {}.", other, s.text(other)),
                     "Make both cyclic, or neither."};
}

Ruling left_right(const Settings& s) {
    return opposite_sides(s, "domain.left", "domain.right");
}
Ruling bottom_top(const Settings& s) {
    return opposite_sides(s, "domain.bottom", "domain.top");
}

constexpr const char* side_names[] = {"left", "right", "bottom", "top"};

/// An inflow is a side of the fluid, with a velocity.
template <int side>
Ruling inflow_has_a_velocity(const Settings& s) {
    const std::string key = std::string("domain.") + side_names[side];
    if (s.text(key) != "inflow") return std::nullopt;
    if (!s.flag("fluid.enabled"))
        return Objection{"Without a fluid nothing enters.",
                         "Use wall, which an inflow is for the grains."};
    if (s.has(key + "_motion")) return std::nullopt;
    return Objection{
        fmt::format("The fluid enters with the velocity of the motion that {}_motion names.", key),
        fmt::format("Describe one below domain.motions, for example stream: {{kind: constant, "
                    "velocity: [1, 0]}}, and set {}_motion: stream.",
                    key)};
}

template <int side>
std::string without_inflow(const Settings& s) {
    const std::string key = std::string("domain.") + side_names[side];
    return s.text(key) == "inflow" ? "" : fmt::format("with {}: {}", key, s.text(key));
}

template <int side>
KeySpec side_profile() {
    return {.name = std::string("domain.") + side_names[side] + "_profile",
            .type = KeyType::choice,
            .fallback = "uniform",
            .choices = {{"uniform", "the velocity of the motion everywhere"},
                        {"parabolic", "6 s (1 - s) of it, s from 0 to 1 along the side"}},
            .help = std::string("profile of the fluid that enters through the ") +
                    side_names[side] + " side; its mean is the velocity of the motion",
            .idle = without_inflow<side>};
}

Ruling whole_cells(const Settings& s) {
    if (!s.flag("fluid.enabled")) return std::nullopt;
    const double cells = s.real("fluid.cells_per_diameter");
    std::vector<double> lengths = real_list("domain.size", s.text("domain.size"));
    if (s.real("fluid.stretch_ratio") > 1.0) lengths.resize(1);  // rows fit any height
    for (const double length : lengths) {
        const double count = length * cells;
        const double whole = std::max(1.0, std::round(count));
        if (std::abs(count - whole) > 1e-6)
            return Objection{fmt::format("With {} cells per diameter, {} D are {} cells; the mesh "
                                         "needs whole ones.",
                                         s.text("fluid.cells_per_diameter"), real_text(length),
                                         real_text(count)),
                             fmt::format("Use {} D.", real_text(whole / cells))};
    }
    return std::nullopt;
}

KeySpec side_motion(const std::string& name) {
    return {.name = "domain." + name + "_motion",
            .type = KeyType::text,
            .need = Need::optional,
            .help = "name of the motion of the " + name +
                    " side, described below domain.motions: of a wall (in a fluid only along "
                    "itself), or of the fluid that enters through an inflow"};
}

KeySpec motion_part(const char* name, KeyType type, const char* unit, const char* help) {
    return {.name = std::string("domain.motions.NAME.") + name,
            .type = type,
            .unit = unit,
            .need = Need::optional,
            .help = help};
}

KeyTable motion_keys() {
    KeySpec kind = motion_part("kind", KeyType::choice, "", "kind of the motion NAME");
    kind.choices = {{"constant", "velocity and spin"},
                    {"harmonic", "A (sin(2 pi t/T + phase) - sin(phase)), from rest at t = 0"},
                    {"table", "linear between the rows, constant after the last"}};
    KeySpec period = motion_part("period", KeyType::real, "t_c", "T of a harmonic motion");
    period.range = positive;
    KeySpec table = motion_part("table", KeyType::real_list, "t_c, D, D",
                                "rows of time, x, y, one after the other; the first is 0, 0, 0");
    table.entries = 0;
    table.allowed = "A list of numbers, three for each row.";
    return {kind,
            motion_part("velocity", KeyType::real_list, "u_c", "of a constant motion"),
            motion_part("spin", KeyType::real, "1/t_c", "of a constant motion, about the pivot"),
            motion_part("amplitude", KeyType::real_list, "D", "A of a harmonic motion"),
            motion_part("turn", KeyType::real, "rad", "A of a harmonic turn about the pivot"),
            period,
            motion_part("phase", KeyType::real, "rad", "of a harmonic motion; 0 unless given"),
            table};
}

KeyTable with_motions(KeyTable table) {
    for (const char* name : {"left", "right", "bottom", "top"}) table.push_back(side_motion(name));
    table.push_back(side_profile<0>());
    table.push_back(side_profile<1>());
    table.push_back(side_profile<2>());
    table.push_back(side_profile<3>());
    for (KeySpec& key : motion_keys()) table.push_back(std::move(key));
    return table;
}

}  // namespace

KeyGroup domain_keys() {
    return {
        .keys = with_motions({
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
             .help =
                 "CSV file of walls inside the box, at rest or moving (header "
                 "id,x1,y1,x2,y2[,thickness][,vx,vy][,spin][,px,py][,friction][,motion]; lengths "
                 "in D, "
                 "velocities in u_c, spin in 1/t_c about (px,py); path relative to the case file). "
                 "In a fluid they are at least two cells thick"},
        }),
        .rules = {{"domain.left", {"domain.right"}, left_right},
                  {"domain.bottom", {"domain.top"}, bottom_top},
                  {"domain.left", {"fluid.enabled"}, inflow_has_a_velocity<0>},
                  {"domain.right", {"fluid.enabled"}, inflow_has_a_velocity<1>},
                  {"domain.bottom", {"fluid.enabled"}, inflow_has_a_velocity<2>},
                  {"domain.top", {"fluid.enabled"}, inflow_has_a_velocity<3>},
                  {"domain.size",
                   {"fluid.enabled", "fluid.cells_per_diameter", "fluid.stretch_ratio"},
                   whole_cells}}};
}

}  // namespace turbidite
