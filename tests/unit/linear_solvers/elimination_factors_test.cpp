// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/linear_solvers/elimination_factors.hpp"

#include <gtest/gtest.h>

#include "fluid_adapter/linear_solvers/separable_operator.hpp"

namespace turbidite {
namespace {

constexpr int modes = 320, rows = 960;

/// Diagonals over r of the modes, with alpha h2/beta added.
std::vector<double> shifts(End end, double added) {
    const AxisOperator x{modes, 1.0, end, end};
    std::vector<double> shift;
    for (int k = 0; k < modes; ++k) shift.push_back(x.eigenvalue(k) + added);
    return shift;
}

/// Every factor equals that of the recurrence, to the rounding of the recurrence.
TEST(EliminationFactors, AreThoseOfTheRecurrence) {
    // Without the added term the first periodic mode has d = 2.
    for (const auto& [end, added] : {std::pair{End::dirichlet, 1e-3},
                                     {End::periodic, 1e-3},
                                     {End::periodic, 0.0},
                                     {End::dirichlet, 0.0}}) {
        const std::vector<double> shift = shifts(end, added);
        EliminationFactors factors;
        factors.compute(shift, 3.0, 2.0, 3.0, rows);
        // gain: sum of the amplified rounding errors
        std::vector<long double> e(modes), gain(modes, 0.0L);
        for (int j = 0; j < rows; ++j) {
            const long double d = j == 0 || j == rows - 1 ? 3.0L : 2.0L;
            for (int k = 0; k < modes; ++k) {
                e[k] = 1.0L / (shift[k] + d - (j > 0 ? e[k] : 0.0L));
                gain[k] = 1.0L + e[k] * e[k] * gain[k];
            }
            int seen = 0;
            factors.for_row(j, [&](int begin, int stop, const double* stored) {
                EXPECT_EQ(begin, seen);
                for (; seen < stop; ++seen) {
                    const double exact = static_cast<double>(e[seen]);
                    EXPECT_NEAR(stored[seen - begin], exact, 4 * 2.2e-16 * gain[seen] * exact);
                }
            });
            EXPECT_EQ(seen, modes);
        }
    }
}

/// Mode k settles within 36/(2 pi k/320) rows. So 4 % of the factors of the pressure are stored,
/// and of those of the viscous step, with nu dt/h2 = 0.07, almost none besides the first and the
/// last row.
TEST(EliminationFactors, AreStoredOnlyUntilTheySettle) {
    EliminationFactors factors;
    std::vector<double> shift = shifts(End::neumann, 0.0);
    shift[0] = 1.0;
    factors.compute(shift, 1.0, 2.0, 1.0, rows);
    EXPECT_LT(factors.stored(), 0.05 * modes * rows);
    factors.compute(shifts(End::periodic, 1.0 / 0.07), 2.0, 2.0, 2.0, rows);
    EXPECT_LT(factors.stored(), 0.02 * modes * rows);
}

}  // namespace
}  // namespace turbidite
