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
#include <fc3d_compute_error.h>
#undef restrict

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "granular_adapter/nscd/problem/problem_file.hpp"

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

/// Memory that Siconos will free.
double* given_away(const std::vector<double>& values) {
    auto* copy = static_cast<double*>(std::malloc(values.size() * sizeof(double)));
    std::copy(values.begin(), values.end(), copy);
    return copy;
}

FrictionContactProblem* made_of(const LocalProblem& problem) {
    const auto n = static_cast<int>(problem.q.size());
    NumericsMatrix* w = NM_create(NM_SPARSE, n, n);
    NM_triplet_alloc(w, static_cast<CS_INT>(problem.value.size()));
    for (int j = 0; j < n; ++j)
        for (int e = problem.column_start[j]; e < problem.column_start[j + 1]; ++e)
            NM_entry(w, problem.row[e], j, problem.value[e]);
    return frictionContactProblem_new_with_data(problem.dimension, n / problem.dimension, w,
                                                given_away(problem.q),
                                                given_away(problem.friction));
}

/// A solver of Siconos, and for Gauss-Seidel the solver of one contact, 0: its default, and the
/// number of sweeps that leave out a contact without impulse.
struct Entry {
    int dimension;
    std::string name;
    int id;
    int one_contact = 0;
    int frozen = 0;
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> list = {
        {2, "nsgs", SICONOS_FRICTION_2D_NSGS},
        {2, "cpg", SICONOS_FRICTION_2D_CPG},
        {2, "lemke", SICONOS_FRICTION_2D_LEMKE},
        {3, "nsgs", SICONOS_FRICTION_3D_NSGS},
        {3, "nsgs-newton", SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_ONECONTACT_NSN},
        {3, "nsgs-newton-frozen", SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_ONECONTACT_NSN, 10},
        {3, "nsgs-projection", SICONOS_FRICTION_3D_NSGS,
         SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnCone},
        {3, "nsgs-iterated-projection", SICONOS_FRICTION_3D_NSGS,
         SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnConeWithLocalIteration},
        {3, "nsgs-quartic", SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_ONECONTACT_QUARTIC},
        {3, "newton", SICONOS_FRICTION_3D_NSN_AC},
        {3, "admm", SICONOS_FRICTION_3D_ADMM},
    };
    return list;
}

using Options = std::unique_ptr<SolverOptions, void (*)(SolverOptions*)>;

Options options_of(const std::string& solver, int dimension) {
    for (const Entry& entry : entries()) {
        if (entry.name != solver || entry.dimension != dimension) continue;
        Options options(solver_options_create(entry.id), solver_options_delete);
        if (entry.one_contact != 0)
            solver_options_update_internal(options.get(), 0, entry.one_contact);
        if (entry.frozen != 0)
            options->iparam[SICONOS_FRICTION_3D_NSGS_FREEZING_CONTACT] = entry.frozen;
        return options;
    }
    throw std::invalid_argument("no Siconos solver \"" + solver + "\" in dimension " +
                                std::to_string(dimension));
}

void multiply(nscd::PlanarTensor& m, double factor) {
    for (double* entry : {&m.xx, &m.yy, &m.ss, &m.xy, &m.xs, &m.ys}) *entry *= factor;
}

void multiply(nscd::SpaceMobility& m, double factor) {
    m.linear *= factor, m.angular *= factor;
}

}  // namespace

nscd::ContactProblem dimensionless(const nscd::ContactProblem& problem, const Scale& scale) {
    nscd::ContactProblem result = problem;
    std::visit(
        [&](auto& bodies) {
            for (auto& m : bodies) multiply(m, scale.mass);
        },
        result.bodies);
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

Problem::Problem(const LocalProblem& problem)
    : problem_(made_of(problem), frictionContactProblem_free) {}

Problem::~Problem() = default;

int Problem::dimension() const {
    return problem_->dimension;
}
int Problem::contacts() const {
    return problem_->numberOfContacts;
}
std::size_t Problem::size() const {
    return static_cast<std::size_t>(dimension()) * static_cast<std::size_t>(contacts());
}
const double* Problem::q() const {
    return problem_->q;
}
const double* Problem::friction() const {
    return problem_->mu;
}

double Problem::error(std::vector<double> impulses, std::vector<double>* velocities) const {
    std::vector<double> u(size());
    double error = 0.0;
    const double size_q = norm(problem_->q, size());
    if (dimension() == 2)
        fc2d_compute_error(problem_.get(), impulses.data(), u.data(), 0.0, size_q, &error);
    else
        fc3d_compute_error(problem_.get(), impulses.data(), u.data(), 0.0, nullptr, size_q, &error);
    if (velocities) *velocities = std::move(u);
    return error;
}

LocalProblem Problem::local() const {
    if (problem_->M->storageType != NM_SPARSE_BLOCK)
        throw std::logic_error("only problems read from text files are given out");
    const SparseBlockStructuredMatrix& w = *problem_->M->matrix1;
    const auto d = static_cast<std::size_t>(dimension());
    // By column, in the order of the rows.
    std::vector<std::vector<std::pair<int, double>>> columns(size());
    for (std::size_t k = 0; k + 1 < w.filled1; ++k)
        for (std::size_t e = w.index1_data[k]; e < w.index1_data[k + 1]; ++e)
            for (std::size_t entry = 0; entry < d * d; ++entry)
                columns[d * w.index2_data[e] + entry / d].emplace_back(d * k + entry % d,
                                                                       w.block[e][entry]);
    LocalProblem problem;
    problem.dimension = dimension();
    problem.column_start.push_back(0);
    for (const auto& column : columns) {
        for (const auto& [row, value] : column)
            problem.row.push_back(row), problem.value.push_back(value);
        problem.column_start.push_back(static_cast<int>(problem.row.size()));
    }
    problem.q.assign(q(), q() + size());
    problem.friction.assign(friction(), friction() + contacts());
    return problem;
}

std::vector<double> Problem::dense_matrix() const {
    std::vector<double> matrix(size() * size());
    SBM_to_dense(problem_->M->matrix1, matrix.data());
    return matrix;
}

Solution Problem::solve(const std::string& solver, double tolerance, int most_iterations) const {
    const Options options = options_of(solver, dimension());
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = most_iterations;
    Solution solution;
    solution.impulses.assign(size(), 0.0);
    solution.velocities = solution.impulses;
    const auto start = std::chrono::steady_clock::now();
    const int info = (dimension() == 2 ? fc2d_driver : fc3d_driver)(
        problem_.get(), solution.impulses.data(), solution.velocities.data(), options.get());
    solution.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    solution.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    solution.converged = info == 0;
    return solution;
}

std::vector<std::string> solver_names(int dimension) {
    std::vector<std::string> names;
    for (const Entry& entry : entries())
        if (entry.dimension == dimension) names.push_back(entry.name);
    return names;
}

std::vector<double> flat(const nscd::Impulses& impulses, int dimension) {
    std::vector<double> result;
    for (const nscd::ContactVector& r : impulses) {
        result.insert(result.end(), {r.n, r.t});
        if (dimension == 3) result.push_back(r.s);
    }
    return result;
}

nscd::Impulses impulses_of(const std::vector<double>& flat, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    nscd::Impulses result(flat.size() / d);
    for (std::size_t k = 0; k < result.size(); ++k) {
        const double* r = &flat[d * k];
        result[k] = {r[0], r[1], d == 3 ? r[2] : 0.0, 0.0};
    }
    return result;
}

}  // namespace turbidite::siconos
