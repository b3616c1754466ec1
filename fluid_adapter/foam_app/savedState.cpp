// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/savedState.hpp"

#include <cstring>
#include <vector>

namespace turbidite {
namespace {

struct Header {
    std::int64_t cells = 0;
    std::int64_t time_index = 0;
    double time = 0.0;
};

/// A field's values as bytes; labels and vectors of doubles have no padding.
template <class Field>
std::size_t bytes_of(const Field& field) {
    return field.size() * sizeof(field[0]);
}

/// All faces, inner ones first, then patch by patch.
std::vector<double> excess_values(const Foam::surfaceScalarField& excess) {
    std::vector<double> values(excess.primitiveField().begin(), excess.primitiveField().end());
    for (const auto& side : excess.boundaryField())
        values.insert(values.end(), side.begin(), side.end());
    return values;
}

void set_excess(const std::vector<double>& values, Foam::surfaceScalarField& excess) {
    auto next = values.begin();
    for (double& value : excess.primitiveFieldRef()) value = *next++;
    for (auto& side : excess.boundaryFieldRef())
        for (double& value : side) value = *next++;
}

}  // namespace

SavedState save_fields(const FluidFields& fields) {
    const Header header{fields.mesh.nCells(), fields.time.timeIndex(), fields.time.value()};
    const auto& U = fields.U.primitiveField();
    const auto& p = fields.p.primitiveField();
    const std::vector<double> excess = excess_values(fields.excess);
    SavedState state(sizeof header + bytes_of(U) + bytes_of(p) + bytes_of(excess));
    std::memcpy(state.data(), &header, sizeof header);
    std::memcpy(state.data() + sizeof header, U.cdata(), bytes_of(U));
    std::memcpy(state.data() + sizeof header + bytes_of(U), p.cdata(), bytes_of(p));
    std::memcpy(state.data() + sizeof header + bytes_of(U) + bytes_of(p), excess.data(),
                bytes_of(excess));
    return state;
}

void restore_fields(const SavedState& state, FluidFields& fields) {
    auto& U = fields.U.primitiveFieldRef();
    auto& p = fields.p.primitiveFieldRef();
    std::vector<double> excess = excess_values(fields.excess);
    Header header;
    if (state.size() == sizeof header + bytes_of(U) + bytes_of(p) + bytes_of(excess))
        std::memcpy(&header, state.data(), sizeof header);
    if (header.cells != fields.mesh.nCells())
        throw Failure(ExitCode::bad_input, "the saved fluid state does not belong to a mesh of " +
                                               std::to_string(fields.mesh.nCells()) + " cells");
    std::memcpy(static_cast<void*>(U.data()), state.data() + sizeof header, bytes_of(U));
    std::memcpy(p.data(), state.data() + sizeof header + bytes_of(U), bytes_of(p));
    std::memcpy(excess.data(), state.data() + sizeof header + bytes_of(U) + bytes_of(p),
                bytes_of(excess));
    set_excess(excess, fields.excess);
    fields.U.correctBoundaryConditions();
    fields.p.correctBoundaryConditions();
    fields.time.setTime(header.time, static_cast<Foam::label>(header.time_index));
    fields.interpolate_flux();
}

}  // namespace turbidite
