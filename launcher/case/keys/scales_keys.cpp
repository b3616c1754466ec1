// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The characteristic values of a case.
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

bool is_physical(const Settings& s) {
    return is(s, "scales.kind", "physical");
}
std::string without_si_values(const Settings& s) {
    return is_physical(s) ? "" : "without scales.kind: physical";
}
std::string without_equation_21(const Settings& s) {
    if (is(s, "scales.kind", "avalanche")) return "with scales.kind: avalanche";
    return s.has("scales.velocity") && is_physical(s) ? "with scales.velocity" : "";
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
            .required = is_physical,
            .idle = without_si_values};
}

}  // namespace

KeyGroup scales_keys() {
    return {.keys = {
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
                 .help = "phi of Eq. 21 (sedimentation, physical)",
                 .idle = without_equation_21},
                physical("diameter", "m", "D"),
                physical("gravity", "m/s2", "g, along -y"),
                physical("fluid_density", "kg/m3", "rho_f"),
                physical("viscosity", "m2/s", "kinematic viscosity nu"),
                {.name = "scales.velocity",
                 .type = KeyType::real,
                 .unit = "m/s",
                 .need = Need::optional,
                 .range = positive,
                 .help = "u_c (physical); otherwise Eq. 21",
                 .idle = without_si_values},
            }};
}

}  // namespace turbidite
