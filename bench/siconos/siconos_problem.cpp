// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/siconos/siconos_problem.hpp"

// The headers are C.
#define restrict __restrict__
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <fc2d_compute_error.h>
#undef restrict

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/problem_file.hpp"

namespace turbidite::siconos {
namespace {

double norm(const double* x, std::size_t n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i] * x[i];
    return std::sqrt(sum);
}

/// A temporary file, removed at the end. Siconos crashes on names without ".dat".
class PassingFile {
 public:
    explicit PassingFile(const nscd::ContactProblem& problem) {
        std::string name = (std::filesystem::temp_directory_path() / "problem-XXXXXX.dat").string();
        const int descriptor = ::mkstemps(name.data(), 4);
        if (descriptor < 0) throw std::runtime_error("no temporary file " + name);
        ::close(descriptor);
        path_ = name;
        std::ofstream stream(path_);
        nscd::write_problem(stream, problem);
        if (!stream.flush()) throw std::runtime_error(name + " cannot be written");
    }
    ~PassingFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

FrictionContactProblem* read(const std::filesystem::path& file) {
    if (file.extension() != ".dat")
        throw std::invalid_argument("Siconos reads files *.dat, not " + file.string());
    FrictionContactProblem* problem = frictionContact_new_from_filename(file.c_str());
    if (!problem) throw std::runtime_error("Siconos cannot read " + file.string());
    return problem;
}

int solver_id(const std::string& name) {
    if (name == "nsgs") return SICONOS_FRICTION_2D_NSGS;
    if (name == "cpg") return SICONOS_FRICTION_2D_CPG;
    if (name == "lemke") return SICONOS_FRICTION_2D_LEMKE;
    throw std::invalid_argument("no Siconos solver \"" + name + "\"");
}

}  // namespace

nscd::ContactProblem dimensionless(const nscd::ContactProblem& problem, const Scale& scale) {
    nscd::ContactProblem result = problem;
    for (nscd::PlanarTensor& m : std::get<std::vector<nscd::PlanarTensor>>(result.bodies))
        for (double* entry : {&m.xx, &m.yy, &m.ss, &m.xy, &m.xs, &m.ys}) *entry *= scale.mass;
    const auto shrink = [&](Vec3& v) {
        for (double& x : v) x /= scale.speed;
    };
    for (Twist& twist : result.free) shrink(twist.velocity), shrink(twist.spin);
    for (nscd::Contact& contact : result.contacts)
        contact.bias = (1.0 / scale.speed) * contact.bias;
    return result;
}

Problem::Problem(const nscd::ContactProblem& problem, const Scale& scale)
    : Problem(PassingFile(dimensionless(problem, scale)).path()) {}

Problem::Problem(const std::filesystem::path& file)
    : problem_(read(file), frictionContactProblem_free) {}

Problem::~Problem() = default;

int Problem::contacts() const {
    return problem_->numberOfContacts;
}
const double* Problem::q() const {
    return problem_->q;
}
const double* Problem::friction() const {
    return problem_->mu;
}

double Problem::error(std::vector<double> impulses, std::vector<double>* velocities) const {
    const std::size_t n = impulses.size();
    std::vector<double> u(n);
    double error = 0.0;
    fc2d_compute_error(problem_.get(), impulses.data(), u.data(), 0.0, norm(problem_->q, n),
                       &error);
    if (velocities) *velocities = std::move(u);
    return error;
}

std::vector<double> Problem::dense_matrix() const {
    const auto n = static_cast<std::size_t>(2 * contacts());
    std::vector<double> matrix(n * n);
    SBM_to_dense(problem_->M->matrix1, matrix.data());
    return matrix;
}

Solution Problem::solve(const std::string& solver, double tolerance, int most_iterations) const {
    const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options(
        solver_options_create(solver_id(solver)), solver_options_delete);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = most_iterations;
    Solution solution;
    solution.impulses.assign(2 * static_cast<std::size_t>(contacts()), 0.0);
    solution.velocities = solution.impulses;
    const auto start = std::chrono::steady_clock::now();
    const int info = fc2d_driver(problem_.get(), solution.impulses.data(),
                                 solution.velocities.data(), options.get());
    solution.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    solution.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    solution.converged = info == 0;
    return solution;
}

std::vector<double> flat(const nscd::Impulses& impulses, const Scale& scale) {
    std::vector<double> result;
    for (const nscd::ContactVector& r : impulses)
        for (const double x : {r.n, r.t}) result.push_back(x / (scale.mass * scale.speed));
    return result;
}

nscd::Impulses impulses_of(const std::vector<double>& flat, const Scale& scale) {
    nscd::Impulses result(flat.size() / 2);
    const double unit = scale.mass * scale.speed;
    for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = nscd::in_plane(flat[2 * k] * unit, flat[2 * k + 1] * unit);
    return result;
}

}  // namespace turbidite::siconos
