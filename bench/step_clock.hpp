// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Times the steps of one contender inside its own process, and leaves the result as a small JSON
// file for the benchmark that started it.
//
// Comparisons on one core use processor time, which does not count what other programs of the
// machine take; only comparisons between numbers of ranks, which wait for each other, use wall
// time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace turbidite::bench {

double processor_seconds();  ///< of this process
double wall_seconds();

/// Middle value; of an even number the mean of the two. Throws std::invalid_argument when empty.
double median(std::vector<double> values);

/// Resident memory of this process now [bytes] (VmRSS).
double resident_bytes();

class StepClock {
 public:
    void start();
    void stop();  ///< ends a step

    // What lies between these two does not count.
    void pause();
    void resume();

    double processor() const { return median(processor_); }
    double wall() const { return median(wall_); }
    double processor_sum() const;
    double wall_sum() const;

 private:
    double processor_start_ = 0.0, wall_start_ = 0.0;
    double processor_so_far_ = 0.0, wall_so_far_ = 0.0;  // of a step that was paused
    bool runs_ = false;
    std::vector<double> processor_, wall_;
};

/// What a contender reports: medians over its timed steps.
struct Sample {
    double processor = 0.0;                ///< per step [s]
    double wall = 0.0;                     ///< per step [s]
    double resident = 0.0;                 ///< after the last step [bytes]
    double arrays = 0.0;                   ///< the array code: its arrays [bytes]
    std::map<std::string, double> parts;   ///< of a step, wall [s]
    std::map<std::string, double> counts;  ///< what was done, by name
};

/// Throw Failure naming the file.
void write_sample(const Sample& sample, const std::filesystem::path& file);
Sample read_sample(const std::filesystem::path& file);

}  // namespace turbidite::bench
