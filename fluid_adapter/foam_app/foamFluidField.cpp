// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamFluidField.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

/// Cell centres may deviate by this fraction of a cell: blockMesh writes its points as text.
constexpr double placement_tolerance = 1e-4;

/// Stencils of points in this rank's cells reach two layers beyond them. There is one layer more,
/// so that no rounding of a position makes a stencil leave the halo, which would go unnoticed.
constexpr int halo_layers = 3;

Side side_of(const std::string& kind) {
    if (kind == "cyclic") return Side::cyclic;
    return kind == "free" ? Side::open : Side::wall;  // grains keep to the inside of an inflow too
}

CellGrid grid_of(const FluidDomain& domain, double thickness) {
    CellGrid grid;
    grid.dimension = domain.dimension;
    for (int axis = 0; axis < grid.dimension; ++axis) {
        grid.counts[axis] = domain.cells[axis];
        grid.spacing[axis] = domain.size[axis] / domain.cells[axis];
        grid.sides[axis] = {side_of(domain.sides[2 * axis]), side_of(domain.sides[2 * axis + 1])};
    }
    if (stretched(domain)) grid.stretch(1, domain.row_edges);
    if (grid.dimension == 2) grid.spacing[2] = thickness;
    return grid;
}

}  // namespace

FoamFluidField::FoamFluidField(FluidFields& fields, const FluidDomain& domain)
    : fields_(fields), grid_(grid_of(domain, fields.thickness)) {
    owned_ = fields.mesh.nCells();
    cell_mass_ = fields.rho * grid_.spacing[0] * grid_.spacing[1];
    if (grid_.dimension == 3) cell_mass_ *= grid_.spacing[2];
    if (fields.ranks.parallel()) shared_ = std::make_unique<SharedGrains>(fields.ranks);
    if (grid_.dimension == 2) know_halo();
}

/// In the plane, where points on surfaces interpolate from cells around them.
void FoamFluidField::know_halo() {
    const FluidFields& fields = fields_;
    block_.emplace(grid_, cell_numbers(), fields.ranks.parallel() ? halo_layers : 0);
    if (fields.ranks.parallel()) {
        halo_ = std::make_unique<HaloExchange>(fields.ranks, grid_.counts[0] * grid_.counts[1],
                                               cell_numbers(), block_->halo());
        block_->number_halo(halo_->halo());
        in_a_halo_.assign(owned_, 0);
        shared_cells_ = halo_->shared();
        for (const int cell : shared_cells_) in_a_halo_[cell] = 1;
    }
    cells_ = block_->table();
    for (std::vector<double>& halo : halo_velocity_) halo.resize(block_->halo().size());
    copy_velocity();
}

std::vector<int> FoamFluidField::cell_numbers() const {
    std::vector<int> numbers;
    bool as_asked = true;
    for (const Foam::point& centre : fields_.mesh.cellCentres()) {
        int index[3] = {};
        for (int axis = 0; axis < grid_.dimension; ++axis) {
            index[axis] = std::max(grid_.wrapped(axis, grid_.layer(axis, centre[axis])), 0);
            const double off = centre[axis] - grid_.centre(axis, index[axis]);
            as_asked =
                as_asked && std::abs(off) < placement_tolerance * grid_.size(axis, index[axis]);
        }
        numbers.push_back(index[0] + grid_.counts[0] * (index[2] + grid_.counts[2] * index[1]));
    }
    double cells = static_cast<double>(numbers.size());
    fields_.ranks.sum(&cells, 1);
    as_asked = as_asked &&
               cells == static_cast<double>(grid_.counts[0]) * grid_.counts[1] * grid_.counts[2];
    if (!fields_.ranks.all(as_asked))
        throw Failure(ExitCode::bad_input,
                      std::string("the fluid mesh is not the ") +
                          (grid_.stretched(1) ? "stretched" : "uniform") + " grid of " +
                          std::to_string(grid_.counts[0]) + " x " +
                          std::to_string(grid_.counts[1]) +
                          (grid_.dimension == 3 ? " x " + std::to_string(grid_.counts[2]) : "") +
                          " cells that the case asks for: run blockMesh (and decomposePar, on "
                          "several ranks) on the fluid case again");
    return numbers;
}

void FoamFluidField::work_on(FluidStep& step) {
    if (step.velocity(0) == nullptr) return copy_velocity();
    copies_used_ = false;
    for (std::vector<double>& copy : copies_) copy = {};
    for (int axis = 0; axis < grid_.dimension; ++axis) velocity_[axis] = step.velocity(axis);
    if (grid_.dimension == 3) find_layers();
}

