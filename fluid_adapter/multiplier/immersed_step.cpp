// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/multiplier/plane/plane_constraint.hpp"
#include "fluid_adapter/multiplier/space/interior_constraint.hpp"

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

std::unique_ptr<Constraint> make_constraint(FluidField& field, const Settings& settings,
                                            const RunValues& run) {
    if (run.dimension == 3)
        return std::make_unique<InteriorConstraint>(field, splitting_of(settings).rigid_grains);
    return std::make_unique<PlaneConstraint>(field, point_rules(settings),
                                             multiplier_settings(settings, run));
}

double tolerance_of(const Settings& settings) {
    return settings.has("coupling.tolerance") ? settings.real("coupling.tolerance") : 0.0;
}

Impulse contact_impulse(const GrainState& state) {
    return {state.contact_impulse, state.contact_angular_impulse};
}

}  // namespace

ImmersedStep::ImmersedStep(FluidField& field, const Settings& settings, const ShapeTable& shapes)
    : field_(field),
      run_(run_values(settings)),
      bodies_(run_, shapes),
      walls_(settings),
      moved_grains_(motions_of(settings, "run.grain_motions")),
      agreement_{splitting_of(settings).rigid_grains, tolerance_of(settings) * run_.velocity},
      constraint_(make_constraint(field, settings, run_)) {
    for (const ShapeRecord& record : shapes) shapes_.push_back(make_shape(record));
}

ImmersedGrain ImmersedStep::immersed(const GrainState& state) const {
    const Shape& shape = *shapes_.at(state.shape);
    // cM = M - rho_f V(R_h) and cI = I - I_f(R_h) (coupler/shapes/immersed_body.hpp)
    const ImmersedBody body = bodies_(state);
    ImmersedGrain grain;
    grain.id = state.id;
    grain.shape = &shape;
    grain.radius = run_.hydrodynamic_radius * state.radius + run_.surface_shift;
    grain.position = {state.position[0], state.position[1], state.position[2]};
    grain.orientation = matrix(rotation(state.orientation));
    grain.effective_mass = body.effective_mass;
    // About z in the plane; of a sphere it is the same about any axis.
    grain.effective_inertia = body.effective_inertia(2, 2);
    grain.contact_motion = twist_of(state);
    grain.prescribed = state.prescribed;
    if (!grain.prescribed) grain.beyond = fluid_beyond(field_.grid(), grain, body.displaced_mass);
    return grain;
}

Vec3 ImmersedStep::driving(const GrainState& state, double step) const {
    // What holds the grain takes the whole force of the stream: fluid and held grains together take
    // rho_f a times the volume of the box.
    if (state.prescribed) return {};
    const ImmersedBody body = bodies_(state);
    return (body.fluid_mass - body.displaced_mass) * step * run_.acceleration;
}

void ImmersedStep::take(const std::vector<GrainState>& states, const Window& window) {
    grains_.clear();
    index_.clear();
    for (const GrainState& state : states) {
        index_.emplace(state.id, grains_.size());
        grains_.push_back(immersed(state));
        grains_.back().driving_impulse = driving(state, window.step);
        grains_.back().stream_gain = window.step * run_.acceleration;
    }
    // Grains have the numbers below this; walls follow, which get no responses and no kicks.
    states_ = grains_.size();
    prescribe(window);
    walls_.append(window.time, window.step, grains_);
    contact_impulses_.assign(grains_.size(), {});
    pushed_ = false;
    constraint_->place(grains_);
}

/// Grains that follow a motion, which changes from window to window.
void ImmersedStep::prescribe(const Window& window) {
    for (const Moved& moved : moved_grains_) {
        const auto at = index_.find(moved.what);
        if (at == index_.end()) continue;
        // The mean over the window, as contacts have it.
        grains_[at->second].contact_motion = moved.motion->rate(window.time, window.step);
    }
}

void ImmersedStep::take_free(const std::vector<GrainState>& states, const Window& window) {
    take(states, window);
    for (std::size_t g = 0; g < states.size(); ++g) {
        Impulse& given = grains_[g].given_impulse;
        given = weight(states[g], window.step);
        grains_[g].motion_before = twist_of(states[g]);
        note_moved(grains_[g], window);
        if (!agreement_.carries_contacts) continue;
        // J^n of the last window, a prediction: `push` adds the difference to this window's.
        contact_impulses_[g] = contact_impulse(states[g]);
        given += contact_impulses_[g];
    }
}

