// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact problems in the files of FCLIB (HDF5), a collection of friction problems that other codes
// read. Only tests and benchmarks link this.
#pragma once

#include <filesystem>

#include "bench/siconos/local_problem.hpp"

namespace turbidite::siconos {

/// Throws std::runtime_error if the file exists or cannot be written.
void write_fclib(const std::filesystem::path& file, const LocalProblem& problem,
                 const std::string& title);

/// Throws std::runtime_error if there is no such file, or no problem in it; and for problems with
/// equality constraints or with W in another form than compressed columns, which write_fclib never
/// writes.
LocalProblem read_fclib(const std::filesystem::path& file);

/// FCLIB's own measure of a solution, its first merit function. Throws std::runtime_error in the
/// plane, where FCLIB has none.
double fclib_merit(const std::filesystem::path& file, std::vector<double> velocities,
                   std::vector<double> impulses);

}  // namespace turbidite::siconos
