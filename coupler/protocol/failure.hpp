// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Exit codes of the job, and errors that carry one. Valid C++17.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace turbidite {

/// Documented exit codes of `turbidite`; participants leave with the same.
enum class ExitCode : int {
    done = 0,
    tests_failed = 1,
    bad_input = 2,           ///< before a job; within one it counts as participant_failed
    handshake_refused = 3,   ///< programs or case do not fit together
    participant_failed = 4,  ///< a program threw, crashed or ended too early
    stalled = 5,             ///< a program did not answer
    physics_refused = 6,     ///< an unphysical state, or a record that cannot be right
    interrupted = 130,
    terminated = 143,
};

/// Of an error within a job, where it is too late for bad input.
inline ExitCode code_in_job(ExitCode code) {
    return code == ExitCode::bad_input ? ExitCode::participant_failed : code;
}

/// An error that ends the run, with the exit code it ends with.
class Failure : public std::runtime_error {
 public:
    Failure(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    ExitCode code() const { return code_; }

 private:
    ExitCode code_;
};

/// The exit code that a program ends with when `error` does.
inline ExitCode code_of(const std::exception& error) {
    const auto* failure = dynamic_cast<const Failure*>(&error);
    return failure ? failure->code() : ExitCode::participant_failed;
}

/// An unphysical state (NaN, a grain outside a wall, a failed projection): exit code 6.
class PhysicsRefused : public Failure {
 public:
    explicit PhysicsRefused(const std::string& what) : Failure(ExitCode::physics_refused, what) {}
};

}  // namespace turbidite
