// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamStore.hpp"

#include <limits>

#include "fluid_adapter/foam_app/foamErrors.hpp"
#include "fluid_adapter/foam_app/makeFluidStep.hpp"

namespace turbidite {

FoamStore::FoamStore(const std::filesystem::path& directory, const RankGroup& ranks,
                     const Settings& settings)
    : domain_(fluid_domain(settings)),
      fields_(directory, ranks),
      field_(make_foam_field(fields_, domain_)),
      sides_(side_motions(settings), fields_),
      step_(make_fluid_step(settings, fields_, field_->grid(), field_->cell_numbers())),
      output_(fields_, settings),
      functions_(fields_.time),
      probes_(settings),
      slices_(settings, field_->grid(), directory) {
    // The step was made with the field's cells; the field works on the step's velocity.
    field_->work_on(*step_);
}

double FoamStore::equal_height() const {
    return stretched(domain_) ? domain_.equal_height : std::numeric_limits<double>::infinity();
}

MovedSides FoamStore::begin(const Window& window) {
    windows_ = window.index + 1;
    fields_.time.readModifiedObjects();
    // `false`: the step as given, not adjusted to times of output
    fields_.time.setDeltaT(window.step, false);
    // Before the time goes on: at the one that a run begins at, or goes on from.
    with_foam_errors("starting function objects", [&] { functions_.begin(); });
    if (finished())
        throw Failure(ExitCode::participant_failed, "window " + std::to_string(window.index) +
                                                        " begins at or after endTime of " +
                                                        "the fluid case's system/controlDict");
    ++fields_.time;
    return sides_.set(window.time, window.step);
}

void FoamStore::show(const std::vector<ImmersedGrain>& grains) {
    output_.compute(*field_, grains);
    functions_.execute();
    if (finished()) functions_.end();
}

void FoamStore::write(const std::vector<ImmersedGrain>& grains) {
    output_.compute(*field_, grains);
    // OpenFOAM's own errors stop the program, but a file that cannot be opened is only told here.
    if (!fields_.ranks.all(fields_.time.writeNow()))
        throw Failure(ExitCode::participant_failed, "OpenFOAM cannot write the fields at time " +
                                                        std::string(fields_.time.timeName()) +
                                                        ": is the disk full, or out of inodes?");
}

void FoamStore::write_slices(const std::vector<ImmersedGrain>& grains) {
    slices_.write(*field_, fields_.ranks, grains, windows_);
}

void FoamStore::guard(const std::string& doing, const std::function<void()>& work) const {
    with_foam_errors(doing, work);
}

void FoamStore::log(const std::string& line) const {
    Foam::Info << line << Foam::endl;
}

}  // namespace turbidite
