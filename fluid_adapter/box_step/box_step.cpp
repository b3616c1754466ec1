// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_step.hpp"

#include <algorithm>
#include <utility>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

double largest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

AcrossFaces along_row(const double* u) {
    return {u - 2, u - 1, u, u + 1};
}

}  // namespace

BoxStep::BoxStep(const BoxFluid& fluid)
    : BoxStep(fluid, std::make_unique<AllRows>(fluid.pressure)) {}

BoxStep::BoxStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows)
    : fluid_(fluid),
      rows_(std::move(rows)),
      nx_(fluid.pressure.x.cells),
      ny_(rows_->count()),
      hx_(fluid.pressure.x.spacing),
      heights_(fluid.pressure.y, *rows_),
      pressure_(fluid.pressure, rows_->pencils()),
      viscous_{SeparableSolve(fluid.velocity, rows_->pencils()),
               SeparableSolve(fluid.velocity, rows_->pencils())},
      u_(fluid.velocity, *rows_, &side_velocity_[0]),
      v_(fluid.velocity, *rows_, &side_velocity_[1]),
      p_(fluid.pressure, *rows_) {
    pressure_.factorise({0.0, 1.0});
    excess_[0].assign(static_cast<std::size_t>(nx_ + 1) * ny_, 0.0);
    excess_[1].assign(static_cast<std::size_t>(nx_) * (ny_ + 1), 0.0);
    flux_x_.resize(nx_ + 1);
    corrected_u_.resize(nx_ + RowReader::padding);
    for (Row* row : {&flux_below_, &flux_above_, &corrected_below_, &corrected_here_, &result_,
                     &largest_divergence_, &largest_outflow_, &divergence_})
        row->resize(nx_);
    for (SideValues& values : side_velocity_)
        for (int side = 0; side < 4; ++side) values[side].assign(side < 2 ? ny_ : nx_, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
        carried_x_[axis].resize(nx_ + 1);
        carried_below_[axis].resize(nx_);
        carried_above_[axis].resize(nx_);
        if (fluid.second_order) last_flux_[axis].assign(excess_[axis].size(), 0.0);
    }
}

/// k on the faces below row j. On the sides of the box it is 0: e is not carried over there.
double BoxStep::kept_on_row(int j) const {
    const bool side = (j == 0 && !rows_->open_below()) || (j == ny_ && !rows_->open_above());
    return side ? 0.0 : kept_;
}

/// S.u + k e on the x faces of row j.
void BoxStep::flux_along(int j, const double* u, double kept, double* flux) {
    mean_flux(nx_ + 1, halves, u - 1, u, kept, excess_x(j), flux);
    if (fluid_.velocity.x.periodic()) return;
    flux[0] = 0.5 * (u[-1] + u[0]);
    flux[nx_] = 0.5 * (u[nx_ - 1] + u[nx_]);
}

/// S.v + k e on the faces below row j.
void BoxStep::flux_across(int j, double kept, double* flux) {
    const double* low = v_.row(j - 1);
    mean_flux(nx_, heights_.volume_shares(j), low, v_.row(j), kept, excess_y(j), flux);
}

/// S.v + k e - dt dp/dy on the faces below row j.
void BoxStep::projected_across(int j, double dt, double* flux) {
    const double* low = v_.row(j - 1);
    const double* p_low = p_.row(j - 1);
    projected_flux(nx_, heights_.volume_shares(j), low, v_.row(j), kept_on_row(j), excess_y(j),
                   dt / heights_.distance(j), p_low, p_.row(j), flux);
}

FluxReport BoxStep::project(double dt) {
    kept_ = kept_excess(dt);
    begin_projection(dt);
    for (int j = -1; j <= ny_; ++j) correct_row(j, dt);
    return checked(dt);
}

/// Solves for the p that makes S.u + k e solenoidal, and begins to read u and p.
void BoxStep::begin_projection(double dt) {
    u_.begin(velocity(0));
    v_.begin(velocity(1));
    flux_across(0, kept_on_row(0), flux_below_.data());
    pressure_.solve([&](int j) { right_hand_side(j, dt); }, [](int) {});
    u_.begin(velocity(0));
    v_.begin(velocity(1));
    p_.begin(pressure_.values());
    std::fill(largest_divergence_.begin(), largest_divergence_.end(), 0.0);
    std::fill(largest_outflow_.begin(), largest_outflow_.end(), 0.0);
}

FluxReport BoxStep::checked(double dt) const {
    return {largest(largest_divergence_), 0.5 * dt * largest(largest_outflow_)};
}

