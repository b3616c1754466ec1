// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Boxes in space: planes that are put side by side stay what they are, and a vortex decays as it
// does whatever axes it turns about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/box_step/transport/second_order.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;
constexpr int nx = 12, ny = 10, nz = 4;
constexpr double spacing = 0.1, dt = 0.02;

/// Walls below, above and at both ends, of which one slides; layers grow from the sixth on.
BoxFluid fluid_between_walls(int rows_of_layer, std::optional<double> central) {
    const AxisOperator z = rows_of_layer > 1
                               ? AxisOperator{rows_of_layer, 0.13, End::periodic, End::periodic}
                               : SeparableOperator{}.z;
    const auto grid = [&](End end) {
        SeparableOperator box{{nx, spacing, end, end}, {ny, spacing, end, end}, z};
        box.y.sizes.assign(ny, spacing);
        for (int j = 6; j < ny; ++j) box.y.sizes[j] = 1.1 * box.y.sizes[j - 1];
        return box;
    };
    return {grid(End::dirichlet), grid(End::neumann), 0.01, 1.0, central, true};
}

class Host final : public SecondOrderHost {
 public:
    explicit Host(BoxStep& step) : step_(step) {}
    std::vector<VelocityValues> velocity_values() override {
        std::vector<VelocityValues> values;
        for (int axis = 0; axis < step_.layers().components(); ++axis)
            values.push_back({step_.velocity(axis), step_.cells()});
        return values;
    }
    void velocity_changed() override {}
    SideForce play(const VelocityStage& stage) override { return step_.play(stage); }
    SideForce diffuse_implicitly(double over) override {
        step_.diffuse(over, [](int) {});
        return step_.viscous_force();
    }

 private:
    BoxStep& step_;
};

/// The same random values in every row of a layer; nothing along z.
void fill_constant_along_z(BoxStep& step) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const BoxLayers& layers = step.layers();
    for (int axis = 0; axis < 2; ++axis)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const double u = value(random);
                for (int k = 0; k < layers.nz; ++k) step.velocity(axis)[layers.row(j, k) + i] = u;
            }
    std::fill(step.side_velocity(0)[3].begin(), step.side_velocity(0)[3].end(), 0.5);
}

void expect_planes(BoxStep& box, BoxStep& plane, double tolerance) {
    for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k)
            for (int i = 0; i < nx; ++i) {
                const std::size_t c = box.layers().row(j, k) + i, d = plane.layers().row(j, 0) + i;
                for (int axis = 0; axis < 2; ++axis)
                    ASSERT_NEAR(box.velocity(axis)[c], plane.velocity(axis)[d], tolerance);
                ASSERT_NEAR(box.velocity(2)[c], 0.0, tolerance);
                ASSERT_NEAR(box.pressure()[c], plane.pressure()[d], tolerance / dt);
            }
}

/// Forces on nz planes of this thickness, against that per unit length.
void expect_forces(const BoxForce& box, const BoxForce& plane) {
    for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(box[axis], nz * 0.13 * plane[axis], 1e-11);
    EXPECT_NEAR(box[2], 0.0, 1e-11);
}

TEST(Layers, OfEqualRowsArePlanes) {
    for (const std::optional<double> central : {std::optional<double>(), std::optional(0.75)}) {
        BoxStep box(fluid_between_walls(nz, central)), plane(fluid_between_walls(1, central));
        for (BoxStep* each : {&box, &plane}) fill_constant_along_z(*each);
        for (int window = 0; window < 5; ++window) {
            const FluxReport of_box = box.project(dt), of_plane = plane.project(dt);
            EXPECT_LT(of_box.divergence, 1e-10);
            EXPECT_NEAR(of_box.courant, of_plane.courant, 1e-12);
            expect_forces(box.pressure_force(), plane.pressure_force());
            expect_forces(box.convective_force(), plane.convective_force());
            for (BoxStep* each : {&box, &plane}) {
                if (window % 2) each->hold_flux();
                each->transport(dt);
                each->release_flux();
                each->diffuse(dt, [](int) {});
            }
            expect_forces(box.viscous_force(), plane.viscous_force());
            expect_planes(box, plane, 1e-12);
        }
    }
}

TEST(Layers, OfEqualRowsArePlanesInSecondOrder) {
    BoxStep box(fluid_between_walls(nz, 0.75)), plane(fluid_between_walls(1, 0.75));
    SecondOrder order_of_box, order_of_plane;
    Host host_of_box(box), host_of_plane(plane);
    for (BoxStep* each : {&box, &plane}) fill_constant_along_z(*each);
    const auto play = [](BoxStep& step, SecondOrder& order, Host& host, bool viscous) {
        step.project_and_hold_middle(dt, !order.goes_on());
        order.transport(host, dt, {2, viscous});
        step.release_flux();
        if (!viscous) order.diffuse(host, dt);
    };
    for (int window = 0; window < 4; ++window) {
        play(box, order_of_box, host_of_box, window % 2 == 1);
        play(plane, order_of_plane, host_of_plane, window % 2 == 1);
        expect_planes(box, plane, 1e-11);
    }
}

