// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/siconos/fclib_file.hpp"

// The header is C, without extern "C".
extern "C" {
#include <fclib.h>
}

#include <memory>
#include <stdexcept>

namespace turbidite::siconos {
namespace {

constexpr int compressed_columns = -1;

using Read = std::unique_ptr<fclib_local, void (*)(fclib_local*)>;

Read read(const std::filesystem::path& file) {
    // FCLIB ends the program at files that do not exist.
    if (!std::filesystem::is_regular_file(file))
        throw std::runtime_error("there is no file " + file.string());
    Read problem(fclib_read_local(file.c_str()), [](fclib_local* p) {
        fclib_delete_local(p);
        ::free(p);
    });
    if (!problem || !problem->W)
        throw std::runtime_error(file.string() + " holds no local problem of FCLIB");
    return problem;
}

}  // namespace

void write_fclib(const std::filesystem::path& file, const LocalProblem& problem,
                 const std::string& title) {
    if (std::filesystem::exists(file))
        throw std::runtime_error(file.string() + " exists: choose another name, or remove it");
    // FCLIB only reads what it writes, but takes pointers to what it could change.
    LocalProblem copy = problem;
    std::string name = title, description = "u = W r + q, Signorini-Coulomb", none = "unknown";
    fclib_info info{name.data(), description.data(), none.data()};
    const auto n = static_cast<int>(copy.q.size());
    fclib_matrix w{};
    w.nzmax = static_cast<int>(copy.value.size());
    w.m = w.n = n;
    w.p = copy.column_start.data(), w.i = copy.row.data(), w.x = copy.value.data();
    w.nz = compressed_columns;
    fclib_local local{};
    local.W = &w;
    local.mu = copy.friction.data(), local.q = copy.q.data();
    local.spacedim = copy.dimension;
    local.info = &info;
    if (fclib_write_local(&local, file.c_str()) != 1)
        throw std::runtime_error(file.string() + " cannot be written");
}

LocalProblem read_fclib(const std::filesystem::path& file) {
    const Read local = read(file);
    const fclib_matrix& w = *local->W;
    if (local->V || local->R) throw std::runtime_error(file.string() + " has equality constraints");
    if (w.nz != compressed_columns)
        throw std::runtime_error(file.string() +
                                 " holds W in another form than compressed columns");
    LocalProblem problem;
    problem.dimension = local->spacedim;
    problem.column_start.assign(w.p, w.p + w.n + 1);
    problem.row.assign(w.i, w.i + w.nzmax);
    problem.value.assign(w.x, w.x + w.nzmax);
    problem.q.assign(local->q, local->q + w.n);
    problem.friction.assign(local->mu, local->mu + w.n / local->spacedim);
    return problem;
}

double fclib_merit(const std::filesystem::path& file, std::vector<double> velocities,
                   std::vector<double> impulses) {
    const Read local = read(file);
    // FCLIB 3.1 prints a sentence and returns zero.
    if (local->spacedim != 3) throw std::runtime_error("FCLIB has a measure in space only");
    fclib_solution solution{};
    solution.u = velocities.data(), solution.r = impulses.data();
    return fclib_merit_local(local.get(), MERIT_1, &solution);
}

}  // namespace turbidite::siconos
