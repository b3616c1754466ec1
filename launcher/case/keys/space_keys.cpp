// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What cases in space (dimension: 3) cannot do in this version, and what has no place in them, each
// in its own sentence.
#include <fmt/format.h>

#include <utility>

#include "coupler/protocol/scene/sides.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/keys/key_groups.hpp"
#include "launcher/case/keys/transport_schemes.hpp"

namespace turbidite {
namespace {

bool is_wet_space(const Settings& s) {
    return in_space(s) && s.flag("fluid.enabled");
}

Ruling points_are_interior(const Settings& s) {
    if (!is_wet_space(s) || s.text("fluid.points") == "interior") return std::nullopt;
    return Objection{"In space there are no points on surfaces in this version.", "Use interior."};
}

template <const char* const& key>
Ruling is_direct(const Settings& s) {
    if (!is_wet_space(s) || s.text(key) == "FFT") return std::nullopt;
    return Objection{"In space the fluid is solved on rows of its box only.", "Use FFT."};
}

Ruling transport_is_on_rows(const Settings& s) {
    const std::string& scheme = s.text("fluid.transport_scheme");
    // Of what is no scheme its own rule has spoken.
    if (!is_wet_space(s) || !read_transport_scheme(scheme).scheme || is_scheme_on_rows(scheme))
        return std::nullopt;
    return Objection{
        "In space transport is on rows of the box, which know Gauss limitedLinearV, "
        "linear, LUST and linearUpwind, not bounded.",
        "Use Gauss LUST grad(U), or Gauss limitedLinearV 1."};
}

Ruling ranks_have_layers(const Settings& s) {
    if (!is_wet_space(s) || s.text("fluid.decomposition") == "rows") return std::nullopt;
    return Objection{"In space every rank has whole layers of cells of one y.", "Use rows."};
}

constexpr const char* profile_keys[] = {"domain.left_profile", "domain.right_profile",
                                        "domain.bottom_profile", "domain.top_profile"};

/// A parabola across one direction of a side leaves open what it is across the other.
template <std::size_t side>
Ruling uniform_profile(const Settings& s) {
    if (!is_wet_space(s) || s.text(profile_keys[side]) == "uniform") return std::nullopt;
    return Objection{"In space the fluid enters uniformly in this version.", "Use uniform."};
}

template <std::size_t... side>
void add_profile_rules(std::vector<Rule>& rules, std::index_sequence<side...>) {
    (rules.push_back({profile_keys[side], {"dimension", "fluid.enabled"}, uniform_profile<side>}),
     ...);
}

constexpr const char* pressure_solver = "fluid.pressure_solver";
constexpr const char* viscous_solver = "fluid.viscous_solver";

Ruling shape_is_of_the_dimension(const Settings& s) {
    const bool sphere = s.text("grains.shape") == "sphere";
    if (sphere == in_space(s)) return std::nullopt;
    if (sphere) return Objection{"A sphere is a grain of space.", "Use disc, or dimension: 3."};
    return Objection{"In space grains are spheres in this version.",
                     "Use sphere, or dimension: 2."};
}

Ruling solver_works_in_space(const Settings& s) {
    if (!in_space(s) || s.text("contact.solver") == "nlgs") return std::nullopt;
    return Objection{fmt::format("{} solves contacts of the plane only.", s.text("contact.solver")),
                     "Use nlgs, or dimension: 2."};
}

Ruling files_know_torsion(const Settings& s) {
    const std::string key = positive_coefficient(s, "torsion_friction");
    if (!in_space(s) || key.empty()) return std::nullopt;
    return Objection{
        fmt::format("The files of Siconos do not support torsional resistance, but {} = {}.", key,
                    s.text(key)),
        "Remove one of the two keys."};
}

}  // namespace

KeyGroup space_keys() {
    std::vector<Rule> rules = {
        {"grains.shape", {"dimension"}, shape_is_of_the_dimension},
        {"contact.solver", {"dimension"}, solver_works_in_space},
        {"contact.dump_interval", {"dimension", "contact.torsion_friction"}, files_know_torsion},
        {"fluid.points", {"dimension", "fluid.enabled"}, points_are_interior},
        {pressure_solver, {"dimension", "fluid.enabled"}, is_direct<pressure_solver>},
        {viscous_solver, {"dimension", "fluid.enabled"}, is_direct<viscous_solver>},
        {"fluid.transport_scheme", {"dimension", "fluid.enabled"}, transport_is_on_rows},
        {"fluid.decomposition", {"dimension", "fluid.enabled"}, ranks_have_layers}};
    add_profile_rules(rules, std::make_index_sequence<planar_sides>{});
    return {.keys = {}, .rules = std::move(rules)};
}

}  // namespace turbidite
