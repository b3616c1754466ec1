// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The film in wedges on every face of a cyclic box in space, face by face.
#include "fluid_adapter/box_step/wedge_flow.hpp"

#include <gtest/gtest.h>

#include <random>

#include "fluid_adapter/box_step/box_step.hpp"

namespace turbidite {
namespace {

constexpr std::array<int, 3> cells{7, 6, 5};
constexpr std::array<double, 3> h{0.11, 0.13, 0.17};
constexpr double nu = 0.02, dt = 0.03;
constexpr double phi = 0.5, k = 1.0 / (1.0 + 12.0 * nu * dt / (0.25 * h[0] * h[1]));

BoxFluid cyclic_box() {
    const auto axis = [](int a) {
        return AxisOperator{cells[a], h[a], End::periodic, End::periodic};
    };
    BoxFluid fluid;
    fluid.velocity = fluid.pressure = {axis(0), axis(1), axis(2)};
    fluid.viscosity = nu;
    return fluid;
}

using Place = std::array<int, 3>;  // i, j, k; a face is at the lower side of its cell

Place beside(Place at, int axis, int side) {
    at[axis] = (at[axis] + side + cells[axis]) % cells[axis];
    return at;
}

class FilmOnEveryFace : public testing::Test {
 protected:
    static constexpr std::array<double, 3> a{3.0, -2.0, 5.0};

    FilmOnEveryFace() {
        const std::size_t count = step.cells();
        p.resize(count), u.assign(count, 0.0), w.assign(count, 0.0), r.resize(count);
        for (double& value : p) value = any(random);
        for (const Place& at : places())
            for (int axis = 0; axis < 3; ++axis) {
                old[axis][cell(at)] = any(random);
                for (const std::size_t face : faces(at, axis))
                    step.excess(axis)[face] = old[axis][cell(at)];
                for (const int side : {-1, 1})
                    sides.push_back({cell(at), static_cast<std::int8_t>(axis),
                                     static_cast<std::int8_t>(side), is_held(axis)});
            }
        film.begin(sides, step.layers(), step.excess_pointers(), nu, step.cell_area(), a, dt);
    }

    static std::vector<Place> places() {
        std::vector<Place> all;
        for (int j = 0; j < cells[1]; ++j)
            for (int depth = 0; depth < cells[2]; ++depth)
                for (int i = 0; i < cells[0]; ++i) all.push_back({i, j, depth});
        return all;
    }
    static int cell(const Place& at) { return at[0] + cells[0] * (at[2] + cells[2] * at[1]); }

    /// Where the face below a cell along an axis stands: those on the sides twice.
    std::vector<std::size_t> faces(Place at, int axis) const {
        const auto number = [&](const Place& of) {
            return step.layers().face_row(axis, of[1], of[2]) + of[0];
        };
        std::vector<std::size_t> list{number(at)};
        if (at[axis] == 0) at[axis] = cells[axis], list.push_back(number(at));
        return list;
    }

    /// Between bodies that no force moves; the same for both copies of a face.
    static bool is_held(int axis) { return axis != 1; }

    /// e = k (e_old + phi dt (a - dp/dn)) on the face below a cell, a between held bodies alone.
    double flux(const Place& at, int axis) const {
        const double slope = (p[cell(at)] - p[cell(beside(at, axis, -1))]) / h[axis];
        const double force = is_held(axis) ? a[axis] : 0.0;
        return k * (old[axis][cell(at)] + phi * dt * (force - slope));
    }

    ExcessFlux excess() { return {step.excess_pointers(), w.data(), &film}; }

    BoxStep step{cyclic_box()};
    std::mt19937 random{3};
    std::uniform_real_distribution<double> any{-1.0, 1.0};
    std::array<std::array<double, cells[0] * cells[1] * cells[2]>, 3> old{};
    std::vector<double> p, u, w, r;
    std::vector<CellSide> sides;
    WedgeFlow film;
};

TEST_F(FilmOnEveryFace, HasTheDivergenceOfItsFluxes) {
    BoxOperators operators = step.operators();
    operators.flux_residual(dt, p.data(), {u.data(), u.data(), u.data()}, excess(), {}, r.data());
    double largest = 0.0;
    for (const Place& at : places()) {
        double divergence = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            divergence += (flux(beside(at, axis, 1), axis) - flux(at, axis)) / h[axis];
        ASSERT_NEAR(r[cell(at)], -divergence, 1e-12);
        largest = std::max(largest, std::abs(divergence));
    }
    EXPECT_GT(largest, 1.0);
}

TEST_F(FilmOnEveryFace, BecomesTheExcessOfBothCopiesOfAFace) {
    step.operators().update_excess(dt, p.data(), excess());
    for (const Place& at : places())
        for (int axis = 0; axis < 3; ++axis)
            for (const std::size_t face : faces(at, axis))
                ASSERT_NEAR(step.excess(axis)[face], flux(at, axis), 1e-13);
}

}  // namespace
}  // namespace turbidite
