// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/grains_adapters.hpp"

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {

GrainsAdapter contact_engine(const char* name, const char* help, GrainsHost host,
                             const char* file) {
    return {.name = name,
            .help = help,
            .contacts = Contacts::rigid,
            .host = host,
            .file = file,
            .shapes = {"disc", "triangle", "polygon", "sphere"},
            .takes_inertia = true,
            .adhesion_and_rolling = true,
            .films = true,
            .cyclic_sides = true,
            .inner_walls = true,
            .moving_sides = true,
            .materials = true,
            .prescribed_grains = true,
            .moved_grains = true};
}

GrainsAdapter on_ranks(GrainsAdapter adapter) {
    adapter.most_ranks = any_number;
    adapter.resumes_on_other_ranks = true;
    return adapter;
}

GrainsAdapter external_program(const char* name, const char* help) {
    GrainsAdapter adapter = contact_engine(name, help, GrainsHost::command, "");
    adapter.contacts = Contacts::any;
    adapter.repeats_windows = true;
    adapter.films = false;
    adapter.moved_grains = false;
    adapter.most_ranks = any_number;
    // It may, and has to refuse it otherwise.
    adapter.resumes_on_other_ranks = true;
    return adapter;
}

const GrainsAdapter& grains_adapter(const Settings& settings) {
    const std::string& name = settings.text("grains.adapter");
    for (const GrainsAdapter& adapter : grains_adapters())
        if (adapter.name == name && adapter.available()) return adapter;
    throw Failure(ExitCode::bad_input,
                  "grains.adapter = " + name + " has no program in this version");
}

bool shares_contacts(const Settings& settings) {
    return settings.integer("grains.ranks") > 1 &&
           grains_adapter(settings).contacts == Contacts::rigid;
}

bool supports(const GrainsAdapter& adapter, const SchemeEntry& scheme) {
    return (adapter.takes_inertia || !scheme.needs_inertia()) &&
           (adapter.repeats_windows || !scheme.repeats);
}

const SchemeEntry& best_scheme(const GrainsAdapter& adapter) {
    // Of a user's program it is not known whether it takes the fluid's inertia: the safe choice.
    const bool known = adapter.takes_inertia && adapter.host != GrainsHost::command;
    return known ? scheme_with_inertia() : scheme_without_rounds();
}

std::string adapters_that(bool (*can)(const GrainsAdapter&)) {
    std::string names;
    for (const GrainsAdapter& adapter : grains_adapters())
        if (!adapter.file.empty() && can(adapter))  // not one that can do anything
            names += (names.empty() ? "" : " or ") + adapter.name;
    return names;
}

}  // namespace turbidite
