// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Films of liquid between grains, below the size of the fluid's cells: a law of contacts that only
// a case with a fluid has.
#include <fmt/format.h>

#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "granular_adapter/contact_keys/offered_choices.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

Ruling adapter_has_films(const Settings& s) {
    if (!has_films(s) || grains_adapter(s).films) return std::nullopt;
    return Objection{
        fmt::format("{} has no films of liquid between grains: none.", s.text("grains.adapter")),
        fmt::format("Use none, or grains.adapter: {}.",
                    adapters_that([](const GrainsAdapter& a) { return a.films; }))};
}

Ruling shape_has_films(const Settings& s) {
    return shape_is_round(s) ? std::nullopt : corners_have_no_films(s);
}

Ruling solver_has_films(const Settings& s) {
    if (!has_films(s) || is(s, "contact.solver", "nlgs")) return std::nullopt;
    return Objection{fmt::format("{} solves contacts without films, but contact.film = {}.",
                                 s.text("contact.solver"), s.text("contact.film")),
                     "Use nlgs, or contact.film: none."};
}

Ruling files_know_films(const Settings& s) {
    if (!has_films(s)) return std::nullopt;
    return Objection{
        fmt::format("The files of Siconos do not support films, but contact.film = {}.",
                    s.text("contact.film")),
        "Remove one of the two keys."};
}

/// Between surfaces that touch there is a film as thick as they are rough.
Ruling rough_film_is_below_the_cutoff(const Settings& s) {
    if (!has_films(s)) return std::nullopt;
    const double cutoff = s.real("contact.film_cutoff") / s.real("fluid.cells_per_diameter");
    if (s.real("contact.film_roughness") < cutoff) return std::nullopt;
    return Objection{
        fmt::format("Films act below contact.film_cutoff = {} cells = {:.3g} D, and "
                    "rough surfaces come no closer than {} D.",
                    s.text("contact.film_cutoff"), cutoff, s.text("contact.film_roughness")),
        "Use a smaller roughness, for example 0.001."};
}

/// Where the surface is calibrated cells resolve thinner films (bench/film.py).
constexpr const char* cutoff_with_shift = "1.2";

void film_notes(const Settings& s, std::vector<std::string>& notes) {
    if (has_films(s) && in_space(s) && s.real("fluid.surface_shift") == 0.0 &&
        s.text("contact.film_cutoff") == cutoff_with_shift)
        notes.push_back(
            fmt::format("contact.film_cutoff = {} is that of fluid.surface_shift: 0.3; without a "
                        "shift cells resolve films from 2 cells on",
                        cutoff_with_shift));
}

std::string without_films(const Settings& s) {
    if (const std::string why = without_fluid(s); !why.empty()) return why;
    return is(s, "contact.film", "none") ? "with contact.film: none" : "";
}

}  // namespace

KeyGroup film_keys() {
    return {
        .keys =
            {{.name = "contact.film",
              .type = KeyType::choice,
              .fallback = "none",
              .choices = offered(nscd::law_choices(nscd::LawSlot::film)),
              .help = "forces of the liquid between grains, and grains and walls, that "
                      "the cells do not resolve",
              .idle = without_fluid},
             {.name = "contact.film_cutoff",
              .type = KeyType::real,
              .unit = "cells",
              .fallback = cutoff_with_shift,
              .range = {.lower = 0.0, .upper = 4.0, .lower_open = true},
              .help =
                  "gap from which on the cells resolve the force of a film; in space measured with "
                  "fluid.surface_shift: 0.3, without a shift it is 2",
              .allowed = "Above 0, and at most 4 cells.",
              .remedy = "Leave it out: bench/film.py measures it.",
              .idle = without_films},
             {.name = "contact.film_roughness",
              .type = KeyType::real,
              .unit = "D",
              .fallback = "0.001",
              .range = {.lower = 0.0, .upper = 0.1, .lower_open = true},
              .help = "thickness of the film between surfaces that touch: the height "
                      "of their asperities",
              .allowed = "Above 0, since smooth surfaces would never touch, and at most "
                         "0.1 D.",
              .remedy = "Use 0.001; glass beads have 0.0001 to 0.001.",
              .idle = without_films}},
        .rules = {{"contact.film", {"grains.adapter", "fluid.enabled"}, adapter_has_films},
                  {"contact.film", {"grains.shape", "fluid.enabled"}, shape_has_films},
                  {"contact.solver", {"contact.film", "fluid.enabled"}, solver_has_films},
                  {"contact.dump_interval", {"contact.film", "fluid.enabled"}, files_know_films},
                  {"contact.film_roughness",
                   {"contact.film", "contact.film_cutoff", "fluid.enabled",
                    "fluid.cells_per_diameter"},
                   rough_film_is_below_the_cutoff}},
        .notes = film_notes};
}

}  // namespace turbidite
