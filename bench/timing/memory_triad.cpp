// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/memory_triad.hpp"

#include <algorithm>
#include <vector>

#include "bench/timing/step_clock.hpp"

namespace turbidite::bench {

double memory_triad() {
    constexpr std::size_t n = 1 << 24;  // 3 x 128 MiB
    constexpr int passes = 5;
    std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
    double best = 1e300;
    for (int pass = 0; pass < passes; ++pass) {
        const double start = wall_seconds();
        const double s = 0.5 + pass;
        for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
        std::swap(a, b);  // makes each pass depend on the previous one
        best = std::min(best, wall_seconds() - start);
    }
    // Uses the result, so that the loops are not optimised away.
    return b[n / 2] > 0.0 ? 3.0 * sizeof(double) * n / best : 0.0;
}

}  // namespace turbidite::bench
