// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs the steps of a window under their names: measures their time, and adds step and window to
// the errors they throw.
#pragma once

#include <chrono>
#include <string>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"

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
    explicit StepWatch(const FluidStore& store) : store_(store) {}

    void begin(const Window& window) { window_ = window.index; }

    /// Throws what `work` throws: errors of the store's program as Failure, PhysicsRefused with the
    /// name of the step.
    template <class Work>
    void play(const std::string& step, double& clock, Work work) const {
        const Stopwatch watch(clock);
        try {
            store_.guard(named(step), work);
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

    const FluidStore& store_;
    std::int64_t window_ = 0;
};

}  // namespace turbidite
