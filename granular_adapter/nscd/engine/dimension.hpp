// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether shapes and solver suit the dimension of a run, its films and its ranks.
#pragma once

#include <string>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument unless the dimension is 2 or 3, and for a shape of another one.
void check_dimension(int dimension, const ShapeTable& shapes);

/// Throws std::invalid_argument for a solver that does not solve problems of this dimension.
void check_solver(int dimension, const std::string& name, const ContactSolver& solver);

/// Throws std::invalid_argument for a solver that does not solve problems with films of liquid.
void check_films(const std::string& name, const ContactSolver& solver);

/// Throws std::invalid_argument for a solver that does not solve problems of several ranks.
void check_ranks(const std::string& name, const ContactSolver& solver);

}  // namespace turbidite::nscd
