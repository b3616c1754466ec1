// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Windows and outputs.
#include <fmt/format.h>
#include <cmath>

#include "coupler/keys/key_value.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

Ruling at_least_one_window(const Settings& s) {
    if (s.real("time.end") >= s.real("time.step")) return std::nullopt;
    return Objection{
        fmt::format("The end must be at least one time.step = {} t_c.", s.text("time.step")),
        "Make the end later or the step smaller."};
}

// More windows than any run needs, and far below the largest integer.
constexpr double most_windows = 1e12;

Ruling countable_windows(const Settings& s) {
    if (s.real("time.end") / s.real("time.step") <= most_windows) return std::nullopt;
    return Objection{fmt::format("time.end = {} t_c would take more than {:.0e} windows.",
                                 s.text("time.end"), most_windows),
                     "Use a larger step."};
}

void notes(const Settings& settings, std::vector<std::string>& notes) {
    const double step = settings.real("time.step");
    const double end = settings.real("time.end");
    const double windows = std::round(end / step);
    if (std::abs(windows * step - end) > 1e-6 * end)
        notes.push_back(
            fmt::format("time.end = {} is not a whole number of steps; the run ends after "
                        "{} windows at {:.6g} t_c",
                        end, windows, windows * step));
    if (settings.real("output.interval") < step)
        notes.push_back("output.interval is shorter than time.step; every window is written");
}

}  // namespace

KeyGroup time_keys() {
    return {.keys =
                {
                    {.name = "time.step",
                     .type = KeyType::real,
                     .unit = "t_c",
                     .need = Need::required,
                     .range = positive,
                     .help = "coupling window",
                     .allowed = "The time step must be above 0 and finite.",
                     .remedy = "Use for example 0.01."},
                    {.name = "time.end",
                     .type = KeyType::real,
                     .unit = "t_c",
                     .need = Need::required,
                     .range = positive,
                     .help = "end of the run; rounded to whole windows"},
                    {.name = "output.interval",
                     .type = KeyType::real,
                     .unit = "t_c",
                     .fallback = "0.5",
                     .range = positive,
                     .help = "interval of rows of history.csv and of pictures; whole windows"},
                    {.name = "checkpoint.interval",
                     .type = KeyType::real,
                     .unit = "t_c",
                     .need = Need::optional,
                     .range = positive,
                     .help = "interval of checkpoints",
                     .available = false},
                },
            .rules = {{"time.end", {"time.step"}, at_least_one_window},
                      {"time.step", {"time.end"}, countable_windows}},
            .notes = notes};
}

}  // namespace turbidite
