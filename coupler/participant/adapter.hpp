// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The functions that couple a code to the job. The participant library calls them as the coupler's
/// messages arrive, one function per message, in the order that the coupler sends at the start. An
/// adapter never sees a message, a rank of another program, MPI, or the name of a scheme: the
/// meaning of a call follows from the calls before it in the same window.
///
///     grains   describe  initialise  [restore]  then per window:  [save]
///              window { motion due: advance } { contact_input: advance } kick: apply_kick
///     fluid    describe  initialise  [restore]  then per window:  [save]
///              window: advance { bodies: let_fall } { constraint: correct } accept: impose
///              and respond wherever `response` is due
///
/// Calls never overlap, and come from the thread that runs the session.
///
/// Errors: throw PhysicsRefused (exit code 6) when the state is unphysical, any other exception for
/// a failure of the program (exit code 4). The user sees the text with role, rank, host and log.
///
/// Valid C++17.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/participant/abilities.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/stored_file.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

/// The library of a participant, and the records that programs exchange.
namespace turbidite {

/// A participant's state as bytes, which mean nothing to all others.
using SavedState = std::vector<char>;

/// A granular code as a participant: derive from it and hand the object to run_grains().
///
/// On several ranks every rank has an adapter of its own, which gets and returns the grains of that
/// rank. Every returned Motion has all of them, in any order: the record that came, with new
/// position, orientation, velocities and impulses; id, shape, material, radius, density and
/// `prescribed` never change. A grain may come from another rank than the last time. The coupler
/// checks every Motion (docs/write-an-adapter.md, What the coupler checks), and ends the run with
/// code 6 at the first violation.
class GrainsAdapter {
 public:
    virtual ~GrainsAdapter() = default;

    /// What the program is and can do, before anything else is known: adapter, adapter_version,
    /// host_code, dimension and capabilities of the Hello. The library fills in the rest. The run
    /// ends with code 3 if the case needs what is not claimed here.
    virtual Hello describe() const = 0;

    /// What it can do beyond the least (abilities.hpp). The library then refuses, naming the key,
    /// every case that asks for more; initialise gets no other. Without an answer initialise has to
    /// look itself.
    virtual std::optional<Abilities> abilities() const { return std::nullopt; }

    /// Receives the resolved case, the table of shapes and this rank's share of the grains at
    /// t = 0. Returns exactly these grains, unmoved and without impulses; report.max_penetration
    /// is their largest overlap. Throws, naming the key, if the case asks for what the program
    /// cannot do and `abilities` does not tell. `settings` and `shapes` are valid during the call
    /// only.
    virtual Motion initialise(const Settings& settings, const ShapeTable& shapes,
                              const std::vector<GrainState>& grains) = 0;

    /// The contacts of the window, step 4. Returns every grain with position and orientation of the
    /// start of the window, q^n, the velocities after the contacts and the impulses of the contacts
    /// (Topin 2011, Eqs. 16-19).
    ///
    /// Without responses (`split`, without a fluid) grains have the inertia cM and the weight
    /// (M - m_f) g of docs/write-an-adapter.md, and velocities are U^{n+4/5}:
    ///
    ///     cM (U^{n+4/5} - U^n) = -(M - m_f) g dt y + J_c
    ///
    /// With one response per grain (`joint`; by `id`, in any order) free velocities and inertia are
    /// those given by the fluid. If it is called again before the kick, always with responses, it
    /// starts from t^n again: nothing is committed before apply_kick.
    ///
    /// An adapter that repeats windows instead (`sub-iterated`: restores_within_window) is called
    /// without responses first. Of later responses only the velocities count: it starts from t^n
    /// again and holds the impulse J_h + cM (U - U^{n+4/5}), U the velocity of the response and
    /// U^{n+4/5} the one it found with J_h, which it reports as announced_impulse.
    virtual Motion advance(const Window& window, const std::vector<FreeResponse>& responses) = 0;

    /// Takes the corrected velocities and moves: q^{n+1} = q^n + dt U, and the orientation turns by
    /// dt omega. U are the corrected velocities, or the contact velocities if coupling.positions
    /// says so or `joint` has given responses. Ends the window.
    ///
    /// There is one kick per grain, by `id`, in any order. Without a fluid there are none: contact
    /// velocities are final, and the report of this call is the only one that travels.
    ///
    /// Returns the state at t^{n+1}: the velocities of the kicks, the contact impulses that
    /// `advance` returned last, and in windows with output the single contacts, if the program can
    /// report them. Grains that have left through a free side are left out and counted in
    /// report.removed.
    virtual Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) = 0;

