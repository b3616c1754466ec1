// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact problem as plain numbers, whoever has written it: find r, u with u = W r + q and
// Signorini-Coulomb between them, d components per contact. FCLIB calls this the local problem.
#pragma once

#include <string>
#include <vector>

namespace turbidite::siconos {

struct LocalProblem {
    int dimension = 0;  ///< d
    // W in compressed columns, rows ascending within a column.
    std::vector<int> column_start;  ///< of the columns in the arrays below; one more entry
    std::vector<int> row;
    std::vector<double> value;     ///< [1/kg]
    std::vector<double> q;         ///< d per contact [m/s]
    std::vector<double> friction;  ///< mu, one per contact

    bool operator==(const LocalProblem&) const = default;
};

}  // namespace turbidite::siconos
