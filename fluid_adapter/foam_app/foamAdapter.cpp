// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamAdapter.hpp"

#include <OSspecific.H>
#include <malloc.h>
#include <sigFpe.H>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "coupler/shapes/immersed_body.hpp"
#include "fluid_adapter/foam_app/advection.hpp"
#include "fluid_adapter/foam_app/foamErrors.hpp"
#include "fluid_adapter/foam_app/foamFluidField.hpp"
#include "fluid_adapter/foam_app/momentumLedger.hpp"
#include "fluid_adapter/foam_app/savedState.hpp"
#include "fluid_adapter/foam_app/solverList.hpp"
#include "fluid_adapter/foam_app/stokesProjection.hpp"
#include "fluid_adapter/multiplier/method_list.hpp"

namespace turbidite {
namespace {

/// |div phi| D / u_c asked of the projection: half of what the run accepts.
constexpr double divergence_goal = 5e-5;

/// Adds the time until it goes out of scope.
class Stopwatch {
 public:
    explicit Stopwatch(double& total) : total_(total) {}
    ~Stopwatch() {
        total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;

 private:
    double& total_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What the multiplier step needs of the case.
struct GrainRules {
    std::vector<std::shared_ptr<const Shape>> shapes;
    double fluid_density = 1.0;
    double hydrodynamic_radius = 1.0;
};

Eigen::Vector3d vector_of(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

Planar planar(const Vec3& linear, const Vec3& angular) {
    return {linear[0], linear[1], angular[2]};
}

ImmersedGrain immersed_grain(const GrainState& state, const GrainRules& rules) {
    const Shape& shape = *rules.shapes.at(state.shape);
    const ImmersedBody body = immersed_body(shape, state.radius, state.density, rules.fluid_density,
                                            rules.hydrodynamic_radius);
    const Quaternion& q = state.orientation;
    ImmersedGrain grain;
    grain.id = state.id;
    grain.shape = &shape;
    grain.radius = rules.hydrodynamic_radius * state.radius;
    grain.position = vector_of(state.position);
    grain.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    grain.effective_mass = body.effective_mass;
    grain.effective_inertia = body.effective_inertia(2, 2);
    grain.contact_motion = planar(state.velocity, state.angular_velocity);
    grain.announced_impulse = planar(state.announced_impulse, state.announced_angular_impulse);
    return grain;
}

Kick kick_of(const ImmersedGrain& grain, const Planar& motion, const Planar& impulse) {
    Kick kick;
    kick.id = grain.id;
    kick.velocity = {motion.x(), motion.y(), 0.0};
    kick.angular_velocity = {0.0, 0.0, motion.z()};
    kick.multiplier_impulse = {impulse.x(), impulse.y(), 0.0};
    kick.multiplier_angular_impulse = {0.0, 0.0, impulse.z()};
    return kick;
}

MultiplierSettings multiplier_settings(const Settings& settings) {
    MultiplierSettings result;
    result.tolerance = settings.real("fluid.multiplier_tolerance");
    result.iterations = static_cast<int>(settings.integer("fluid.multiplier_iterations"));
    result.velocity_scale = settings.real("run.velocity_scale");
    return result;
}

PointRules point_rules(const Settings& settings, const MethodEntry& method) {
    PointRules rules;
    rules.boundary = method.boundary_points;
    rules.spacing = settings.real("fluid.point_spacing");
    return rules;
}

[[noreturn]] void refuse(const std::string& step, const Window& window, const std::string& why) {
    throw PhysicsRefused(step + " of window " + std::to_string(window.index) + ": " + why);
}

/// Adds the step and the window to the text of a refusal.
template <class Work>
auto in_step(const std::string& step, const Window& window, Work work) {
    const std::string doing = step + " of window " + std::to_string(window.index);
    try {
        return with_foam_errors(doing, work);
    } catch (const PhysicsRefused& refused) {
        refuse(step, window, refused.what());
    }
}

void check_finite(const FluidFields& fields, const std::string& step, const Window& window) {
    Foam::scalar sum = 0.0;
    for (const Foam::vector& u : fields.U) sum += Foam::magSqr(u);
    Foam::reduce(sum, Foam::sumOp<Foam::scalar>());
    if (!std::isfinite(sum)) refuse(step, window, "the fluid velocity is not finite");
}

void check_finite(const std::vector<Kick>& kicks, const Window& window) {
    for (const Kick& kick : kicks) {
        const double sum = kick.velocity[0] + kick.velocity[1] + kick.angular_velocity[2] +
                           kick.multiplier_impulse[0] + kick.multiplier_impulse[1] +
                           kick.multiplier_angular_impulse[2];
        if (!std::isfinite(sum))
            refuse("step 5 (multipliers)", window,
                   "the kick of grain " + std::to_string(kick.id) + " is not finite");
    }
}

/// OpenFOAM's operators make fields and drop them, several per window. Freed memory stays with the
/// process, or the system would clear the same pages again each time: a quarter of a window.
void keep_freed_memory() {
    constexpr int most = 1 << 30;
    ::mallopt(M_MMAP_THRESHOLD, most);
    ::mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace

struct FoamAdapter::State {
    State(const std::filesystem::path& directory, const Settings& settings,
          const ShapeTable& table);

    FluidFields fields;
    FoamFluidField field;
    StokesProjection projection;
    std::unique_ptr<ViscousSolver> viscosity;
    MomentumLedger ledger;
    const MethodEntry& method;
    MultiplierSettings solve_settings;
    PointPlacement placement;
    GrainRules grain_rules;

    std::vector<ImmersedGrain> grains;
    CollocationPoints points;
    SaddlePoint system;
    MultiplierWorkspace work;
    FluidReport report;
    FluidTimings timings;

    void begin(const Window& window);
    MultiplierResult solve_multipliers(const Window& window, const std::vector<GrainState>& states);
    std::vector<Kick> kicks() const;
    Foam::vector impulse_to_grains() const;
};

FoamAdapter::State::State(const std::filesystem::path& directory, const Settings& settings,
                          const ShapeTable& table)
    : fields(directory),
      field(fields, fluid_domain(settings)),
      projection(
          fields,
          divergence_goal * settings.real("run.velocity_scale") / settings.real("run.diameter"),
          make_pressure_solver(settings.text("fluid.pressure_solver"), fields)),
      viscosity(make_viscous_solver(settings.text("fluid.viscous_solver"), fields)),
      ledger(fields),
      method(find_method(settings.text("fluid.points"))),
      solve_settings(multiplier_settings(settings)),
      placement(point_rules(settings, method)) {
    grain_rules.fluid_density = settings.real("run.fluid_density");
    grain_rules.hydrodynamic_radius = settings.real("fluid.hydrodynamic_radius");
    for (const ShapeRecord& record : table) grain_rules.shapes.push_back(make_shape(record));
}

void FoamAdapter::State::begin(const Window& window) {
    timings = {};
    report = {};
    fields.time.setDeltaT(window.step);
    if (!fields.time.loop())
        throw Failure(ExitCode::participant_failed, "window " + std::to_string(window.index) +
                                                        " begins at or after endTime of " +
                                                        "the fluid case's system/controlDict");
}

MultiplierResult FoamAdapter::State::solve_multipliers(const Window& window,
                                                       const std::vector<GrainState>& states) {
    {
        const Stopwatch watch(timings.points);
        field.load();
        grains.clear();
        for (const GrainState& state : states) grains.push_back(immersed_grain(state, grain_rules));
        placement.place(field, grains, points);
    }
    const Stopwatch watch(timings.multipliers);
    system.assemble(field, grains, points);
    const MultiplierResult result = method.solve(system, solve_settings, work);
    field.store(points.touched, window.write_output);
    return result;
}

std::vector<Kick> FoamAdapter::State::kicks() const {
    std::vector<Kick> kicks;
    const CellGrid& grid = field.grid();
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const Eigen::Vector3d& x = grains[g].position;
        const int home = field.cell(grid.wrapped(0, grid.layer(0, x.x())),
                                    grid.wrapped(1, grid.layer(1, x.y())), 0);
        // On one rank a grain whose centre has left the grid is still ours to answer for.
        if (Foam::Pstream::parRun() && (home < 0 || !field.owns(home))) continue;
        kicks.push_back(kick_of(grains[g], system.motions()[g], system.impulses()[g]));
    }
    return kicks;
}

Foam::vector FoamAdapter::State::impulse_to_grains() const {
    Foam::vector sum = Foam::Zero;
    for (std::size_t g = 0; g < grains.size(); ++g)
        sum += Foam::vector(system.impulses()[g].x(), system.impulses()[g].y(), 0.0);
    return sum;
}

FoamAdapter::FoamAdapter(std::filesystem::path directory) : directory_(std::move(directory)) {
    Foam::FatalError.throwExceptions();
    Foam::FatalIOError.throwExceptions();
    // Debian's controlDict asks for the floating-point trap, which kills the job without a word;
    // finiteness is checked instead. Who sets FOAM_SIGFPE gets it back.
    if (!Foam::getEnv("FOAM_SIGFPE").empty()) Foam::sigFpe::set(false);
    keep_freed_memory();
}

FoamAdapter::~FoamAdapter() = default;

Hello FoamAdapter::describe() const {
    Hello hello;
    hello.role = Role::fluid;
    hello.adapter = "openfoam";
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = "OpenFOAM 1912";
    hello.dimension = 2;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.shapes = {"disc"};
    return hello;
}

Box FoamAdapter::initialise(const Settings& settings, const ShapeTable& shapes) {
    state_ = with_foam_errors("opening the case " + directory_.string(), [&] {
        return std::make_unique<State>(directory_, settings, shapes);
    });
    const Foam::boundBox bounds(state_->fields.mesh.points(), false);
    return {{bounds.min().x(), bounds.min().y(), bounds.min().z()},
            {bounds.max().x(), bounds.max().y(), bounds.max().z()}};
}

void FoamAdapter::advance(const Window& window) {
    State& s = *state_;
    s.begin(window);
    s.ledger.open();
    in_step("step 1 (projection)", window, [&] {
        const Stopwatch watch(s.timings.projection);
        s.report.divergence = s.projection.project();
        s.report.courant = s.fields.courant();
        s.ledger.add_pressure();
    });
    in_step("step 2 (transport)", window, [&] {
        const Stopwatch watch(s.timings.transport);
        s.ledger.add_convection();
        advect(s.fields);
    });
    check_finite(s.fields, "steps 1-2 (projection, transport)", window);
    in_step("step 3 (viscosity)", window, [&] {
        const Stopwatch watch(s.timings.viscosity);
        s.viscosity->solve(window.step);
        s.ledger.add_viscosity();
    });
    check_finite(s.fields, "step 3 (viscosity)", window);
}

std::vector<FreeResponse> FoamAdapter::respond(const Window&, const std::vector<GrainState>&) {
    throw Failure(
        ExitCode::bad_input,
        "coupling.scheme = joint: the OpenFOAM adapter does not know effective inertia yet; "
        "use split");
}

std::vector<FreeResponse> FoamAdapter::correct(const Window&, const std::vector<GrainState>&) {
    throw std::logic_error("correct() needs a respond() of the same window before it");
}

Kicks FoamAdapter::impose(const Window& window, const std::vector<GrainState>& grains) {
    State& s = *state_;
    Kicks answer;
    in_step("step 5 (multipliers)", window, [&] {
        const MultiplierResult result = s.solve_multipliers(window, grains);
        s.report.multiplier_iterations = result.iterations;
        s.report.multiplier_residual = result.residual;
        if (!result.converged)
            Foam::Info << "window " << window.index << ": multipliers not converged after "
                       << result.iterations << " iterations, rms slip " << result.residual
                       << Foam::endl;
        answer.kicks = s.kicks();
        const Stopwatch watch(s.timings.multipliers);
        s.report.momentum_defect = s.ledger.close(s.impulse_to_grains());
        s.fields.interpolate_flux();
        s.report.final_divergence = s.fields.largest_divergence();
    });
    check_finite(s.fields, "step 5 (multipliers)", window);
    check_finite(answer.kicks, window);
    if (window.write_output)
        with_foam_errors("writing fields", [&] {
            const Stopwatch watch(s.timings.output);
            s.fields.time.writeNow();
        });
    // The last window: lets function objects finish, as OpenFOAM's own loops do.
    if (s.fields.finished())
        with_foam_errors("ending function objects", [&] { s.fields.time.run(); });
    const FluidTimings& t = s.timings;
    s.report.wall_seconds =
        t.projection + t.transport + t.viscosity + t.points + t.multipliers + t.output;
    answer.report = s.report;
    return answer;
}

SavedState FoamAdapter::save() const {
    return save_fields(state_->fields);
}

void FoamAdapter::restore(const SavedState& state) {
    with_foam_errors("restoring the fluid", [&] { restore_fields(state, state_->fields); });
}

const FluidTimings& FoamAdapter::timings() const {
    return state_->timings;
}

const CollocationPoints& FoamAdapter::points() const {
    return state_->points;
}

void FoamAdapter::add_velocity(double x, double y) {
    state_->fields.U.primitiveFieldRef() += Foam::vector(x, y, 0.0);
    state_->fields.U.correctBoundaryConditions();
    state_->fields.interpolate_flux();
}

Vec3 FoamAdapter::velocity(int i, int j) const {
    const Foam::vector& u = state_->fields.U[state_->field.cell(i, j, 0)];
    return {u.x(), u.y(), u.z()};
}

double FoamAdapter::pressure(int i, int j) const {
    return state_->fields.p[state_->field.cell(i, j, 0)];
}

}  // namespace turbidite
