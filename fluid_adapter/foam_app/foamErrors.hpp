// SPDX-License-Identifier: GPL-3.0-or-later
//
// Converts OpenFOAM's fatal errors to our exceptions, with OpenFOAM's text.
#pragma once

#include <error.H>

#include <string>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

/// What it says, with the place in the file if it is about one.
inline std::string text_of(const Foam::error& error) {
    std::string text = error.message();
    text.erase(text.find_last_not_of(" \n") + 1);
    const auto* of_file = dynamic_cast<const Foam::IOerror*>(&error);
    if (!of_file || of_file->ioFileName().empty()) return text;
    const int line = of_file->ioStartLineNumber();
    return text + " (" + of_file->ioFileName() +
           (line < 0 ? ")" : " line " + std::to_string(line) + ")");
}

/// Calls `work`; an OpenFOAM error becomes a Failure (exit code 4) that names the activity.
template <class Work>
auto with_foam_errors(const std::string& doing, Work work) {
    try {
        return work();
    } catch (const Foam::error& error) {
        throw Failure(ExitCode::participant_failed, "OpenFOAM, " + doing + ": " + text_of(error));
    }
}

}  // namespace turbidite
