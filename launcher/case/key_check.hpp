// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Entries against the table of keys: known? of the right type? in range? available? The values that
// pass go into Settings, with defaults for the keys not given; the others become problems.
#pragma once

#include "coupler/protocol/settings.hpp"
#include "launcher/case/case_entries.hpp"

namespace turbidite {

/// Problems are appended to entries.problems.
Settings check_keys(CaseEntries& entries);

}  // namespace turbidite
