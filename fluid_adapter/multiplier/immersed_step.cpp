// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_step.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupler/protocol/splitting.hpp"

namespace turbidite {
namespace {

MultiplierSettings multiplier_settings(const Settings& settings, const RunValues& run) {
    MultiplierSettings result;
    result.tolerance = settings.real("run.slip_tolerance");
    result.iterations = static_cast<int>(settings.integer("fluid.multiplier_iterations"));
    result.velocity_scale = run.velocity;
    return result;
}

/// The values of `fluid.points`, and whether they place boundary points.
struct PointKind {
    const char* name;
    bool boundary;
};
constexpr PointKind point_kinds[] = {{"interior", false}, {"interior+boundary", true}};

PointRules point_rules(const Settings& settings) {
    const std::string& name = settings.text("fluid.points");
    std::string known;
    for (const PointKind& kind : point_kinds) {
        if (kind.name == name) return {kind.boundary, settings.real("fluid.point_spacing")};
        known += (known.empty() ? "" : ", ") + std::string(kind.name);
    }
    throw std::invalid_argument("unknown fluid.points \"" + name + "\"; known: " + known);
}

/// The plane components (x, y, spin) are 0, 1, 5 of the six in space. The others are fixed; their
/// diagonal entries are set to 1.
std::array<double, 21> in_space(const Eigen::Matrix3d& plane) {
    constexpr std::size_t six[] = {0, 1, 5};
    std::array<double, 21> inertia{};
    for (const std::size_t still : {2, 3, 4}) inertia[upper_entry(still, still)] = 1.0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) inertia[upper_entry(six[i], six[j])] = plane(i, j);
    return inertia;
}

}  // namespace

ImmersedStep::ImmersedStep(FluidField& field, const Settings& settings, const ShapeTable& shapes)
    : field_(field),
      run_(run_values(settings)),
      bodies_(run_, shapes),
      plates_(settings),
      moved_grains_(motions_of(settings, "run.grain_motions")),
      settings_(multiplier_settings(settings, run_)),
      carries_contacts_(splitting_of(settings).rigid_grains),
      placement_(point_rules(settings)) {
    for (const ShapeRecord& record : shapes) shapes_.push_back(make_shape(record));
}

ImmersedGrain ImmersedStep::immersed(const GrainState& state) const {
    const Shape& shape = *shapes_.at(state.shape);
    const ImmersedBody body = bodies_(state);
    ImmersedGrain grain;
    grain.id = state.id;
    grain.shape = &shape;
    grain.radius = run_.hydrodynamic_radius * state.radius;
    grain.position = {state.position[0], state.position[1], state.position[2]};
    grain.orientation = matrix(rotation(state.orientation));
    grain.effective_mass = body.effective_mass;
    grain.effective_inertia = body.effective_inertia(2, 2);
    grain.contact_motion = planar(twist_of(state));
    grain.prescribed = state.prescribed;
    return grain;
}

void ImmersedStep::take(const std::vector<GrainState>& states, const Window& window) {
    grains_.clear();
    index_.clear();
    for (const GrainState& state : states) {
        index_.emplace(state.id, grains_.size());
        grains_.push_back(immersed(state));
    }
    states_ = grains_.size();
    prescribe(window);
    for (const ImmersedGrain& plate : plates_.bodies(window.time, window.step))
        grains_.push_back(plate);
    contact_impulses_.assign(grains_.size(), Planar::Zero());
    pushed_ = false;
    placement_.place(field_, grains_, points_);
}

/// Grains that follow a motion, which changes from window to window.
void ImmersedStep::prescribe(const Window& window) {
    for (const Moved& moved : moved_grains_) {
        const auto at = index_.find(moved.what);
        if (at == index_.end()) continue;
        grains_[at->second].contact_motion = planar(moved.motion->rate(window.time, window.step));
    }
}

void ImmersedStep::take_free(const std::vector<GrainState>& states, const Window& window) {
    take(states, window);
    for (std::size_t g = 0; g < states.size(); ++g) {
        Planar& given = grains_[g].given_impulse;
        given.y() = -bodies_(states[g]).submerged_mass * run_.gravity * window.step;
        if (!carries_contacts_) continue;
        contact_impulses_[g] = planar(states[g].contact_impulse, states[g].contact_angular_impulse);
        given += contact_impulses_[g];
    }
}

void ImmersedStep::take_constrained(const std::vector<GrainState>& states, const Window& window) {
    take(states, window);
    for (std::size_t g = 0; g < states.size(); ++g) {
        const GrainState& state = states[g];
        contact_impulses_[g] = planar(state.contact_impulse, state.contact_angular_impulse);
        grains_[g].announced_impulse =
            planar(state.announced_impulse, state.announced_angular_impulse);
    }
}

