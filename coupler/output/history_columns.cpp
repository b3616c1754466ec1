// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of columns. New columns are appended. Contact forces are in rho_s g D^2, in space
// rho_s g D^3, stresses in rho_s g D, rho_s the mean density of the grains. In the plane a volume
// is one per unit length.
#include <fmt/format.h>

#include <cmath>

#include "coupler/output/history.hpp"

namespace turbidite {
namespace {

using Cell = const RowValues&;
using Text = std::string (*)(Cell);

std::string number(double value) {
    return fmt::format("{:.10g}", value);
}
std::string number(const std::optional<double>& value) {
    return value ? number(*value) : "";
}

bool in_space(Cell c) {
    return c.run.dimension == 3;
}

/// D, in the plane 1: what a quantity of space has more.
double depth(Cell c) {
    return in_space(c) ? c.run.diameter : 1.0;
}

// Each is empty unless there are grains, contact results, a fluid, or wall times, respectively.
std::string mean(Cell c, double value) {
    return c.row.state->grains.empty() ? "" : number(value);
}
template <class Value>
std::string contact(Cell c, Value ContactReport::*value) {
    return c.row.contact ? number(c.row.contact->*value) : "";
}
std::string fluid(Cell c, double (*value)(Cell)) {
    return c.row.fluid ? number(value(c)) : "";
}
std::string wall(Cell c, double WallTimes::*part) {
    if (!c.row.since) return "";
    return fmt::format("{:.6f}",
                       c.row.since->wall.*part / static_cast<double>(c.row.since->windows));
}

// Empty unless contacts were sent.
template <class Value>
std::string network(Cell c, Value ContactNetwork::*value) {
    return c.network ? number((*c.network).*value) : "";
}
std::string fabric(Cell c, double Fabric::*value) {
    return c.network && c.network->fabric ? number((*c.network->fabric).*value) : "";
}

/// Weight per area of a layer of solid one diameter high: rho_s g D.
double pressure_unit(Cell c) {
    // mass over volume of all grains: rho_s
    return c.mean.mass / c.mean.solid * c.run.gravity * c.run.diameter;
}
/// sigma = virial / V over rho_s g D, V the volume of the grains and the pores between them.
std::string stress(Cell c, double Symmetric3::*part) {
    if (!c.network || !c.network->has_branches || c.row.state->grains.empty()) return "";
    return number(c.network->virial.*part / (c.mean.solid + c.pores) / pressure_unit(c));
}

/// A component of the sum of F_h over rho_f u_c^2 D, in space over rho_f u_c^2 D^2.
double force(Cell c, std::size_t axis) {
    return c.row.fluid_force[axis] /
           (c.run.fluid_density * c.run.velocity * c.run.velocity * c.run.diameter * depth(c));
}

/// Empty in the plane.
template <class Text>
std::string of_space(Cell c, Text text) {
    return in_space(c) ? text() : std::string();
}

/// Work since the last row over the mass of all grains times u_c^2.
std::string work(Cell c, double GrainWork::*part) {
    if (!c.row.since || c.row.state->grains.empty()) return "";
    return number(c.row.since->work.*part / (c.mean.mass * c.run.velocity * c.run.velocity));
}

/// Empty with marchuk-yanenko.
template <class Value>
std::string splitting(Cell c, Value value) {
    return c.row.fluid && c.row.fluid->splitting ? number(value(*c.row.fluid->splitting)) : "";
}

struct Column {
    const char* name;
    Text text;
};

const std::vector<Column> columns = {
    {"step", [](Cell c) { return std::to_string(c.row.step); }},
    {"time", [](Cell c) { return number(c.row.time / c.run.time); }},
    {"mean_velocity_x", [](Cell c) { return mean(c, c.mean.velocity[0] / c.run.velocity); }},
    {"mean_velocity_y", [](Cell c) { return mean(c, c.mean.velocity[1] / c.run.velocity); }},
    {"mean_velocity_norm",
     [](Cell c) {
         const Vec3& u = c.mean.velocity;
         return mean(c, std::hypot(u[0], u[1], u[2]) / c.run.velocity);
     }},
    {"mean_speed", [](Cell c) { return mean(c, c.mean.speed / c.run.velocity); }},
    {"mean_position_x", [](Cell c) { return mean(c, c.mean.position[0] / c.run.diameter); }},
    {"mean_position_y", [](Cell c) { return mean(c, c.mean.position[1] / c.run.diameter); }},
    {"front_x", [](Cell c) { return mean(c, c.mean.front / c.run.diameter); }},
    {"kinetic_energy",
     [](Cell c) {
         return mean(c, c.mean.kinetic_energy / (c.mean.mass * c.run.velocity * c.run.velocity));
     }},
    {"grains", [](Cell c) { return std::to_string(c.row.state->grains.size()); }},
    {"contacts", [](Cell c) { return contact(c, &ContactReport::contacts); }},
    {"max_penetration",
     [](Cell c) { return number(c.row.state->report.max_penetration / c.run.diameter); }},
    {"contact_iterations", [](Cell c) { return contact(c, &ContactReport::iterations); }},
    {"contact_residual", [](Cell c) { return contact(c, &ContactReport::residual); }},
    {"multiplier_iterations",
     [](Cell c) {
         return fluid(c, [](Cell r) { return double(r.row.fluid->multiplier_iterations); });
     }},
    {"multiplier_residual",
     [](Cell c) {
         return fluid(c, [](Cell r) { return r.row.fluid->multiplier_residual / r.run.velocity; });
     }},
    {"divergence",
     [](Cell c) {
         return fluid(
             c, [](Cell r) { return r.row.fluid->divergence * r.run.diameter / r.run.velocity; });
     }},
    {"pore_volume",
     [](Cell c) { return mean(c, c.pores / (c.run.diameter * c.run.diameter * depth(c))); }},
    {"wall_step", [](Cell c) { return wall(c, &WallTimes::step); }},
    {"wall_fluid", [](Cell c) { return c.row.fluid ? wall(c, &WallTimes::fluid) : std::string(); }},
    {"wall_grains", [](Cell c) { return wall(c, &WallTimes::grains); }},
    {"wall_coupling", [](Cell c) { return wall(c, &WallTimes::coupling); }},
    {"grain_balance", [](Cell c) { return number(c.row.grain_balance); }},
    {"fluid_balance",
     [](Cell c) { return fluid(c, [](Cell r) { return r.row.fluid->momentum_defect; }); }},
    {"joint_rounds", [](Cell c) { return c.row.joint ? std::to_string(c.row.joint->rounds) : ""; }},
    {"joint_mismatch",
     [](Cell c) { return c.row.joint ? number(c.row.joint->mismatch / c.run.velocity) : ""; }},
    {"contact_quad", [](Cell c) { return contact(c, &ContactReport::quad); }},
    {"contact_max", [](Cell c) { return contact(c, &ContactReport::max); }},
    {"unconverged",
     [](Cell c) { return c.row.since ? std::to_string(c.row.since->unconverged) : ""; }},
    {"coordination", [](Cell c) { return network(c, &ContactNetwork::coordination); }},
    {"loose_grains", [](Cell c) { return network(c, &ContactNetwork::loose_grains); }},
    {"fabric_anisotropy", [](Cell c) { return fabric(c, &Fabric::anisotropy); }},
    {"fabric_angle",
     [](Cell c) { return in_space(c) ? std::string() : fabric(c, &Fabric::angle); }},
    {"sigma_xx", [](Cell c) { return stress(c, &Symmetric3::xx); }},
    {"sigma_xy", [](Cell c) { return stress(c, &Symmetric3::xy); }},
    {"sigma_yy", [](Cell c) { return stress(c, &Symmetric3::yy); }},
    {"mean_normal_force",
     [](Cell c) {
         if (!c.network || !c.network->normal_force) return std::string();
         return number(*c.network->normal_force / (pressure_unit(c) * c.run.diameter * depth(c)));
     }},
    {"sliding_share", [](Cell c) { return network(c, &ContactNetwork::sliding_share); }},
    {"flow_x",
     [](Cell c) {
         return fluid(c, [](Cell r) { return r.row.fluid->mean_velocity[0] / r.run.velocity; });
     }},
    {"flow_y",
     [](Cell c) {
         return fluid(c, [](Cell r) { return r.row.fluid->mean_velocity[1] / r.run.velocity; });
     }},
    {"fluid_force_x", [](Cell c) { return fluid(c, [](Cell r) { return force(r, 0); }); }},
    {"fluid_force_y", [](Cell c) { return fluid(c, [](Cell r) { return force(r, 1); }); }},
    {"pressure_iterations",
     [](Cell c) {
         return splitting(c, [](const auto& s) { return double(s.pressure_iterations); });
     }},
    {"viscous_iterations",
     [](Cell c) {
         return splitting(c, [](const auto& s) { return double(s.viscous_iterations); });
     }},
    {"remaining_divergence",
     [](Cell c) {
         return splitting(
             c, [&](const auto& s) { return s.divergence * c.run.diameter / c.run.velocity; });
     }},
    {"viscous_residual",
     [](Cell c) {
         return splitting(c, [&](const auto& s) {
             return s.viscous_residual * c.run.diameter / (c.run.velocity * c.run.velocity);
         });
     }},
    {"potential_energy",
     [](Cell c) {
         return mean(c, c.run.gravity * c.mean.height / (c.run.velocity * c.run.velocity));
     }},
    {"contact_work", [](Cell c) { return work(c, &GrainWork::contacts); }},
    {"fluid_work", [](Cell c) { return c.row.fluid ? work(c, &GrainWork::fluid) : std::string(); }},
    {"contact_violation",
     [](Cell c) {
         const auto& violation = c.row.state->report.contact_violation;
         return violation ? number(*violation / c.run.velocity) : std::string();
     }},
    {"motion_defect",
     [](Cell c) {
         return c.row.motion_defect ? number(*c.row.motion_defect / c.run.diameter) : "";
     }},
    {"mean_velocity_z",
     [](Cell c) {
         return of_space(c, [&] { return mean(c, c.mean.velocity[2] / c.run.velocity); });
     }},
    {"mean_position_z",
     [](Cell c) {
         return of_space(c, [&] { return mean(c, c.mean.position[2] / c.run.diameter); });
     }},
    {"sigma_xz", [](Cell c) { return of_space(c, [&] { return stress(c, &Symmetric3::xz); }); }},
    {"sigma_yz", [](Cell c) { return of_space(c, [&] { return stress(c, &Symmetric3::yz); }); }},
    {"sigma_zz", [](Cell c) { return of_space(c, [&] { return stress(c, &Symmetric3::zz); }); }},
    {"flow_z",
     [](Cell c) {
         return of_space(c, [&] {
             return fluid(c, [](Cell r) { return r.row.fluid->mean_velocity[2] / r.run.velocity; });
         });
     }},
    {"fluid_force_z",
     [](Cell c) {
         return of_space(c, [&] { return fluid(c, [](Cell r) { return force(r, 2); }); });
     }},
    {"film_work",
     [](Cell c) {
         return c.row.state->report.film_work ? work(c, &GrainWork::films) : std::string();
     }},
};

template <class Part>
std::string joined(Part part) {
    std::string text;
    for (const Column& column : columns)
        text += (&column == columns.data() ? "" : ",") + part(column);
    return text;
}

}  // namespace

std::string history_header() {
    return joined([](const Column& column) { return std::string(column.name); });
}

std::string history_line(const RowValues& values) {
    return joined([&](const Column& column) { return column.text(values); });
}

}  // namespace turbidite
