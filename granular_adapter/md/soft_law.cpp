// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/md/soft_law.hpp"

#include "coupler/protocol/scene/sides.hpp"

namespace turbidite {
namespace {

double share_of(const Settings& settings, bool in_space) {
    constexpr const char* key = "run.md_tangential_share";
    if (settings.has(key)) return settings.real(key);
    return in_space ? tangential_share_of_spheres : tangential_share_of_discs;
}

}  // namespace

SoftLaw::SoftLaw(const Settings& settings)
    : frequency(settings.real("run.md_frequency")),
      damping(settings.real("run.md_damping")),
      friction(settings.real("contact.friction")),
      in_space(dimension_of(settings) == 3),
      tangential_share(share_of(settings, in_space)) {}

}  // namespace turbidite
