// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Clocks of tests that nothing hangs. They bound a wait, not a speed.
#pragma once

#include <chrono>

namespace turbidite {

constexpr double longest = 10.0;  ///< [s] from the end of a program to the end of the job
constexpr double longest_with_report = 30.0;  ///< and with the report that follows

class Stopwatch {
 public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

 private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace turbidite
