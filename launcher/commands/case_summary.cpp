// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/commands/case_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"
#include "launcher/case/files/command_words.hpp"
#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/remarks.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/grains/grains_adapters.hpp"

namespace turbidite {
namespace {

/// Rows of different heights; empty if all are equal.
std::string rows_text(const Settings& settings, double top) {
    if (!rows_are_stretched(settings)) return "";
    const MeshRows rows = *mesh_rows(settings, top);
    return fmt::format(
        "  rows: {} equal ones up to {:.4g} D, {} that grow by {:.4f} to {:.3g} "
        "cells\n",
        rows.equal, rows.equal_height(), rows.stretched.size(), rows.ratio,
        rows.largest() / rows.height);
}

std::string fluid_line(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    if (!settings.flag("fluid.enabled")) return "  fluid: none\n";
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const double cells = settings.real("fluid.cells_per_diameter");
    const std::string depth =
        in_space(settings) ? fmt::format(" x {:.0f}", size.at(2) * cells) : "";
    return fmt::format("  fluid: {:.0f} x {:.0f}{} cells, Re = {:.4g}\n", size[0] * cells,
                       fluid_rows(settings), depth, resolved.scales.reynolds) +
           rows_text(settings, size[1]) + "  scheme: " + settings.text("coupling.scheme") + "\n";
}

std::string functions_line(const FunctionObjectsFile& functions) {
    if (functions.text.empty()) return "";
    std::string names;
    for (const std::string& name : functions.names) names += (names.empty() ? "" : ", ") + name;
    if (functions.from_elsewhere) names += names.empty() ? "by directives" : ", more by directives";
    return fmt::format("  function objects: {}\n", names);
}

/// "fluid 22, grains 1.2, coupler 0.5, messages 7"
std::string parts_text(const WindowForecast& window) {
    std::string text = window.fluid > 0.0 ? fmt::format("fluid {:.3g}, ", 1e3 * window.fluid) : "";
    return text + fmt::format("grains {:.3g}, coupler {:.3g}, messages {:.3g}", 1e3 * window.grains,
                              1e3 * window.coupler, 1e3 * window.messages);
}

std::string forecast_line(const ResolvedCase& resolved) {
    const WindowForecast window = forecast_window(resolved);
    return fmt::format(
        "  forecast: roughly {}, {:.3g} ms per window ({}), {} of memory, {} of files\n",
        rough_time(predicted_seconds(resolved)), 1e3 * window.seconds(), parts_text(window),
        rough_size(predicted_memory(resolved)), rough_size(predicted_disk(resolved)));
}

std::string md_line(const Settings& settings) {
    if (grains_adapter(settings).contacts != Contacts::springs) return "";
    const double frequency = settings.real("run.md_frequency");
    const double fall = settings.real("run.gravity") / settings.real("run.diameter");
    return fmt::format(
        "  molecular dynamics: stiffness {:.3g} m g/D, damping {:.3g} of critical, contact time "
        "{:.3g} t_c, {} sub-steps per window\n",
        frequency * frequency / (2.0 * fall), settings.real("run.md_damping"),
        std::numbers::pi / frequency / settings.real("run.time_scale"),
        settings.integer("run.md_substeps"));
}

std::string command_line(const Settings& settings) {
    if (grains_adapter(settings).host != GrainsHost::command) return "";
    const auto program = find_program_file(command_words(settings.text("grains.command"))->front());
    return fmt::format("  grains program: {} ({})\n", settings.text("grains.command"),
                       program.empty() ? "not found" : program.string());
}

/// "every 10 t_c or 15 min", empty if all rules are off.
std::string checkpoint_rules(const Settings& settings) {
    std::string text;
    const auto add = [&](double every, const char* unit) {
        if (every > 0.0)
            text += fmt::format("{}{:g} {}", text.empty() ? "every " : " or ", every, unit);
    };
    add(settings.real("checkpoint.interval"), "t_c");
    add(static_cast<double>(settings.integer("checkpoint.windows")), "windows");
    add(settings.real("checkpoint.wall_minutes"), "min");
    return text;
}

std::string checkpoint_line(const Settings& settings) {
    const std::string rules = checkpoint_rules(settings);
    if (rules.empty())
        return "  checkpoints: only when asked for; without one an interrupted run cannot go on\n";
    std::string text = fmt::format("  checkpoints: {}, the newest {} are kept\n", rules,
                                   settings.integer("checkpoint.keep"));
    if (grains_adapter(settings).host == GrainsHost::command)
        text +=
            "    if the grains program saves and restores its state (turbidite adapter-test says "
            "whether it does);\n    if not, there are none, and an interrupted run cannot go on\n";
    return text;
}

}  // namespace

std::string case_summary(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    std::string text =
        fmt::format("{}: {} grains ({}) in {} D\n", resolved.name, resolved.population.size(),
                    settings.text("grains.adapter"), settings.text("domain.size"));
    text += command_line(settings);
    text += fluid_line(resolved);
    text += functions_line(resolved.functions);
    const bool in_si = is(settings, "scales.kind", "physical");
    text += fmt::format("  time: {} windows of {} t_c, t_c = {:.4g}{}, u_c = {:.4g}{}\n",
                        settings.integer("run.windows"), settings.text("time.step"),
                        resolved.scales.time, in_si ? " s" : "", resolved.scales.velocity,
                        in_si ? " m/s" : "");
    text += forecast_line(resolved);
    text += md_line(settings);
    text += checkpoint_line(settings);
    for (const std::string& remark : remarks_of(resolved)) text += "  " + remark + "\n";
    return text;
}

}  // namespace turbidite
