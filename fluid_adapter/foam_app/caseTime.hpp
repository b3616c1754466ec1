// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenFOAM's time of the case. A window sets its step and moves it on; it never changes either by
// itself.
#pragma once

#include <Time.H>

namespace turbidite {

class CaseTime final : public Foam::Time {
 public:
    /// OpenFOAM's own list of function objects stays empty (functionObjects.hpp).
    CaseTime(const Foam::fileName& root, const Foam::fileName& name)
        : Foam::Time(controlDictName, root, name, Foam::word("system"), Foam::word("constant"),
                     false) {}

    /// A restart: to OpenFOAM a run that begins at this time, as with `startFrom latestTime`.
    void go_on_from(Foam::scalar time, Foam::label index) {
        setTime(time, index);
        startTime_ = time;
        startTimeIndex_ = index;
    }
};

}  // namespace turbidite
