// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact problem in Siconos: access to its solvers and its error measure. Only tests and
// benchmarks link this.
//
// Siconos' measure adds impulses and velocities, so the problem is made dimensionless first, with
// masses scaled by `mass` and velocities by `speed`. Vectors here are dimensionless, the components
// of all contacts in order: (n, t) in the plane (fc2d), (n, t, s) in space (fc3d).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/siconos/local_problem.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"

struct FrictionContactProblem;

namespace turbidite::siconos {

struct Scale {
    double mass = 1.0;   ///< [kg]
    double speed = 1.0;  ///< [m/s]; for packings at rest h g
};

/// The same problem in dimensionless numbers.
nscd::ContactProblem dimensionless(const nscd::ContactProblem& problem, const Scale& scale);

struct Solution {
    std::vector<double> impulses, velocities;
    int iterations = 0;
    bool converged = false;
    double seconds = 0.0;
};

class Problem {
 public:
    /// Passes the problem through the text file of nscd/problem/problem_file.hpp, which Siconos
    /// reads.
    Problem(const nscd::ContactProblem& problem, const Scale& scale);
    /// Reads a problem from a file of Siconos.
    explicit Problem(const std::filesystem::path& file);
    explicit Problem(const LocalProblem& problem);
    ~Problem();
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;

    int dimension() const;  ///< components per contact: 2 or 3
    int contacts() const;
    std::size_t size() const;  ///< dimension() contacts()

    /// fc2d_compute_error or fc3d_compute_error of these impulses, relative to the largest norm of
    /// q, r and u; stores W r
    /// + q in `velocities` if given.
    double error(std::vector<double> impulses, std::vector<double>* velocities = nullptr) const;

    /// W with all entries of its blocks, zeros too. Of problems read from text files.
    LocalProblem local() const;
    /// W as size() columns of size() entries; for small problems.
    std::vector<double> dense_matrix() const;
    const double* q() const;         ///< H^T v_free + b, size() values
    const double* friction() const;  ///< contacts() values

    /// fc2d_driver or fc3d_driver from zero impulses. `solver`: one of solver_names().
    Solution solve(const std::string& solver, double tolerance, int most_iterations) const;

 private:
    std::unique_ptr<FrictionContactProblem, void (*)(FrictionContactProblem*)> problem_;
};

/// Solvers by name; lemke and cpg of the plane are dense, for small problems.
std::vector<std::string> solver_names(int dimension);

/// Impulses of a dimensionless problem as a vector, and the inverse.
std::vector<double> flat(const nscd::Impulses& impulses, int dimension);
nscd::Impulses impulses_of(const std::vector<double>& flat, int dimension);

}  // namespace turbidite::siconos
