// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The functions that couple a code to the job. The participant library calls them as the coupler's
// messages arrive, one function per message, in the order that the coupler sends at the start. An
// adapter never sees a message, a rank of another program, MPI, or the name of a scheme: the
// meaning of a call follows from the calls before it in the same window.
//
//     grains   window { motion due: advance } { contact_input: advance } kick: apply_kick
//     fluid    window: advance { bodies: let_fall } { constraint: correct } accept: impose
//              and respond wherever `response` is due
//
//
// Errors: throw PhysicsRefused (exit code 6) when the state is unphysical, any other exception for
// a failure of the program (exit code 4). The user sees the text with role, rank, host and log.
//
// Valid C++17.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/protocol/stored_file.hpp"

namespace turbidite {

/// A participant's state as bytes, opaque to all others.
using SavedState = std::vector<char>;

class GrainsAdapter {
 public:
    virtual ~GrainsAdapter() = default;

    /// Adapter, host code, capabilities. Role, rank and place are filled in by the library.
    virtual Hello describe() const = 0;

    /// Receives its share of the grains at t = 0; returns them with their largest overlap.
    virtual Motion initialise(const Settings& settings, const ShapeTable& shapes,
                              const std::vector<GrainState>& grains) = 0;

    /// Step 4, the contact problem (Topin 2011, Eqs. 16-19). Returns configuration q^n, velocities
    /// after the contacts and their impulses.
    ///
    /// Without responses (`split`, `dry`) grains have inertia cM and weight cMg: velocities are
    /// U^{n+4/5}. With one response per grain (`joint`) free velocities and inertia are those given
    /// by the fluid. If it is called again before the kick, always with responses, it starts from
    /// t^n again.
    ///
    /// An adapter that repeats windows instead (`sub-iterated`: restores_within_window) is called
    /// without responses first. Of later responses only the velocities count: it starts from t^n
    /// again and holds the impulse J_h + cM (U - U^{n+4/5}), U the velocity of the response and
    /// U^{n+4/5} the one it found with J_h, which it reports as announced_impulse.
    virtual Motion advance(const Window& window, const std::vector<FreeResponse>& responses) = 0;

    /// Takes the corrected velocities and moves: q^{n+1} = q^n + dt U. U are the corrected
    /// velocities, or the contact velocities if coupling.positions says so or `joint` has given
    /// responses. Returns the state at t^{n+1}, including the contacts of this window if
    /// output is due. Ends the window. In a dry run there are no kicks: contact velocities are
    /// final.
    virtual Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) = 0;

    /// Between two windows, for a checkpoint: everything that the next windows depend on and that
    /// initialise() does not set. Called only if `describe` says saves_state.
    virtual SavedState save() const = 0;

    /// After initialise() of a resumed run, with the same settings: from here on everything must be
    /// as if the run had never been interrupted. `state` is this rank's own.
    virtual void restore(const SavedState& state) = 0;

    /// The states of all ranks of a run that had another number of them: this rank takes its even
    /// share of the grains (coupler/protocol/even_shares.hpp).
    virtual void restore_from(const std::vector<SavedState>& of_ranks) {
        throw Failure(ExitCode::bad_input, "the checkpoint was written by " +
                                               std::to_string(of_ranks.size()) +
                                               " grains ranks; go on with the same grains.ranks");
    }
};

class FluidAdapter {
 public:
    virtual ~FluidAdapter() = default;

    virtual Hello describe() const = 0;

    /// Reads the fluid case; returns the box of this rank.
    virtual Box initialise(const Settings& settings, const ShapeTable& shapes) = 0;

    /// Steps 1-3: degenerate Stokes problem, transport, viscosity. Begins the window; under `split`
    /// it runs while the grains do step 4.
    virtual void advance(const Window& window) = 0;

    /// Begins step 5 with grains that feel no contacts (`joint`): given at t^n, they move from U^n
    /// over the window together with the fluid.
    virtual void let_fall(const Window& window, const std::vector<GrainState>& grains) = 0;

    /// Step 5, Eqs. 9-10, for every grain that touches this rank's box, with the velocities and
    /// contact impulses of a contact solve.
    ///
    /// As the first call of its window (`split`) it takes the grains with the given velocities
    /// U^{n+4/5}, which contain their contact impulses. After let_fall, or after another correct,
    /// grains keep their velocities, and the change of their contact impulses acts on grains and
    /// fluid together, so that momentum is conserved exactly.
    virtual void correct(const Window& window, const std::vector<GrainState>& grains) = 0;

    /// The response of the grains to contact impulses, and the mismatch between the last correct
    /// and its contact solve (records.hpp), for the grains whose centre this rank owns. Not called
    /// under `split`.
    virtual std::vector<FreeResponse> respond() = 0;

    /// Ends the window: writes u, and fields if output is due. Returns the kicks of the grains
    /// whose centre this rank owns: the velocities found by step 5.
    virtual Kicks impose(const Window& window) = 0;

    /// As of GrainsAdapter; called on all ranks at the same time.
    virtual SavedState save() const { throw no_state(); }
    virtual void restore(const SavedState&) { throw no_state(); }

    /// The same to and from the files of the checkpoint, by parts, for a fluid that is not to be in
    /// memory a second time.
    virtual void save_to(PieceWriter& file) const {
        const SavedState state = save();
        file.write(state.data(), state.size());
    }
    virtual void restore_own(PieceReader& file) { restore(file.all()); }
    virtual void restore_parts(std::vector<PieceReader>& of_ranks) {
        std::vector<SavedState> states;
        for (PieceReader& file : of_ranks) states.push_back(file.all());
        restore_from(states);
    }

    /// The states of all ranks of a run that had another number of them.
    virtual void restore_from(const std::vector<SavedState>& of_ranks) {
        throw Failure(ExitCode::bad_input,
                      "this fluid adapter can only go on with the number of ranks that wrote the "
                      "checkpoint: fluid.ranks = " +
                          std::to_string(of_ranks.size()));
    }

 private:
    static std::logic_error no_state() {
        return std::logic_error(
            "a fluid that says saves_state overrides save and restore, or save_to, restore_own and "
            "restore_parts");
    }
};

}  // namespace turbidite
