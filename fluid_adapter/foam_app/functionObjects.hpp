// SPDX-License-Identifier: GPL-3.0-or-later
//
// The function objects of the case, `functions` in system/controlDict, as OpenFOAM's own loop over
// time plays them: made before the first window, after a restart at the time it goes on from;
// executed and asked to write after every window. OpenFOAM's list of them would end the program
// without a word to the others when one cannot be made.
#pragma once

#include <Time.H>
#include <functionObject.H>

#include <memory>
#include <vector>

namespace turbidite {

class FunctionObjects {
 public:
    explicit FunctionObjects(Foam::Time& time);

    /// Whether the case has any.
    bool any() const { return any_; }

    /// Makes them, at the first call. Throws Failure naming the one that cannot be made, and
    /// why.
    void begin();

    void execute();  ///< after a window, whose time it is
    void end();      ///< after the last window

 private:
    void make(const Foam::word& name, const Foam::dictionary& entries);

    Foam::Time& time_;
    bool any_;
    bool made_ = false;
    std::vector<std::unique_ptr<Foam::functionObject>> objects_;
};

}  // namespace turbidite
