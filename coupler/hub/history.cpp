// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

// A row with its averages and scales at hand.
struct Cell {
    const Row& row;
    const Averages& mean;
    double diameter, velocity, time;
};

using Text = std::string (*)(const Cell&);

std::string number(double value) {
    return fmt::format("{:.10g}", value);
}

// Empty unless there are grains, was a window with contacts, with a fluid, with a clock.
std::string mean(const Cell& c, double value) {
    return c.row.state->grains.empty() ? "" : number(value);
}
std::string contact(const Cell& c, double (*value)(const Cell&)) {
    return c.row.contact ? number(value(c)) : "";
}
std::string fluid(const Cell& c, double (*value)(const Cell&)) {
    return c.row.fluid ? number(value(c)) : "";
}
std::string wall(const Cell& c, double WallTimes::*part) {
    return c.row.wall ? fmt::format("{:.6f}", (*c.row.wall).*part) : "";
}

struct Column {
    const char* name;
    Text text;
};

const std::vector<Column> columns = {
    {"step", [](const Cell& c) { return std::to_string(c.row.step); }},
    {"time", [](const Cell& c) { return number(c.row.time / c.time); }},
    {"mean_velocity_x", [](const Cell& c) { return mean(c, c.mean.velocity[0] / c.velocity); }},
    {"mean_velocity_y", [](const Cell& c) { return mean(c, c.mean.velocity[1] / c.velocity); }},
    {"mean_velocity_norm",
     [](const Cell& c) {
         const Vec3& u = c.mean.velocity;
         return mean(c, std::hypot(u[0], u[1], u[2]) / c.velocity);
     }},
    {"mean_speed", [](const Cell& c) { return mean(c, c.mean.speed / c.velocity); }},
    {"mean_position_x", [](const Cell& c) { return mean(c, c.mean.position[0] / c.diameter); }},
    {"mean_position_y", [](const Cell& c) { return mean(c, c.mean.position[1] / c.diameter); }},
    {"front_x", [](const Cell& c) { return mean(c, c.mean.front / c.diameter); }},
    {"kinetic_energy",
     [](const Cell& c) {
         return mean(c, c.mean.kinetic_energy / (c.mean.mass * c.velocity * c.velocity));
     }},
    {"grains", [](const Cell& c) { return std::to_string(c.row.state->grains.size()); }},
    {"contacts",
     [](const Cell& c) {
         return contact(c, [](const Cell& r) { return double(r.row.contact->contacts); });
     }},
    {"max_penetration",
     [](const Cell& c) { return number(c.row.state->report.max_penetration / c.diameter); }},
    {"contact_iterations",
     [](const Cell& c) {
         return contact(c, [](const Cell& r) { return double(r.row.contact->iterations); });
     }},
    {"contact_residual",
     [](const Cell& c) {
         return contact(c, [](const Cell& r) { return r.row.contact->residual; });
     }},
    {"multiplier_iterations",
     [](const Cell& c) {
         return fluid(c, [](const Cell& r) { return double(r.row.fluid->multiplier_iterations); });
     }},
    {"multiplier_residual",
     [](const Cell& c) {
         return fluid(c,
                      [](const Cell& r) { return r.row.fluid->multiplier_residual / r.velocity; });
     }},
    {"divergence",
     [](const Cell& c) {
         return fluid(
             c, [](const Cell& r) { return r.row.fluid->divergence * r.diameter / r.velocity; });
     }},
    {"pore_volume", [](const Cell&) { return std::string(); }},
    {"wall_step", [](const Cell& c) { return wall(c, &WallTimes::step); }},
    {"wall_fluid",
     [](const Cell& c) { return c.row.fluid ? wall(c, &WallTimes::fluid) : std::string(); }},
    {"wall_grains", [](const Cell& c) { return wall(c, &WallTimes::grains); }},
    {"wall_coupling", [](const Cell& c) { return wall(c, &WallTimes::coupling); }},
    {"grain_balance",
     [](const Cell& c) {
         return c.row.grain_balance ? number(*c.row.grain_balance) : std::string();
     }},
    {"fluid_balance",
     [](const Cell& c) {
         return fluid(c, [](const Cell& r) { return r.row.fluid->momentum_defect; });
     }},
    {"joint_rounds",
     [](const Cell& c) { return c.row.joint ? std::to_string(c.row.joint->rounds) : ""; }},
    {"joint_mismatch",
     [](const Cell& c) { return c.row.joint ? number(c.row.joint->mismatch / c.velocity) : ""; }},
};

template <class Part>
std::string line(Part part) {
    std::string text;
    for (const Column& column : columns)
        text += (&column == columns.data() ? "" : ",") + part(column);
    return text;
}

}  // namespace

std::string history_header() {
    return line([](const Column& column) { return std::string(column.name); });
}

Averages averages(const Motion& state, const KickRule& rule) {
    Averages mean;
    const double n = std::max<double>(1.0, static_cast<double>(state.grains.size()));
    mean.front = state.grains.empty() ? 0.0 : -INFINITY;
    for (const GrainState& grain : state.grains) {
        double speed2 = 0.0, spin_energy = 0.0;
        const ImmersedBody body = rule.body(grain);
        for (int i = 0; i < 3; ++i) {
            mean.velocity[i] += grain.velocity[i] / n;
            mean.position[i] += grain.position[i] / n;
            speed2 += grain.velocity[i] * grain.velocity[i];
            spin_energy +=
                body.inertia(i, i) * grain.angular_velocity[i] * grain.angular_velocity[i];
        }
        mean.speed += std::sqrt(speed2) / n;
        mean.front = std::max(mean.front, grain.position[0] + grain.radius);
        mean.kinetic_energy += 0.5 * (body.mass * speed2 + spin_energy);
        mean.mass += body.mass;
    }
    return mean;
}

History::History(const std::filesystem::path& file, const Settings& settings, const KickRule& rule)
    : file_(file),
      out_(file, std::ios::trunc),
      rule_(rule),
      diameter_(settings.real("run.diameter")),
      velocity_(settings.real("run.velocity_scale")),
      time_(settings.real("run.time_scale")) {
    out_ << history_header() << std::endl;
    if (!out_) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

void History::append(const Row& row) {
    const Averages mean = averages(*row.state, rule_);
    const Cell cell{row, mean, diameter_, velocity_, time_};
    const auto whole = out_.tellp();
    out_ << line([&](const Column& column) { return column.text(cell); }) << std::endl;
    if (out_) return;
    out_.close();
    std::error_code ignored;  // half a row would spoil the file for its readers
    std::filesystem::resize_file(file_, static_cast<std::uintmax_t>(whole), ignored);
    throw Failure(ExitCode::participant_failed,
                  "cannot write " + file_.string() + ": is the disk full?");
}

}  // namespace turbidite
