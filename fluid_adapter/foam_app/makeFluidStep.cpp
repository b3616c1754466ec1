// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/makeFluidStep.hpp"
#include "fluid_adapter/foam_app/fields/sideConditions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/splitting.hpp"
#include "fluid_adapter/box_step/transport/convective_flux.hpp"
#include "fluid_adapter/fluid_window/box_of_grid.hpp"
#include "fluid_adapter/foam_app/fields/foamRows.hpp"
#include "fluid_adapter/foam_app/operators/laplacianOperator.hpp"
#include "fluid_adapter/foam_app/operators/operatorStep.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

/// |div phi| D / u_c required of the projection: half of what the run accepts.
constexpr double divergence_goal = 5e-5;

/// Transport on rows of a box, as in BoxFluid.
struct TransportMethod {
    double limiter = 1.0;
    std::optional<double> central;
};

/// Whether a gradient scheme of the case is Gauss' linear one.
bool gauss_linear(const FluidFields& fields, const Foam::word& gradient) {
    Foam::Istream& scheme = fields.mesh.gradScheme(gradient);
    return Foam::word(scheme) == "Gauss" && (scheme.eof() || Foam::word(scheme) == "linear");
}

/// Of the case's div(phi,U), `bounded` or not.
std::optional<double> central_share_of_case(const FluidFields& fields) {
    Foam::Istream& scheme = fields.mesh.divScheme("div(phi,U)");
    Foam::word name;
    while (!scheme.eof() && (name.empty() || name == "bounded" || name == "Gauss"))
        name = Foam::word(scheme);
    return central_share(name);
}

/// The case's div(phi,U), if rows of a box know the scheme.
std::optional<TransportMethod> transport_on_rows(const FluidFields& fields) {
    Foam::Istream& scheme = fields.mesh.divScheme("div(phi,U)");
    if (Foam::word(scheme) != "Gauss" || scheme.eof()) return std::nullopt;
    const Foam::word name(scheme);
    TransportMethod method;
    method.central = central_share(name);
    if (name == "linear") return method;
    if (scheme.eof()) return std::nullopt;  // OpenFOAM says what is missing
    if (method.central) {
        if (!gauss_linear(fields, Foam::word(scheme))) return std::nullopt;
        return method;
    }
    if (name != "limitedLinearV") return std::nullopt;
    const std::optional<double> limiter = limiter_of_steps(Foam::readScalar(scheme));
    if (!limiter) return std::nullopt;
    method.limiter = *limiter;
    return method;
}

bool in_second_order(const Settings& settings) {
    return settings.text("fluid.time_scheme") == "second-order";
}

/// For what only the rows of a box can do.
void demand_marchuk_yanenko(const Settings& settings, const std::string& why) {
    if (splitting_of(settings).rigid_grains)
        throw Failure(ExitCode::bad_input, "fluid.splitting = " + settings.text("fluid.splitting") +
                                               " does not fit this fluid case: " + why +
                                               "; use marchuk-yanenko");
}

/// Whether the case's fvSolution names our solver for the field.
template <class Field>
bool solved_by_fft(const Field& field) {
    return field.mesh().solverDict(field.name()).template get<Foam::word>("solver") == "FFT";
}

/// The same, if rows are solved for as well.
std::optional<TransportMethod> method_on_rows(const FluidFields& fields) {
    if (!solved_by_fft(fields.p) || !solved_by_fft(fields.U)) return std::nullopt;
    return transport_on_rows(fields);
}

/// Reports at the start what the solver itself would report in the first window.
template <class Field>
void check_solver(Field& field, const BoxCells& box, const char* key, const char* others) {
    if (!solved_by_fft(field)) return;
    try {
        laplacian_operator(field, box);
    } catch (const DoesNotFit& why) {
        throw Failure(ExitCode::bad_input, std::string(key) + " = FFT does not fit this fluid " +
                                               "case: " + why.what() + "; use " + others);
    }
}

std::unique_ptr<FluidStep> operator_step(const Settings& settings, FluidFields& fields,
                                         const BoxCells& box) {
    check_solver(fields.p, box, "fluid.pressure_solver", "GAMG, PCG");
    check_solver(fields.U, box, "fluid.viscous_solver", "PCG");
    const RunValues run = run_values(settings);
    return std::make_unique<OperatorStep>(fields, divergence_goal * run.velocity / run.diameter,
                                          in_second_order(settings), central_share_of_case(fields));
}

/// The operator with the spacing of the mesh in metres; of a stretched grid, that of its first row.
SeparableOperator in_metres(SeparableOperator plane, const Foam::vector& box_size,
                            const CellGrid& grid) {
    // The matrix tells ratios alone (spacing 1 along x), and heights to coefficient_tolerance: the
    // exact ones are the grid's.
    plane.x.spacing = box_size.x() / plane.x.cells;
    plane.y.spacing = box_size.y() / plane.y.cells;
    plane.y.sizes.clear();
    for (int j = 0; grid.stretched(1) && j < plane.y.cells; ++j)
        plane.y.sizes.push_back(grid.size(1, j));
    if (plane.y.stretched()) plane.y.spacing = grid.size(1, 0);
    return plane;
}

