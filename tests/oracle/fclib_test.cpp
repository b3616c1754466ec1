// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contact problems in files of FCLIB, so that others can check ours: the file holds the same
// numbers, Siconos' measure of what was read is the same, and FCLIB's own measure tells a solution
// from what is none.
#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/contact/dense_packing.hpp"
#include "bench/siconos/fclib_file.hpp"
#include "each_other.hpp"
#include "problems.hpp"

namespace turbidite {
namespace {

using namespace judged;

/// A file that is removed at the end.
struct PassingFile {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                       ("fclib-" + std::to_string(::getpid()) + ".hdf5");

    PassingFile() { std::filesystem::remove(path); }
    ~PassingFile() { std::filesystem::remove(path); }
};

nscd::ContactProblem loose_spheres() {
    std::vector<Named> list;
    take_problems("loose",
                  bench::dense_spheres({.width = 4.0, .shrink = 0.2, .agitation = 0.5}, {}), 0.01,
                  {2.0}, list);
    return list.front().problem;
}

/// Writes, reads and measures a problem of ours.
void pass_through_a_file(const nscd::ContactProblem& problem) {
    const PassingFile file;
    const siconos::Problem written(problem, {});
    const siconos::LocalProblem local = written.local();
    siconos::write_fclib(file.path, local, "test");
    const siconos::LocalProblem read = siconos::read_fclib(file.path);
    EXPECT_EQ(read.dimension, written.dimension());
    EXPECT_TRUE(read == local);

    const nscd::SolverResult solved = ours("nlgs", problem, 1e-6);
    ASSERT_TRUE(solved.converged);
    std::vector<double> r = siconos::flat(solved.impulses, read.dimension), u;
    const siconos::Problem again(read);
    const double error = written.error(r, &u);
    EXPECT_GT(norm(r), 0.0);
    EXPECT_LT(error, 1e-6);
    EXPECT_NEAR(again.error(r), error, 1e-6 * error);

    if (read.dimension == 2) {
        EXPECT_THROW(siconos::fclib_merit(file.path, u, r), std::runtime_error);
        return;
    }
    const double merit = siconos::fclib_merit(file.path, u, r);
    EXPECT_LT(merit, 1e-5);
    for (double& impulse : r) impulse *= 1.5;
    written.error(r, &u);
    EXPECT_GT(siconos::fclib_merit(file.path, u, r), 1e3 * merit);
}

TEST(Fclib, PassesProblemsOfSpheresOn) {
    const nscd::ContactProblem problem = loose_spheres();
    EXPECT_GT(problem.contacts.size(), 200u);
    pass_through_a_file(problem);
}

TEST(Fclib, PassesProblemsOfThePlaneOn) {
    pass_through_a_file(nscd::problems::random_problem({.bodies = 15, .friction = 0.6}));
}

TEST(Fclib, OverwritesNothingAndReadsNoOtherFile) {
    const PassingFile file;
    EXPECT_THROW(siconos::read_fclib(file.path), std::runtime_error);
    const siconos::Problem problem(nscd::problems::random_problem({}), {});
    siconos::write_fclib(file.path, problem.local(), "test");
    EXPECT_THROW(siconos::write_fclib(file.path, problem.local(), "test"), std::runtime_error);
}

}  // namespace
}  // namespace turbidite
