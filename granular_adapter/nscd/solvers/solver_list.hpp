// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every contact solver by name: the lines of names/solver_table.def.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

using MakeSolver = std::unique_ptr<const ContactSolver>();

#define TURBIDITE_SOLVER(name, description, make) MakeSolver make;
#include "granular_adapter/nscd/names/solver_table.def"
#undef TURBIDITE_SOLVER

struct SolverEntry {
    std::string name;
    std::string description;
    MakeSolver* make;
};

/// The table in which names are looked up; a caller with solvers of its own passes a longer one.
using SolverList = std::span<const SolverEntry>;
SolverList solver_list();

/// Throws std::invalid_argument listing the known solvers.
std::unique_ptr<const ContactSolver> make_solver(const std::string& name,
                                                 SolverList solvers = solver_list());

}  // namespace turbidite::nscd
