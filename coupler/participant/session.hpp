// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Drives an adapter through a run. A host code with its own loop (YADE) calls `start` once and
/// `step` once per window; other programs use participant.hpp.
///
/// Valid C++17; includes neither MPI nor any host.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "coupler/participant/adapter.hpp"

namespace turbidite {

class Channel;
class FramedMessage;

/// Who this rank is; fills the fields of Hello that the adapter cannot know.
struct Identity {
    int rank = 0;                 ///< among those of its program
    int ranks = 1;                ///< of its program
    std::string log_file;         ///< for the messages of others
    std::string case_hash;        ///< case_hash() of `RUN/case.yaml`; empty: not known
    std::string run_folder = {};  ///< folders of checkpoints are relative to it
};

/// How the run ended for this participant.
struct Outcome {
    ExitCode code = ExitCode::done;
    std::string reason;  ///< empty if the run is done
};

/// One rank's part of a run: start() once, step() per window until it returns false, then
/// outcome(). Made by make_session().
class Session {
 public:
    virtual ~Session();

    /// Handshake, settings, initial state; once. False if the run is already over (refused). Like
    /// `step`, throws when the coupler no longer answers: the job must then be aborted. Calls in a
    /// wrong order throw std::logic_error that names the call that is missing.
    bool start();

    /// One window, after `start`, and a checkpoint before it if one is due. False when the run is
    /// over; `outcome` gives the reason. An exception from an adapter ends the run for all
    /// participants, with its text.
    bool step();

    /// After `start` or `step` returned false; throws std::logic_error before.
    const Outcome& outcome() const;

    /// `text` describes an exception that is not a C++ standard exception, such as a Python error
    /// of the host; it is called while that exception is being handled.
    void explain_other_exceptions(std::function<std::string()> text);

 protected:
    Session();
    struct Talk;
    std::unique_ptr<Talk> talk_;

 private:
    virtual void begin() = 0;
    /// Reacts to a message of a window.
    virtual void take(const FramedMessage& message) = 0;
    /// Writes or reads a checkpoint.
    virtual void checkpoint(const FramedMessage& message) = 0;
    template <class Action>
    bool guarded(Action action);

    enum class Phase { made, started, over };
    Phase phase_ = Phase::made;
};

/// `adapter` and `channel` outlive the session.
std::unique_ptr<Session> make_session(GrainsAdapter& adapter, Channel& channel,
                                      const Identity& identity);
/// The same for a fluid.
std::unique_ptr<Session> make_session(FluidAdapter& adapter, Channel& channel,
                                      const Identity& identity);

}  // namespace turbidite
