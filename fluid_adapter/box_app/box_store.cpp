// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_store.hpp"

#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/splitting.hpp"
#include "fluid_adapter/box_app/central_divergence.hpp"
#include "fluid_adapter/fluid_window/box_of_grid.hpp"
#include "fluid_adapter/fluid_window/grid_of_domain.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

FluidDomain domain_in_space(const Settings& settings) {
    FluidDomain domain = fluid_domain(settings);
    if (domain.dimension == 3) return domain;
    throw Failure(ExitCode::bad_input, "fluid.program = box is for dimension: 3");
}

/// Numbers i + nx (k + nz j) of the layers that `simple (1 n 1)` gives this rank.
std::vector<int> cells_of_rank(const CellGrid& grid, const RankGroup& ranks) {
    const auto first_of = [&](int rank) {
        return (rank * grid.counts[1] + ranks.size() - 1) / ranks.size();
    };
    const int layer = grid.counts[0] * grid.counts[2];
    std::vector<int> cells((first_of(ranks.rank() + 1) - first_of(ranks.rank())) * layer);
    std::iota(cells.begin(), cells.end(), first_of(ranks.rank()) * layer);
    return cells;
}

void set_transport(BoxFluid& fluid, const Settings& settings) {
    const std::string& scheme = settings.text("fluid.transport_scheme");
    const std::pair<const char*, double> central[] = {
        {"Gauss linearUpwind ", 0.0}, {"Gauss LUST ", 0.75}, {"Gauss linear", 1.0}};
    for (const auto& [name, share] : central) {
        if (scheme.rfind(name, 0) != 0) continue;
        fluid.central = share;
        return;
    }
    const std::string limited = "Gauss limitedLinearV ";
    if (scheme.rfind(limited, 0) != 0)
        throw Failure(ExitCode::bad_input, "fluid.transport_scheme = " + scheme +
                                               " is not known by fluid.program = box");
    fluid.limiter = std::max(std::stod(scheme.substr(limited.size())), 1e-15);
}

BoxFluid fluid_of(const CellGrid& grid, const RunValues& run, const Settings& settings) {
    BoxFluid fluid = box_of(grid);
    fluid.viscosity = run.viscosity;
    fluid.second_order = settings.text("fluid.time_scheme") == "second-order";
    set_transport(fluid, settings);
    return fluid;
}

bool names_solid(const Settings& settings) {
    return settings.has("output.fields") &&
           settings.text("output.fields").find("solid") != std::string::npos;
}

}  // namespace

LayerFields::LayerFields(BoxField& field, const CellRows& rows,
                         const std::array<SideMotion, box_sides.size()>& motions)
    : field_(field), rows_(rows), motions_(motions), held_(sides_at_rest(field.grid())) {}

void LayerFields::read_pressure(double* p) {
    std::copy(field_.pressure().begin(), field_.pressure().end(), p);
}

void LayerFields::write_pressure(const double* p, bool floating) {
    field_.set_pressure(p, floating ? rows_.first(p) : 0.0);
}

bool LayerFields::set_sides(double time, double step) {
    bool any = false;
    for (std::size_t side = 0; side < box_sides.size(); ++side) {
        if (!motions_[side].motion) continue;
        any = true;
        const Vec3 v = motions_[side].velocity(time, step);
        for (std::size_t axis = 0; axis < 3; ++axis)
            std::fill(held_[axis][side].begin(), held_[axis][side].end(), v[axis]);
    }
    return any;
}

BoxStore::BoxStore(const Settings& settings, const RankGroup& ranks,
                   const std::filesystem::path& folder)
    : domain_(domain_in_space(settings)),
      run_(run_values(settings)),
      ranks_(ranks),
      grid_(grid_of(domain_, 1.0)),
      rows_(ranks, grid_.counts[0] * grid_.counts[2], grid_.counts[1], cells_of_rank(grid_, ranks)),
      field_(grid_, run_.fluid_density, ranks, rows_.rows_of_rank()[ranks.rank()]),
      neighbours_(box_rows()),
      probes_(settings),
      slices_(settings, grid_, folder),
      solid_(names_solid(settings)),
      folder_(folder) {
    auto fields = std::make_unique<LayerFields>(field_, rows_, side_motions(settings));
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

bool BoxStore::begin(const Window& window) {
    windows_ = window.index + 1;
    return fields_->set_sides(window.time, window.step);
}

double BoxStore::largest_divergence() const {
    double largest = largest_central_divergence(field_, *neighbours_, fields_->held());
    ranks_.max(&largest, 1);
    return largest;
}

/// The whole box, on every rank: by rank, the layers of the others are zero.
void BoxStore::write(const std::vector<ImmersedGrain>& grains) {
    const LayerCells layers = field_.layers();
    const std::vector<double> shares =
        solid_ ? covered_share(field_, grains) : std::vector<double>();
    const auto whole = [&](const std::string& name, int components, auto value) {
        SliceArray array{name, components, {}};
        array.values.resize(static_cast<std::size_t>(components) * grid_.counts[0] *
                            grid_.counts[1] * grid_.counts[2]);
        std::vector<double> sum(array.values.size());
        for (int j = 0; j < layers.count; ++j)
            for (int k = 0; k < grid_.counts[2]; ++k)
                for (int i = 0; i < grid_.counts[0]; ++i) {
                    const int cell = layers.cell(i, layers.first + j, k);
                    const std::size_t place =
                        i + grid_.counts[0] *
                                (layers.first + j + static_cast<std::size_t>(grid_.counts[1]) * k);
                    for (int c = 0; c < components; ++c)
                        sum[components * place + c] = value(cell, c);
                }
        ranks_.sum(sum.data(), static_cast<int>(sum.size()));
        std::copy(sum.begin(), sum.end(), array.values.begin());
        return array;
    };
    std::vector<SliceArray> arrays{
        whole("p", 1, [&](int cell, int) { return field_.shown_pressure(cell); }),
        whole("U", 3, [&](int cell, int c) { return field_.shown_velocity(cell)[c]; })};
    if (solid_) arrays.push_back(whole("solid", 1, [&](int cell, int) { return shares[cell]; }));
    if (ranks_.rank() != 0) return;
    SliceEdges edges;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < grid_.counts[axis]; ++i)
            edges[axis].push_back(grid_.centre(axis, i) - 0.5 * grid_.size(axis, i));
        edges[axis].push_back(grid_.origin[axis] + grid_.length(axis));
    }
    const std::filesystem::path series = folder_ / "fields";
    std::filesystem::create_directories(series);
    write_slice(series / slice_file_name("fields", windows_), edges, arrays);
    write_slice_series(series, {"fields"}, run_.step);
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
