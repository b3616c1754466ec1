// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the steps of a window under their names: measures their time, and adds step and window to
// the errors they throw.
#pragma once

#include <chrono>
#include <string>

#include "coupler/protocol/records.hpp"
#include "fluid_adapter/foam_app/foamErrors.hpp"

namespace turbidite {

/// Adds the time between its construction and destruction to a total [s].
class Stopwatch {
 public:
    explicit Stopwatch(double& total) : total_(total) {}
    ~Stopwatch() {
        total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;

 private:
    double& total_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class StepWatch {
 public:
    void begin(const Window& window) { window_ = window.index; }

    /// Throws what `work` throws: OpenFOAM's errors as Failure, PhysicsRefused with the name of the
    /// step.
    template <class Work>
    auto play(const std::string& step, double& clock, Work work) const {
        const Stopwatch watch(clock);
        try {
            return with_foam_errors(named(step), work);
        } catch (const PhysicsRefused& refused) {
            refuse(step, refused.what());
        }
    }

    [[noreturn]] void refuse(const std::string& step, const std::string& why) const {
        throw PhysicsRefused(named(step) + ": " + why);
    }

 private:
    std::string named(const std::string& step) const {
        return step + " of window " + std::to_string(window_);
    }

    std::int64_t window_ = 0;
};

}  // namespace turbidite
