// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fluidStep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid_adapter/foam_app/boxFluidStep.hpp"
#include "fluid_adapter/foam_app/operatorStep.hpp"
#include "fluid_adapter/foam_app/solverList.hpp"

namespace turbidite {
namespace {

/// |div phi| D / u_c asked of the projection: half of what the run accepts.
constexpr double divergence_goal = 5e-5;

/// k where the case transports with `Gauss limitedLinearV k`.
std::optional<double> limiter_of(const FluidFields& fields) {
    Foam::Istream& scheme = fields.mesh.divScheme("div(phi,U)");
    if (Foam::word(scheme) != "Gauss" || scheme.eof()) return std::nullopt;
    if (Foam::word(scheme) != "limitedLinearV" || scheme.eof()) return std::nullopt;
    const double k = Foam::readScalar(scheme);
    if (k < 0.0 || k > 1.0) return std::nullopt;  // OpenFOAM refuses it
    return std::max(k, Foam::SMALL);
}

std::unique_ptr<FluidStep> operator_step(const Settings& settings, FluidFields& fields) {
    const double goal =
        divergence_goal * settings.real("run.velocity_scale") / settings.real("run.diameter");
    return std::make_unique<OperatorStep>(
        fields,
        StokesProjection(fields, goal,
                         make_pressure_solver(settings.text("fluid.pressure_solver"), fields)),
        make_viscous_solver(settings.text("fluid.viscous_solver"), fields));
}

}  // namespace

std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields) {
    const bool direct = settings.text("fluid.pressure_solver") == "FFT" &&
                        settings.text("fluid.viscous_solver") == "FFT";
    const std::optional<double> limiter = limiter_of(fields);
    if (!direct || !limiter) return operator_step(settings, fields);
    try {
        return std::make_unique<BoxFluidStep>(fields, *limiter);
    } catch (const NotSeparable&) {
        return operator_step(settings,
                             fields);  // which does without whole rows, or says what does not fit
    }
}

}  // namespace turbidite