    /// Between two windows, for a checkpoint: everything that the next windows depend on and that
    /// initialise() does not set. Called only if `describe` says saves_state; otherwise it may
    /// return nothing. An exception costs this checkpoint, not the run.
    virtual SavedState save() const = 0;

    /// After initialise() of a resumed run, which has got the grains of t = 0 and the same
    /// settings: from here on everything must be as if the run had never been interrupted. `state`
    /// is this rank's own.
    virtual void restore(const SavedState& state) = 0;

    /// In the place of restore(): the states of all ranks of a run that had another number of them,
    /// in the order of the ranks. This rank takes its even share of the grains
    /// (coupler/protocol/even_shares.hpp). Refuses unless it is overridden.
    virtual void restore_from(const std::vector<SavedState>& of_ranks) {
        throw Failure(ExitCode::bad_input, "the checkpoint was written by " +
                                               std::to_string(of_ranks.size()) +
                                               " grains ranks; go on with the same grains.ranks");
    }
};

/// A fluid as a participant: derive from it and hand the object to run_fluid(). Steps are those of
/// Topin et al. 2011. All ranks of the fluid get every call at the same point of the run.
class FluidAdapter {
 public:
    virtual ~FluidAdapter() = default;

    /// As of GrainsAdapter.
    virtual Hello describe() const = 0;

    /// Reads the fluid case; returns where this rank must know the grains. The parts of all ranks
    /// cover the domain: a rank gets the grains that touch its box, and answers for those whose
    /// centre is in its own part.
    virtual Box initialise(const Settings& settings, const ShapeTable& shapes) = 0;

    /// Steps 1 to 3: degenerate Stokes problem, transport, viscosity. Begins the window; under
    /// `split` it runs while the grains do step 4.
    virtual void advance(const Window& window) = 0;

    /// Begins step 5 with grains that feel no contacts (`joint`): given at t^n, they move from U^n
    /// over the window together with the fluid.
    virtual void let_fall(const Window& window, const std::vector<GrainState>& grains) = 0;

    /// The multipliers, step 5 (Equations 9 and 10), for every grain that touches this rank's box,
    /// with the velocities and contact impulses of a contact solve.
    ///
    /// As the first call of its window (`split`) it takes the grains with the given velocities
    /// U^{n+4/5}, which contain their contact impulses. After let_fall, or after another correct,
    /// grains keep their velocities, and the change of their contact impulses acts on grains and
    /// fluid together, so that momentum is conserved exactly.
    virtual void correct(const Window& window, const std::vector<GrainState>& grains) = 0;

    /// The response of the grains to contact impulses, and the mismatch between the last correct()
    /// and its contact solve (FreeResponse), for the grains whose centre this rank owns. Not called
    /// under `split`.
    virtual std::vector<FreeResponse> respond() = 0;

    /// Ends the window: writes u, and fields if output is due. Returns the kicks of the grains
    /// whose centre this rank owns, with the velocities found by step 5 and the impulses of the
    /// multipliers; the coupler adds force and torque.
    virtual Kicks impose(const Window& window) = 0;

    /// As of GrainsAdapter; called on all ranks at the same time.
    virtual SavedState save() const { throw no_state(); }
    /// As of GrainsAdapter; called on all ranks at the same time.
    virtual void restore(const SavedState&) { throw no_state(); }

    /// save() to the file of the checkpoint, by parts, for a fluid that is not to be in memory a
    /// second time.
    virtual void save_to(PieceWriter& file) const {
        const SavedState state = save();
        file.write(state.data(), state.size());
    }
    /// restore() from this rank's own file, by parts.
    virtual void restore_own(PieceReader& file) { restore(file.all()); }
    /// restore_from() the files of all ranks, by parts.
    virtual void restore_parts(std::vector<PieceReader>& of_ranks) {
        std::vector<SavedState> states;
        for (PieceReader& file : of_ranks) states.push_back(file.all());
        restore_from(states);
    }

    /// The states of all ranks of a run that had another number of them. Refuses unless it is
    /// overridden.
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
