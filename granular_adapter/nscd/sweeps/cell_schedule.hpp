// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Groups of contacts cell by cell (problem/contact_cells.hpp), so that what a sweep does in a cell
// depends on the contacts of this cell only, whoever has the others: ranks have equal bits.
//
// No group has contacts of two cells. Within a cell any order is as good as another one, so every
// contact goes into the first group that has a free lane and none of its bodies, and whose
// neighbours have none of them either; then nearly all lanes are full although groups begin anew
// with every cell. A cell is a stretch, or several if it has many contacts: its active groups come
// first.
#pragma once

#include "granular_adapter/nscd/problem/contact_cells.hpp"
#include "granular_adapter/nscd/sweeps/contact_schedule.hpp"

namespace turbidite::nscd {

/// As make_schedule; `settings.stretch` is not used. `phase_ends`: by phase, the number of cells up
/// to its end.
Schedule make_cell_schedule(const std::vector<MovedPair>& pairs,
                            const std::vector<std::uint8_t>& active, std::size_t bodies,
                            const ScheduleSettings& settings, const ContactCells& cells,
                            const std::vector<std::size_t>& phase_ends = {});

}  // namespace turbidite::nscd
