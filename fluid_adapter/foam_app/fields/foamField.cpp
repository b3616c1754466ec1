// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/foamField.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/fluid_window/grid_of_domain.hpp"
#include "fluid_adapter/foam_app/fields/planeField.hpp"
#include "fluid_adapter/foam_app/fields/spaceField.hpp"

namespace turbidite {
namespace {

/// Cell centres may deviate by this fraction of a cell: blockMesh writes its points as text.
constexpr double placement_tolerance = 1e-4;

}  // namespace

FoamField::FoamField(FluidFields& fields, const FluidDomain& domain)
    : fields_(fields),
      grid_(grid_of(domain, fields.thickness)),
      cell_mass_(fields.rho * grid_.spacing[0] * grid_.spacing[1]) {
    if (grid_.dimension == 3) cell_mass_ *= grid_.spacing[2];
    // A single rank holds every grain alone: nothing is summed.
    if (fields.ranks.parallel()) shared_ = std::make_unique<SharedGrains>(fields.ranks);
}

std::vector<int> FoamField::cell_numbers() const {
    std::vector<int> numbers;
    bool as_asked = true;
    // By the places of the cells, whatever the numbering of the mesh and its decomposition
    for (const Foam::point& centre : fields_.mesh.cellCentres()) {
        int index[3] = {};
        for (int axis = 0; axis < grid_.dimension; ++axis) {
            // A centre outside the grid is off by more than the tolerance from cell 0.
            index[axis] = std::max(grid_.wrapped(axis, grid_.layer(axis, centre[axis])), 0);
            const double off = centre[axis] - grid_.centre(axis, index[axis]);
            as_asked =
                as_asked && std::abs(off) < placement_tolerance * grid_.size(axis, index[axis]);
        }
        numbers.push_back(index[0] + grid_.counts[0] * (index[2] + grid_.counts[2] * index[1]));
    }
    // Right places, and as many cells as places, over all ranks
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

void FoamField::sum_over_ranks(double* values, int count) const {
    fields_.ranks.sum(values, count);
}

void FoamField::hold_grains(const GrainId* ids, int count) const {
    if (shared_) shared_->hold(ids, count);
}

void FoamField::sum_over_holders(double* rows, int per_grain) const {
    if (shared_) shared_->sum(rows, per_grain);
}

Vec3 FoamField::constrained(int cell) const {
    Vec3 u{};
    for (int axis = 0; axis < grid_.dimension; ++axis) u[axis] = velocity_[axis][cell];
    return u;
}

void FoamField::put_force_density(const Constraint& constraint) {
    // Grains move: cells of the last window may not be among these.
    fields_.lambda.primitiveFieldRef() = Foam::Zero;
    // lambda = rho_f (u3 - u)/dt, u3 from the fields and u from the multipliers
    const Foam::scalar rate = fields_.rho / fields_.time.deltaTValue();
    constraint.for_cells([&](int cell) {
        const Vec3 u = constrained(cell);
        const int at = mesh_cell(cell);
        fields_.lambda[at] = rate * (fields_.U[at] - Foam::vector(u[0], u[1], u[2]));
    });
}

Vec3 FoamField::shown_velocity(int cell) const {
    const Foam::vector& u = fields_.U[mesh_cell(cell)];
    return {u.x(), u.y(), u.z()};
}

std::unique_ptr<FoamField> make_foam_field(FluidFields& fields, const FluidDomain& domain) {
    if (domain.dimension == 3) return std::make_unique<SpaceField>(fields, domain);
    return std::make_unique<PlaneField>(fields, domain);
}

}  // namespace turbidite
