// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Limits at which a run is ended.
#include <fmt/format.h>

#include "coupler/keys/key_value.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

Ruling limits_in_order(const Settings& s) {
    if (s.real("limits.stall_soft") <= s.real("limits.stall_hard")) return std::nullopt;
    return Objection{fmt::format("The hard limit must be at least limits.stall_soft = {} s.",
                                 s.text("limits.stall_soft")),
                     "Increase it, or decrease limits.stall_soft."};
}

/// A pair of limits of a relative defect: a warning at `soft`, the end of the run at `hard`.
Ruling balance_in_order(const Settings& s, const std::string& key) {
    if (s.real(key + "_soft") <= s.real(key + "_hard")) return std::nullopt;
    return Objection{
        fmt::format("The hard limit must be at least {0}_soft = {1}.", key, s.text(key + "_soft")),
        fmt::format("Increase it, or decrease {}_soft.", key)};
}
Ruling grain_balance_in_order(const Settings& s) {
    return balance_in_order(s, "limits.grain_balance");
}
Ruling fluid_balance_in_order(const Settings& s) {
    return balance_in_order(s, "limits.fluid_balance");
}

KeySpec balance_key(const char* name, const char* fallback, const char* help) {
    return {
        .name = name, .type = KeyType::real, .fallback = fallback, .range = positive, .help = help};
}

KeySpec with_fluid(KeySpec key) {
    key.idle = without_fluid;
    return key;
}

}  // namespace

KeyGroup limit_keys() {
    return {
        .keys =
            {
                {.name = "limits.stall_soft",
                 .type = KeyType::real,
                 .unit = "s",
                 .fallback = "60",
                 .range = positive,
                 .help = "waiting time after which a table shows who waits for whom"},
                {.name = "limits.stall_hard",
                 .type = KeyType::real,
                 .unit = "s",
                 .fallback = "600",
                 .range = positive,
                 .help = "waiting time after which the run ends with code 5"},
                {.name = "limits.start",
                 .type = KeyType::real,
                 .unit = "s",
                 .fallback = "120",
                 .range = positive,
                 .help =
                     "time until all programs of the job must have joined; then the run ends with "
                     "code 5"},
                {.name = "limits.penetration",
                 .type = KeyType::real,
                 .unit = "D",
                 .fallback = "0.2",
                 .range = positive,
                 .help = "largest overlap of grains; beyond it the run ends with code 6"},
                balance_key("limits.grain_balance_soft", "1e-08",
                            "relative defect of the grains' momentum (column grain_balance) "
                            "above which a warning is printed"),
                balance_key("limits.grain_balance_hard", "0.0001",
                            "the same, above which the run ends with code 6"),
                with_fluid(
                    balance_key("limits.fluid_balance_soft", "1e-06",
                                "relative defect of the fluid's momentum (column fluid_balance) "
                                "above which a warning is printed")),
                with_fluid(balance_key("limits.fluid_balance_hard", "0.01",
                                       "the same, above which the run ends with code 6")),
                {.name = "limits.memory",
                 .type = KeyType::real,
                 .unit = "GB",
                 .need = Need::optional,
                 .range = positive,
                 .help = "memory that the fluid may take; otherwise that of the machine that "
                         "checks the case",
                 .idle = without_fluid},
            },
        .rules = {
            {"limits.stall_hard", {"limits.stall_soft"}, limits_in_order},
            {"limits.grain_balance_hard", {"limits.grain_balance_soft"}, grain_balance_in_order},
            {"limits.fluid_balance_hard", {"limits.fluid_balance_soft"}, fluid_balance_in_order}}};
}

}  // namespace turbidite
