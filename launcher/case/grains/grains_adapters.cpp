// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/grains_adapters.hpp"

#include <algorithm>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

GrainsAdapter contact_engine(const char* name, const char* help, GrainsHost host,
                             const char* file) {
    return {.name = name,
            .help = help,
            .family = "nscd",
            .host = host,
            .file = file,
            .shapes = {"disc", "triangle", "polygon"},
            .schemes = {"split", "joint"},
            .adhesion_and_rolling = true,
            .cyclic_sides = true,
            .inner_walls = true,
            .moving_sides = true,
            .materials = true,
            .prescribed_grains = true,
            .moved_grains = true};
}

GrainsAdapter external_program(const char* name, const char* help) {
    GrainsAdapter adapter = contact_engine(name, help, GrainsHost::command, "");
    adapter.family = "any";
    adapter.schemes.push_back("sub-iterated");
    adapter.moved_grains = false;
    adapter.most_ranks = any_number;
    return adapter;
}

const GrainsAdapter& grains_adapter(const Settings& settings) {
    const std::string& name = settings.text("grains.adapter");
    for (const GrainsAdapter& adapter : grains_adapters())
        if (adapter.name == name && adapter.available()) return adapter;
    throw Failure(ExitCode::bad_input,
                  "grains.adapter = " + name + " has no program in this version");
}

const char* best_scheme(const GrainsAdapter& adapter) {
    const bool joint =
        std::find(adapter.schemes.begin(), adapter.schemes.end(), "joint") != adapter.schemes.end();
    return joint && adapter.host != GrainsHost::command ? "joint" : "split";
}

std::string adapters_that(bool (*can)(const GrainsAdapter&)) {
    std::string names;
    for (const GrainsAdapter& adapter : grains_adapters())
        if (!adapter.file.empty() && can(adapter))  // not one that can do anything
            names += (names.empty() ? "" : " or ") + adapter.name;
    return names;
}

}  // namespace turbidite