/// What is solved with rigid grains: images of fields that do not depend on z, per row.
TEST(Layers, HaveTheOperatorsOfPlanes) {
    BoxStep box(fluid_between_walls(nz, {})), plane(fluid_between_walls(1, {}));
    std::vector<VelocityRows> gradients(2);
    std::vector<std::vector<double>> images;
    for (BoxStep* each : {&box, &plane}) {
        fill_constant_along_z(*each);
        VelocityRows& g = gradients[each == &box ? 0 : 1];
        g.resize(each->layers().components(), each->cells());
        BoxOperators operators = each->operators();
        const std::vector<double> w(each->cells(), 0.5);
        operators.gradient(dt, each->velocity(1), g.pointers());
        std::vector<double> image(each->cells());
        operators.flux_image(dt, {VelocityPointers(), w.data()}, each->velocity(0), g.pointers(),
                             w.data(), image.data());
        operators.update_excess(dt, each->velocity(0), {each->excess_pointers(), w.data()});
        VelocityPointers u(each->layers().components());
        for (int axis = 0; axis < u.size(); ++axis) u[axis] = each->velocity(axis);
        std::vector<double> residual(each->cells());
        operators.flux_residual(dt, each->velocity(0), u, {each->excess_pointers(), w.data()}, {},
                                residual.data());
        image.insert(image.end(), residual.begin(), residual.end());
        images.push_back(image);
    }
    for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k)
            for (int i = 0; i < nx; ++i) {
                const std::size_t c = box.layers().row(j, k) + i, d = plane.layers().row(j, 0) + i;
                for (int axis = 0; axis < 2; ++axis)
                    ASSERT_DOUBLE_EQ(gradients[0][axis][c], gradients[1][axis][d]);
                ASSERT_NEAR(images[0][c], images[1][d], 1e-12);
                ASSERT_NEAR(images[0][box.cells() + c], images[1][plane.cells() + d], 1e-11);
            }
}

/// Taylor-Green vortices about an axis, in a stream along that axis, in a cyclic box:
/// (u, v) = (sin a cos b, -cos a sin b) exp(-2 nu t). Returns the largest error after t = 0.2.
double error_of_vortices(int n, int about) {
    const int along[] = {(about + 1) % 3, (about + 2) % 3};
    const AxisOperator axis{n, 2.0 * pi / n, End::periodic, End::periodic};
    const SeparableOperator grid{axis, axis, axis};
    const double nu = 0.05, end = 0.2;
    BoxStep step({grid, grid, nu, 1.0, 0.75, true});
    const auto exact = [&](int component, int i, int j, int k, double t) {
        const int cell[] = {i, j, k};
        const double a = (cell[along[0]] + 0.5) * axis.spacing;
        const double b = (cell[along[1]] + 0.5) * axis.spacing, decay = std::exp(-2.0 * nu * t);
        if (component == about) return 0.4;
        return component == along[0] ? decay * std::sin(a) * std::cos(b)
                                     : -decay * std::cos(a) * std::sin(b);
    };
    const auto for_cells = [&](auto work) {
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k)
                for (int i = 0; i < n; ++i)
                    for (int component = 0; component < 3; ++component)
                        work(component, step.layers().row(j, k) + i, i, j, k);
    };
    for_cells([&](int component, std::size_t c, int i, int j, int k) {
        step.velocity(component)[c] = exact(component, i, j, k, 0.0);
    });
    SecondOrder order;
    Host host(step);
    for (int window = 0; window < n; ++window) {
        const FluxReport report = step.project_and_hold_middle(end / n, !order.goes_on());
        EXPECT_LT(report.divergence, 1e-11);
        order.transport(host, end / n, {1, false});
        step.release_flux();
        order.diffuse(host, end / n);
    }
    step.project(end / n);
    double largest = 0.0;
    for_cells([&](int component, std::size_t c, int i, int j, int k) {
        largest = std::max(largest,
                           std::abs(step.velocity(component)[c] - exact(component, i, j, k, end)));
    });
    return largest;
}

TEST(Layers, VorticesAboutEveryAxisConverge) {
    double last = 0.0;
    for (int about = 0; about < 3; ++about) {
        const double coarse = error_of_vortices(12, about), fine = error_of_vortices(24, about);
        EXPECT_LT(fine, 0.3 * coarse);  // second order: a quarter
        EXPECT_LT(fine, 1e-2);
        if (about > 0) {
            EXPECT_NEAR(fine, last, 1e-10) << "no axis differs from another";
        }
        last = fine;
    }
}

}  // namespace
}  // namespace turbidite
