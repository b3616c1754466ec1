// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/solver_list.hpp"

#include <stdexcept>
#include <vector>

namespace turbidite::nscd {

SolverList solver_list() {
    static const std::vector<SolverEntry> solvers = {
#define TURBIDITE_SOLVER(name, description, make) {name, description, make},
#include "granular_adapter/nscd/names/solver_table.def"
#undef TURBIDITE_SOLVER
    };
    return solvers;
}

std::unique_ptr<const ContactSolver> make_solver(const std::string& name, SolverList solvers) {
    std::string known;
    for (const SolverEntry& entry : solvers) {
        if (entry.name == name) return entry.make();
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw std::invalid_argument("unknown contact solver \"" + name + "\"; known: " + known);
}

}  // namespace turbidite::nscd
