// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/physics/fluid_run.hpp"

#include <stdlib.h>

#include <stdexcept>

#include "coupler/shapes/disc.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"

namespace turbidite {
namespace {

std::filesystem::path new_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "turbidite-fluid-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder " + name);
    return name;
}

}  // namespace

Settings settings_of(const FluidRunSetup& setup) {
    Settings settings;
    settings.set("run.diameter", 1.0);
    settings.set("run.velocity_scale", 1.0);
    settings.set("run.fluid_density", 1.0);
    settings.set("run.viscosity", 1.0 / setup.reynolds);
    settings.set("run.step", setup.step);
    settings.set("run.windows", std::int64_t{setup.windows});
    settings.set("run.size_x", setup.width);
    settings.set("run.size_y", setup.height);
    settings.set("domain.left", setup.left_right);
    settings.set("domain.right", setup.left_right);
    settings.set("domain.bottom", setup.bottom);
    settings.set("domain.top", setup.top);
    settings.set("fluid.cells_per_diameter", std::int64_t{setup.cells_per_diameter});
    settings.set("fluid.ranks", std::int64_t{1});
    settings.set("fluid.points", setup.points);
    settings.set("fluid.point_spacing", 1.5);
    settings.set("fluid.hydrodynamic_radius", setup.hydrodynamic_radius);
    settings.set("fluid.multiplier_tolerance", setup.tolerance);
    settings.set("fluid.multiplier_iterations", std::int64_t{200});
    settings.set("fluid.transport_scheme", std::string("Gauss limitedLinearV 1"));
    settings.set("fluid.pressure_solver", std::string("GAMG"));
    settings.set("fluid.pressure_tolerance", 1e-6);
    settings.set("fluid.viscous_tolerance", 1e-8);
    return settings;
}

FluidRun::FluidRun(const FluidRunSetup& setup) : setup_(setup), folder_(new_folder()) {
    const Settings settings = settings_of(setup);
    write_fluid_case(settings, folder_);
    build_fluid_mesh(folder_, folder_ / "blockMesh.log");
    fluid_ = std::make_unique<FoamAdapter>(folder_);
    fluid_->initialise(settings, {ShapeRecord{"disc", {}}});
}

FluidRun::~FluidRun() {
    fluid_.reset();
    std::error_code ignored;  // a left-over folder in /tmp is no reason to fail a test
    std::filesystem::remove_all(folder_, ignored);
}

void FluidRun::add_disc(double x, double y, double vx, double vy) {
    GrainState grain;
    grain.id = static_cast<GrainId>(grains_.size()) + 1;
    grain.radius = 0.5;
    grain.density = setup_.density_ratio;
    grain.position = {x, y, 0.0};
    grain.velocity = {vx, vy, 0.0};
    grains_.push_back(grain);
}

ImmersedBody FluidRun::body() const {
    return immersed_body(Disc(), 0.5, setup_.density_ratio, 1.0, setup_.hydrodynamic_radius);
}

void FluidRun::advance(bool write_output) {
    const Window window{window_, static_cast<double>(window_) * setup_.step, setup_.step,
                        write_output, false};
    fluid_->advance(window);
    const ImmersedBody b = body();
    given_ = grains_;
    for (GrainState& grain : given_)
        grain.velocity[1] -= b.submerged_mass / b.effective_mass * setup_.gravity * setup_.step;
    answer_ = fluid_->impose(window, given_);
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const Kick& kick = answer_.kicks.at(g);
        grains_[g].velocity = kick.velocity;
        grains_[g].angular_velocity = kick.angular_velocity;
        for (int axis = 0; axis < 2; ++axis)
            grains_[g].position[axis] += setup_.step * kick.velocity[axis];
    }
    ++window_;
}

}  // namespace turbidite
