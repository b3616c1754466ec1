// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/cli/case_summary.hpp"

#include <fmt/format.h>

#include "coupler/case/key_value.hpp"

namespace turbidite {
namespace {

std::string fluid_line(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    if (!settings.flag("fluid.enabled")) return "  fluid: none\n";
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const double cells = settings.real("fluid.cells_per_diameter");
    return fmt::format("  fluid: {:.0f} x {:.0f} cells, Re = {:.4g}\n", size[0] * cells,
                       size[1] * cells, resolved.scales.reynolds);
}

}  // namespace

std::string case_summary(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    std::string text =
        fmt::format("{}: {} grains ({}) in {} D\n", resolved.name, resolved.population.size(),
                    settings.text("grains.adapter"), settings.text("domain.size"));
    text += fluid_line(resolved);
    text += fmt::format("  time: {} windows of {} t_c, t_c = {:.4g}, u_c = {:.4g}\n",
                        settings.integer("run.windows"), settings.text("time.step"),
                        resolved.scales.time, resolved.scales.velocity);
    for (const std::string& note : resolved.notes) text += "  note: " + note + "\n";
    return text;
}

}  // namespace turbidite