/// -div(S.u + k e)/dt of row j, written into the right-hand side of the pressure solve.
void BoxStep::right_hand_side(int j, double dt) {
    flux_along(j, u_.row(j), kept_, flux_x_.data());
    flux_across(j + 1, kept_on_row(j + 1), flux_above_.data());
    divergence_row(nx_, -1.0 / (hx_ * dt), flux_x_.data(), flux_x_.data() + 1,
                   -1.0 / (heights_.size(j) * dt), flux_below_.data(), flux_above_.data(),
                   pressure_.values() + static_cast<std::size_t>(j) * nx_);
    flux_below_.swap(flux_above_);
}

/// u1 of row j, and phi1 and e on the faces below it and on its x faces; row j - 1 then has all its
/// fluxes and is checked.
void BoxStep::correct_row(int j, double dt) {
    // v1 = v - dt dp/dy
    RowDifferences{nx_, hx_, heights_}.correct_across(j, dt, p_, v_.row(j), corrected_here_.data());
    if (j >= 0) {
        // phi1 = S.v + k e - dt dp/dy,   e = phi1 - S.v1
        projected_across(j, dt, flux_above_.data());
        excess_of(nx_, heights_.volume_shares(j), flux_above_.data(), corrected_below_.data(),
                  corrected_here_.data(), excess_y(j));
    }
    const std::size_t row = j;
    if (j >= 0) hold_middle(1, row * nx_, nx_, flux_above_.data());
    if (j >= 1) check_row(j - 1, flux_x_.data(), flux_below_.data(), flux_above_.data());
    if (j >= 0 && j < ny_) {
        correct_across(j, dt, p_.row(j));
        hold_middle(0, row * (nx_ + 1), nx_ + 1, flux_x_.data());
    }
    flux_below_.swap(flux_above_);
    corrected_below_.swap(corrected_here_);
}

/// The x component of u1, phi1 and e on the x faces of row j, and u1 of the row into u.
void BoxStep::correct_across(int j, double dt, const double* p) {
    const double* u = u_.row(j);
    double* corrected = corrected_u_.data() + RowReader::beyond;
    correct(nx_, 0.5 * dt / hx_, p - 1, p + 1, u, corrected);  // u1 = u - dt dp/dx
    u_.extend(corrected, j);
    // phi1 = S.u + k e - dt dp/dx,   e = phi1 - S.u1
    flux_along(j, u, kept_, flux_x_.data());
    correct(nx_ + 1, dt / hx_, p - 1, p, flux_x_.data(), flux_x_.data());
    excess_of(nx_ + 1, halves, flux_x_.data(), corrected - 1, corrected, excess_x(j));
    std::copy_n(corrected, nx_, row_of(0, j));
    std::copy(corrected_here_.begin(), corrected_here_.end(), row_of(1, j));
}

/// Divergence and Courant number of row j, from its x fluxes and the fluxes below and above.
void BoxStep::check_row(int j, const double* along, const double* below, const double* above) {
    const double hy = heights_.size(j);
    divergence_row(nx_, 1.0 / hx_, along, along + 1, 1.0 / hy, below, above, divergence_.data());
    keep_largest(nx_, divergence_.data(), largest_divergence_.data());
    keep_largest_outflow(nx_, 1.0 / hx_, along, along + 1, 1.0 / hy, below, above,
                         largest_outflow_.data());
}

FluxReport BoxStep::hold_solenoidal_flux(double dt) {
    for (int axis = 0; axis < 2; ++axis) flux_[axis].resize(excess_[axis].size());
    kept_ = 1.0;
    begin_projection(dt);
    for (int j = 0; j <= ny_; ++j) correct_held_row(j, dt);
    held_ = true;
    return checked(dt);
}

/// S.u + e - dt S.grad p on the faces below row j and on its x faces; row j - 1 then has all its
/// fluxes and is checked.
void BoxStep::correct_held_row(int j, double dt) {
    projected_across(j, dt, held_y(j));
    if (j >= 1) check_row(j - 1, held_x(j - 1), held_y(j - 1), held_y(j));
    if (j == ny_) return;
    flux_along(j, u_.row(j), kept_, held_x(j));
    const double* p = p_.row(j);
    correct(nx_ + 1, dt / hx_, p - 1, p, held_x(j), held_x(j));
}

void BoxStep::transport(double dt, ImpulsesOfWindow* impulses) {
    u_.begin(velocity(0));
    v_.begin(velocity(1));
    if (impulses) begin_impulses(*impulses);
    for (int j = -1; j < ny_; ++j) {
        carry_above(j);
        if (j >= 0) transport_row(j, dt);
        if (j >= 0 && impulses) add_impulses(j, *impulses);
        carried_below_.swap(carried_above_);
    }
}

