// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/history.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/output/measures/pore_volume.hpp"
#include "coupler/output/measures/pore_voxels.hpp"
#include "coupler/output/output_state.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {

Averages averages(const Motion& state, const ImmersedBodies& bodies) {
    Averages mean;
    const double n = std::max<double>(1.0, static_cast<double>(state.grains.size()));
    mean.front = state.grains.empty() ? 0.0 : -INFINITY;
    for (const GrainState& grain : state.grains) {
        double speed2 = 0.0, spin_energy = 0.0;
        const ImmersedBody body = bodies(grain);
        for (int i = 0; i < 3; ++i) {
            mean.velocity[i] += grain.velocity[i] / n;
            mean.position[i] += grain.position[i] / n;
            speed2 += grain.velocity[i] * grain.velocity[i];
            spin_energy +=
                body.inertia(i, i) * grain.angular_velocity[i] * grain.angular_velocity[i];
        }
        mean.speed += std::sqrt(speed2) / n;
        mean.front = std::max(mean.front, grain.position[0] + grain.radius);
        // (M U^2 + omega . I omega)/2: about z in the plane; a sphere's I is the same in all
        // directions.
        mean.kinetic_energy += 0.5 * (body.mass * speed2 + spin_energy);
        // sum (M - m_f) y over sum M: times g the potential energy per mass
        mean.height += body.submerged_mass * grain.position[1];
        mean.mass += body.mass;
        // V(R), whatever the hydrodynamic radius
        mean.solid += body.mass / grain.density;
    }
    if (mean.mass > 0.0) mean.height /= mean.mass;
    return mean;
}

namespace {

std::vector<SolidBall> balls_of(const Motion& state) {
    std::vector<SolidBall> balls;
    for (const GrainState& grain : state.grains) balls.push_back({grain.position, grain.radius});
    return balls;
}

}  // namespace

History::History(const std::filesystem::path& file, const RunValues& run, const ShapeTable& shapes)
    : file_(file), out_(file, std::ios::trunc), bodies_(run, shapes), run_(run) {
    out_ << history_header() << std::endl;
    if (!out_) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

History::History(const std::filesystem::path& file, const RunValues& run, const ShapeTable& shapes,
                 std::int64_t length)
    : file_(file), bodies_(run, shapes), run_(run) {
    // Rows that were written after the checkpoint are of windows that are played again.
    cut_to(file, length);
    out_.open(file, std::ios::in | std::ios::out | std::ios::ate);
    if (!out_) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

RowValues History::values(const Row& row) const {
    const Motion& state = *row.state;
    RowValues values{row, averages(state, bodies_), pores(state), {}, run_};
    if (state.contacts)
        values.network =
            contact_network(*state.contacts, state.grains.size(), run_.step, run_.dimension);
    return values;
}

double History::pores(const Motion& state) const {
    if (run_.dimension == 3) return pore_volume(balls_of(state), run_.diameter, run_.period);
    std::vector<SolidGrain> solids;
    for (const GrainState& grain : state.grains)
        solids.push_back(
            {grain.position[0], grain.position[1], bodies_(grain).mass / grain.density});
    return pore_volume(solids, run_.diameter, run_.period);
}

void History::append(const Row& row) {
    // The end of the last whole row, should this one not fit on the disk.
    const auto whole = out_.tellp();
    out_ << history_line(values(row)) << std::endl;
    if (out_) return;
    out_.close();
    std::error_code ignored;  // half a row would make the file unreadable
    std::filesystem::resize_file(file_, static_cast<std::uintmax_t>(whole), ignored);
    throw Failure(ExitCode::participant_failed,
                  "cannot write " + file_.string() + ": is the disk full?");
}

}  // namespace turbidite
