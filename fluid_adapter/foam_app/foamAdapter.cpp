// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamAdapter.hpp"

#include <OSspecific.H>
#include <sigFpe.H>

#include <chrono>
#include <stdexcept>

#include "coupler/protocol/freed_memory.hpp"
#include "fluid_adapter/box_step/transport_parts.hpp"
#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_app/foamErrors.hpp"
#include "fluid_adapter/foam_app/foamFluidField.hpp"
#include "fluid_adapter/foam_app/momentumLedger.hpp"
#include "fluid_adapter/foam_app/savedState.hpp"
#include "fluid_adapter/multiplier/immersed_step.hpp"

namespace turbidite {
namespace {

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

void check_finite(bool finite, const std::string& step, const Window& window) {
    if (!finite) refuse(step, window, "the fluid velocity is not finite; use a smaller time.step");
}

}  // namespace

struct FoamAdapter::State {
    State(const std::filesystem::path& directory, const RankGroup& ranks, const Settings& settings,
          const ShapeTable& table);

    FluidFields fields;
    FoamFluidField field;
    std::unique_ptr<FluidStep> step;
    bool fields_follow = true;  // p and phi hold what the step knows
    MomentumLedger ledger;
    ImmersedStep step_five;
    bool grains_taken = false;  // in this window
    FluidReport report;
    FluidTimings timings;