/// Rows are read before they are written, so u may be the result.
BoxStep::Force BoxStep::play(const VelocityStage& stage) {
    Force force = convective_force(stage.u[0], stage.u[1]);
    if (stage.viscous) {
        const Force viscous = viscous_force(stage.u[0], stage.u[1]);
        for (int axis = 0; axis < 2; ++axis) force[axis] += viscous[axis];
    }
    u_.begin(stage.u[0]);
    v_.begin(stage.u[1]);
    for (int j = -1; j < ny_; ++j) {
        carry_above(j);
        if (stage.viscous) diffuse_between(j + 1);
        if (j >= 0) play_row(j, stage);
        carried_below_.swap(carried_above_);
    }
    return force;
}

/// The flux of momentum by viscosity, nu du/dy, through the faces below row j.
void BoxStep::diffuse_between(int j) {
    const double share = fluid_.viscosity / heights_.distance(j);
    subtract_difference(nx_, share, u_.row(j - 1), u_.row(j), carried_above_[0].data());
    subtract_difference(nx_, share, v_.row(j - 1), v_.row(j), carried_above_[1].data());
}

void BoxStep::play_row(int j, const VelocityStage& stage) {
    const std::array<const double*, 2> u{u_.row(j), v_.row(j)};
    carry_along(j);
    const std::size_t first = static_cast<std::size_t>(j) * nx_;
    for (int axis = 0; axis < 2; ++axis) {
        double* across = carried_x_[axis].data();
        if (stage.viscous)
            subtract_difference(nx_ + 1, fluid_.viscosity / hx_, u[axis] - 1, u[axis], across);
        const StageRows rows{stage.old,
                             stage.fresh,
                             stage.rate,
                             stage.v[axis] + first,
                             stage.now[axis] + first,
                             stage.before[axis] + first};
        stage_row(nx_, rows, u[axis], -stage.dt / hx_, across, across + 1,
                  -stage.dt / heights_.size(j), carried_below_[axis].data(),
                  carried_above_[axis].data(), result_.data());
        std::copy(result_.begin(), result_.end(), stage.result[axis] + first);
        if (!stage.copy.empty())
            std::copy(result_.begin(), result_.end(), stage.copy[axis] + first);
    }
}

void BoxStep::add_impulses(const VelocityStage::Values& u2, ImpulsesOfWindow& impulses) {
    begin_impulses(impulses);
    u_.begin(velocity(0));
    v_.begin(velocity(1));
    for (int j = 0; j < ny_; ++j) {
        u_.row(j + 1);  // before row j is written
        v_.row(j + 1);
        for (int axis = 0; axis < 2; ++axis)
            std::copy_n(u2[axis] + static_cast<std::size_t>(j) * nx_, nx_, row_of(axis, j));
        add_impulses(j, impulses);
    }
}

void BoxStep::begin_impulses(ImpulsesOfWindow& impulses) {
    impulses.f.resize(static_cast<std::size_t>(nx_) * ny_);
    impulses.sum_f = {};
    p_.begin(pressure());
}

double BoxStep::fastest_decay(double dt) const {
    const double hy = fluid_.pressure.y.spacing;
    return 4.0 * fluid_.viscosity * dt * (1.0 / (hx_ * hx_) + 1.0 / (hy * hy));
}

void BoxStep::hold_flux() {
    for (int axis = 0; axis < 2; ++axis) flux_[axis].resize(excess_[axis].size());
    u_.begin(velocity(0));
    v_.begin(velocity(1));
    for (int j = 0; j <= ny_; ++j) {
        const double* u = u_.row(j);
        // phi1 = S.u1 + e
        if (j < ny_) mean_flux(nx_ + 1, halves, u - 1, u, 1.0, excess_x(j), held_x(j));
        flux_across(j, 1.0, held_y(j));
    }
    held_ = true;
}

namespace {

double windows_to_the_middle(bool begins) {
    return begins ? 0.0 : 0.5;
}

}  // namespace

FluxReport BoxStep::project_and_hold_middle(double dt, bool begins) {
    for (int axis = 0; axis < 2; ++axis) flux_[axis].resize(excess_[axis].size());
    extrapolated_ = windows_to_the_middle(begins);
    const FluxReport report = project(dt);
    extrapolated_.reset();
    held_ = true;
    return report;
}

/// Of a row of phi1 over |S|, which begins at `first`.
void BoxStep::hold_middle(int axis, std::size_t first, int count, const double* flux) {
    if (extrapolated_)
        extrapolate(count, *extrapolated_, flux, last_flux_[axis].data() + first,
                    flux_[axis].data() + first);
}

