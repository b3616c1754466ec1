// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_step/box_operators.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coupled_step/tank.hpp"

namespace turbidite {
namespace {

class Operators : public testing::TestWithParam<TankSides> {
 protected:
    std::size_t size() const { return box.size(); }

    /// D (-dt G p) + dt Q p with this w, and its product with r.
    std::vector<double> image_of(const std::vector<double>& p, const std::vector<double>& w,
                                 const WedgeFlow* wedges = nullptr) {
        std::vector<double> x(size()), y(size()), image(size()), r(size(), 0.0);
        box.gradient(time_step, p.data(), {x.data(), y.data()});
        box.flux_image(time_step, {VelocityPointers(), w.data(), wedges}, p.data(),
                       {x.data(), y.data()}, r.data(), image.data());
        return image;
    }

    /// About a third of the faces inside the box, from both of their cells.
    std::vector<CellSide> some_faces() const {
        std::vector<double> chosen(2 * size());
        fill_randomly(chosen, 12);
        std::vector<CellSide> sides;
        for (int j = 0; j < cells_across; ++j)
            for (int i = 0; i < cells_across; ++i) {
                const int cell = j * cells_across + i;
                for (const auto& [axis, last, next] :
                     {std::array{0, i, 1}, std::array{1, j, cells_across}})
                    if (last + 1 < cells_across && chosen[2 * cell + axis] > 0.3) {
                        sides.push_back({cell, static_cast<std::int8_t>(axis), 1});
                        sides.push_back({cell + next, static_cast<std::int8_t>(axis), -1});
                    }
            }
        return sides;
    }

    /// Fluid at rest: the excess that p leaves has the divergence that the residual knew.
    void expect_flux_of_residual(const std::vector<double>& p, const ExcessFlux& excess) {
        std::vector<double> before(size());
        double *x = step.velocity(0), *y = step.velocity(1);
        std::fill_n(x, size(), 0.0), std::fill_n(y, size(), 0.0);
        box.flux_residual(time_step, p.data(), {x, y}, excess, {}, before.data());
        box.update_excess(time_step, p.data(), excess);
        const std::vector<double> after = flux_defect(step);
        EXPECT_GT(product(before, before), 1.0);
        for (std::size_t c = 0; c < size(); ++c) ASSERT_NEAR(after[c], before[c], 1e-10);
    }

    /// Weighted by the volumes of the cells.
    double product(const std::vector<double>& a, const std::vector<double>& b) const {
        std::vector<double> each(size());
        for (std::size_t c = 0; c < size(); ++c) each[c] = a[c] * b[c];
        return box.sum_of_cells(each);
    }

