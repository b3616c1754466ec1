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
                     "Increase it."};
}

}  // namespace

KeyGroup limit_keys() {
    return {.keys =
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
                    {.name = "limits.penetration",
                     .type = KeyType::real,
                     .unit = "D",
                     .fallback = "0.2",
                     .range = positive,
                     .help = "largest overlap of grains; beyond it the run ends with code 6"},
                    {.name = "limits.memory",
                     .type = KeyType::real,
                     .unit = "GB",
                     .need = Need::optional,
                     .range = positive,
                     .help = "memory that the fluid may take; otherwise that of the machine that "
                             "checks the case",
                     .idle = without_fluid},
                },
            .rules = {{"limits.stall_hard", {"limits.stall_soft"}, limits_in_order}}};
}

}  // namespace turbidite
