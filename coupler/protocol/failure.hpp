// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Exit codes of the job, and errors that carry one. Valid C++17.
#pragma once

#include <stdexcept>
#include <string>

namespace turbidite {

/// Documented exit codes of `turbidite`; participants leave with the same.
enum class ExitCode : int {
    done = 0,
    tests_failed = 1,
    bad_input = 2,
    handshake_refused = 3,
    participant_failed = 4,
    stalled = 5,
    physics_refused = 6,
    interrupted = 130,
    terminated = 143,
};

/// An error that ends the run, with the exit code it ends with.
class Failure : public std::runtime_error {
 public:
    Failure(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    ExitCode code() const { return code_; }

 private:
    ExitCode code_;
};

/// An unphysical state (NaN, a grain outside a wall, a failed projection): exit code 6.
class PhysicsRefused : public Failure {
 public:
    explicit PhysicsRefused(const std::string& what) : Failure(ExitCode::physics_refused, what) {}
};

}  // namespace turbidite
