// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/makeFluidStep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/splitting.hpp"
#include "fluid_adapter/fluid_window/box_of_grid.hpp"
#include "fluid_adapter/foam_app/foamRows.hpp"
#include "fluid_adapter/foam_app/laplacianOperator.hpp"
#include "fluid_adapter/foam_app/operatorStep.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

/// |div phi| D / u_c required of the projection: half of what the run accepts.
constexpr double divergence_goal = 5e-5;

/// Transport on rows of a box (box_step.hpp).
struct TransportMethod {
    double limiter = 1.0;
    std::optional<double> central;
    bool second_order = false;
    bool coupled = false;  ///< pressure and viscosity are corrected together with the grains
};

/// Whether a gradient scheme of the case is Gauss' linear one.
bool gauss_linear(const FluidFields& fields, const Foam::word& gradient) {
    Foam::Istream& scheme = fields.mesh.gradScheme(gradient);
    return Foam::word(scheme) == "Gauss" && (scheme.eof() || Foam::word(scheme) == "linear");
}

/// Share of linear interpolation of the schemes that are linear in u.
std::optional<double> central_share(const Foam::word& name) {
    if (name == "linear") return 1.0;
    if (name == "LUST") return 0.75;
    if (name == "linearUpwind") return 0.0;
    return std::nullopt;
}

/// The same for the case's div(phi,U), `bounded` or not.
std::optional<double> central_share(const FluidFields& fields) {
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
    const double k = Foam::readScalar(scheme);
    if (k < 0.0 || k > 1.0) return std::nullopt;  // refused by OpenFOAM
    method.limiter = std::max(k, Foam::SMALL);
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
                                          in_second_order(settings), central_share(fields));
}

/// The operator with the spacing of the mesh in metres; of a stretched grid, that of its first row.
SeparableOperator in_metres(SeparableOperator plane, const Foam::vector& box_size,
                            const CellGrid& grid) {
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

BoxFluid box_fluid(FluidFields& fields, const TransportMethod& method, const BoxCells& box,
                   const CellGrid& grid) {
    demand_volume_weights(fields.mesh, grid);
    const Foam::vector size = fields.mesh.bounds().span();
    return {in_metres(laplacian_with_values(fields.U, box).plane, size, grid),
            in_metres(homogeneous_laplacian(fields.p, box).plane, size, grid),
            fields.nu,
            method.limiter,
            method.central,
            method.second_order};
}

std::unique_ptr<BoxRows> box_rows(const RankGroup& ranks, const SeparableOperator& plane,
                                  const CellRows& cells) {
    if (!ranks.parallel()) return std::make_unique<AllRows>(plane);
    try {
        return std::make_unique<RankRows>(ranks, plane, cells);
    } catch (const std::invalid_argument& why) {
        throw DoesNotFit(why.what());
    }
}

/// Throws DoesNotFit.
std::unique_ptr<FluidStep> box_fluid_step(FluidFields& fields, const TransportMethod& method,
                                          const BoxCells& box, const CellGrid& grid) {
    const BoxFluid fluid = box_fluid(fields, method, box, grid);
    auto own = std::make_unique<FoamRows>(fields, box);
    if (method.coupled && !own->stay_in_rows())
        throw DoesNotFit("its ranks do not have complete rows of cells");
    auto rows = box_rows(fields.ranks, fluid.pressure, own->rows());
    return std::make_unique<BoxFluidStep>(fluid, std::move(rows), std::move(own), fields.ranks,
                                          method.coupled);
}

/// In space fields are a view of the rows: there are no steps by OpenFOAM's operators.
std::unique_ptr<FluidStep> step_in_space(const Settings& settings, FluidFields& fields,
                                         const CellGrid& grid, const std::vector<int>& cells) {
    const std::optional<TransportMethod> method = transport_on_rows(fields);
    if (!method || !solved_by_fft(fields.p) || !solved_by_fft(fields.U))
        throw Failure(ExitCode::bad_input,
                      "in space fluid.transport_scheme must be Gauss limitedLinearV, linear, LUST "
                      "or linearUpwind with linear gradients, and fluid.pressure_solver and "
                      "fluid.viscous_solver FFT");
    BoxFluid fluid = box_of(grid);
    fluid.viscosity = fields.nu;
    fluid.limiter = method->limiter;
    fluid.central = method->central;
    fluid.second_order = in_second_order(settings);
    auto own = std::make_unique<FoamRows>(fields, grid, cells);
    if (!own->stay_in_rows())
        throw Failure(ExitCode::bad_input,
                      "in space every rank must have whole layers of cells of one y: use "
                      "fluid.decomposition = rows");
    auto rows = box_rows(fields.ranks, fluid.pressure, own->rows());
    return std::make_unique<BoxFluidStep>(fluid, std::move(rows), std::move(own), fields.ranks,
                                          splitting_of(settings).rigid_grains);
}

}  // namespace

std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields,
                                           const CellGrid& grid, const std::vector<int>& cells) {
    if (grid.dimension == 3) return step_in_space(settings, fields, grid, cells);
    const BoxCells box =
        box_cells(fields.mesh, fields.ranks, {grid.counts[0], grid.counts[1]}, cells);
    std::optional<TransportMethod> method = transport_on_rows(fields);
    if (method) method->second_order = in_second_order(settings);
    if (method) method->coupled = splitting_of(settings).rigid_grains;
    if (!method || !solved_by_fft(fields.p) || !solved_by_fft(fields.U)) {
        demand_marchuk_yanenko(
            settings,
            "fluid.transport_scheme must be Gauss limitedLinearV, linear, LUST or linearUpwind "
            "with linear gradients, and fluid.pressure_solver and fluid.viscous_solver FFT");
        return operator_step(settings, fields, box);
    }
    try {
        return box_fluid_step(fields, *method, box, grid);
    } catch (const DoesNotFit& why) {
        demand_marchuk_yanenko(settings, why.what());
        // Accepts more general cases, or reports what does not fit.
        return operator_step(settings, fields, box);
    }
}

}  // namespace turbidite
