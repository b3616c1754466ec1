// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/nlgs.hpp"

#include "granular_adapter/nscd/solvers/nlgs_iteration.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_pack.hpp"
#include "granular_adapter/nscd/sweeps/space/sphere_pack.hpp"

namespace turbidite::nscd {

SolverResult Nlgs::solve(const ContactProblem& problem, const Impulses& guess,
                         const SolverSettings& settings) const {
    check_settings(settings);
    if (contacts_in_all(problem) == 0) return {{}, problem.free, 0, 0.0, {}, true};
    const auto solve_kind = [&]<ContactOperator W>(const W& w) {
        const NlgsCall<W> call{problem, w, guess, settings, instructions_};
        return with_rows(w, [&]<class Rows>(std::type_identity<Rows>) {
            return NlgsIteration<Rows, W>(call).run();
        });
    };
    return std::visit([&](const auto& bodies) { return solve_kind(operator_of(problem, bodies)); },
                      problem.bodies);
}

std::unique_ptr<const ContactSolver> make_nlgs() {
    return std::make_unique<Nlgs>();
}

}  // namespace turbidite::nscd
