// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What cases in space (dimension: 3) cannot do in this version, and what has no place in them, each
// in its own sentence.
#include <fmt/format.h>

#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

Ruling no_fluid_in_space(const Settings& s) {
    if (!in_space(s) || !s.flag("fluid.enabled")) return std::nullopt;
    return Objection{"In space there is no fluid in this version.",
                     "Set fluid.enabled: false, or dimension: 2."};
}

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

Ruling no_problem_files_in_space(const Settings& s) {
    if (!in_space(s)) return std::nullopt;
    return Objection{"Contact problems of space are not written to files in this version.",
                     "Remove it, or use dimension: 2."};
}

}  // namespace

KeyGroup space_keys() {
    return {.keys = {},
            .rules = {{"fluid.enabled", {"dimension"}, no_fluid_in_space},
                      {"grains.shape", {"dimension"}, shape_is_of_the_dimension},
                      {"contact.solver", {"dimension"}, solver_works_in_space},
                      {"contact.dump_interval", {"dimension"}, no_problem_files_in_space}}};
}

}  // namespace turbidite
