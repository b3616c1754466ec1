// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/second_order.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

const double diagonal = 1.0 - std::sqrt(0.5);  // g

void add(SideForce& sum, double share, const SideForce& force) {
    for (int axis = 0; axis < 2; ++axis) sum[axis] += share * force[axis];
}

}  // namespace

void SecondOrder::copy(SecondOrderHost& host, Pieces& to) const {
    const std::vector<VelocityValues> pieces = host.velocity_values();
    to.resize(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k)
        to[k].assign(pieces[k].first, pieces[k].first + pieces[k].count);
}

/// u = old_share v + new_share u + rate_share dt s.
void SecondOrder::combine(SecondOrderHost& host, const Pieces& v, double old_share,
                          double new_share, double rate_share) const {
    const std::vector<VelocityValues> pieces = host.velocity_values();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const std::size_t n = pieces[k].count;
        if (goes_on_)
            combine_stage(n, old_share, v[k].data(), new_share, rate_share, window_start_[k].data(),
                          carried_[k].data(), pieces[k].first);
        else
            combine_stage(n, old_share, v[k].data(), new_share, pieces[k].first);
    }
    host.velocity_changed();
}

/// Over `share` of the window; at the end of the last one s is taken off.
SideForce SecondOrder::sub_step(SecondOrderHost& host, double share, bool last) {
    const double d = share * dt_;
    const Pieces& v = share < 1.0 ? part_start_ : window_start_;
    if (share < 1.0) copy(host, part_start_);
    SideForce force{};
    add(force, 1.0 / 6.0, host.convect(d));
    combine(host, v, 0.0, 1.0, share);
    add(force, 1.0 / 6.0, host.convect(d));
    combine(host, v, 0.75, 0.25, 0.25 * share);
    add(force, 2.0 / 3.0, host.convect(d));
    combine(host, v, 1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0 * share - (last ? 1.0 : 0.0));
    return force;
}

std::vector<SideForce> SecondOrder::transport(SecondOrderHost& host, double dt, int parts) {
    dt_ = dt;
    copy(host, window_start_);
    std::vector<SideForce> forces;
    for (int part = 0; part < parts; ++part)
        forces.push_back(sub_step(host, 1.0 / parts, part + 1 == parts));
    copy(host, carried_);
    goes_on_ = true;
    return forces;
}

SideForce SecondOrder::diffuse(SecondOrderHost& host, double dt) {
    const double g = diagonal;
    SideForce force{};
    const std::vector<VelocityValues> pieces = host.velocity_values();
    for (std::size_t k = 0; k < pieces.size(); ++k)  // u1 + g c
        combine_stage(pieces[k].count, 1.0 - g, window_start_[k].data(), g, pieces[k].first);
    host.velocity_changed();
    add(force, 1.0 - g, host.diffuse_implicitly(g * dt));
    for (std::size_t k = 0; k < pieces.size(); ++k)  // u1 + (1 - g)/g (y1 - u1) + g c
        combine_stage(pieces[k].count, 1.0 - (1.0 - g) / g, window_start_[k].data(), (1.0 - g) / g,
                      -g, window_start_[k].data(), carried_[k].data(), pieces[k].first);
    host.velocity_changed();
    add(force, g, host.diffuse_implicitly(g * dt));
    return force;
}

void SecondOrder::append_memory(SecondOrderHost& host, std::vector<double>& values) {
    if (carried_.empty()) copy(host, carried_);
    values.push_back(goes_on_ ? 1.0 : 0.0);
    for (const std::vector<double>& piece : carried_)
        values.insert(values.end(), piece.begin(), piece.end());
}

void SecondOrder::set_memory(SecondOrderHost& host, const double* values) {
    if (carried_.empty()) copy(host, carried_);
    goes_on_ = *values++ > 0.0;
    for (std::vector<double>& piece : carried_)
        for (double& value : piece) value = *values++;
}

}  // namespace turbidite