void ImmersedStep::take_constrained(const std::vector<GrainState>& states, const Window& window) {
    take(states, window);
    for (std::size_t g = 0; g < states.size(); ++g) {
        const GrainState& state = states[g];
        // U^{n+4/5} has weight and contacts already, so nothing is given; J_h is taken off again in
        // ImmersedGrain::momentum.
        contact_impulses_[g] = contact_impulse(state);
        grains_[g].announced_impulse = {state.announced_impulse, state.announced_angular_impulse};
        if (state.prescribed)
            grains_[g].motion_before = twist_of(state);
        else if (grains_[g].effective_mass > 0.0)
            grains_[g].motion_before = before_contacts(grains_[g], state, window.step);
    }
}

/// q^n - q^{n-1} = dt U^n, with the velocity that contacts allow; the fluid has its own answer,
/// which differs by coupling.tolerance at most. So a grain that is slower may be at rest, and would
/// cross the same cell in every window. Where a run begins nothing has moved.
void ImmersedStep::note_moved(ImmersedGrain& grain, const Window& window) const {
    if (window.index == 0 || norm(grain.motion_before.velocity) <= agreement_.tolerance) return;
    const Vec3 moved = window.step * grain.motion_before.velocity;
    grain.moved = {moved[0], moved[1], moved[2]};
}

/// (M - m_f) g dt: buoyancy is that of R, not of R_h.
Impulse ImmersedStep::weight(const GrainState& state, double step) const {
    return {{0.0, -bodies_(state).submerged_mass * run_.gravity * step, 0.0}, {}};
}

/// U^n of cM (U^{n+4/5} - U^n) = (M - m_f) g dt + J_c + J_h, and the same of the spin. cM > 0
/// where contacts come first.
Twist ImmersedStep::before_contacts(const ImmersedGrain& grain, const GrainState& state,
                                    double step) const {
    const Impulse gained = weight(state, step) + contact_impulse(state) + grain.announced_impulse;
    return {grain.contact_motion.velocity - gained.linear / grain.effective_mass,
            grain.contact_motion.spin - gained.moment / grain.effective_inertia};
}

bool ImmersedStep::moves(const Twist& motion) const {
    // Above what is left of a zero that `before_contacts` finds as a difference
    const double rounding = 1e-9 * run_.velocity;
    return norm(motion.velocity) + run_.diameter * norm(motion.spin) > rounding;
}

bool ImmersedStep::begins_in_motion() const {
    return std::any_of(
        grains_.begin(), grains_.begin() + static_cast<std::ptrdiff_t>(states_),
        [&](const auto& grain) { return !grain.prescribed && moves(grain.motion_before); });
}

bool ImmersedStep::is_driven() const {
    return std::any_of(grains_.begin(), grains_.end(), [&](const auto& body) {
        return body.prescribed && moves(body.contact_motion);
    });
}

/// u += W(0) of bodies whose motion is given.
MultiplierResult ImmersedStep::carry_fluid_along() {
    std::vector<ImmersedGrain> starting = grains_;
    for (ImmersedGrain& body : starting) {
        body.contact_motion = body.prescribed ? Twist{} : body.motion_before;
        body.prescribed = true;
        body.moved.setZero();
    }
    const VelocityPointers u = field_.velocities();
    std::vector<std::vector<double>> carried(u.size(),
                                             std::vector<double>(field_.owned_cells(), 0.0));
    VelocityPointers change(u.size());
    for (int axis = 0; axis < u.size(); ++axis) change[axis] = carried[axis].data();
    constraint_->place(starting);
    const MultiplierResult result = constraint_->solve(change);
    constraint_->impose();
    for (int axis = 0; axis < u.size(); ++axis)
        for (std::size_t cell = 0; cell < carried[axis].size(); ++cell)
            u[axis][cell] += carried[axis][cell];
    constraint_->place(grains_);
    return result;
}

MultiplierResult ImmersedStep::solve() {
    return constraint_->solve(field_.velocities());
}

