// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys for setting up and solving the contact problem of a window.
#include "granular_adapter/contact_keys/contact_keys.hpp"

#include <fmt/format.h>

#include "granular_adapter/contact_keys/offered_choices.hpp"

namespace turbidite {
namespace {

Ruling dumps_know_rolling(const Settings& s) {
    const std::string key = positive_coefficient(s, "rolling_friction");
    if (key.empty()) return std::nullopt;
    return Objection{
        fmt::format("The files of Siconos do not support rolling resistance, but {} = {}.", key,
                    s.text(key)),
        "Remove one of the two keys."};
}

std::string without_recovery(const Settings& s) {
    return s.real("contact.recovery_fraction") == 0.0 ? "with contact.recovery_fraction: 0" : "";
}

void problem_notes(const Settings& s, std::vector<std::string>& notes) {
    // The solver begins with 8000 sweeps
    // (granular_adapter/nscd/solvers/plane/central_path_solver.cpp).
    if (constexpr std::int64_t enough = 20000;
        s.text("contact.solver") == "central-path" && s.integer("contact.iterations") < enough)
        notes.push_back(fmt::format(
            "contact.iterations = {} is used up by the initial sweeps of contact.solver: "
            "central-path, an interior-point method; use at least {}; 1000000 solves hard packings",
            s.integer("contact.iterations"), enough));
}

}  // namespace

KeyGroup contact_problem_keys() {
    return {
        .keys =
            {
                {.name = "contact.friction",
                 .type = KeyType::real,
                 .fallback = "0.3",
                 .range = not_negative,
                 .help = "Coulomb friction coefficient of grains and walls; law static-dynamic: of "
                         "sliding contacts",
                 .allowed = "A friction coefficient must be zero or positive.",
                 .remedy = "Use 0 for smooth grains."},
                {.name = "contact.solver",
                 .type = KeyType::choice,
                 .fallback = "nlgs",
                 .choices = offered(nscd::solver_choices()),
                 .help = "how the contact problem of a window is solved",
                 .contacts = Contacts::rigid},
                {.name = "contact.tolerance",
                 .type = KeyType::real,
                 .fallback = "0.001",
                 .range = open_unit_interval,
                 .help = "scaled natural map at which the contact solver stops",
                 .contacts = Contacts::rigid},
                {.name = "contact.iterations",
                 .type = KeyType::integer,
                 .fallback = "2000",
                 .range = {.lower = 1.0},
                 .help = "largest number of sweeps of the contact solver",
                 .contacts = Contacts::rigid},
                {.name = "contact.threads",
                 .type = KeyType::integer,
                 .fallback = "1",
                 .range = {.lower = 1.0, .upper = 64.0},
                 .help = "threads of contact detection and of the sweeps of the contact solver; "
                         "results do not depend on it",
                 .contacts = Contacts::rigid},
                {.name = "contact.recovery_fraction",
                 .type = KeyType::real,
                 .unit = "per window",
                 .fallback = "0.2",
                 .range = {.lower = 0.0, .upper = 1.0},
                 .help = "fraction of an overlap that is removed in a window",
                 .contacts = Contacts::rigid},
                {.name = "contact.recovery_speed",
                 .type = KeyType::real,
                 .unit = "u_c",
                 .fallback = "0.5",
                 .range = not_negative,
                 .help = "largest velocity at which overlaps are removed",
                 .contacts = Contacts::rigid,
                 .idle = without_recovery},
                {.name = "contact.dump_interval",
                 .type = KeyType::real,
                 .unit = "t_c",
                 .need = Need::optional,
                 .range = positive,
                 .help = "interval at which contact problems are written to "
                         "contacts/problem_STEP.dat, for Siconos and FCLIB",
                 .contacts = Contacts::rigid},
            },
        .rules = {{"contact.dump_interval", {"contact.rolling_friction"}, dumps_know_rolling}},
        .notes = problem_notes};
}

KeyTable contact_key_table() {
    KeyTable table;
    for (const auto& group :
         {contact_problem_keys(), contact_law_keys(), material_keys(), molecular_dynamics_keys()})
        table.insert(table.end(), group.keys.begin(), group.keys.end());
    return table;
}

}  // namespace turbidite
