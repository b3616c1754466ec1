// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamAdapter.hpp"

#include <OSspecific.H>
#include <sigFpe.H>

#include "coupler/protocol/files/freed_memory.hpp"
#include "fluid_adapter/domain/grain_reach.hpp"
#include "fluid_adapter/foam_app/foamErrors.hpp"
#include "fluid_adapter/foam_app/foamStore.hpp"
#include "fluid_adapter/foam_app/savedState.hpp"

namespace turbidite {

FoamAdapter::FoamAdapter(std::filesystem::path directory) : directory_(std::move(directory)) {
    // Errors have to reach the coupler instead of ending the program.
    Foam::FatalError.throwExceptions();
    Foam::FatalIOError.throwExceptions();
    // Debian's controlDict switches on the floating-point trap, which kills the job without a
    // message; here finiteness is checked instead. If the user sets FOAM_SIGFPE, the trap is set
    // again.
    if (!Foam::getEnv("FOAM_SIGFPE").empty()) Foam::sigFpe::set(false);
    keep_freed_memory();
}

FoamAdapter::~FoamAdapter() = default;

void FoamAdapter::share(int communicator) {
    ranks_ = RankGroup(MPI_Comm_f2c(communicator));
    if (!ranks_.parallel()) return;
    // OpenFOAM's own messages go over MPI_COMM_WORLD, which is this communicator by now.
    int no_arguments = 0;
    char** none = nullptr;
    with_foam_errors("starting in parallel",
                     [&] { Foam::Pstream::init(no_arguments, none, false); });
}

Hello FoamAdapter::describe() const {
    Hello hello = hello_of_window();
    hello.adapter = "openfoam";
    hello.host_code = "OpenFOAM 1912";
    hello.dimension = 0;  // both
    hello.capabilities.shapes = {"disc", "triangle", "polygon", "sphere"};
    return hello;
}

Box FoamAdapter::initialise(const Settings& settings, const ShapeTable& shapes) {
    with_foam_errors("opening the case " + directory_.string(), [&] {
        store_ = std::make_unique<FoamStore>(directory_, ranks_, settings);
        window_ = std::make_unique<FluidWindow>(*store_, settings, shapes);
    });
    // `false`: of this rank's part of the mesh, not reduced over the ranks
    const Foam::boundBox bounds(store_->fields().mesh.points(), false);
    return with_reach({{bounds.min().x(), bounds.min().y(), bounds.min().z()},
                       {bounds.max().x(), bounds.max().y(), bounds.max().z()}},
                      settings);
}

FluidRank FoamAdapter::of_this_rank() const {
    return {store_->fields(), store_->step(), store_->field().cell_numbers()};
}

SavedState FoamAdapter::save() const {
    // Steps may keep u and p to themselves; what is saved are the fields.
    window_->put_fields();
    return save_fields(of_this_rank());
}

void FoamAdapter::restore(const SavedState& state) {
    with_foam_errors("restoring the fluid", [&] {
        restore_fields(state, of_this_rank());
        window_->fields_replaced();
    });
}

void FoamAdapter::restore_from(const std::vector<SavedState>& of_ranks) {
    restore(part_of(of_ranks, of_this_rank()));
}

const FluidTimings& FoamAdapter::timings() const {
    return window_->timings();
}

void FoamAdapter::add_velocity(double x, double y) {
    window_->put_fields();
    Foam::volVectorField& U = store_->fields().U;
    U.primitiveFieldRef() += Foam::vector(x, y, 0.0);
    U.correctBoundaryConditions();
    window_->velocity_changed();
}

Vec3 FoamAdapter::velocity(int i, int j, int k) const {
    const FoamField& field = store_->field();
    return field.velocity_of(field.cell(i, j, k));
}

double FoamAdapter::pressure(int i, int j, int k) const {
    window_->put_fields();
    const FoamField& field = store_->field();
    return field.shown_pressure(field.cell(i, j, k));
}

}  // namespace turbidite
