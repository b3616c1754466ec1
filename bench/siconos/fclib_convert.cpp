// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-bench-fclib: writes a contact problem that a run has left in Siconos' text format
// (contact.dump_interval) as a file of FCLIB, and reads it back.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <stdexcept>

#include "bench/siconos/fclib_file.hpp"
#include "bench/siconos/siconos_problem.hpp"

namespace turbidite::siconos {
namespace {

/// The same problem in units of these.
LocalProblem scaled(LocalProblem problem, const Scale& scale) {
    for (double& w : problem.value) w *= scale.mass;
    for (double& q : problem.q) q /= scale.speed;
    return problem;
}

void convert(const std::string& from, const std::string& to, const Scale& scale) {
    const LocalProblem problem = scaled(Problem(std::filesystem::path(from)).local(), scale);
    write_fclib(to, problem, "Turbidite, " + std::filesystem::path(from).filename().string());
    if (read_fclib(to) != problem) throw std::runtime_error(to + " does not hold what was written");
    std::printf("%s: %zu contacts of %d components, %zu entries of W, read back alike\n",
                to.c_str(), problem.friction.size(), problem.dimension, problem.value.size());
}

}  // namespace
}  // namespace turbidite::siconos

int main(int argc, char** argv) {
    std::string from, to;
    turbidite::siconos::Scale scale;
    CLI::App app{"A contact problem of a run as a file of FCLIB", "turbidite-bench-fclib"};
    app.add_option("problem", from, "contacts/problem_STEP.dat of a run")->required();
    app.add_option("file", to, "HDF5 file to write")->required();
    app.add_option("--mass", scale.mass, "W is multiplied by this mass, such as that of a grain");
    app.add_option("--speed", scale.speed, "q is divided by this speed, such as g dt");
    CLI11_PARSE(app, argc, argv);
    try {
        turbidite::siconos::convert(from, to, scale);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-fclib: %s\n", error.what());
        return 1;
    }
    return 0;
}