    BoxStep step{box_fluid(GetParam(), 0.01)};
    BoxOperators box{step.operators()};
};

/// The step's own pressure solve inverts the operator without grains.
TEST_P(Operators, WithoutGrainsThePressureSolveIsTheInverse) {
    std::vector<double> p(size());
    fill_randomly(p, 1);
    const std::vector<double> image = image_of(p, std::vector<double>(size(), 1.0));
    double* values = step.pressure_solve().values();
    for (std::size_t c = 0; c < size(); ++c) values[c] = image[c] / time_step;
    step.pressure_solve().solve();
    const double level = GetParam().side == Side::open ? 0.0 : p[0] - values[0];
    for (std::size_t c = 0; c < size(); ++c) ASSERT_NEAR(values[c] + level, p[c], 1e-10);
}

/// G is minus the transpose of D, of a change that is zero where sides hold a velocity.
TEST_P(Operators, GradientAndDivergenceAreTransposed) {
    std::vector<double> p(size()), x(size()), y(size()), gx(size()), gy(size()), r(size());
    fill_randomly(p, 1), fill_randomly(x, 2), fill_randomly(y, 3);
    const std::vector<double> none(size(), 0.0);
    std::vector<double> divergence(size());
    box.flux_image(0.0, {VelocityPointers(), none.data()}, none.data(), {x.data(), y.data()},
                   none.data(), divergence.data());
    box.gradient(-1.0, p.data(), {gx.data(), gy.data()});
    const double by_gradient = product(gx, x) + product(gy, y);
    EXPECT_NEAR(product(p, divergence), -by_gradient, 1e-10 * std::abs(by_gradient));
    EXPECT_GT(std::abs(by_gradient), 1.0);
}

TEST_P(Operators, TheLaplacianIsSymmetricAndNegative) {
    std::vector<double> a(size()), b(size()), la(size()), lb(size());
    fill_randomly(a, 1), fill_randomly(b, 2);
    box.laplacian(1.0, 0, a.data(), la.data());
    box.laplacian(1.0, 0, b.data(), lb.data());
    EXPECT_NEAR(product(a, lb), product(b, la), 1e-12 * std::abs(product(a, la)));
    EXPECT_LT(product(a, la), 0.0);
}

/// What an iteration asks for are sums weighted by volumes.
TEST_P(Operators, ProductsAreThoseOfTheImages) {
    std::vector<double> p(size()), x(size()), y(size()), r(size()), image(size());
    const std::vector<double> w(size(), 1.0);
    fill_randomly(p, 1), fill_randomly(x, 2), fill_randomly(y, 3), fill_randomly(r, 4);
    const ImageProducts of = box.flux_image(time_step, {VelocityPointers(), w.data()}, p.data(),
                                            {x.data(), y.data()}, r.data(), image.data());
    EXPECT_NEAR(of.direction, product(image, p), 1e-10 * std::abs(of.itself));
    EXPECT_NEAR(of.residual, product(image, r), 1e-10 * std::abs(of.itself));
    EXPECT_NEAR(of.itself, product(image, image), 1e-10 * std::abs(of.itself));
    const ImageProducts viscous =
        box.viscous_image(0.01, 0, p.data(), x.data(), r.data(), image.data());
    EXPECT_NEAR(viscous.direction, product(image, x), 1e-10 * std::abs(viscous.itself));
    EXPECT_NEAR(viscous.step, product(r, x), 1e-10 * std::abs(viscous.itself));
}

TEST_P(Operators, AreSymmetricWithCellsInsideGrains) {
    std::vector<double> a(size()), b(size()), w(size());
    fill_randomly(a, 1), fill_randomly(b, 2), fill_randomly(w, 3);
    for (double& value : w) value = value > 0.0 ? 1.0 : 0.0;
    const std::vector<double> image_a = image_of(a, w), image_b = image_of(b, w);
    EXPECT_NEAR(product(a, image_b), product(b, image_a), 1e-10 * std::abs(product(a, image_b)));
    EXPECT_GT(product(a, image_a), 0.0);
}

/// What is added to the excess for p changes the residual by what the residual already knew.
TEST_P(Operators, TheExcessIsTheFluxOfTheResidual) {
    std::vector<double> p(size()), w(size());
    fill_randomly(p, 1), fill_randomly(w, 3);
    for (double& value : w) value = value > 0.0 ? 0.5 : 0.0;
    const ExcessFlux excess{step.excess_pointers(), w.data()};
    fill_randomly(step.excess(0), 7), fill_randomly(step.excess(1), 8);
    expect_flux_of_residual(p, excess);
}

/// Under a pressure that stays e tends to (h2/4 nu) (d2 p_{+1} - d2 p)/(4h), whatever dt is.
TEST_P(Operators, TheExcessOfSteadyFlowDoesNotDependOnTheStep) {
    constexpr double viscosity = 0.3, squared = cell_size * cell_size;
    std::vector<double> p(size()), w(size());
    fill_randomly(p, 1);
    const auto excess_after = [&](double dt, int windows) {
        std::fill(w.begin(), w.end(), 1.0 / (1.0 + 4.0 * viscosity * dt / squared));
        for (int axis = 0; axis < 2; ++axis)
            std::fill(step.excess(axis).begin(), step.excess(axis).end(), 0.0);
        for (int window = 0; window < windows; ++window)
            box.update_excess(dt, p.data(), {step.excess_pointers(), w.data()});
        return step.excess(0);
    };
    const std::vector<double> fine = excess_after(0.001, 500), coarse = excess_after(0.1, 40);
    const auto curvature = [&](int c) { return p[c - 1] - 2.0 * p[c] + p[c + 1]; };
    for (int j = 0; j < cells_across; ++j)
        for (int i = 2; i < cells_across - 1; ++i) {  // faces between cells with neighbours
            const int cell = j * cells_across + i, face = j * (cells_across + 1) + i;
            const double limit = squared / (4.0 * viscosity) *
                                 (curvature(cell) - curvature(cell - 1)) / (4.0 * cell_size);
            ASSERT_NEAR(fine[face], limit, 1e-12);
            ASSERT_NEAR(coarse[face], limit, 1e-12);
        }
}

TEST_P(Operators, AreSymmetricWithWedges) {
    WedgeFlow wedges;
    wedges.begin(some_faces(), step.layers(), step.excess_pointers(), 0.01, step.cell_area(), {},
                 time_step);
    std::vector<double> a(size()), b(size());
    const std::vector<double> w(size(), 0.0);
    fill_randomly(a, 1), fill_randomly(b, 2);
    const std::vector<double> image_a = image_of(a, w, &wedges), image_b = image_of(b, w, &wedges);
    const double without = product(a, image_of(a, w));
    EXPECT_NEAR(product(a, image_b), product(b, image_a), 1e-10 * std::abs(product(a, image_b)));
    // dt k phi |grad p|^2 on a third of the faces
    EXPECT_GT(product(a, image_a), 1.1 * without);
}

/// As TheExcessIsTheFluxOfTheResidual, with faces of a film between cells inside grains.
TEST_P(Operators, TheFilmInWedgesIsTheFluxOfTheResidual) {
    std::vector<double> p(size());
    const std::vector<double> w(size(), 0.0);
    fill_randomly(p, 1);
    fill_randomly(step.excess(0), 7), fill_randomly(step.excess(1), 8);
    WedgeFlow wedges;
    wedges.begin(some_faces(), step.layers(), step.excess_pointers(), 0.01, step.cell_area(), {},
                 time_step);
    const ExcessFlux excess{step.excess_pointers(), w.data(), &wedges};
    expect_flux_of_residual(p, excess);
}

/// Under a constant slope of p it is the flow between two plates at half a cell from each other.
TEST_P(Operators, TheFilmInWedgesApproachesTheFlowBetweenPlates) {
    constexpr double slope = 0.7, viscosity = 0.5, delta = 0.5 * cell_size;
    const int face = 20, cell = 20 * cells_across + face - 1;
    const std::vector<CellSide> sides = {{cell, 0, 1}, {cell + 1, 0, -1}};
    std::vector<double> p(size());
    const std::vector<double> w(size(), 0.0);
    for (std::size_t c = 0; c < size(); ++c) p[c] = slope * cell_size * (c % cells_across);
    WedgeFlow wedges;
    std::vector<double> fluxes;
    for (int window = 0; window < 20; ++window) {
        wedges.begin(sides, step.layers(), step.excess_pointers(), viscosity, step.cell_area(), {},
                     0.001);
        box.update_excess(0.001, p.data(), {step.excess_pointers(), w.data(), &wedges});
        fluxes.push_back(step.excess(0)[20 * (cells_across + 1) + face]);
    }
    // At first phi dt dp/dx; at last delta^3/(12 nu h) dp/dx
    EXPECT_NEAR(fluxes.front(),
                -0.5 * 0.001 * slope / (1.0 + 12.0 * viscosity * 0.001 / (delta * delta)), 1e-12);
    EXPECT_NEAR(fluxes.back(), -delta * delta * delta / (12.0 * viscosity * cell_size) * slope,
                1e-9);
}

TEST_P(Operators, NoExcessBetweenCellsInsideGrains) {
    std::vector<double> w(size(), 0.0), p(size());
    fill_randomly(p, 4);
    fill_randomly(step.excess(0), 7), fill_randomly(step.excess(1), 8);
    const ExcessFlux excess{step.excess_pointers(), w.data()};
    box.update_excess(time_step, p.data(), excess);
    for (int axis = 0; axis < 2; ++axis)
        for (const double e : step.excess(axis)) ASSERT_EQ(e, 0.0);
}

/// What is done while a velocity is read equals what is done before it is read.
TEST_P(Operators, APendingChangeIsMadeOnce) {
    std::vector<double> w(size(), 1.0), p(size()), together(size()), apart(size());
    VelocityRows change, u;
    change.resize(2, size()), u.resize(2, size());
    for (int axis = 0; axis < 2; ++axis) {
        fill_randomly(change[axis], 10 + axis), fill_randomly(u[axis], 20 + axis);
        std::copy(u[axis].begin(), u[axis].end(), step.velocity(axis));
        for (std::size_t c = 0; c < size(); ++c) u[axis][c] += 0.7 * change[axis][c];
    }
    fill_randomly(p, 4);
    const ExcessFlux excess{step.excess_pointers(), w.data()};
    box.flux_residual(time_step, p.data(), {step.velocity(0), step.velocity(1)}, excess,
                      {0.7, {change[0].data(), change[1].data()}}, together.data());
    box.flux_residual(time_step, p.data(), u.pointers(), excess, {}, apart.data());
    EXPECT_EQ(together, apart);
    for (int axis = 0; axis < 2; ++axis)
        for (std::size_t c = 0; c < size(); ++c) ASSERT_EQ(step.velocity(axis)[c], u[axis][c]);
}

TEST_P(Operators, ADirectionIsTheGradientOfItsSum) {
    std::vector<double> z(size()), d(size()), x(size()), y(size()), again_x(size()),
        again_y(size());
    fill_randomly(z, 1), fill_randomly(d, 2);
    std::vector<double> sum = d;
    for (std::size_t c = 0; c < size(); ++c) sum[c] = z[c] + 0.3 * d[c];
    box.direction(time_step, z.data(), 0.3, d.data(), {x.data(), y.data()});
    EXPECT_EQ(d, sum);
    box.gradient(time_step, sum.data(), {again_x.data(), again_y.data()});
    EXPECT_EQ(x, again_x);
    EXPECT_EQ(y, again_y);
    EXPECT_GT(product(x, x) + product(y, y), 0.01);
}

/// Transport that adds the impulses of the window equals transport followed by them.
TEST_P(Operators, TransportAddsTheImpulsesOfItsVelocity) {
    BoxStep other{box_fluid(GetParam(), 0.01)};
    for (BoxStep* each : {&step, &other}) {
        each->keep_pressure();
        std::vector<double> p(size());
        fill_randomly(p, 4);
        std::copy(p.begin(), p.end(), each->pressure());
        for (int axis = 0; axis < 2; ++axis) {
            std::vector<double> u(size());
            fill_randomly(u, 5 + axis);
            std::copy(u.begin(), u.end(), each->velocity(axis));
        }
    }
    VelocityRows f;
    f.resize(2, size());
    for (int axis = 0; axis < 2; ++axis)
        box.laplacian(0.01 * time_step, axis, step.velocity(axis), f[axis].data());
    ImpulsesOfWindow impulses;
    impulses.dt = time_step;
    step.transport(time_step, &impulses);
    other.transport(time_step);
    other.operators().add_impulses(1.0, time_step, other.pressure(), f,
                                   {other.velocity(0), other.velocity(1)});
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_EQ(impulses.f[axis], f[axis]);
        EXPECT_NEAR(impulses.sum_f[axis], box.sum_of_cells(f[axis]), 1e-12);
        for (std::size_t c = 0; c < size(); ++c)
            ASSERT_NEAR(step.velocity(axis)[c], other.velocity(axis)[c], 1e-14);
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, Operators, testing::ValuesIn(all_tanks),
                         [](const auto& info) { return name_of(info.param); });

}  // namespace
}  // namespace turbidite
