// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Text for a terminal: no word is cut at the end of a line.
#pragma once

#include <string>

namespace turbidite {

/// The words of a text in lines of this width, each begun with `indent` blanks.
std::string wrapped(const std::string& text, int indent, int width);

/// The same lines, those that are too long continued below their beginning, or below their second
/// column if they have one ("  name    description").
std::string fitted(const std::string& lines, int width);

}  // namespace turbidite