void BoxStep::hold_middle_flux(bool begins) {
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double>& last = last_flux_[axis];
        std::swap(flux_[axis], last);  // phi1 is the next window's last flux
        if (begins) flux_[axis] = last;
        if (!begins) combine(last.size(), -0.5, flux_[axis].data(), 1.5, last.data());
    }
}

/// By the scheme of the case, inside the box.
void BoxStep::carry(int count, const FacePlace& face, const double* flux, const AcrossFaces& u,
                    const AcrossFaces& v, std::array<Row, 2>& carried) const {
    const CarriedRows rows{carried[0].data(), carried[1].data()};
    if (fluid_.central)
        blended_flux(count, *fluid_.central, face, flux, {u, v}, rows);
    else
        convective_flux(count, 2.0 / fluid_.limiter, face, flux, {u, v}, rows);
}

/// Momentum carried through the faces above row j.
void BoxStep::carry_above(int j) {
    const AcrossFaces u{u_.row(j - 1), u_.row(j), u_.row(j + 1), u_.row(j + 2)};
    const AcrossFaces v{v_.row(j - 1), v_.row(j), v_.row(j + 1), v_.row(j + 2)};
    const double* flux = held_ ? held_y(j + 1) : flux_above_.data();
    if (!held_) flux_across(j + 1, 1.0, flux_above_.data());
    carry(nx_, heights_.face(j + 1), flux, u, v, carried_above_);
    const bool side = (j == -1 && !rows_->open_below()) || (j == ny_ - 1 && !rows_->open_above());
    for (int i = 0; side && i < nx_; ++i) {  // the boundary value
        carried_above_[0][i] = 0.5 * flux[i] * (u.low[i] + u.high[i]);
        carried_above_[1][i] = 0.5 * flux[i] * (v.low[i] + v.high[i]);
    }
}

/// Momentum carried through the x faces of row j.
void BoxStep::carry_along(int j) {
    const double *u = u_.row(j), *v = v_.row(j);
    const double* flux = held_ ? held_x(j) : flux_x_.data();
    if (!held_) mean_flux(nx_ + 1, halves, u - 1, u, 1.0, excess_x(j), flux_x_.data());
    carry(nx_ + 1, {}, flux, along_row(u), along_row(v), carried_x_);
    if (!fluid_.velocity.x.periodic())
        for (const int face : {0, nx_}) {  // the boundary value
            carried_x_[0][face] = 0.5 * flux[face] * (u[face - 1] + u[face]);
            carried_x_[1][face] = 0.5 * flux[face] * (v[face - 1] + v[face]);
        }
}

void BoxStep::transport_row(int j, double dt) {
    const double *u = u_.row(j), *v = v_.row(j);
    carry_along(j);
    for (int axis = 0; axis < 2; ++axis) {
        const double* across = carried_x_[axis].data();
        advance_row(nx_, axis == 0 ? u : v, -dt / hx_, across, across + 1, -dt / heights_.size(j),
                    carried_below_[axis].data(), carried_above_[axis].data(), row_of(axis, j));
    }
}

/// Of row j, after its transport; u_ and v_ still read u1.
void BoxStep::add_impulses(int j, ImpulsesOfWindow& impulses) {
    const double dt = impulses.dt;
    const RowDifferences differences{nx_, hx_, heights_};
    for (int axis = 0; axis < 2; ++axis) {
        double* f = impulses.f[axis].data() + static_cast<std::size_t>(j) * nx_;
        differences.laplacian(j, fluid_.viscosity * dt, axis == 0 ? u_ : v_, f);
        impulses.sum_f[axis] += heights_.relative(j) * sum_row(nx_, f);
        add_row(nx_, 1.0, f, row_of(axis, j));
    }
    const double* p = p_.row(j);
    correct(nx_, 0.5 * dt / hx_, p - 1, p + 1, row_of(0, j), row_of(0, j));
    differences.correct_across(j, dt, p_, row_of(1, j), row_of(1, j));
}

void BoxStep::diffuse(double dt, const SeparableSolve::LayerWork& take) {
    if (factorised_for_ != dt)
        for (SeparableSolve& solve : viscous_) solve.factorise({1.0, fluid_.viscosity * dt});
    factorised_for_ = dt;
    add_side_velocity(dt);
    viscous_[0].solve();
    viscous_[1].solve([](int) {}, take);
}

