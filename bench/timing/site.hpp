// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The working place of a benchmark: a temporary folder, removed at the end, with the prepared
// cases; and the programs it starts. Every contender is a process of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/timing/figure.hpp"
#include "bench/timing/step_clock.hpp"
#include "launcher/job/folder/temporary_folder.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite::bench {

class Site {
 public:
    /// `quick`: tiny meshes. Throws Failure if the folder cannot be made.
    explicit Site(bool quick);

    bool quick() const { return quick_; }  ///< tiny meshes, to test that everything works
    const Programs& programs() const { return programs_; }
    const std::filesystem::path& folder() const { return folder_.path(); }
    /// Path of a file in this folder, bench/.
    std::filesystem::path source(const std::string& file) const;

    /// Runs a program to its end, with its output in the folder's file `log`. Throws Failure with
    /// the end of the log if the program fails.
    void run(const std::vector<std::string>& line, const std::string& log) const;

    /// The same; returns the largest resident memory that it or any program it waited for had
    /// [bytes].
    double peak_memory_of(const std::vector<std::string>& line, const std::string& log) const;

    /// The contents of a log in the folder.
    std::string text(const std::string& log) const;

 private:
    void demand_success(const std::string& program, int status, const std::string& log) const;

    bool quick_;
    Programs programs_;
    TemporaryFolder folder_;
};

using Contender = std::function<Sample()>;

/// Samples of two contenders in turns, A B A B …, so that the state of the machine is the same for
/// both.
struct Duel {
    std::vector<Sample> first, second;
};
/// Runs the contenders in turns, `repeats` times each.
Duel alternate(int repeats, const Contender& first, const Contender& second);

using Quantity = std::function<double(const Sample&)>;
double median_of(const std::vector<Sample>& samples, const Quantity& quantity);

/// Ratio of the medians, first over second, with the spread of the ratios of the turns.
Measured ratio(const Duel& duel, const Quantity& quantity);

}  // namespace turbidite::bench