/// OpenFOAM's operators do as the case says; rows of different heights know one interpolation.
void demand_volume_weights(const Foam::fvMesh& mesh, const CellGrid& grid) {
    if (grid.stretched(1) && Foam::word(mesh.interpolationScheme("flux(U)")) != "reverseLinear")
        throw DoesNotFit("with rows of different heights interpolation must be reverseLinear");
}

/// By the mesh and the boundary conditions of the fields.
BoxFluid box_in_the_plane(FluidFields& fields, const BoxCells& box, const CellGrid& grid) {
    demand_volume_weights(fields.mesh, grid);
    const Foam::vector size = fields.mesh.bounds().span();
    BoxFluid fluid;
    fluid.velocity = in_metres(laplacian_with_values(fields.U, box).plane, size, grid);
    fluid.pressure = in_metres(homogeneous_laplacian(fields.p, box).plane, size, grid);
    return fluid;
}

std::unique_ptr<BoxRows> box_rows(const RankGroup& ranks, const SeparableOperator& plane,
                                  const CellRows& cells) {
    if (!ranks.parallel()) return std::make_unique<AllRows>(plane);
    try {
        return std::make_unique<RankRows>(ranks, plane, cells);
    } catch (const std::invalid_argument& why) {
        // So that the operators are tried instead
        throw DoesNotFit(why.what());
    }
}

/// The steps on a box whose grid and conditions are known. Throws DoesNotFit.
std::unique_ptr<FluidStep> box_fluid_step(const Settings& settings, BoxFluid fluid,
                                          const TransportMethod& method,
                                          std::unique_ptr<FoamRows> own,
                                          const FluidFields& fields) {
    fluid.viscosity = fields.nu;
    fluid.limiter = method.limiter;
    fluid.central = method.central;
    fluid.second_order = in_second_order(settings);
    auto rows = box_rows(fields.ranks, fluid.pressure, own->rows());
    return std::make_unique<BoxFluidStep>(fluid, std::move(rows), std::move(own), fields.ranks,
                                          splitting_of(settings).rigid_grains);
}

/// Throws DoesNotFit.
std::unique_ptr<FluidStep> step_in_the_plane(const Settings& settings, FluidFields& fields,
                                             const TransportMethod& method, const BoxCells& box,
                                             const CellGrid& grid) {
    const BoxFluid fluid = box_in_the_plane(fields, box, grid);
    auto own = std::make_unique<PlaneRows>(fields, box);
    // Pressure and viscosity with rigid grains change the velocity that step 5 works on, in place.
    if (splitting_of(settings).rigid_grains && !own->stay_in_rows())
        throw DoesNotFit("its ranks do not have complete rows of cells");
    return box_fluid_step(settings, fluid, method, std::move(own), fields);
}

/// In space fields are a view of the rows: there are no steps by OpenFOAM's operators.
std::unique_ptr<FluidStep> step_in_space(const Settings& settings, FluidFields& fields,
                                         const CellGrid& grid, const std::vector<int>& cells) {
    const std::optional<TransportMethod> method = method_on_rows(fields);
    if (!method)
        throw Failure(ExitCode::bad_input,
                      "in space fluid.transport_scheme must be Gauss limitedLinearV, linear, LUST "
                      "or linearUpwind with linear gradients, and fluid.pressure_solver and "
                      "fluid.viscous_solver FFT");
    demand_conditions_of_grid(fields, grid);
    auto own = std::make_unique<SpaceRows>(fields, grid, cells);
    if (!own->stay_in_rows())
        throw Failure(ExitCode::bad_input,
                      "in space every rank must have whole layers of cells of one y: use "
                      "fluid.decomposition = rows");
    // box_of: by what the sides are. OpenFOAM's matrices are read in the plane only.
    return box_fluid_step(settings, box_of(grid), *method, std::move(own), fields);
}

}  // namespace

std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields,
                                           const CellGrid& grid, const std::vector<int>& cells) {
    if (grid.dimension == 3) return step_in_space(settings, fields, grid, cells);
    const BoxCells box =
        box_cells(fields.mesh, fields.ranks, {grid.counts[0], grid.counts[1]}, cells);
    const std::optional<TransportMethod> method = method_on_rows(fields);
    if (!method) {
        demand_marchuk_yanenko(
            settings,
            "fluid.transport_scheme must be Gauss limitedLinearV, linear, LUST or linearUpwind "
            "with linear gradients, and fluid.pressure_solver and fluid.viscous_solver FFT");
        return operator_step(settings, fields, box);
    }
    try {
        return step_in_the_plane(settings, fields, *method, box, grid);
    } catch (const DoesNotFit& why) {
        demand_marchuk_yanenko(settings, why.what());
        // Accepts more general cases, or reports what does not fit.
        return operator_step(settings, fields, box);
    }
}

}  // namespace turbidite
