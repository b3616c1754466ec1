// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/savedState.hpp"

#include <array>
#include <cstring>
#include <vector>

namespace turbidite {
namespace {

struct Header {
    std::int64_t cells = 0;
    std::int64_t kind = 0;  // FluidStep::kind of the steps that wrote it
    std::int64_t time_index = 0;
    double time = 0.0;
    std::array<double, 4> corners{};  // of this rank's cells
};

std::array<double, 4> corners_of(const Foam::fvMesh& mesh) {
    const Foam::boundBox box(mesh.points(), false);
    return {box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}

/// A field's values as bytes; labels and vectors of doubles have no padding.
template <class Field>
std::size_t bytes_of(const Field& field) {
    return field.size() * sizeof(field[0]);
}

/// Appends an array's bytes.
template <class Field>
void append(SavedState& state, const Field& field) {
    const std::size_t old = state.size();
    state.resize(old + bytes_of(field));
    std::memcpy(state.data() + old, &field[0], bytes_of(field));
}

/// Fills an array from the bytes at `from`, and advances `from`.
template <class Field>
void take(const char*& from, Field& field) {
    std::memcpy(static_cast<void*>(&field[0]), from, bytes_of(field));
    from += bytes_of(field);
}

}  // namespace

SavedState save_fields(FluidFields& fields, FluidStep& step) {
    const Header header{fields.mesh.nCells(), step.kind(), fields.time.timeIndex(),
                        fields.time.value(), corners_of(fields.mesh)};
    SavedState state(sizeof header);
    std::memcpy(state.data(), &header, sizeof header);
    append(state, fields.U.primitiveField());
    append(state, fields.p.primitiveField());
    append(state, step.memory());
    return state;
}

void restore_fields(const SavedState& state, FluidFields& fields, FluidStep& step) {
    auto& U = fields.U.primitiveFieldRef();
    auto& p = fields.p.primitiveFieldRef();
    std::vector<double> memory = step.memory();
    Header header;
    if (state.size() >= sizeof header) std::memcpy(&header, state.data(), sizeof header);
    if (header.cells != fields.mesh.nCells() || header.corners != corners_of(fields.mesh))
        throw Failure(ExitCode::bad_input,
                      "the saved fluid state has " + std::to_string(header.cells) +
                          " cells, this rank has " + std::to_string(fields.mesh.nCells()) +
                          " or different ones; continue with the same mesh, fluid.ranks and "
                          "fluid.decomposition");
    if (header.kind != step.kind())
        throw Failure(
            ExitCode::bad_input,
            "the saved fluid state was written with another fluid.pressure_solver, "
            "fluid.viscous_solver, fluid.transport_scheme, fluid.time_scheme or fluid.splitting; "
            "continue with the same ones");
    const std::size_t expected = sizeof header + bytes_of(U) + bytes_of(p) + bytes_of(memory);
    if (state.size() != expected)
        throw Failure(ExitCode::bad_input, "the saved fluid state has " +
                                               std::to_string(state.size()) + " bytes instead of " +
                                               std::to_string(expected) + "; it is incomplete");
    const char* from = state.data() + sizeof header;
    take(from, U);
    take(from, p);
    take(from, memory);
    step.set_memory(memory);
    fields.U.correctBoundaryConditions();
    fields.p.correctBoundaryConditions();
    fields.time.setTime(header.time, static_cast<Foam::label>(header.time_index));
    fields.interpolate_flux();
}

}  // namespace turbidite
