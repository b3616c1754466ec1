// SPDX-License-Identifier: GPL-3.0-or-later
//
// Converts OpenFOAM's fatal errors to our exceptions, with OpenFOAM's text.
#pragma once

#include <error.H>

#include <string>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

/// Calls `work`; an OpenFOAM error becomes a Failure (exit code 4) that names the activity.
template <class Work>
auto with_foam_errors(const std::string& doing, Work work) {
    try {
        return work();
    } catch (const Foam::error& error) {
        throw Failure(ExitCode::participant_failed, "OpenFOAM, " + doing + ": " + error.message());
    }
}

}  // namespace turbidite
