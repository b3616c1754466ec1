// SPDX-License-Identifier: GPL-2.0-or-later
#include "bench/array_code/plane_flow.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <tuple>

namespace turbidite::array_code {
namespace {

constexpr int line = 8;  // doubles in a cache line; the ghosts left of a row occupy one

std::ptrdiff_t padded(int nx) {
    return line + (nx + line) / line * line;  // at least one ghost on the right
}

/// max(x, 0) without a branch.
inline double positive(double x) {
    return 0.5 * (x + std::abs(x));
}

/// A row of faces; face i lies between the cells i - next and i.
struct FaceRow {
    int first = 0, end = 0;
    std::ptrdiff_t next = 1;
    const double *u, *v, *p;  // by cell; cell i is on the upper side of face i
    const double* normal;     // u or v, the component normal to the faces
    double* w;                // face velocity, becomes e
    double *flux_u, *flux_v;
};

/// Subtracts the pressure part from w, computes the momentum flux, and leaves e in w. c = dt/h.
///
/// limitedLinear with a limiter in the direction of the difference (OpenFOAM: limitedLinearV 1).
/// There is no branch, so that the loop is vectorised.
void cross(const FaceRow& row, double c) {
    const std::ptrdiff_t next = row.next;
    const double *u = row.u, *v = row.v, *p = row.p, *normal = row.normal;
    double *w = row.w, *flux_u = row.flux_u, *flux_v = row.flux_v;
    constexpr double tiny = 1e-300;  // 0/0 is smooth: limiter 1
#pragma GCC ivdep                    // arrays do not overlap
    for (int i = row.first; i < row.end; ++i) {
        const double speed = w[i] - c * (p[i] - p[i - next]);
        w[i] = speed - 0.5 * (normal[i] + normal[i - next]);
        const double du = u[i] - u[i - next], dv = v[i] - v[i - next];
        const double back =
            du * (u[i - next] - u[i - 2 * next]) + dv * (v[i - next] - v[i - 2 * next]);
        const double ahead = du * (u[i + next] - u[i]) + dv * (v[i + next] - v[i]);
        const double forward = 0.5 + std::copysign(0.5, speed);  // 1 or 0
        const double upwind = forward * back + (1.0 - forward) * ahead;
        const double ratio = 2.0 * (upwind + tiny) / (du * du + dv * dv + tiny);
        const double half = 0.5 * positive(1.0 - positive(1.0 - ratio));  // half the limiter
        const double beyond = forward * half + (1.0 - forward) * (1.0 - half);
        flux_u[i] = speed * (u[i - next] + beyond * du);
        flux_v[i] = speed * (v[i - next] + beyond * dv);
    }
}

}  // namespace

PlaneFlow::Field::Field(const FlowSetup& setup)
    : stride_(padded(setup.nx)),
      size_(static_cast<std::size_t>(stride_) * (setup.ny + 2) + line),
      values_(fftw_alloc_real(size_)) {
    if (!values_) throw std::bad_alloc();
    std::fill_n(values_.get(), size_, 0.0);
    first_ = values_.get() + line + stride_;
}

PlaneFlow::PlaneFlow(const FlowSetup& setup, const VelocityAt& start)
    : setup_(setup),
      u_(setup),
      v_(setup),
      p_(setup),
      moved_u_(setup),
      moved_v_(setup),
      wx_(setup),
      wy_(setup),
      pressure_({setup.nx, setup.ny, p_.stride()}, setup.spacing, Condition::neumann, 0.0, 1.0,
                p_.row(0)),
      viscosity_({setup.nx, setup.ny, u_.stride()}, setup.spacing, Condition::dirichlet, 1.0,
                 setup.viscosity * setup.step, u_.row(0)) {
    for (FaceFlux* flux : {&left_, &above_, &below_}) {
        flux->u.assign(setup.nx + 1, 0.0);
        flux->v.assign(setup.nx + 1, 0.0);
    }
    const double h = setup.spacing;
    for (int j = 0; j < setup.ny; ++j)
        for (int i = 0; i < setup.nx; ++i)
            std::tie(u_.row(j)[i], v_.row(j)[i]) = start((i + 0.5) * h, (j + 0.5) * h);
}

std::size_t PlaneFlow::bytes() const {
    return 7 * u_.bytes() + pressure_.bytes() + viscosity_.bytes();
}

void PlaneFlow::step() {
    face_velocity_and_divergence();
    pressure_.solve(p_.row(0));
    fill_ghosts(p_, 1.0);
    correct_cells();
    fill_ghosts(u_, -1.0);
    fill_ghosts(v_, -1.0);
    transport();
    viscosity_.solve(moved_u_.row(0));
    viscosity_.solve(moved_v_.row(0));
    std::swap(u_, moved_u_);
    std::swap(v_, moved_v_);
}

/// The mirror image that gives the walls zero gradient (sign 1) or zero value (-1).
void PlaneFlow::fill_ghosts(Field& field, double sign) const {
    const int nx = setup_.nx, ny = setup_.ny;
    for (int j = 0; j < ny; ++j) {
        double* row = field.row(j);
        row[-1] = sign * row[0];
        row[nx] = sign * row[nx - 1];
    }
    for (int i = 0; i < nx; ++i) {
        field.row(-1)[i] = sign * field.row(0)[i];
        field.row(ny)[i] = sign * field.row(ny - 1)[i];
    }
}

/// Writes w into wx and wy, and -div w/dt into p. Faces on walls stay zero.
void PlaneFlow::face_velocity_and_divergence() {
    const int nx = setup_.nx, ny = setup_.ny;
    const double h = setup_.spacing, dt = setup_.step;
    const double kept = 1.0 / (1.0 + 4.0 * setup_.viscosity * dt / (h * h));
    const double scale = -1.0 / (h * dt);
    for (int j = 0; j < ny; ++j) {
        const double* __restrict u = u_.row(j);
        const double* __restrict v = v_.row(j);
        const double* __restrict v_above = v_.row(j + 1);
        double* __restrict wx = wx_.row(j);
        double* __restrict wy = wy_.row(j);
        const double* __restrict wy_below = wy_.row(j - 1);
        double* __restrict f = p_.row(j);
        for (int i = 1; i < nx; ++i) wx[i] = 0.5 * (u[i] + u[i - 1]) + kept * wx[i];
        if (j < ny - 1)
            for (int i = 0; i < nx; ++i) wy[i] = 0.5 * (v[i] + v_above[i]) + kept * wy[i];
        for (int i = 0; i < nx; ++i) f[i] = scale * (wx[i + 1] - wx[i] + wy[i] - wy_below[i]);
    }
}

void PlaneFlow::correct_cells() {
    const double c = 0.5 * setup_.step / setup_.spacing;
    for (int j = 0; j < setup_.ny; ++j) {
        const double* __restrict p = p_.row(j);
        const double* __restrict p_above = p_.row(j + 1);
        const double* __restrict p_below = p_.row(j - 1);
        double* __restrict u = u_.row(j);
        double* __restrict v = v_.row(j);
        for (int i = 0; i < setup_.nx; ++i) u[i] -= c * (p[i + 1] - p[i - 1]);
        for (int i = 0; i < setup_.nx; ++i) v[i] -= c * (p_above[i] - p_below[i]);
    }
}

/// Turns the face velocities into e by subtracting their pressure part, and transports momentum.
void PlaneFlow::transport() {
    const int nx = setup_.nx;
    const double c = setup_.step / setup_.spacing;
    std::fill(below_.u.begin(), below_.u.end(), 0.0);
    std::fill(below_.v.begin(), below_.v.end(), 0.0);
    for (int j = 0; j < setup_.ny; ++j) {
        flux_across(j);
        flux_above(j);
        const auto move = [&](const double* __restrict from, double* __restrict to,
                              const std::vector<double>& left, const std::vector<double>& above,
                              const std::vector<double>& below) {
            for (int i = 0; i < nx; ++i)
                to[i] = from[i] - c * (left[i + 1] - left[i] + above[i] - below[i]);
        };
        move(u_.row(j), moved_u_.row(j), left_.u, above_.u, below_.u);
        move(v_.row(j), moved_v_.row(j), left_.v, above_.v, below_.v);
        std::swap(above_, below_);
    }
}

void PlaneFlow::flux_across(int j) {
    cross({1, setup_.nx, 1, u_.row(j), v_.row(j), p_.row(j), u_.row(j), wx_.row(j), left_.u.data(),
           left_.v.data()},
          setup_.step / setup_.spacing);
}

void PlaneFlow::flux_above(int j) {
    if (j == setup_.ny - 1) {
        std::fill(above_.u.begin(), above_.u.end(), 0.0);
        std::fill(above_.v.begin(), above_.v.end(), 0.0);
        return;
    }
    cross({0, setup_.nx, u_.stride(), u_.row(j + 1), v_.row(j + 1), p_.row(j + 1), v_.row(j + 1),
           wy_.row(j), above_.u.data(), above_.v.data()},
          setup_.step / setup_.spacing);
}

}  // namespace turbidite::array_code
