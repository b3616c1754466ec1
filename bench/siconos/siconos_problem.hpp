// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact problem in Siconos: access to its solvers and its error measure. Only tests and
// benchmarks link this.
//
// Siconos' measure adds impulses and velocities, so the problem is made dimensionless first, with
// masses scaled by `mass` and velocities by `speed`. Vectors here are dimensionless, (n, t) of all
// contacts in order.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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
    /// Passes the problem through the text file of nscd/problem/plane/problem_file.hpp, which
    /// Siconos reads.
    Problem(const nscd::ContactProblem& problem, const Scale& scale);
    /// Reads a problem from a file of Siconos.
    explicit Problem(const std::filesystem::path& file);
    ~Problem();
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;

    int contacts() const;

    /// fc2d_compute_error of these impulses, relative to the largest norm of q, r and u; stores W r
    /// + q in `velocities` if given.
    double error(std::vector<double> impulses, std::vector<double>* velocities = nullptr) const;

    /// W as n rows of n entries; for small problems.
    std::vector<double> dense_matrix() const;
    const double* q() const;  ///< H^T v_free + b, 2 contacts() values
    const double* friction() const;

    /// fc2d_driver from zero impulses. `solver`: "nsgs" (any size), "lemke" or "cpg" (dense, small
    /// problems).
    Solution solve(const std::string& solver, double tolerance, int most_iterations) const;

 private:
    std::unique_ptr<FrictionContactProblem, void (*)(FrictionContactProblem*)> problem_;
};

/// Impulses [N s] as the dimensionless vector, and the inverse.
std::vector<double> flat(const nscd::Impulses& impulses, const Scale& scale);
nscd::Impulses impulses_of(const std::vector<double>& flat, const Scale& scale);

}  // namespace turbidite::siconos
