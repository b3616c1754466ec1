// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/law_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "launcher/case/key_value.hpp"

namespace turbidite {
namespace {

Verdict sliding_holds_less(const Settings& s) {
    if (s.real("contact.static_friction") >= s.real("contact.friction")) return std::nullopt;
    return Objection{fmt::format("Contacts that stick hold at least as much as those that slide, "
                                 "and contact.friction = {}.",
                                 s.text("contact.friction")),
                     "Enlarge it."};
}

// With restitution e an impact feeds energy in unless theta <= 1/(1 + e).
Verdict theta_makes_no_energy(const Settings& s) {
    const double e =
        std::max(s.real("contact.restitution"), s.real("contact.restitution_tangential"));
    const double most = 1.0 / (1.0 + e);
    if (s.real("contact.theta") <= most * (1.0 + 1e-12)) return std::nullopt;
    return Objection{fmt::format("With a restitution e = {} impacts make energy beyond "
                                 "theta = 1/(1 + e) = {}.",
                                 real_text(e), real_text(most)),
                     "Use 0.5, which is right for every restitution."};
}

Verdict moreau_has_one_restitution(const Settings& s) {
    if (s.text("contact.impact") != "moreau" || s.real("contact.restitution_tangential") == 0.0)
        return std::nullopt;
    return Objection{"With contact.impact: moreau one restitution serves both directions.",
                     "Remove it, or use contact.impact: newton."};
}

Verdict only_discs_resist_rolling(const Settings& s) {
    if (s.real("contact.rolling_friction") == 0.0 || s.text("grains.shape") == "disc")
        return std::nullopt;
    return Objection{fmt::format("Rolling resistance is for discs, and grains.shape = {}: faces "
                                 "resist rolling by themselves.",
                                 s.text("grains.shape")),
                     "Use 0."};
}

Verdict range_of_neighbours(const Settings& s) {
    if (s.text("contact.adhesion") == "none") return std::nullopt;
    if (s.real("contact.adhesion_range") <= 1.0) return std::nullopt;
    return Objection{"Adhesion acts between neighbours: up to 1 D.", "Use a smaller range."};
}

bool resists_rolling(const Settings& s) {
    return s.real("contact.rolling_friction") > 0.0;
}

Verdict solver_knows_rolling(const Settings& s) {
    if (s.text("contact.solver") != "nlgs-stored" || !resists_rolling(s)) return std::nullopt;
    return Objection{fmt::format("nlgs-stored does not solve rolling resistance, and "
                                 "contact.rolling_friction = {}.",
                                 s.text("contact.rolling_friction")),
                     "Use nlgs or central-path."};
}

Verdict dumps_know_rolling(const Settings& s) {
    if (!resists_rolling(s)) return std::nullopt;
    return Objection{fmt::format("The files of Siconos have no rolling resistance, and "
                                 "contact.rolling_friction = {}.",
                                 s.text("contact.rolling_friction")),
                     "Remove one of the two."};
}

}  // namespace

const std::vector<Rule>& law_rules() {
    static const std::vector<Rule> table = {
        {"contact.static_friction", {"contact.friction"}, sliding_holds_less},
        {"contact.theta",
         {"contact.restitution", "contact.restitution_tangential"},
         theta_makes_no_energy},
        {"contact.restitution_tangential", {"contact.impact"}, moreau_has_one_restitution},
        {"contact.rolling_friction", {"grains.shape"}, only_discs_resist_rolling},
        {"contact.solver", {"contact.rolling_friction"}, solver_knows_rolling},
        {"contact.dump_interval", {"contact.rolling_friction"}, dumps_know_rolling},
        {"contact.adhesion_range", {"contact.adhesion"}, range_of_neighbours},
    };
    return table;
}

void add_law_notes(const Settings& s, std::vector<std::string>& notes) {
    const auto without = [&](const char* key, bool used, const char* law) {
        if (s.has(key) && !used)
            notes.push_back(fmt::format("{} has no effect without {}", key, law));
    };
    const std::string& adhesion = s.text("contact.adhesion");
    without("contact.static_friction", s.text("contact.law") == "static-dynamic",
            "contact.law: static-dynamic");
    without("contact.adhesion_force", adhesion != "none", "contact.adhesion");
    without("contact.adhesion_range", adhesion != "none", "contact.adhesion");
    without("contact.adhesion_length", adhesion == "capillary", "contact.adhesion: capillary");
    without("contact.adhesion_shear", adhesion == "cohesion", "contact.adhesion: cohesion");
    if (s.text("contact.impact") == "newton" && s.real("contact.restitution") > 0.0 &&
        s.real("contact.friction") > 0.0)
        notes.push_back(
            "contact.impact: newton with friction may make energy where several contacts of a "
            "grain answer at once; contact.impact: moreau never does");
    // It begins with 8000 sweeps (granular_adapter/nscd/solvers/central_path_solver.cpp).
    if (constexpr std::int64_t enough = 20000;
        s.text("contact.solver") == "central-path" && s.integer("contact.iterations") < enough)
        notes.push_back(fmt::format(
            "contact.iterations = {} leaves contact.solver: central-path, an interior-point method, "
            "with its first sweeps; "
            "{} is the least that is of use, 1000000 solves hard packings",
            s.integer("contact.iterations"), enough));
}

}  // namespace turbidite