MultiplierResult ImmersedStep::solve() {
    system_.assemble(field_, grains_, points_);
    flow_.begin(system_, {field_.velocity(0), field_.velocity(1)}, momenta_of(grains_),
                prescribed_motions(grains_));
    const MultiplierResult result = uzawa_cg(flow_, settings_, work_);
    slip_goal_ = result.goal;
    return result;
}

MultiplierSettings ImmersedStep::continued() const {
    MultiplierSettings settings = settings_;
    settings.tolerance = slip_goal_ / settings.velocity_scale;
    settings.reduction = 1.0;
    return settings;
}

MultiplierResult ImmersedStep::push(const std::vector<GrainState>& with_contacts) {
    changes_.assign(grains_.size(), Planar::Zero());
    solved_.assign(grains_.size(), Planar::Zero());
    std::vector<std::uint8_t> received(states_, 0);
    for (const GrainState& state : with_contacts) {
        const auto at = index_.find(state.id);
        if (at == index_.end())
            throw std::runtime_error("contact impulses were received for grain " +
                                     std::to_string(state.id) + ", which is not in this window");
        if (std::exchange(received[at->second], 1) != 0)
            throw std::runtime_error("contact impulses were received twice for grain " +
                                     std::to_string(state.id));
        const Planar impulse = planar(state.contact_impulse, state.contact_angular_impulse);
        changes_[at->second] = impulse - contact_impulses_[at->second];
        contact_impulses_[at->second] = impulse;
        solved_[at->second] = planar(twist_of(state));
    }
    if (with_contacts.size() != states_)
        throw std::runtime_error("contact impulses were received for " +
                                 std::to_string(with_contacts.size()) +
                                 " grains, but the window has " + std::to_string(states_));
    pushed_ = true;
    flow_.push(changes_);
    return uzawa_cg(flow_, continued(), work_);
}

/// True on exactly one rank: the owner of the cell that contains the centre or, for a grain leaving
/// the grid, of the nearest cell.
bool ImmersedStep::answers_for(std::size_t grain) const {
    const CellGrid& grid = field_.grid();
    int index[2];
    for (int axis = 0; axis < 2; ++axis) {
        const int layer = grid.layer(axis, grains_[grain].position[axis]);
        index[axis] = grid.cyclic(axis) ? grid.wrapped(axis, layer)
                                        : std::clamp(layer, 0, grid.counts[axis] - 1);
    }
    const int home = field_.cell(index[0], index[1], 0);
    return home >= 0 && field_.owns(home);
}

std::vector<FreeResponse> ImmersedStep::responses() const {
    std::vector<FreeResponse> responses;
    for (std::size_t g = 0; g < states_; ++g) {
        if (!answers_for(g)) continue;
        responses.push_back(response(g));
    }
    return responses;
}

/// Of what is sent, whatever has changed the motions since the contacts were solved.
double ImmersedStep::mismatch(std::size_t g) const {
    if (!pushed_) return 0.0;
    const double radius = grains_[g].radius / run_.hydrodynamic_radius;
    const Planar off = flow_.motions()[g] - solved_[g];
    return off.head<2>().norm() + radius * std::abs(off.z());
}

/// A grain of prescribed motion moves as it did, whatever the impulses, and has no inertia to send.
FreeResponse ImmersedStep::response(std::size_t g) const {
    Planar free = flow_.motions()[g];
    FreeResponse response;
    response.id = grains_[g].id;
    response.mismatch = mismatch(g);
    if (!grains_[g].prescribed) {
        const Eigen::Matrix3d& inertia = system_.effective_inertia()[g];
        free -= inertia.llt().solve(contact_impulses_[g]);
        response.inertia = in_space(inertia);
    }
    response.velocity = linear(free);
    response.angular_velocity = angular(free);
    return response;
}

void ImmersedStep::impose() {
    flow_.impose();
}

std::vector<Kick> ImmersedStep::kicks() const {
    std::vector<Kick> kicks;
    for (std::size_t g = 0; g < states_; ++g) {
        if (!answers_for(g)) continue;
        const Planar& motion = flow_.motions()[g];
        const Planar& impulse = flow_.impulses()[g];
        Kick kick;
        kick.id = grains_[g].id;
        kick.velocity = linear(motion);
        kick.angular_velocity = angular(motion);
        kick.multiplier_impulse = linear(impulse);
        kick.multiplier_angular_impulse = angular(impulse);
        kicks.push_back(kick);
    }
    return kicks;
}

Planar ImmersedStep::impulse_to_grains() const {
    Planar sum = Planar::Zero();
    for (std::size_t g = 0; g < grains_.size(); ++g)
        if (answers_for(g)) sum += flow_.impulses()[g];
    return sum;
}

}  // namespace turbidite
