// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/physics/coupled_run.hpp"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

/// Writes the case and its mesh; returns the folder.
std::filesystem::path prepared(const std::filesystem::path& folder, const CoupledSetup& setup) {
    write_fluid_case(settings_of(setup), folder);
    build_fluid_mesh(folder, folder / "blockMesh.log");
    return folder;
}

void set_run_values(Settings& settings, const CoupledSetup& setup) {
    set_run_keys(settings);
    settings.set("run.gravity", setup.gravity);
    settings.set("run.acceleration_x", setup.acceleration_x);
    settings.set("run.viscosity", 1.0 / setup.reynolds);
    settings.set("run.step", setup.step);
    settings.set("run.windows", std::int64_t{setup.windows});
    settings.set("run.output_every", std::int64_t{setup.windows});
    settings.set("run.size_x", setup.width);
    settings.set("run.size_y", setup.height);
    settings.set("domain.left", setup.left);
    settings.set("domain.right", setup.right);
    settings.set("domain.bottom", setup.bottom);
    settings.set("domain.top", setup.top);
    settings.set("run.wall_motions", setup.wall_motions);
    settings.set("run.inflow_motions", setup.inflow_motions);
    settings.set("run.walls", setup.walls);
    settings.set("run.grain_motions", setup.grain_motions);
    settings.set("domain.left_profile", setup.left_profile);
    settings.set("run.probes", setup.probes);
    settings.set("output.fields", setup.fields);
}

void set_fluid_values(Settings& settings, const CoupledSetup& setup) {
    settings.set("fluid.cells_per_diameter", std::int64_t{setup.cells_per_diameter});
    settings.set("fluid.ranks", std::int64_t{1});
    settings.set("fluid.decomposition", std::string("rows"));
    settings.set("fluid.stretch_ratio", setup.stretch_ratio);
    settings.set("fluid.stretch_from", setup.stretch_from);
    settings.set("fluid.stretch_largest", 16.0);
    settings.set("fluid.allow_coarse", setup.allow_coarse);
    settings.set("fluid.points", setup.points);
    settings.set("fluid.point_spacing", 1.5);
    settings.set("fluid.hydrodynamic_radius", setup.hydrodynamic_radius);
    settings.set("fluid.multiplier_tolerance", setup.tolerance);
    settings.set("fluid.multiplier_iterations", setup.multiplier_iterations);
    settings.set("fluid.splitting", setup.splitting);
    settings.set("fluid.splitting_tolerance", setup.splitting_tolerance);
    settings.set("fluid.splitting_iterations", std::int64_t{200});
    settings.set("fluid.transport_scheme", setup.transport_scheme);
    settings.set("fluid.time_scheme", setup.time_scheme);
    settings.set("fluid.pressure_solver", setup.pressure_solver);
    settings.set("fluid.pressure_tolerance", setup.pressure_tolerance);
    settings.set("fluid.viscous_solver", setup.viscous_solver);
    settings.set("fluid.viscous_tolerance", setup.viscous_tolerance);
}

void set_contact_values(Settings& settings, const CoupledSetup& setup) {
    settings.set("contact.friction", 0.3);
    settings.set("contact.tolerance", setup.contact_tolerance);
    settings.set("contact.iterations", std::int64_t{2000});
    settings.set("contact.recovery_fraction", 0.2);
    settings.set("contact.recovery_speed", 0.5);
    settings.set("contact.solver", std::string("nlgs"));
    settings.set("run.slip_tolerance", settings.real("fluid.multiplier_tolerance"));
    settings.set("coupling.positions", std::string("corrected"));
    settings.set("limits.penetration", 0.2);
    settings.set("limits.grain_balance_soft", 1e-8);
    settings.set("limits.grain_balance_hard", 1e-4);
    settings.set("limits.fluid_balance_soft", 1e-6);
    settings.set("limits.fluid_balance_hard", 1e-2);
}

}  // namespace

CoupledSetup with_sides(const Sides& sides) {
    CoupledSetup setup;
    setup.left = sides.left;
    setup.right = sides.right;
    setup.bottom = sides.bottom;
    setup.top = sides.top;
    return setup;
}

Settings settings_of(const CoupledSetup& setup) {
    Settings settings;
    set_run_values(settings, setup);
    set_fluid_values(settings, setup);
    set_contact_values(settings, setup);
    return settings;
}