/// What a prescribed u_b contributes to the right-hand side of step 3: dt nu 2 u_b/h2, since the
/// solve itself takes the image beyond the side to be -u.
void BoxStep::add_side_velocity(double dt) {
    const double across_x = 2.0 * fluid_.viscosity * dt / (hx_ * hx_);
    const auto across_y = [&](int j) {
        return 2.0 * fluid_.viscosity * dt / (heights_.size(j) * heights_.size(j));
    };
    const double at_bottom = across_y(0), at_top = across_y(ny_ - 1);
    for (int axis = 0; axis < 2; ++axis) {
        for (int j = 0; j < ny_; ++j) {
            row_of(axis, j)[0] += across_x * at_side(axis, 0, j);
            row_of(axis, j)[nx_ - 1] += across_x * at_side(axis, 1, j);
        }
        for (int i = 0; i < nx_; ++i) {
            if (!rows_->open_below()) row_of(axis, 0)[i] += at_bottom * at_side(axis, 2, i);
            if (!rows_->open_above()) row_of(axis, ny_ - 1)[i] += at_top * at_side(axis, 3, i);
        }
    }
}

/// Sums per_cell(side, at, cell, face) |S| over the cells along the non-cyclic sides. Sides 0 to 3
/// are left, right, bottom, top; `at` is the place along the side, `face` the index of the boundary
/// face in excess(side/2).
template <class PerCell>
BoxStep::Force BoxStep::over_sides(PerCell per_cell) {
    Force sum{};
    const auto add = [&](int side, int at, std::size_t cell, std::size_t face, double length) {
        const Force one = per_cell(side, at, cell, face);
        for (int axis = 0; axis < 2; ++axis) sum[axis] += length * one[axis];
    };
    const std::size_t nx = nx_, ny = ny_;
    if (!fluid_.velocity.x.periodic())
        for (std::size_t j = 0; j < ny; ++j) {
            add(0, j, j * nx, j * (nx + 1), heights_.size(j));
            add(1, j, j * nx + nx - 1, j * (nx + 1) + nx, heights_.size(j));
        }
    for (std::size_t i = 0; i < nx && !rows_->open_below(); ++i) add(2, i, i, i, hx_);
    for (std::size_t i = 0; i < nx && !rows_->open_above(); ++i)
        add(3, i, (ny - 1) * nx + i, ny * nx + i, hx_);
    return sum;
}

namespace {

End end_at(const SeparableOperator& plane, int side) {
    const AxisOperator& axis = side < 2 ? plane.x : plane.y;
    return side % 2 == 0 ? axis.lower : axis.upper;
}

/// Value at the boundary face over the value in the cell next to it.
double at_face(const SeparableOperator& plane, int side) {
    return 0.5 * (1.0 + mirrored(end_at(plane, side)));
}

}  // namespace

BoxStep::Force BoxStep::pressure_force() {
    return over_sides([&](int side, int, std::size_t cell, std::size_t) {
        Force force{};
        force[side / 2] =
            (side % 2 == 0 ? 1.0 : -1.0) * at_face(fluid_.pressure, side) * pressure()[cell];
        return force;
    });
}

BoxStep::Force BoxStep::convective_force() {
    return convective_force(velocity(0), velocity(1));
}

BoxStep::Force BoxStep::convective_force(const double* u_x, const double* u_y) {
    return over_sides([&](int side, int at, std::size_t cell, std::size_t face) {
        const double share = at_face(fluid_.velocity, side);
        const Force u{share * u_x[cell] + at_side(0, side, at),
                      share * u_y[cell] + at_side(1, side, at)};
        const int axis = side / 2;
        const double flux = held_ ? flux_[axis][face] : u[axis] + excess_[axis][face];
        const double inward = side % 2 == 0 ? flux : -flux;
        return Force{inward * u[0], inward * u[1]};
    });
}

BoxStep::Force BoxStep::viscous_force() {
    return viscous_force(velocity(0), velocity(1));
}

BoxStep::Force BoxStep::viscous_force(const double* u_x, const double* u_y) {
    const auto across = [&](int side) {  // h
        return side < 2 ? hx_ : heights_.size(side == 2 ? 0 : ny_ - 1);
    };
    return over_sides([&](int side, int at, std::size_t cell, std::size_t) {
        const double difference = mirrored(end_at(fluid_.velocity, side)) - 1.0;
        const double per_length = fluid_.viscosity / across(side);
        const auto rate = [&](int axis) {  // nu (u_{-1} - u_0)/h
            return per_length *
                   (difference * (axis == 0 ? u_x : u_y)[cell] + 2.0 * at_side(axis, side, at));
        };
        return Force{rate(0), rate(1)};
    });
}

}  // namespace turbidite