MultiplierResult ImmersedStep::push(const std::vector<GrainState>& with_contacts) {
    changes_.assign(grains_.size(), {});
    solved_.assign(grains_.size(), {});
    std::vector<std::uint8_t> received(states_, 0);
    for (const GrainState& state : with_contacts) {
        const auto at = index_.find(state.id);
        if (at == index_.end())
            throw std::runtime_error("contact impulses were received for grain " +
                                     std::to_string(state.id) + ", which is not in this window");
        if (std::exchange(received[at->second], 1) != 0)
            throw std::runtime_error("contact impulses were received twice for grain " +
                                     std::to_string(state.id));
        const Impulse impulse = contact_impulse(state);
        // Only the change, since the motions contain the impulses of the last round.
        changes_[at->second] = impulse - contact_impulses_[at->second];
        contact_impulses_[at->second] = impulse;
        solved_[at->second] = twist_of(state);
    }
    if (with_contacts.size() != states_)
        throw std::runtime_error("contact impulses were received for " +
                                 std::to_string(with_contacts.size()) +
                                 " grains, but the window has " + std::to_string(states_));
    pushed_ = true;
    return constraint_->push(changes_);
}

/// True on exactly one rank: the owner of the cell that contains the centre or, for a grain leaving
/// the grid, of the nearest cell.
bool ImmersedStep::answers_for(std::size_t grain) const {
    const CellGrid& grid = field_.grid();
    int index[3] = {};
    for (int axis = 0; axis < grid.dimension; ++axis) {
        const int layer = grid.layer(axis, grains_[grain].position[axis]);
        // The indices are those of a cell of the grid, so that some rank owns it.
        index[axis] = grid.cyclic(axis) ? grid.wrapped(axis, layer)
                                        : std::clamp(layer, 0, grid.counts[axis] - 1);
    }
    const int home = field_.cell(index[0], index[1], index[2]);
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
    // |U' - U| + R |omega' - omega|, with R = (R_h - shift) / (R_h/R)
    const double radius = (grains_[g].radius - run_.surface_shift) / run_.hydrodynamic_radius;
    const Twist motion = constraint_->motion(g);
    return norm(motion.velocity - solved_[g].velocity) +
           radius * norm(motion.spin - solved_[g].spin);
}

/// A grain of prescribed motion moves as it did, whatever the impulses, and has no inertia to send.
FreeResponse ImmersedStep::response(std::size_t g) const {
    Twist free = constraint_->motion(g);
    FreeResponse response;
    response.id = grains_[g].id;
    response.mismatch = mismatch(g);
    if (!grains_[g].prescribed) {
        // U^F = U' - A_eff^-1 J, with the same A_eff that is sent: a contact solve that finds J
        // again finds U' as well (FreeResponse in coupler/protocol/records.hpp).
        const Twist pushed = constraint_->moved_by(g, contact_impulses_[g]);
        free = {free.velocity - pushed.velocity, free.spin - pushed.spin};
        response.inertia = constraint_->effective_inertia(g);
    }
    response.velocity = free.velocity;
    response.angular_velocity = free.spin;
    return response;
}

void ImmersedStep::impose() {
    constraint_->impose();
}

std::vector<Kick> ImmersedStep::kicks() const {
    std::vector<Kick> kicks;
    for (std::size_t g = 0; g < states_; ++g) {
        if (!answers_for(g)) continue;
        const Twist motion = constraint_->motion(g);
        const Impulse impulse = constraint_->impulse(g);
        Kick kick;
        kick.id = grains_[g].id;
        kick.velocity = motion.velocity;
        kick.angular_velocity = motion.spin;
        // The driving impulse is in the momentum of step 5, so the balance of the grain needs it
        // here. The fluid has not lost it: impulse_to_grains is without.
        // Nor has it what the fluid beyond a free side loses.
        const Impulse beyond = grains_[g].beyond.momentum(grains_[g].fluid_before()) -
                               grains_[g].beyond.momentum(motion);
        kick.multiplier_impulse = impulse.linear + beyond.linear + grains_[g].driving_impulse;
        kick.multiplier_angular_impulse = impulse.moment + beyond.moment;
        kicks.push_back(kick);
    }
    return kicks;
}

Impulse ImmersedStep::impulse_to_grains() const {
    Impulse sum;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        // With walls, which take momentum from the fluid as well; each body on one rank.
        if (answers_for(g)) sum += constraint_->impulse(g);
    return sum;
}

}  // namespace turbidite