Settings settings_in_space(CoupledSetup setup, const std::array<int, 3>& cells,
                           const std::string& front, const std::string& back) {
    const double edge = 1.0 / setup.cells_per_diameter;
    setup.width = cells[0] * edge;
    setup.height = cells[1] * edge;
    setup.time_scheme = "second-order";
    setup.transport_scheme = "Gauss LUST grad(U)";
    setup.points = "interior";
    Settings settings = settings_of(setup);
    settings.set("run.dimension", std::int64_t{3});
    settings.set("run.size_z", cells[2] * edge);
    settings.set("run.acceleration_z", 0.0);
    settings.set("run.surface_shift", 0.3 * edge);
    settings.set("domain.front", front);
    settings.set("domain.back", back);
    return settings;
}

GrainState disc_at(const CoupledSetup& setup, double x, double y, double vx, double vy) {
    GrainState grain;
    grain.id = 1;
    grain.radius = 0.5;
    grain.density = setup.density_ratio;
    grain.position = {x, y, 0.0};
    grain.velocity = {vx, vy, 0.0};
    return grain;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "turbidite-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder " + name);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;  // a folder left behind is no reason to fail
    std::filesystem::remove_all(path_, ignored);
}

CoupledRun::CoupledRun(const CoupledSetup& setup, std::vector<GrainState> grains)
    : setup_(setup), fluid_(prepared(folder_.path(), setup)), grains_(std::move(grains)) {
    const Settings settings = settings_of(setup);
    const ShapeTable shapes = {setup.shape};
    for (std::size_t g = 0; g < grains_.size(); ++g) grains_[g].id = static_cast<GrainId>(g) + 1;
    fluid_.initialise(settings, shapes);
    grains_ = contact_.initialise(settings, shapes, grains_).grains;
}

ImmersedBody CoupledRun::body() const {
    return immersed_body(*make_shape(setup_.shape), 0.5, setup_.density_ratio, 1.0,
                         setup_.hydrodynamic_radius);
}

void CoupledRun::advance(bool write_output) {
    const Window window{window_, static_cast<double>(window_) * setup_.step, setup_.step,
                        write_output};
    before_ = grains_;
    fluid_.advance(window);
    if (splitting_of(settings_of(setup_)).rigid_grains)
        solve_jointly(window);
    else
        solve_split(window);
    answer_ = fluid_.impose(window);
    const Motion state = contact_.apply_kick(window, answer_.kicks);
    grains_ = state.grains;
    contact_violation_ = state.report.contact_violation.value();
    ++window_;
}

void CoupledRun::solve_split(const Window& window) {
    const Motion motion = contact_.advance(window, {});
    between_ = motion.grains;
    contacts_ += motion.report.contacts;
    fluid_.correct(window, between_);
}

void CoupledRun::solve_jointly(const Window& window) {
    constexpr int most_rounds = 50;
    fluid_.let_fall(window, grains_);
    std::vector<FreeResponse> responses = fluid_.respond();
    std::int64_t contacts = 0;
    for (rounds_ = 0; rounds_ == 0 || mismatch_ > setup_.joint_tolerance; ++rounds_) {
        if (rounds_ == most_rounds) throw std::runtime_error("contacts and fluid do not agree");
        const Motion motion = contact_.advance(window, responses);
        between_ = motion.grains;
        contacts = motion.report.contacts;
        fluid_.correct(window, between_);
        responses = fluid_.respond();
        mismatch_ = 0.0;
        for (const FreeResponse& response : responses)
            mismatch_ = std::max(mismatch_, response.mismatch);
    }
    contacts_ += contacts;
}

void resume_after_three(CoupledRun& straight, CoupledRun& resumed) {
    for (int n = 0; n < 3; ++n) straight.advance();
    const SavedState state = straight.fluid().save();
    resumed.advance();
    resumed.fluid().restore(state);
}

void advance_both(CoupledRun& straight, CoupledRun& resumed) {
    const double step = straight.setup().step;
    for (CoupledRun* run : {&straight, &resumed}) run->fluid().advance({3, 3 * step, step});
}

double largest_difference(CoupledRun& a, CoupledRun& b, std::array<int, 2> cells) {
    double largest = 0.0;
    const double per_p = a.setup().step * a.setup().cells_per_diameter;
    for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i) {
            for (int axis : {0, 1})
                largest = std::max(largest, std::abs(a.fluid().velocity(i, j)[axis] -
                                                     b.fluid().velocity(i, j)[axis]));
            const double dp = a.fluid().pressure(i, j) - b.fluid().pressure(i, j);
            largest = std::max(largest, per_p * std::abs(dp));
        }
    return largest;
}

}  // namespace turbidite
