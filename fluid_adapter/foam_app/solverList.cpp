// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/solverList.hpp"

#include <vector>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/foam_app/fftPressureSolver.hpp"
#include "fluid_adapter/foam_app/fftViscousSolver.hpp"
#include "fluid_adapter/foam_app/uniformBox.hpp"

namespace turbidite {
namespace {

template <class Solver>
struct Entry {
    std::string name;
    std::unique_ptr<Solver> (*make)(FluidFields&);
};

std::unique_ptr<PressureSolver> fft_pressure(FluidFields& fields) {
    return std::make_unique<FftPressureSolver>(fields.p, fields.ranks);
}
std::unique_ptr<PressureSolver> matrix_pressure(FluidFields& fields) {
    return std::make_unique<MatrixPressureSolver>(fields.p);
}
std::unique_ptr<ViscousSolver> fft_viscous(FluidFields& fields) {
    return std::make_unique<FftViscousSolver>(fields.U, fields.nu, fields.ranks);
}
std::unique_ptr<ViscousSolver> matrix_viscous(FluidFields& fields) {
    return std::make_unique<MatrixViscousSolver>(fields.U, fields.nu);
}

// What the matrix is solved with stands in the case's system/fvSolution.
const std::vector<Entry<PressureSolver>> pressure_solvers = {
    {"FFT", fft_pressure}, {"GAMG", matrix_pressure}, {"PCG", matrix_pressure}};
const std::vector<Entry<ViscousSolver>> viscous_solvers = {{"FFT", fft_viscous},
                                                           {"PCG", matrix_viscous}};

template <class Solver>
std::string other_names(const std::vector<Entry<Solver>>& list, const std::string& name) {
    std::string names;
    for (const auto& entry : list)
        if (entry.name != name) names += (names.empty() ? "" : ", ") + entry.name;
    return names;
}

template <class Solver>
std::unique_ptr<Solver> make(const std::vector<Entry<Solver>>& list, const std::string& key,
                             const std::string& name, FluidFields& fields) try {
    for (const auto& entry : list)
        if (entry.name == name) return entry.make(fields);
    throw Failure(ExitCode::bad_input,
                  key + " = \"" + name + "\"; allowed are " + other_names(list, name));
} catch (const NotSeparable& why) {
    throw Failure(ExitCode::bad_input, key + " = " + name + " does not fit this fluid case: " +
                                           why.what() + "; use " + other_names(list, name));
}

}  // namespace

std::unique_ptr<PressureSolver> make_pressure_solver(const std::string& name, FluidFields& fields) {
    return make(pressure_solvers, "fluid.pressure_solver", name, fields);
}

std::unique_ptr<ViscousSolver> make_viscous_solver(const std::string& name, FluidFields& fields) {
    return make(viscous_solvers, "fluid.viscous_solver", name, fields);
}

}  // namespace turbidite
