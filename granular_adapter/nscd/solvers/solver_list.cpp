// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/solver_list.hpp"

#include <stdexcept>

#include "granular_adapter/nscd/solvers/central_path_solver.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "granular_adapter/nscd/solvers/nlgs_stored.hpp"

namespace turbidite::nscd {
namespace {

template <class Solver>
std::unique_ptr<const ContactSolver> make() {
    return std::make_unique<Solver>();
}

}  // namespace

const std::vector<SolverEntry>& solver_list() {
    static const std::vector<SolverEntry> solvers = {
        {"nlgs", "non-linear Gauss-Seidel on body velocities", make<Nlgs>},
        {"nlgs-stored", "the same on the assembled Delassus operator", make<NlgsStored>},
        {"central-path", "path following with a sparse factorisation, for tight tolerances",
         make<CentralPathSolver>},
    };
    return solvers;
}

std::unique_ptr<const ContactSolver> make_solver(const std::string& name) {
    std::string known;
    for (const SolverEntry& entry : solver_list()) {
        if (entry.name == name) return entry.make();
        known += (known.empty() ? "" : ", ") + entry.name;
    }
    throw std::invalid_argument("unknown contact solver \"" + name + "\"; known: " + known);
}

}  // namespace turbidite::nscd
