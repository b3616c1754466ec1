// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/mesh_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite {
namespace {

constexpr double rounding = 1e-9;  // relative, of lengths from a case

// Far above what any mesh has: to count the rows of a box of 1e300 D would never end.
constexpr int most_rows = 1'000'000;

/// In units of h.
struct Growth {
    double ratio, largest;

    // h_k = min(h r^k, L) with h = 1: each from the one before, the first from the last equal row.
    std::vector<double> heights(int rows) const {
        std::vector<double> all;
        double next = 1.0;
        while (static_cast<int>(all.size()) < rows)
            all.push_back(next = std::min(next * ratio, largest));
        return all;
    }

    double sum(int rows) const {
        double total = 0.0;
        for (const double height : heights(rows)) total += height;
        return total;
    }

    /// The fewest rows that reach `room`; most_rows + 1 if there are more.
    int rows_to(double room) const {
        int rows = 0;
        double reached = 0.0, next = 1.0;
        // The rounding keeps a room that r fills exactly from getting one row more.
        while (reached < room * (1.0 - rounding) && rows <= most_rows) {
            reached += next = std::min(next * ratio, largest);
            ++rows;
        }
        return rows;
    }
};

Growth growth_of(const Settings& settings) {
    return {settings.real("fluid.stretch_ratio"), settings.real("fluid.stretch_largest")};
}

/// The ratio up to that of `most` with which so many rows fill `room`, by bisection.
double fitted_ratio(const Growth& most, int rows, double room) {
    double low = 1.0, high = most.ratio;
    // The sum grows with r, between rows (r = 1) and at least `room` (r of the case): one root. 60
    // halvings are beyond the last digit of a double.
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (Growth{middle, most.largest}.sum(rows) < room ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

MeshRows equal_rows(double height, double top) {
    MeshRows rows;
    rows.equal = static_cast<int>(std::lround(top / height));
    // Equal rows end at the top exactly; h gives way by as little as whole rows need.
    rows.height = top / rows.equal;
    return rows;
}

}  // namespace

double MeshRows::height_at(double y) const {
    const auto within = [y](double top) { return y <= top * (1.0 + rounding); };
    double top = equal_height();
    if (within(top)) return height;
    for (const double row : stretched)
        if (within(top += row)) return row;
    return largest();
}

bool rows_are_stretched(const Settings& settings) {
    return settings.has("fluid.stretch_ratio") && settings.real("fluid.stretch_ratio") > 1.0 &&
           settings.has("fluid.stretch_from") && settings.has("fluid.stretch_largest");
}

std::optional<MeshRows> mesh_rows(const Settings& settings, double top) {
    const double h = 1.0 / settings.real("fluid.cells_per_diameter");
    if (!rows_are_stretched(settings)) return equal_rows(h, top);
    const Growth most = growth_of(settings);
    MeshRows rows;
    rows.height = h;
    const double equal = std::ceil(settings.real("fluid.stretch_from") / h - rounding);
    const double room = top / h - equal;
    if (!(room > 0.0) || equal > most_rows) return std::nullopt;
    rows.equal = static_cast<int>(equal);
    const int count = most.rows_to(room);
    // Even rows of height h would be too high: n rows fit only if some were lower.
    if (count > room * (1.0 + rounding) || count > most_rows) return std::nullopt;
    rows.ratio = fitted_ratio(most, count, room);
    rows.stretched = Growth{rows.ratio, most.largest}.heights(count);
    for (double& height : rows.stretched) height *= h;
    return rows;
}

double least_stretched_room(const Settings& settings) {
    const Growth most = growth_of(settings);
    // sum(n) >= n + 1: any larger room takes n + 1 rows or more, and is high enough for as many of
    // height h.
    double sum = 0.0, next = 1.0;
    for (int rows = 1; rows <= most_rows; ++rows) {
        sum += next = std::min(next * most.ratio, most.largest);
        if (sum - rows >= 1.0) return sum / settings.real("fluid.cells_per_diameter");
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace turbidite
