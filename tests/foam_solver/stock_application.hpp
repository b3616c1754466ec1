// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenFOAM's own programs on a small box, with the library under test named in `libs`.
#pragma once

#include <cmath>
#include <regex>

#include "tests/foam_solver/foam_box.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {

class StockApplication : public ShellTest {
 protected:
    static constexpr const char* libs = "libs (\"" TURBIDITE_FFT_LIBRARY "\");";

    Answer foam(const std::string& command) const {
        return shell("export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}; " + command);
    }

    /// Of the box as it is written; a box that has its mesh already keeps it.
    void make_mesh() const {
        const std::string box = text(scratch.path() / "system/blockMeshDict");
        if (box == meshed_) return;
        const Answer mesh = foam("blockMesh");
        ASSERT_EQ(mesh.code, 0) << mesh.out << mesh.err;
        meshed_ = box;
    }

    Answer run(const std::string& application) const {
        const Answer answer = foam(application);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        return answer;
    }

    static std::string on_ranks(int ranks, const std::string& application) {
        return "mpirun --allow-run-as-root --oversubscribe -n " + std::to_string(ranks) + " " +
               application + " -parallel";
    }

    /// Runs the application; on several ranks its output is reconstructed.
    Answer run(int ranks, const std::string& application) const {
        if (ranks == 1) return run(application);
        run("decomposePar -force");
        const Answer answer = run(on_ranks(ranks, application));
        run("reconstructPar -withZero");
        return answer;
    }

    std::vector<double> field(const std::string& name) const {
        return read_field(scratch.path() / name);
    }

    static double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
        EXPECT_EQ(a.size(), b.size());
        double largest = 0.0;
        for (std::size_t c = 0; c < a.size() && c < b.size(); ++c)
            largest = std::max(largest, std::abs(a[c] - b[c]));
        return largest;
    }

    /// The iterations of every solve of a field, from the log.
    static std::vector<int> iterations(const std::string& log, const std::string& field) {
        const std::regex line("Solving for " + field + ", .*No Iterations ([0-9]+)");
        std::vector<int> found;
        for (std::sregex_iterator at(log.begin(), log.end(), line), end; at != end; ++at)
            found.push_back(std::stoi((*at)[1]));
        return found;
    }

    static int most_iterations(const std::string& log, const std::string& field) {
        const std::vector<int> found = iterations(log, field);
        EXPECT_FALSE(found.empty()) << log;
        return found.empty() ? -1 : *std::max_element(found.begin(), found.end());
    }

    /// Largest final residual of a field's solves.
    static double worst_residual(const std::string& log, const std::string& field) {
        const std::regex line("Solving for " + field + ", .*Final residual = ([^,]+),");
        double worst = -1.0;
        for (std::sregex_iterator at(log.begin(), log.end(), line), end; at != end; ++at)
            worst = std::max(worst, std::stod((*at)[1]));
        return worst;
    }

    static std::string solver_of(const std::string& field, const std::string& entries) {
        return "solvers { " + field + " { " + entries + " } }\nSIMPLE {}\n";
    }

 private:
    mutable std::string meshed_;  // the box whose mesh is in the folder
};

}  // namespace turbidite
