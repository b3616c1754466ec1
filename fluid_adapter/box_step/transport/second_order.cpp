// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/transport/second_order.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_adapter/box_step/row_work.hpp"
#include "fluid_adapter/box_step/transport/transport_parts.hpp"

namespace turbidite {
namespace {

const double diagonal = 1.0 - std::sqrt(0.5);  // g

// Of a sub-step: the scheme is stable up to a decay of 2.51, and convection takes of it.
constexpr double largest_decay = 2.0;

void add(SideForce& sum, double share, const SideForce& force) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += share * force[axis];
}

VelocityStage::Values pieces_of(SecondOrderHost& host) {
    VelocityStage::Values values;
    for (const VelocityValues& piece : host.velocity_values()) values.push_back(piece.first);
    return values;
}

}  // namespace

TransportParts SecondOrder::parts(double relative_courant, double decay) {
    // Convection and viscosity share the region of stability: their parts of it add up. With decay
    // <= largest_decay viscosity adds at most 1, one sub-step.
    const bool viscous = decay <= largest_decay;
    const double share = viscous ? decay / largest_decay : 0.0;
    return {transport_parts(relative_courant + share, 1.0), viscous};
}

/// Arrays of the size of the velocity.
VelocityStage::Values SecondOrder::room(SecondOrderHost& host, Pieces& pieces) const {
    const std::vector<VelocityValues> velocity = host.velocity_values();
    pieces.resize(velocity.size());
    VelocityStage::Values values;
    for (std::size_t k = 0; k < velocity.size(); ++k) {
        pieces[k].resize(velocity[k].count);
        values.push_back(pieces[k].data());
    }
    return values;
}

void SecondOrder::make_room(SecondOrderHost& host) {
    carried_values_ = room(host, carried_);
}

/// Over `share` of the window, from `stage.v`; at the end of the last one s is taken off.
SideForce SecondOrder::sub_step(SecondOrderHost& host, VelocityStage stage, double share,
                                bool last) {
    const VelocityStage::Values result = stage.result, copy = stage.copy;
    // rate (now - before) is a share of dt s = u1^n - u2^{n-1}: all of it in a window, `share` in a
    // sub-step. Without an earlier window s = 0.
    const double steered = goes_on_ ? 1.0 : 0.0;
    SideForce force{};
    stage.u = stage.v;
    stage.result = room(host, working_);
    stage.copy.clear();
    // v1 = v + d (L(v) + s)
    stage.old = 0.0, stage.fresh = 1.0, stage.rate = steered * share;
    add(force, 1.0 / 6.0, host.play(stage));
    stage.u = stage.result;
    // v2 = 3/4 v + 1/4 (v1 + d (L(v1) + s))
    stage.old = 0.75, stage.fresh = 0.25, stage.rate = steered * 0.25 * share;
    add(force, 1.0 / 6.0, host.play(stage));
    stage.result = result, stage.copy = copy;
    // v = 1/3 v + 2/3 (v2 + d (L(v2) + s)), less dt s in the last sub-step: u2 has L alone
    stage.old = 1.0 / 3.0, stage.fresh = 2.0 / 3.0;
    stage.rate = steered * (2.0 / 3.0 * share - (last ? 1.0 : 0.0));
    add(force, 2.0 / 3.0, host.play(stage));
    return force;
}

std::vector<SideForce> SecondOrder::transport(SecondOrderHost& host, double dt,
                                              TransportParts parts) {
    const VelocityStage::Values velocity = pieces_of(host);  // u1
    make_room(host);
    VelocityStage stage;
    stage.viscous = parts.viscous;
    stage.dt = dt / parts.count;
    stage.v = stage.now = velocity;
    // u2 of the last window, until the last sub-step writes this window's in its place
    stage.before = carried_values_;
    std::vector<SideForce> forces;
    for (int part = 1; part <= parts.count; ++part) {
        const bool last = part == parts.count;
        stage.result = last ? carried_values_ : room(host, part_start_);
        // u2 is u3 then, which is the velocity and the memory of the next window.
        if (last && parts.viscous) stage.copy = velocity;
        forces.push_back(sub_step(host, stage, 1.0 / parts.count, last));
        // The next sub-step begins where this one has ended, with the same flux.
        stage.v = stage.result;
    }
    goes_on_ = true;
    if (parts.viscous) host.velocity_changed();
    return forces;
}

SideForce SecondOrder::diffuse(SecondOrderHost& host, double dt) {
    const double g = diagonal, a = (1.0 - g) / g;
    const std::vector<VelocityValues> u = host.velocity_values();
    const VelocityStage::Values start = room(host, working_);  // u1
    SideForce force{};
    for (std::size_t k = 0; k < u.size(); ++k) {  // u1 + g c
        std::copy_n(u[k].first, u[k].count, start[k]);
        combine(u[k].count, 1.0 - g, u[k].first, g, carried_values_[k]);
    }
    host.velocity_changed();
    // y1; u3 = u1 + dt ((1 - g) R(y1) + g R(u3)) with R = nu laplacian + C gives the shares.
    add(force, 1.0 - g, host.diffuse_implicitly(g * dt));
    for (std::size_t k = 0; k < u.size(); ++k)  // u1 + (1 - g)/g (y1 - u1) + g c
        combine(u[k].count, a, u[k].first, 1.0 - a - g, start[k], g, carried_values_[k]);
    host.velocity_changed();
    add(force, g, host.diffuse_implicitly(g * dt));
    return force;
}

void SecondOrder::visit_memory(SecondOrderHost& host, const ValuesVisit& visit) {
    make_room(host);
    // A number like all others, since a saved state is made of arrays of doubles
    double goes_on = goes_on_ ? 1.0 : 0.0;
    visit(&goes_on, 1);
    goes_on_ = goes_on > 0.0;
    for (std::vector<double>& piece : carried_) visit(piece.data(), piece.size());
}

void SecondOrder::append_memory(SecondOrderHost& host, std::vector<double>& values) {
    visit_memory(host, [&](const double* first, std::size_t count) {
        values.insert(values.end(), first, first + count);
    });
}

void SecondOrder::set_memory(SecondOrderHost& host, const double* values) {
    visit_memory(host, [&](double* first, std::size_t count) {
        std::copy_n(values, count, first);
        values += count;
    });
}

}  // namespace turbidite
