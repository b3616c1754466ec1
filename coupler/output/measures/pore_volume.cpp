// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/pore_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "coupler/output/measures/delaunay.hpp"

namespace turbidite {
namespace {

// Rounding must not decide about a circumradius of exactly D (the loosest lattice).
constexpr double slack = 1.0 + 1e-9;
// Half the width of the integer grid for the points.
constexpr double grid_reach = 1 << 30;

using Corners = std::array<const SolidGrain*, 3>;

/// A point of the plane: a grain or one of its images.
struct Site {
    SolidGrain grain;
    GridPoint place;
    bool real = true;
};

/// Maps lengths to the grid. A period becomes a whole number of steps, so that the position of an
/// image relative to the others is exact.
class Grid {
 public:
    Grid(const std::vector<SolidGrain>& grains, double margin, const Vec3& period) {
        std::array<double, 2> low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
        for (const SolidGrain& grain : grains)
            for (int axis = 0; axis < 2; ++axis) {
                const double x = axis == 0 ? grain.x : grain.y;
                low[axis] = std::min(low[axis], x);
                high[axis] = std::max(high[axis], x);
            }
        const double widest = std::max(high[0] - low[0], high[1] - low[1]);
        // All sites and images stay within 2^30 steps of the middle (delaunay.hpp).
        scale_ = grid_reach / (0.5 * widest + margin + std::max(period[0], period[1]));
        for (int axis = 0; axis < 2; ++axis) middle_[axis] = 0.5 * (low[axis] + high[axis]);
    }

    std::int32_t steps(double length) const {
        return static_cast<std::int32_t>(std::lround(length * scale_));
    }
    GridPoint place(const SolidGrain& grain) const {
        return {steps(grain.x - middle_[0]), steps(grain.y - middle_[1])};
    }

 private:
    double scale_ = 1.0;
    std::array<double, 2> middle_{};
};

/// Adds the images one period below and above along an axis of all sites that come within `margin`
/// of the middle of the others.
void add_images(std::vector<Site>& sites, const Grid& grid, int axis, double period,
                double margin) {
    double SolidGrain::*x = axis == 0 ? &SolidGrain::x : &SolidGrain::y;
    std::int32_t GridPoint::*step = axis == 0 ? &GridPoint::x : &GridPoint::y;
    double low = INFINITY, high = -INFINITY;
    for (const Site& site : sites) {
        low = std::min(low, site.grain.*x);
        high = std::max(high, site.grain.*x);
    }
    const std::size_t originals = sites.size();
    for (std::size_t i = 0; i < originals; ++i)
        for (const int side : {-1, 1}) {
            Site image = sites[i];
            image.real = false;
            image.grain.*x += side * period;
            image.place.*step += side * grid.steps(period);
            if (image.grain.*x >= low - margin && image.grain.*x <= high + margin)
                sites.push_back(image);
        }
}

/// Positions of outside programs may run on across cyclic sides.
std::vector<SolidGrain> within_period(std::vector<SolidGrain> grains, const Vec3& period) {
    const auto wrapped = [](double x, double length) {
        return length > 0.0 ? x - length * std::floor(x / length) : x;
    };
    for (SolidGrain& grain : grains) {
        grain.x = wrapped(grain.x, period[0]);
        grain.y = wrapped(grain.y, period[1]);
    }
    return grains;
}

/// The widest circumradius of triangles that belong to the packing, of grains with this mean area:
/// their diameter, and at least D.
double widest(double area, double diameter) {
    return slack * std::max(diameter, 2.0 * std::sqrt(area / std::numbers::pi));
}

std::vector<Site> all_sites(const std::vector<SolidGrain>& grains, double diameter,
                            const Vec3& period) {
    double largest = 0.0;
    for (const SolidGrain& grain : grains) largest = std::max(largest, grain.area);
    const double margin = 2.0 * widest(largest, diameter);
    const Grid grid(grains, margin, period);
    std::vector<Site> sites;
    for (const SolidGrain& grain : grains) sites.push_back({grain, grid.place(grain), true});
    for (int axis = 0; axis < 2; ++axis)
        // Along y the images along x are repeated as well: corners of a box that is cyclic both
        // ways.
        if (period[axis] > 0.0) add_images(sites, grid, axis, period[axis], margin);
    return sites;
}

/// Angle between two sides [rad].
double angle(const SolidGrain& at, const SolidGrain& b, const SolidGrain& c) {
    const double x1 = b.x - at.x, y1 = b.y - at.y, x2 = c.x - at.x, y2 = c.y - at.y;
    // |a x b| and a . b: keeps its digits in thin triangles, where acos loses them.
    return std::atan2(std::abs(x1 * y2 - y1 * x2), x1 * x2 + y1 * y2);
}

double distance(const SolidGrain& a, const SolidGrain& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// Pore area of a triangle; zero if it is too wide.
double pore(const Corners& corner, double diameter) {
    const auto& [a, b, c] = corner;
    const double area =
        0.5 * std::abs((b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x));
    // Circumradius abc/(4 area)
    const double sides = distance(*a, *b) * distance(*b, *c) * distance(*c, *a);
    const double limit = widest((a->area + b->area + c->area) / 3.0, diameter);
    if (!(sides <= 4.0 * area * limit) || area == 0.0) return 0.0;
    double solid = 0.0;
    for (int k = 0; k < 3; ++k)
        // V_i angle_i, over 2 pi below
        solid += corner[k]->area * angle(*corner[k], *corner[(k + 1) % 3], *corner[(k + 2) % 3]);
    return area - solid / (2.0 * std::numbers::pi);
}

}  // namespace

double pore_volume(const std::vector<SolidGrain>& grains, double diameter, const Vec3& period) {
    if (grains.empty()) return 0.0;
    const std::vector<Site> sites = all_sites(within_period(grains, period), diameter, period);
    std::vector<GridPoint> places;
    places.reserve(sites.size());
    for (const Site& site : sites) places.push_back(site.place);
    double total = 0.0;
    for (const std::vector<std::size_t>& cell : delaunay_cells(places)) {
        const auto real =
            std::count_if(cell.begin(), cell.end(), [&](std::size_t i) { return sites[i].real; });
        double pores = 0.0;
        // A cell of more than three vertices (a square of the loosest lattice) as a fan of
        // triangles, whose circle is the same.
        for (std::size_t k = 2; k < cell.size(); ++k)
            pores += pore({&sites[cell[0]].grain, &sites[cell[k - 1]].grain, &sites[cell[k]].grain},
                          diameter);
        // Each image of a cell across a border has a different number of real vertices: together
        // they count once.
        total += pores * static_cast<double>(real) / static_cast<double>(cell.size());
    }
    return total;
}

}  // namespace turbidite