    void begin(const Window& window);
    void put_fields();
    template <class Take>
    void take_grains(const Window& window, Take take);
    void note(const Window& window, const MultiplierResult& result);
    Kicks finish(const Window& window);
};

FoamAdapter::State::State(const std::filesystem::path& directory, const RankGroup& ranks,
                          const Settings& settings, const ShapeTable& table)
    : fields(directory, ranks),
      field(fields, fluid_domain(settings)),
      step(make_fluid_step(settings, fields, field.grid(), field.cell_numbers())),
      ledger(fields),
      step_five(field, settings, table) {}

/// For whoever reads fields: output, function objects, a saved state.
void FoamAdapter::State::put_fields() {
    if (fields_follow) return;
    step->put_fields();
    fields.interpolate_flux();
    fields_follow = true;
}

void FoamAdapter::State::begin(const Window& window) {
    timings = {};
    report = {};
    grains_taken = false;
    if (!fields.time.functionObjects().empty()) put_fields();
    fields.time.setDeltaT(window.step);
    if (!fields.time.loop())
        throw Failure(ExitCode::participant_failed, "window " + std::to_string(window.index) +
                                                        " begins at or after endTime of " +
                                                        "the fluid case's system/controlDict");
}

/// The grains of this window, and the multipliers that hold them.
template <class Take>
void FoamAdapter::State::take_grains(const Window& window, Take take) {
    {
        const Stopwatch watch(timings.points);
        field.load();
        take();
    }
    const Stopwatch watch(timings.multipliers);
    note(window, step_five.solve());
    grains_taken = true;
}

/// A window's solves together.
void FoamAdapter::State::note(const Window& window, const MultiplierResult& result) {
    report.multiplier_iterations += result.iterations;
    report.multiplier_residual = result.residual;
    report.multipliers_converged = report.multipliers_converged && result.converged;
    if (!result.converged)
        Foam::Info << "window " << window.index << ": multipliers not converged after "
                   << result.iterations << " iterations, rms slip " << result.residual
                   << Foam::endl;
}

Kicks FoamAdapter::State::finish(const Window& window) {
    const Stopwatch watch(timings.multipliers);
    step_five.impose();
    field.store(step_five.points(), window.write_output);
    Planar to_grains = step_five.impulse_to_grains();
    field.sum_over_ranks(to_grains.data(), 2);
    report.momentum_defect = ledger.close({to_grains.x(), to_grains.y(), 0.0});
    if (window.write_output) {
        put_fields();
        report.final_divergence = fields.largest_divergence();
    }
    return {step_five.kicks(), {}};
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

void FoamAdapter::share(int communicator) {
    ranks_ = RankGroup(MPI_Comm_f2c(communicator));
    if (!ranks_.parallel()) return;
    int no_arguments = 0;
    char** none = nullptr;
    with_foam_errors("starting in parallel",
                     [&] { Foam::Pstream::init(no_arguments, none, false); });
}

Hello FoamAdapter::describe() const {
    Hello hello;
    hello.role = Role::fluid;
    hello.adapter = "openfoam";
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = "OpenFOAM 1912";
    hello.dimension = 2;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.effective_inertia = true;
    hello.capabilities.shapes = {"disc", "triangle", "polygon"};
    return hello;
}

Box FoamAdapter::initialise(const Settings& settings, const ShapeTable& shapes) {
    state_ = with_foam_errors("opening the case " + directory_.string(), [&] {
        return std::make_unique<State>(directory_, ranks_, settings, shapes);
    });
    const Foam::boundBox bounds(state_->fields.mesh.points(), false);
    return {{bounds.min().x(), bounds.min().y(), bounds.min().z()},
            {bounds.max().x(), bounds.max().y(), bounds.max().z()}};
}

void FoamAdapter::advance(const Window& window) {
    State& s = *state_;
    s.begin(window);
    s.ledger.open();
    s.fields_follow = false;
    in_step("step 1 (projection)", window, [&] {
        const Stopwatch watch(s.timings.projection);
        const FluxReport flux = s.step->project(s.ledger);
        s.report.divergence = flux.divergence;
        s.report.courant = flux.courant;
    });
    in_step("step 2 (transport)", window, [&] {
        const Stopwatch watch(s.timings.transport);
        s.step->transport(s.ledger, transport_parts(s.report.courant));
    });
    in_step("step 3 (viscosity)", window, [&] {
        const Stopwatch watch(s.timings.viscosity);
        s.step->diffuse(s.ledger);
    });
    check_finite(s.step->finite(), "steps 1-3 (projection, transport, viscosity)", window);
}

void FoamAdapter::let_fall(const Window& window, const std::vector<GrainState>& grains) {
    State& s = *state_;
    in_step("step 5 (free grains)", window,
            [&] { s.take_grains(window, [&] { s.step_five.take_free(grains, window.step); }); });
}

void FoamAdapter::correct(const Window& window, const std::vector<GrainState>& grains) {
    State& s = *state_;
    if (!s.grains_taken)
        return in_step("step 5 (multipliers)", window, [&] {
            s.take_grains(window, [&] { s.step_five.take_constrained(grains); });
        });
    in_step("step 5 (contact impulses)", window, [&] {
        const Stopwatch watch(s.timings.multipliers);
        s.note(window, s.step_five.push(grains));
    });
}

std::vector<FreeResponse> FoamAdapter::respond() {
    const Stopwatch watch(state_->timings.multipliers);
    return state_->step_five.responses();
}

Kicks FoamAdapter::impose(const Window& window) {
    State& s = *state_;
    Kicks answer = in_step("step 5 (multipliers)", window, [&] { return s.finish(window); });
    check_finite(s.ledger.finite(), "step 5 (multipliers)", window);
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
    state_->put_fields();
    return save_fields(state_->fields, *state_->step);
}

void FoamAdapter::restore(const SavedState& state) {
    with_foam_errors("restoring the fluid", [&] {
        restore_fields(state, state_->fields, *state_->step);
        state_->ledger.forget();
        state_->fields_follow = true;
    });
}

const FluidTimings& FoamAdapter::timings() const {
    return state_->timings;
}

const CollocationPoints& FoamAdapter::points() const {
    return state_->step_five.points();
}

void FoamAdapter::add_velocity(double x, double y) {
    state_->fields.U.primitiveFieldRef() += Foam::vector(x, y, 0.0);
    state_->fields.U.correctBoundaryConditions();
    state_->ledger.forget();
}

Vec3 FoamAdapter::velocity(int i, int j) const {
    const Foam::vector& u = state_->fields.U[state_->field.cell(i, j, 0)];
    return {u.x(), u.y(), u.z()};
}

double FoamAdapter::pressure(int i, int j) const {
    state_->put_fields();
    return state_->fields.p[state_->field.cell(i, j, 0)];
}

}  // namespace turbidite
