// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/md/soft_law.hpp"

namespace turbidite {

SoftLaw::SoftLaw(const Settings& settings)
    : frequency(settings.real("run.md_frequency")),
      damping(settings.real("run.md_damping")),
      friction(settings.real("contact.friction")) {}

}  // namespace turbidite
