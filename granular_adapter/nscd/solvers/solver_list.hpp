// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every contact solver there is, by name. A new solver: one file pair, one line in solver_list.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

struct SolverEntry {
    std::string name;
    std::string description;
    std::unique_ptr<const ContactSolver> (*make)();
};
const std::vector<SolverEntry>& solver_list();

/// Throws std::invalid_argument that lists the known solvers.
std::unique_ptr<const ContactSolver> make_solver(const std::string& name);

}  // namespace turbidite::nscd
