// SPDX-License-Identifier: LGPL-2.1-or-later
//
// probes.csv: pressure and velocity of the fluid at the points of output.probes, one row per output
// interval, dimensionless like history.csv. The file is created with its first row; without probes
// there is none.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "coupler/protocol/run_values.hpp"

namespace turbidite {

class ProbeSeries {
 public:
    /// In the run folder.
    static constexpr const char* file_name = "probes.csv";

    ProbeSeries(std::filesystem::path file, const RunValues& run)
        : file_(std::move(file)), run_(run) {}

    /// Goes on with the file of an earlier part of the run.
    void resume(std::int64_t length);

    const std::filesystem::path& file() const { return file_; }

    /// Bytes written so far; -1: there is no file.
    std::int64_t length();

    /// `values`: p/rho_f [m2/s2], u, v, in space w [m/s] at each point. Throws Failure when the
    /// disk is full.
    void append(double time, const std::vector<double>& values);

 private:
    void begin(std::size_t points);

    std::filesystem::path file_;
    RunValues run_;
    std::ofstream out_;
};

}  // namespace turbidite
