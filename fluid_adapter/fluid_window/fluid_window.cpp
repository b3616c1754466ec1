// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/fluid_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "coupler/protocol/scene/splitting.hpp"

namespace turbidite {
namespace {

/// explicit-multiplier corrects once.
CoupledLimits coupled_limits(const Settings& settings) {
    const RunValues run = run_values(settings);
    CoupledLimits limits;
    if (!splitting_of(settings).rigid_grains) return limits;
    const auto most = static_cast<int>(settings.integer("fluid.splitting_iterations"));
    limits.viscosity.most = most;
    if (!splitting_of(settings).iterated) return limits;
    limits.iterated = true;
    // u_c/D [1/s] for the divergence, u_c^2/D [m/s2] for the missing viscous acceleration
    const double rate = settings.real("fluid.splitting_tolerance") * run.velocity / run.diameter;
    limits.viscosity = {most, rate * run.velocity};
    limits.pressure = {most, rate};
    return limits;
}

/// Where rows of cells are stretched a grain is not resolved as the case asks.
double highest_grain(const FluidStore& store, const Settings& settings) {
    const double height = store.equal_height();
    const bool any = std::isinf(height) || settings.flag("fluid.allow_coarse");
    return any ? std::numeric_limits<double>::infinity() : height;
}

/// Contacts are about to change what is found: a few iterations of pressure are saved.
CoupledLimits before_contacts(CoupledLimits limits) {
    limits.pressure.tolerance *= 3.0;
    return limits;
}

}  // namespace

FluidWindow::FluidWindow(FluidStore& store, const Settings& settings, const ShapeTable& shapes)
    : run_(run_values(settings)),
      store_(store),
      field_(store.field()),
      step_(store.step()),
      highest_grain_(highest_grain(store, settings)),
      ledger_(field_, store.density()),
      multipliers_(field_, settings, shapes),
      coupled_limits_(coupled_limits(settings)),
      watch_(store) {}

void FluidWindow::advance(const Window& window) {
    begin(window);
    // Before step 1, whose body force (`drive`) is part of the balance.
    ledger_.open(window.step);
    watch_.play("step 1 (projection)", timings_.projection, [&] { project(); });
    watch_.play("step 2 (transport)", timings_.transport, [&] { transport(); });
    watch_.play("step 3 (viscosity)", timings_.viscosity, [&] { diffuse(); });
    check_finite(step_.finite(), "steps 1-3 (projection, transport, viscosity)");
}

void FluidWindow::let_fall(const std::vector<GrainState>& grains) {
    check_rows(grains);
    answer("step 5 (free grains)", [&] { multipliers_.take_free(grains, window_); });
}

void FluidWindow::correct(const std::vector<GrainState>& grains) {
    // Under `joint` let_fall has taken the grains, and these are the results of their contacts;
    // under `split` this is the first time that they come.
    if (!so_far_.grains_taken) check_rows(grains);
    if (!so_far_.grains_taken)
        return answer("step 5 (multipliers)",
                      [&] { multipliers_.take_constrained(grains, window_); });
    watch_.play("step 5 (contact impulses)", timings_.multipliers,
                [&] { note(multipliers_.push(grains)); });
    // implicit-multiplier, after every round: what the contacts change is not solenoidal.
    if (coupled_limits_.iterated) correct_fluid(coupled_limits_);
}

std::vector<FreeResponse> FluidWindow::responses() {
    std::vector<FreeResponse> responses;
    watch_.play("step 5 (responses)", timings_.multipliers,
                [&] { responses = multipliers_.responses(); });
    return responses;
}

Kicks FluidWindow::impose() {
    watch_.play("step 5 (multipliers)", timings_.multipliers, [&] {
        if (lambda_is_seen()) step_.put_unconstrained();  // u3
        multipliers_.impose();
        // Those of pressure and viscosity with rigid grains are known only now.
        for (const BoundaryForce& force : step_.end_coupled()) ledger_.add(force);
        fields_follow_ = false;
        if (lambda_is_seen()) field_.put_force_density(multipliers_.constraint());
        // After put_force_density, which needs the u3 that the fields still have.
        field_.store(multipliers_.constraint());
        close_ledger();
    });
    check_finite(ledger_.finite(), "step 5 (multipliers)");
    if (window_.write_output) watch_.play("output", timings_.output, [&] { write_fields(); });
    if (store_.observed())
        watch_.play("function objects", timings_.output, [&] {
            put_fields();
            store_.show(multipliers_.grains());
        });
    if (so_far_.jumped) forget_jump();
    report_.wall_seconds = timings_.together();
    return {multipliers_.kicks(), report_};
}

void FluidWindow::begin(const Window& window) {
    window_ = window;
    watch_.begin(window);
    timings_ = {};
    report_ = {};
    so_far_ = {};
    // An array per component, only for windows whose lambda somebody sees.
    if (CoupledStep* coupled = step_.coupled()) coupled->keep_unconstrained(lambda_is_seen());
    // Before step 1, which sees what sides hold in this window.
    const MovedSides sides = store_.begin(window);
    if (sides.any) step_.sides_changed();
    so_far_.flows_in = sides.through > 1e-9 * run_.velocity;
    step_.begin(window.step);
    fields_follow_ = false;
}

/// At the end of the present window.
bool FluidWindow::lambda_is_seen() const {
    return field_.shows_force_density() && (window_.write_output || store_.observed());
}

void FluidWindow::project() {
    if (!step_.coupled()) drive();
    const Projection projection = step_.project();
    ledger_.add(projection.force);
    report_.divergence = projection.flux.divergence;
    report_.courant = projection.flux.courant;
    parts_ = step_.parts(projection.flux.carried_courant);
}

/// u += a dt in every cell, those of grains included: the force on a grain contains that of the
/// mean pressure gradient. It acts with the pressure: before the projection, and after transport
/// where p^n acts there, so that what is carried in a steady flow is that flow.
void FluidWindow::drive() {
    if (run_.acceleration == Vec3{}) return;
    field_.accelerate(window_.step * run_.acceleration);
    // The ledger multiplies by rho_f dt.
    const Vec3 rate = volume() * run_.acceleration;
    ledger_.add(BoundaryForce{rate[0], rate[1], rate[2]});
}

void FluidWindow::transport() {
    ledger_.add(step_.transport(parts_));
    if (step_.coupled()) drive();
}

void FluidWindow::diffuse() {
    ledger_.add(step_.diffuse());
}

/// Takes the grains of this window and solves for their multipliers.
template <class Take>
void FluidWindow::answer(const char* name, Take take) {
    // Points first: what is loaded are the velocities in the cells that they need.
    watch_.play(name, timings_.points, take);
    if (ledger_.began_at_rest()) watch_.play(name, timings_.points, [&] { begin_in_motion(); });
    watch_.play(name, timings_.multipliers, [&] {
        field_.load(multipliers_.constraint());
        note(multipliers_.solve());
    });
    if (CoupledStep* coupled = step_.coupled())
        coupled->place_grains(multipliers_.constraint(), run_.acceleration);
    correct_fluid(before_contacts(coupled_limits_));
    so_far_.grains_taken = true;
}

/// The window in which bodies or an inflow set a fluid at rest in motion. The fluid around bodies
/// takes its share through the pressure (added mass).
void FluidWindow::begin_in_motion() {
    double moving[] = {multipliers_.begins_in_motion() ? 1.0 : 0.0,
                       multipliers_.is_driven() ? 1.0 : 0.0};
    store_.ranks().max(moving, 2);
    const bool bodies_move = moving[0] + moving[1] > 0.0;
    if (moving[0] > 0.0) carry_along();
    // The jump is no rate of change that the next window should go on with. Where step 1 projects
    // the velocity, an inflow has made it before transport.
    if (bodies_move || (so_far_.flows_in && step_.coupled())) step_.forget_rates();
    so_far_.jumped = bodies_move || so_far_.flows_in;
}

/// Grains that begin with a velocity begin with it in the cells that they cover too; otherwise the
/// fluid there would take it from them.
void FluidWindow::carry_along() {
    const Vec3 before = field_.momentum().sum;
    field_.load(multipliers_.constraint());
    note(multipliers_.carry_fluid_along());
    field_.store(multipliers_.constraint());
    ledger_.begin_with(field_.momentum().sum - before);
    // s contains it.
    if (CoupledStep* coupled = step_.coupled()) coupled->keep_transported();
}

/// The pressure that sets the fluid around in motion is an impulse over dt, and not that of the
/// next window, which finds its own.
void FluidWindow::forget_jump() {
    if (coupled_limits_.iterated) return;
    step_.forget_pressure();
    fields_follow_ = false;
}

bool FluidWindow::begins_without_pressure(const CoupledStep& coupled) const {
    if (ledger_.began_at_rest()) return true;
    double has_one = coupled.begins_without_pressure() ? 0.0 : 1.0;
    store_.ranks().max(&has_one, 1);
    return has_one == 0.0;
}

/// Pressure and viscosity of the fluid with these grains, where the splitting corrects them.
void FluidWindow::correct_fluid(CoupledLimits limits) {
    CoupledStep* coupled = step_.coupled();
    if (!coupled) return;
    // Without a pressure to begin with, at the start of a run and after a jump, one iteration would
    // leave too much of it. What is below the tolerance is rounding.
    if (!limits.iterated && begins_without_pressure(*coupled))
        limits.pressure = {limits.viscosity.most, 1e-9 * run_.velocity / run_.diameter, 1e-3};
    watch_.play("step 5 (pressure and viscosity)", timings_.correction, [&] {
        // Pressure and viscosity change an imposed velocity by rigid changes, and the multipliers
        // go on from what has been imposed.
        multipliers_.impose();
        RigidGrains grains(multipliers_.constraint(), field_.velocities(), field_.owned_cells());
        note(coupled->correct(grains, limits));
        report_.multiplier_iterations += grains.iterations();
        report_.multipliers_converged = report_.multipliers_converged && grains.converged();
    });
}

/// Iterations of all corrections of a window; what is left, by the last one.
void FluidWindow::note(const CoupledReport& result) {
    if (!report_.splitting) report_.splitting.emplace();
    SplittingReport& splitting = *report_.splitting;
    splitting.pressure_iterations += result.pressure.iterations;
    splitting.viscous_iterations += result.viscosity.iterations;
    splitting.divergence = result.pressure.residual;
    splitting.viscous_residual = result.viscosity.residual;
    splitting.converged = splitting.converged && result.converged;
    // That of `settle`, which came last
    if (coupled_limits_.iterated) report_.multiplier_residual = result.slip.residual;
}

/// Accumulates the results of all solves of a window.
void FluidWindow::note(const MultiplierResult& result) {
    report_.multiplier_iterations += result.iterations;
    // Of the last solve, while iterations are those of all.
    report_.multiplier_residual = result.residual;
    report_.multipliers_converged = report_.multipliers_converged && result.converged;
    if (result.converged) return;
    std::ostringstream line;
    line << "window " << window_.index << ": multipliers not converged after " << result.iterations
         << " iterations, rms slip " << result.residual;
    store_.log(line.str());
}

void FluidWindow::close_ledger() {
    Vec3 to_grains = multipliers_.impulse_to_grains().linear;
    // Each body has been counted on one rank.
    field_.sum_over_ranks(to_grains.data(), 3);
    report_.momentum_defect = ledger_.close(to_grains);
    report_.mean_velocity = ledger_.momentum() / (run_.fluid_density * volume());
}

/// Of the domain [m3], per unit length in the plane.
double FluidWindow::volume() const {
    const double area = run_.size[0] * run_.size[1];
    return run_.dimension == 3 ? area * run_.size[2] : area;
}

void FluidWindow::check_finite(bool finite, const char* steps) const {
    if (!finite) watch_.refuse(steps, "the fluid velocity is not finite; use a smaller time.step");
}

void FluidWindow::check_rows(const std::vector<GrainState>& grains) const {
    if (std::isinf(highest_grain_)) return;
    // Of the cells that it covers, too
    const auto top = [this](const GrainState& grain) {
        const double seen = run_.hydrodynamic_radius * grain.radius + run_.surface_shift;
        return grain.position[1] + std::max(grain.radius, seen);
    };
    const auto highest =
        std::max_element(grains.begin(), grains.end(),
                         [&](const GrainState& a, const GrainState& b) { return top(a) < top(b); });
    double height = highest == grains.end() ? 0.0 : top(*highest);
    const double own = height;
    store_.ranks().max(&height, 1);
    if (height <= highest_grain_ * (1.0 + 1e-9)) return;
    // The grain is named by the rank that has it; the others offer -1.
    double id = height == own && highest != grains.end() ? static_cast<double>(highest->id) : -1.0;
    store_.ranks().max(&id, 1);
    std::ostringstream why;
    why << "grain " << static_cast<long long>(id) << " reaches y = " << height / run_.diameter
        << " D, and rows of cells are stretched above " << highest_grain_ / run_.diameter
        << " D; use a larger fluid.stretch_from, or fluid.allow_coarse = true";
    watch_.refuse("step 5 (rows of cells)", why.str());
}

void FluidWindow::write_fields() {
    put_fields();
    report_.final_divergence = store_.largest_divergence();
    std::ostringstream line;
    line << "window " << window_.index << ": Courant number " << report_.courant
         << ", transport in " << parts_.count << " parts; largest divergence " << report_.divergence
         << " 1/s after step 1, " << report_.final_divergence << " 1/s after step 5; multipliers "
         << report_.multiplier_iterations << " iterations, rms slip " << report_.multiplier_residual
         << " m/s";
    store_.log(line.str());
    report_.probes = store_.probes();
    store_.write_slices(multipliers_.grains());
    if (fields_due()) store_.write(multipliers_.grains());
}

/// An output out of turn is that of an interrupted run.
bool FluidWindow::fields_due() const {
    const std::int64_t done = window_.index + 1;
    return done % run_.fields_every == 0 || done % run_.output_every != 0 || store_.finished();
}

void FluidWindow::put_fields() {
    if (fields_follow_) return;
    step_.put_velocity();
    step_.put_pressure();
    store_.interpolate_flux();
    fields_follow_ = true;
}

void FluidWindow::velocity_changed() {
    step_.take_velocity();
    fields_follow_ = false;
    step_.forget_rates();
    ledger_.forget();
}

void FluidWindow::fields_replaced() {
    step_.take_velocity();
    ledger_.forget();
    // Rates and excess fluxes have come with the state: nothing is forgotten but the ledger's P.
    fields_follow_ = true;
}

}  // namespace turbidite
