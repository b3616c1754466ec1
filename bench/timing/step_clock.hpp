// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Times the steps of one contender inside its own process, and writes the result to a small JSON
// file for the benchmark that started it.
//
// Comparisons on one core use processor time, which excludes the time of other programs on the
// machine. Only comparisons between different numbers of ranks, which wait for each other, use wall
// time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace turbidite::bench {

double processor_seconds();  ///< of this process [s]
double wall_seconds();       ///< of the monotonic clock [s]

/// Median; the mean of the two middle values if their number is even. Throws std::invalid_argument
/// if empty.
double median(std::vector<double> values);

/// Present resident memory of this process [bytes] (VmRSS).
double resident_bytes();

class StepClock {
 public:
    void start();
    void stop();  ///< ends a step

    // The time between these two calls is not counted.
    void pause();
    void resume();

    double processor() const { return median(processor_); }
    double wall() const { return median(wall_); }
    /// Sums over the timed steps [s].
    double processor_sum() const;
    double wall_sum() const;

 private:
    double processor_start_ = 0.0, wall_start_ = 0.0;
    double processor_so_far_ = 0.0, wall_so_far_ = 0.0;  // of a step interrupted by pause()
    bool runs_ = false;
    std::vector<double> processor_, wall_;
};

/// The result of a contender: medians over its timed steps.
struct Sample {
    double processor = 0.0;                ///< per step [s]
    double wall = 0.0;                     ///< per step [s]
    double resident = 0.0;                 ///< after the last step [bytes]
    double arrays = 0.0;                   ///< the array code: its arrays [bytes]
    std::map<std::string, double> parts;   ///< of a step, wall [s]
    std::map<std::string, double> counts;  ///< of operations, by name
};

/// Throw Failure naming the file.
void write_sample(const Sample& sample, const std::filesystem::path& file);
Sample read_sample(const std::filesystem::path& file);

}  // namespace turbidite::bench
