// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The five functions that plug a code into the job: describe, initialise, advance, apply kick
// (fluid: impose), save/restore; a fluid that takes part in scheme `joint` has two more, respond and
// correct. The participant library calls them in the order of the scheme; an adapter never sees a
// message, a rank of another program, or MPI.
//
// Errors: throw PhysicsRefused (exit code 6) when the physics cannot go on, any other exception for
// a failure of the program (exit code 4). The text reaches the user with role, rank, host and log.
//
// Valid C++17.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// A participant's state as bytes, opaque to everybody else.
using SavedState = std::vector<char>;

class GrainsAdapter {
 public:
    virtual ~GrainsAdapter() = default;

    /// Adapter, host code, capabilities. Role, rank and place are filled in by the library.
    virtual Hello describe() const = 0;

    /// Takes its share of the grains at t = 0; returns them with their largest overlap.
    virtual Motion initialise(const Settings& settings, const ShapeTable& shapes,
                              const std::vector<GrainState>& grains) = 0;

    /// Step 4: the contact problem without fluid, inertia cM and weight cMg (Topin 2011, Eqs.
    /// 16-19). Returns configuration q^n and velocities U^{n+4/5}. Under `joint` the responses hold
    /// free velocities and effective inertia and replace free motion; under `split` they are empty.
    virtual Motion advance(const Window& window, const std::vector<FreeResponse>& responses) = 0;

    /// Takes the corrected velocities and moves: q^{n+1} = q^n + dt U. Returns the state at
    /// t^{n+1}, in windows with output with the contacts of this window.
    virtual Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) = 0;

    virtual SavedState save() const = 0;
    virtual void restore(const SavedState& state) = 0;
};

class FluidAdapter {
 public:
    virtual ~FluidAdapter() = default;

    virtual Hello describe() const = 0;

    /// Reads the fluid case; returns the box of this rank.
    virtual Box initialise(const Settings& settings, const ShapeTable& shapes) = 0;

    /// Steps 1-3: degenerated Stokes, transport, viscosity. Runs while the grains do step 4.
    virtual void advance(const Window& window) = 0;

    /// Scheme `joint` only, once per window: step 5 for grains that feel no contacts, from
    /// U^n + g dt (grains at t^n are given). Answers for the grains whose centre this rank owns.
    virtual std::vector<FreeResponse> respond(const Window& window,
                                              const std::vector<GrainState>& grains) = 0;

    /// Scheme `joint` only, after every contact solve: the grains carry its velocities and contact
    /// impulses. Answers with corrected free velocities and the mismatch (records.hpp).
    virtual std::vector<FreeResponse> correct(const Window& window,
                                              const std::vector<GrainState>& grains) = 0;

    /// Step 5, Eqs. 9-10, for every grain that touches this rank's box. Writes fields when the
    /// window says so. Under `joint` it ends the window: the grains are those of the last
    /// `correct`, the kick's velocity is its U', so that momentum balances to round-off.
    virtual Kicks impose(const Window& window, const std::vector<GrainState>& grains) = 0;

    virtual SavedState save() const = 0;
    virtual void restore(const SavedState& state) = 0;
};

}  // namespace turbidite
