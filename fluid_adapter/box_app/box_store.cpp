// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_store.hpp"

#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/box_app/interpolated_velocity.hpp"
#include "fluid_adapter/box_step/transport/convective_flux.hpp"
#include "fluid_adapter/fluid_window/box_of_grid.hpp"
#include "fluid_adapter/fluid_window/grid_of_domain.hpp"
#include "fluid_adapter/fluid_window/wanted_fields.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

FluidDomain domain_in_space(const Settings& settings) {
    FluidDomain domain = fluid_domain(settings);
    if (domain.dimension == 3) return domain;
    throw Failure(ExitCode::bad_input, "fluid.program = box is for dimension: 3");
}

/// Numbers i + nx (k + nz j) of the layers of this rank.
std::vector<int> cells_of_rank(const Settings& settings, const CellGrid& grid,
                               const RankGroup& ranks) {
    const std::vector<int> first = first_layers(settings, grid.counts[1], ranks.size());
    const int layer = grid.counts[0] * grid.counts[2];
    std::vector<int> cells((first[ranks.rank() + 1] - first[ranks.rank()]) * layer);
    std::iota(cells.begin(), cells.end(), first[ranks.rank()] * layer);
    return cells;
}

/// The cases of this program have no other scheme.
void set_transport(BoxFluid& fluid, const Settings& settings) {
    std::istringstream words(settings.text("fluid.transport_scheme"));
    std::string gauss, scheme;
    words >> gauss >> scheme;
    if (gauss == "Gauss") fluid.central = central_share(scheme);
    if (fluid.central) return;
    std::optional<double> limiter;
    if (double k = 0.0; gauss == "Gauss" && scheme == "limitedLinearV" && words >> k)
        limiter = limiter_of_steps(k);
    if (!limiter)
        throw Failure(ExitCode::bad_input,
                      "fluid.transport_scheme = " + settings.text("fluid.transport_scheme") +
                          " is not known by fluid.program = box; use Gauss limitedLinearV k "
                          "with k from 0 to 1, linear, LUST grad(U) or linearUpwind grad(U)");
    fluid.limiter = *limiter;
}

BoxFluid fluid_of(const CellGrid& grid, const RunValues& run, const Settings& settings) {
    BoxFluid fluid = box_of(grid);
    fluid.viscosity = run.viscosity;
    fluid.second_order = settings.text("fluid.time_scheme") == "second-order";
    set_transport(fluid, settings);
    return fluid;
}

}  // namespace

LayerFields::LayerFields(BoxField& field, const CellRows& rows,
                         const std::array<SideMotion, box_sides.size()>& motions)
    : field_(field), rows_(rows), motions_(motions), held_(sides_at_rest(field.grid())) {}

void LayerFields::read_pressure(double* p) {
    std::copy(field_.pressure().begin(), field_.pressure().end(), p);
}

void LayerFields::write_pressure(const double* p, bool floating) {
    // Where no side fixes p it is shown relative to cell (0, 0, 0).
    field_.set_pressure(p, floating ? rows_.first(p) : 0.0);
}

MovedSides LayerFields::set_sides(double time, double step) {
    MovedSides moved;
    for (std::size_t side = 0; side < box_sides.size(); ++side) {
        if (!motions_[side].motion) continue;
        const Vec3 v = motions_[side].velocity(time, step);
        moved.add(side, v);
        for (std::size_t axis = 0; axis < 3; ++axis)
            std::fill(held_[axis][side].begin(), held_[axis][side].end(), v[axis]);
    }
    return moved;
}

BoxStore::BoxStore(const Settings& settings, const RankGroup& ranks,
                   const std::filesystem::path& folder)
    : domain_(domain_in_space(settings)),
      run_(run_values(settings)),
      ranks_(ranks),
      grid_(grid_of(domain_, 1.0)),
      rows_(ranks, grid_.counts[0] * grid_.counts[2], grid_.counts[1],
            cells_of_rank(settings, grid_, ranks)),
      field_(grid_, run_.fluid_density, ranks, rows_.rows_of_rank()[ranks.rank()]),
      neighbours_(box_rows()),
      probes_(settings),
      slices_(settings, grid_, folder),
      series_(folder, run_.step),
      solid_(is_wanted(settings, "solid")),
      vorticity_(is_wanted(settings, "vorticity")) {
    auto fields = std::make_unique<LayerFields>(field_, rows_, side_motions(settings));
    // The step owns them; sides are set through this pointer.
    fields_ = fields.get();
    step_ = std::make_unique<BoxFluidStep>(fluid_of(grid_, run_, settings), box_rows(),
                                           std::move(fields), ranks_,
                                           splitting_of(settings).rigid_grains);
    field_.work_on(*step_);
}

std::unique_ptr<BoxRows> BoxStore::box_rows() const {
    const SeparableOperator pressure = box_of(grid_).pressure;
    if (!ranks_.parallel()) return std::make_unique<AllRows>(pressure);
    return std::make_unique<RankRows>(ranks_, pressure, rows_);
}

double BoxStore::equal_height() const {
    return stretched(domain_) ? domain_.equal_height : std::numeric_limits<double>::infinity();
}

MovedSides BoxStore::begin(const Window& window) {
    windows_ = window.index + 1;
    return fields_->set_sides(window.time, window.step);
}

double BoxStore::largest_divergence() const {
    double largest = largest_divergence_of(field_, *neighbours_, fields_->held());
    ranks_.max(&largest, 1);
    return largest;
}

void BoxStore::write(const std::vector<ImmersedGrain>& grains) {
    std::vector<WrittenField> fields{
        {"p", 1, [&](int cell, const CellIndex&, int) { return field_.shown_pressure(cell); }},
        {"U", 3,
         [&](int cell, const CellIndex&, int c) { return field_.shown_velocity(cell)[c]; }}};
    std::vector<double> shares;
    if (solid_) {
        shares = covered_share(field_, grains);
        fields.push_back(
            {"solid", 1, [&](int cell, const CellIndex&, int) { return shares[cell]; }});
    }
    std::optional<InterpolatedVelocity> faces;
    if (vorticity_) {
        faces.emplace(field_, *neighbours_, fields_->held());
        fields.push_back(
            {"vorticity", 3, [&](int, const CellIndex& at, int c) { return faces->curl(at)[c]; }});
    }
    series_.write(field_, ranks_, fields, windows_);
}

void BoxStore::write_slices(const std::vector<ImmersedGrain>& grains) {
    slices_.write(field_, ranks_, grains, windows_);
}

void BoxStore::log(const std::string& line) const {
    if (ranks_.rank() == 0) std::printf("%s\n", line.c_str());
}

Box BoxStore::box() const {
    const LayerCells layers = field_.layers();
    const int last = layers.first + layers.count - 1;
    return {{0.0, grid_.centre(1, layers.first) - 0.5 * grid_.size(1, layers.first), 0.0},
            {grid_.length(0), grid_.centre(1, last) + 0.5 * grid_.size(1, last), grid_.length(2)}};
}

}  // namespace turbidite
