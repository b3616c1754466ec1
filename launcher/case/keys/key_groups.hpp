// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The groups of keys, one file each, with the rules that their keys must satisfy together. The keys
// of contacts are in granular_adapter/contact_keys.
#pragma once

#include "coupler/keys/rule.hpp"

namespace turbidite {

KeyGroup domain_keys();
KeyGroup grains_keys();
KeyGroup adapter_keys();  ///< grains.adapter, and the capabilities of the adapters
KeyGroup fluid_keys();
KeyGroup film_keys();  ///< contact.film*, which need a fluid
KeyGroup coupling_keys();
KeyGroup time_keys();
KeyGroup scales_keys();
KeyGroup limit_keys();
KeyGroup space_keys();  ///< rules of dimension: 3

/// Why a key of the fluid has no effect ("without a fluid"); empty if it has one.
std::string without_fluid(const Settings& s);

}  // namespace turbidite
