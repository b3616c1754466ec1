// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What standard output can do. The report's scripts ask the same of standard error
// (report/document/working.py).
#pragma once

#include <string>

namespace turbidite {

/// True for a terminal that can go back to the start of a line and clear it: TERM=dumb cannot.
bool rewrites_lines();

/// Columns of the terminal at stdout, or of COLUMNS, from 40 to 120; 80 if neither is known.
int terminal_width();

/// Lines as they are for a file or a pipe, and in the width of the terminal for a terminal.
std::string for_stdout(const std::string& lines);

/// The same for stderr.
std::string for_stderr(const std::string& lines);

/// Flushes stdout. Whether all that was printed could be written: on a full disk it cannot.
bool stdout_took_all();

/// Writes to stderr. What nobody takes any more, as on a full disk or in a closed terminal, is
/// lost: no run ends for it.
void print_on_stderr(const std::string& lines);

/// Writes "turbidite: ..." as a line of its own to stderr.
void tell_on_stderr(const std::string& text);

}  // namespace turbidite