void FoamFluidField::copy_velocity() {
    copies_used_ = true;
    for (int axis = 0; axis < 2; ++axis) {
        copies_[axis].resize(owned_);
        velocity_[axis] = copies_[axis].data();
    }
}

/// In space local indices are those of layers, not of the mesh.
void FoamFluidField::find_layers() {
    const std::vector<int> numbers = cell_numbers();
    first_cell_ = *std::min_element(numbers.begin(), numbers.end());
    mesh_cell_.resize(numbers.size());
    for (std::size_t c = 0; c < numbers.size(); ++c)
        mesh_cell_[numbers[c] - first_cell_] = static_cast<int>(c);
}

std::array<const double*, 2> FoamFluidField::import_halo(const double* x, const double* y) {
    if (halo_) halo_->import({x, y}, {halo_velocity_[0].data(), halo_velocity_[1].data()});
    return {halo_velocity_[0].data(), halo_velocity_[1].data()};
}

void FoamFluidField::share_sums(double* x, double* y) const {
    if (!halo_) return;
    halo_->export_sums({x, y});
    halo_->import({x, y});
}

void FoamFluidField::sum_over_ranks(double* values, int count) const {
    fields_.ranks.sum(values, count);
}

void FoamFluidField::hold_grains(const GrainId* ids, int count) const {
    if (shared_) shared_->hold(ids, count);
}

void FoamFluidField::sum_over_holders(double* rows, int per_grain) const {
    if (shared_) shared_->sum(rows, per_grain);
}

Vec3 FoamFluidField::velocity_of(int cell) const {
    if (copies_used_) return {fields_.U[cell].x(), fields_.U[cell].y(), 0.0};
    return {velocity_[0][cell], velocity_[1][cell], velocity_[2] ? velocity_[2][cell] : 0.0};
}

void FoamFluidField::accelerate(const Vec3& change) {
    if (copies_used_) {
        fields_.U.primitiveFieldRef() += Foam::vector(change[0], change[1], 0.0);
        fields_.U.correctBoundaryConditions();
        return;
    }
    for (int axis = 0; axis < grid_.dimension; ++axis)
        for (int cell = 0; cell < owned_; ++cell) velocity_[axis][cell] += change[axis];
}

FluidMomentum FoamFluidField::momentum() const {
    if (copies_used_) return fields_.momentum();
    if (grid_.dimension == 3) return momentum_of_layers();
    return fields_.momentum(velocity_[0], velocity_[1]);
}

FluidMomentum FoamFluidField::momentum_of_layers() const {
    std::array<double, 4> sums{};
    const LayerCells layers = this->layers();
    const std::size_t layer = layers.cells() / layers.count;
    for (int j = 0; j < layers.count; ++j) {
        const double mass = cell_mass(0, layers.first + j);
        for (int axis = 0; axis < 3; ++axis) {
            const double* u = velocity_[axis] + j * layer;
            double sum = 0.0, sizes = 0.0;
            for (std::size_t c = 0; c < layer; ++c) sum += u[c], sizes += std::abs(u[c]);
            sums[axis] += mass * sum, sums[3] += mass * sizes;
        }
    }
    fields_.ranks.sum(sums.data(), static_cast<int>(sums.size()));
    return {{sums[0], sums[1], sums[2]}, sums[3]};
}

void FoamFluidField::load(const Constraint& constraint) {
    if (!copies_used_) return;
    constraint.for_cells([&](int cell) { load(cell); });
    for (const int cell : shared_cells_) load(cell);
}

void FoamFluidField::load(int cell) {
    velocity_[0][cell] = fields_.U[cell].x();
    velocity_[1][cell] = fields_.U[cell].y();
}

void FoamFluidField::store(const Constraint& constraint) {
    if (!copies_used_) return;
    constraint.for_cells([&](int cell) {
        fields_.U[cell] = Foam::vector(velocity_[0][cell], velocity_[1][cell], 0.0);
    });
    fields_.U.correctBoundaryConditions();
}

void FoamFluidField::put_force_density(const Constraint& constraint) {
    fields_.lambda.primitiveFieldRef() = Foam::Zero;
    const Foam::scalar rate = fields_.rho / fields_.time.deltaTValue();
    constraint.for_cells([&](int cell) {
        const Vec3 corrected =
            copies_used_ ? Vec3{velocity_[0][cell], velocity_[1][cell], 0.0} : velocity_of(cell);
        const int at = mesh_cell(cell);
        fields_.lambda[at] =
            rate * (fields_.U[at] - Foam::vector(corrected[0], corrected[1], corrected[2]));
    });
}

}  // namespace turbidite
