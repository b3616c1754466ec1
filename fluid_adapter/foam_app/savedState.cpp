// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/savedState.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace turbidite {
namespace {

struct Header {
    std::int64_t cells = 0;
    std::int64_t kind = 0;  // FluidStep::kind of the steps that wrote it
    std::int64_t time_index = 0;
    double time = 0.0;
    std::array<double, 4> corners{};       // of this rank's cells
    std::int64_t first_row = 0, rows = 0;  // MemoryRows
    std::int64_t memory = 0;               // values
};

std::array<double, 4> corners_of(const Foam::fvMesh& mesh) {
    const Foam::boundBox box(mesh.points(), false);
    return {box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}

constexpr std::size_t components = 4;  // of u, and p
/// Of cells in no state that was read; a run with NaN is not saved.
constexpr std::array<double, components> unsaved{NAN, NAN, NAN, NAN};

/// A state by its parts.
struct Parts {
    Header header;
    std::vector<std::int32_t> cells;  // i + nx (k + nz j)
    std::vector<double> values;       // u, v, w, p of each cell
    std::vector<double> memory;
};

template <class Value>
void append(SavedState& state, const std::vector<Value>& values) {
    const auto* first = reinterpret_cast<const char*>(values.data());
    state.insert(state.end(), first, first + values.size() * sizeof(Value));
}

SavedState joined(const Parts& parts) {
    SavedState state(sizeof(Header));
    std::memcpy(state.data(), &parts.header, sizeof(Header));
    append(state, parts.cells);
    append(state, parts.values);
    append(state, parts.memory);
    return state;
}

std::size_t size_of(const Header& header) {
    const auto cells = static_cast<std::size_t>(header.cells);
    return sizeof header + cells * sizeof(std::int32_t) +
           (components * cells + static_cast<std::size_t>(header.memory)) * sizeof(double);
}

Parts parts_of(const SavedState& state) {
    Parts parts;
    // Nothing in it is believed before the sizes agree.
    if (state.size() >= sizeof(Header)) std::memcpy(&parts.header, state.data(), sizeof(Header));
    const Header& header = parts.header;
    if (state.size() < sizeof(Header) || header.cells < 0 || header.memory < 0 ||
        state.size() != size_of(header))
        throw Failure(ExitCode::bad_input, "the saved fluid state has " +
                                               std::to_string(state.size()) +
                                               " bytes; it is incomplete");
    parts.cells.resize(static_cast<std::size_t>(header.cells));
    parts.values.resize(components * parts.cells.size());
    parts.memory.resize(static_cast<std::size_t>(header.memory));
    const char* from = state.data() + sizeof(Header);
    const auto take = [&from](auto& values) {
        const std::size_t bytes = values.size() * sizeof(values[0]);
        if (bytes > 0) std::memcpy(values.data(), from, bytes);
        from += bytes;
    };
    take(parts.cells), take(parts.values), take(parts.memory);
    return parts;
}

void check_kind(const Header& header, const FluidStep& step) {
    if (header.kind == step.kind()) return;
    throw Failure(ExitCode::bad_input,
                  "the saved fluid state was written with another fluid.pressure_solver, "
                  "fluid.viscous_solver, fluid.transport_scheme, fluid.time_scheme or "
                  "fluid.splitting; continue with the same ones");
}

/// Arrays over all rows of the box, put together from those of the ranks or cut into them.
class WholeMemory {
 public:
    explicit WholeMemory(std::vector<MemoryRows::Array> arrays)
        : arrays_(std::move(arrays)), whole_(arrays_.size()) {}

    void take(const Parts& rank) {
        visit(rank.header.first_row, rank.header.rows, rank.memory.size(),
              [&](std::size_t array, std::size_t to, std::size_t from, std::size_t count) {
                  // It grows as ranks are read: how many rows there are is not known before.
                  if (whole_[array].size() < to + count) whole_[array].resize(to + count);
                  std::copy_n(rank.memory.begin() + static_cast<std::ptrdiff_t>(from), count,
                              whole_[array].begin() + static_cast<std::ptrdiff_t>(to));
              });
    }

    std::vector<double> part(const MemoryRows& rows, std::size_t size) const {
        std::vector<double> memory(size);
        visit(static_cast<std::int64_t>(rows.first), static_cast<std::int64_t>(rows.count), size,
              [&](std::size_t array, std::size_t from, std::size_t to, std::size_t count) {
                  if (whole_[array].size() < from + count)
                      throw Failure(ExitCode::bad_input,
                                    "the saved fluid states do not have all rows of the mesh");
                  std::copy_n(whole_[array].begin() + static_cast<std::ptrdiff_t>(from), count,
                              memory.begin() + static_cast<std::ptrdiff_t>(to));
              });
        return memory;
    }

 private:
    /// copy(array, place in the whole array, place in the rank's memory, number of values)
    template <class Copy>
    void visit(std::int64_t first, std::int64_t rows, std::size_t size, Copy copy) const {
        std::size_t at = 0;
        for (std::size_t k = 0; k < arrays_.size(); ++k) {
            const MemoryRows::Array& array = arrays_[k];
            const std::size_t count =
                array.width == 0 ? 1 : array.width * (static_cast<std::size_t>(rows) + array.above);
            if (at + count > size)
                throw Failure(ExitCode::bad_input, "the saved fluid state is incomplete");
            // A single value (width 0) has the place 0, whatever the rank.
            copy(k, array.width * static_cast<std::size_t>(first), at, count);
            at += count;
        }
    }

    std::vector<MemoryRows::Array> arrays_;
    std::vector<std::vector<double>> whole_;
};

}  // namespace

SavedState save_fields(const FluidRank& rank) {
    const FluidFields& fields = rank.fields;
    const MemoryRows rows = rank.step.memory_rows();
    Parts parts;
    parts.memory = rank.step.memory();
    parts.header = {fields.mesh.nCells(),
                    rank.step.kind(),
                    fields.time.timeIndex(),
                    fields.time.value(),
                    corners_of(fields.mesh),
                    static_cast<std::int64_t>(rows.first),
                    static_cast<std::int64_t>(rows.count),
                    static_cast<std::int64_t>(parts.memory.size())};
    // Places in the grid: by them another decomposition finds its cells.
    parts.cells.assign(rank.cells.begin(), rank.cells.end());
    parts.values.reserve(components * parts.cells.size());
    forAll(fields.p, c) {
        const Foam::vector& u = fields.U[c];
        parts.values.insert(parts.values.end(), {u.x(), u.y(), u.z(), fields.p[c]});
    }
    return joined(parts);
}

void restore_fields(const SavedState& state, const FluidRank& rank) {
    FluidFields& fields = rank.fields;
    const Parts parts = parts_of(state);
    const Header& header = parts.header;
    const bool same_cells =
        std::equal(parts.cells.begin(), parts.cells.end(), rank.cells.begin(), rank.cells.end());
    // Corners as bits: another size of the box with as many cells is another mesh.
    if (header.corners != corners_of(fields.mesh) || !same_cells)
        throw Failure(ExitCode::bad_input,
                      "the saved fluid state has " + std::to_string(header.cells) +
                          " cells, this rank has " + std::to_string(fields.mesh.nCells()) +
                          " or different ones; continue with the same mesh and "
                          "fluid.decomposition");
    check_kind(header, rank.step);
    if (parts.memory.size() != rank.step.memory().size())
        throw Failure(ExitCode::bad_input, "the saved fluid state is incomplete");
    auto& U = fields.U.primitiveFieldRef();
    auto& p = fields.p.primitiveFieldRef();
    forAll(U, c) {
        const double* values = &parts.values[components * static_cast<std::size_t>(c)];
        U[c] = Foam::vector(values[0], values[1], values[2]);
        p[c] = values[3];
    }
    // After p, which a step may read back from the field (BoxFluidStep::take_pressure).
    rank.step.set_memory(parts.memory);
    fields.U.correctBoundaryConditions();
    fields.p.correctBoundaryConditions();
    fields.time.go_on_from(header.time, static_cast<Foam::label>(header.time_index));
    fields.interpolate_flux();
}

SavedState part_of(const std::vector<SavedState>& of_ranks, const FluidRank& rank) {
    const MemoryRows rows = rank.step.memory_rows();
    if (rows.arrays.empty())
        throw Failure(ExitCode::bad_input,
                      "the fluid of this case, which is solved with OpenFOAM's own operators, can "
                      "only go on with the number of ranks that wrote the checkpoint: "
                      "fluid.ranks = " +
                          std::to_string(of_ranks.size()));
    WholeMemory memory(rows.arrays);
    std::vector<std::array<double, components>> values;  // by number of the cell
    Parts own;
    for (const SavedState& state : of_ranks) {
        const Parts other = parts_of(state);
        check_kind(other.header, rank.step);
        memory.take(other);
        // The time is that of any of them.
        own.header = other.header;
        for (std::size_t c = 0; c < other.cells.size(); ++c) {
            const auto place = static_cast<std::size_t>(other.cells[c]);
            if (values.size() <= place) values.resize(place + 1, unsaved);
            std::copy_n(&other.values[components * c], components, values[place].begin());
        }
    }
    own.cells.assign(rank.cells.begin(), rank.cells.end());
    for (const std::int32_t cell : own.cells) {
        const auto place = static_cast<std::size_t>(cell);
        if (place >= values.size() || std::isnan(values[place].front()))
            throw Failure(ExitCode::bad_input,
                          "the saved fluid states lack cell " + std::to_string(cell) +
                              ": they are of another mesh, or one of them is missing");
        const auto& value = values[place];
        own.values.insert(own.values.end(), value.begin(), value.end());
    }
    own.memory = memory.part(rows, rank.step.memory().size());
    own.header.cells = static_cast<std::int64_t>(own.cells.size());
    own.header.corners = corners_of(rank.fields.mesh);
    own.header.first_row = static_cast<std::int64_t>(rows.first);
    own.header.rows = static_cast<std::int64_t>(rows.count);
    own.header.memory = static_cast<std::int64_t>(own.memory.size());
    return joined(own);
}

}  // namespace turbidite
