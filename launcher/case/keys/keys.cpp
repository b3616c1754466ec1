// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/keys.hpp"

#include <algorithm>

#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/keys/key_groups.hpp"

namespace turbidite {
namespace {

/// The position after the last key of the same group.
void insert_in_group(KeyTable& table, const KeySpec& key) {
    const auto last = std::find_if(table.rbegin(), table.rend(), [&](const KeySpec& other) {
        return group_of(other.name) == group_of(key.name);
    });
    table.insert(last == table.rend() ? table.end() : last.base(), key);
}

KeyTable all_keys() {
    KeyTable table;
    for (const KeyGroup& group : key_groups())
        for (const KeySpec& key : group.keys) insert_in_group(table, key);
    return table;
}

}  // namespace

const std::vector<KeyGroup>& key_groups() {
    static const std::vector<KeyGroup> groups = {
        domain_keys(),
        adapter_keys(),
        grains_keys(),
        fluid_keys(),
        contact_problem_keys(),
        contact_law_keys(),
        film_keys(),
        material_keys(),
        molecular_dynamics_keys(),
        coupling_keys(),
        time_keys(),
        scales_keys(),
        limit_keys(),
        space_keys(),
    };
    return groups;
}

const KeyTable& key_table() {
    static const KeyTable table = all_keys();
    return table;
}

const KeySpec* find_key(const std::string& name) {
    return find_key(key_table(), name);
}

}  // namespace turbidite
