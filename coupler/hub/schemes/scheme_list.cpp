// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <stdexcept>

#include "coupler/hub/schemes/scheme.hpp"

namespace turbidite {

const std::vector<SchemeEntry>& scheme_list() {
    static const std::vector<SchemeEntry> schemes = {
        split_scheme(),
        joint_scheme(),
        sub_iterated_scheme(),
        dry_scheme(),
    };
    return schemes;
}

namespace {

template <class Test>
const SchemeEntry& first_scheme(Test test) {
    const auto& list = scheme_list();
    return *std::find_if(list.begin(), list.end(), test);
}

}  // namespace

std::string scheme_name(const Settings& settings) {
    if (settings.flag("fluid.enabled")) return settings.text("coupling.scheme");
    return first_scheme([](const SchemeEntry& entry) { return entry.fluid.empty(); }).name;
}

const SchemeEntry& scheme_with_inertia() {
    return first_scheme([](const SchemeEntry& entry) { return entry.needs_inertia(); });
}

const SchemeEntry& scheme_without_rounds() {
    return first_scheme([](const SchemeEntry& entry) { return entry.side_by_side(); });
}

bool SchemeEntry::has_responses() const {
    return std::any_of(fluid.begin(), fluid.end(),
                       [](const Step& step) { return step.kind == Kind::response; });
}

bool SchemeEntry::has_rounds() const {
    return std::any_of(fluid.begin(), fluid.end(),
                       [](const Step& step) { return step.times == Times::per_round; });
}

const SchemeEntry& find_scheme(const std::string& name) {
    std::string known;
    for (const SchemeEntry& entry : scheme_list()) {
        if (name == entry.name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw std::invalid_argument("unknown scheme \"" + name + "\"; known: " + known);
}

double SchemeEntry::slip_tolerance(const Settings& settings) const {
    const double alone = settings.real("fluid.multiplier_tolerance");
    if (slip_per_mismatch == 0.0) return alone;
    return std::min(alone, slip_per_mismatch * settings.real("coupling.tolerance"));
}

}  // namespace turbidite
