// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Windows and outputs.
#include <fmt/format.h>
#include <cmath>
#include <sstream>

#include "coupler/keys/key_value.hpp"
#include "launcher/case/keys/key_groups.hpp"
#include "launcher/case/slices.hpp"

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

Ruling fields_are_known(const Settings& s) {
    std::istringstream names(s.text("output.fields"));
    for (std::string name; names >> name;)
        if (name != "vorticity" && name != "solid")
            return Objection{
                fmt::format("There is no field {}; there are vorticity and solid.", name),
                "Write for example fields: vorticity solid."};
    return std::nullopt;
}

Ruling probes_are_inside(const Settings& s) {
    const std::vector<double> points = real_list("output.probes", s.text("output.probes"));
    const std::vector<double> size = real_list("domain.size", s.text("domain.size"));
    const std::size_t axes = in_space(s) ? 3 : 2;
    if (points.empty() || points.size() % axes != 0)
        return Objection{
            fmt::format("A list of numbers, {} for each point.", in_space(s) ? "three" : "two"),
            fmt::format("Write for example probes: [{}].",
                        in_space(s) ? "1, 2, 1, 3, 2, 1" : "1, 2, 3, 2")};
    for (std::size_t k = 0; k < points.size(); ++k)
        if (points[k] < 0.0 || points[k] > size.at(k % axes))
            return Objection{fmt::format("Point {} is outside the box of {}.", k / axes + 1,
                                         s.text("domain.size")),
                             "Use points inside."};
    return std::nullopt;
}

Ruling slices_are_inside(const Settings& s) {
    const std::string& text = s.text("output.slices");
    if (text == "auto") return std::nullopt;
    const auto planes = read_slices(text);
    if (!planes)
        return Objection{"Planes are an axis and a place in D each, with commas between.",
                         "Write for example slices: z = 6.4, x = 3, or auto, or none."};
    const std::vector<double> size = real_list("domain.size", s.text("domain.size"));
    for (const SlicePlane& plane : *planes)
        if (plane.place < 0.0 || plane.place > size.at(plane.axis))
            return Objection{fmt::format("The plane {} = {} is outside the box of {}.",
                                         "xyz"[plane.axis], plane.place, s.text("domain.size")),
                             "Use planes inside."};
    return std::nullopt;
}

bool is_whole_number(double value) {
    return std::abs(value - std::round(value)) <= 1e-6 * value;
}

void time_notes(const Settings& settings, std::vector<std::string>& notes) {
    const double step = settings.real("time.step");
    const double end = settings.real("time.end");
    const double windows = std::round(end / step);
    if (std::abs(windows * step - end) > 1e-6 * end)
        notes.push_back(
            fmt::format("time.end = {} is not a whole number of steps; the run ends after "
                        "{} windows at {:.6g} t_c",
                        end, windows, windows * step));
    const double interval = settings.real("output.interval");
    const double every = step * std::max(1.0, std::round(interval / step));
    if (interval < step)
        notes.push_back("output.interval is shorter than time.step; every window is written");
    else if (!is_whole_number(interval / step) && interval < end)
        notes.push_back(
            fmt::format("output.interval = {} is not a whole number of steps; rows "
                        "come every {:.6g} t_c",
                        settings.text("output.interval"), every));
    if (!settings.has("output.fields_interval")) return;
    const double fields = settings.real("output.fields_interval");
    if (fields < interval)
        notes.push_back(
            "output.fields_interval is shorter than output.interval; fields are written at every "
            "output");
    else if (!is_whole_number(fields / every) && fields < end)
        notes.push_back(
            fmt::format("output.fields_interval = {} is not a whole number of outputs; "
                        "fields come every {:.6g} t_c",
                        settings.text("output.fields_interval"),
                        every * std::max(1.0, std::round(fields / every))));
}

}  // namespace

KeyGroup time_keys() {
    return {
        .keys =
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
                 .help = "interval of rows of history.csv and of files of the grains; whole "
                         "windows"},
                {.name = "output.fields_interval",
                 .type = KeyType::real,
                 .unit = "t_c",
                 .need = Need::optional,
                 .range = positive,
                 .help = "interval of the fluid's fields, which need the most space; a whole "
                         "number of output.interval, the default",
                 .idle = without_fluid},
                {.name = "output.fields",
                 .type = KeyType::text,
                 .need = Need::optional,
                 .help = "fields of the fluid besides velocity, pressure and multipliers, with "
                         "spaces between: vorticity, solid (share of a cell covered by grains as "
                         "the fluid sees them)",
                 .idle = without_fluid},
                {.name = "output.probes",
                 .type = KeyType::real_list,
                 .unit = "D",
                 .need = Need::optional,
                 .help = "points x, y, in space x, y, z, one after the other, at which "
                         "probes.csv gives the fluid's pressure and velocity",
                 .allowed = "A list of numbers, two for each point.",
                 .entries = 0,
                 .idle = without_fluid,
                 .in_space = {.allowed = "A list of numbers, three for each point."}},
                of_space({.name = "output.slices",
                          .type = KeyType::text,
                          .unit = "D",
                          .fallback = "auto",
                          .help = "planes at which the fluid's pressure and velocity are "
                                  "written at every output, for ParaView and the report: z = "
                                  "6.4, x = 3. auto: one through the middle of the depth; "
                                  "none",
                          .allowed = "auto, none, or planes: an axis and a place each.",
                          .idle = without_fluid}),
                {.name = "output.timeline",
                 .type = KeyType::flag,
                 .fallback = "false",
                 .help = "when each rank computes, waits and transfers, in timeline/ as a "
                         "trace for ui.perfetto.dev; at most 64 MB per host"},
                {.name = "checkpoint.interval",
                 .type = KeyType::real,
                 .unit = "t_c",
                 .fallback = "10",
                 .range = not_negative,
                 .help = "simulated time from one checkpoint to the next; 0: no such rule. "
                         "Without any rule there are no checkpoints but those asked for"},
                {.name = "checkpoint.windows",
                 .type = KeyType::integer,
                 .fallback = "0",
                 .range = not_negative,
                 .help = "also after so many windows; 0: no such rule"},
                {.name = "checkpoint.wall_minutes",
                 .type = KeyType::real,
                 .unit = "min",
                 .fallback = "15",
                 .range = not_negative,
                 .help = "also after so much wall time; 0: no such rule"},
                {.name = "checkpoint.keep",
                 .type = KeyType::integer,
                 .fallback = "2",
                 .range = {.lower = 1.0},
                 .help = "checkpoints that stay, the newest ones"},
            },
        .rules = {{"time.end", {"time.step"}, at_least_one_window},
                  {"time.step", {"time.end"}, countable_windows},
                  {"output.fields", {}, fields_are_known},
                  {"output.slices", {"domain.size"}, slices_are_inside},
                  {"output.probes", {"domain.size", "dimension"}, probes_are_inside}},
        .notes = time_notes};
}

}  // namespace turbidite
