// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_adapter.hpp"

#include <algorithm>
#include <cstring>

#include "coupler/protocol/freed_memory.hpp"
#include "fluid_adapter/box_app/box_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"

namespace turbidite {
namespace {

/// What a saved state begins with; u by component, p and the step's memory follow.
struct Header {
    std::int64_t first_layer = 0, cells = 0;
    std::int64_t kind = 0;  // FluidStep::kind
    std::int64_t memory = 0;
    bool operator==(const Header& other) const {
        return first_layer == other.first_layer && cells == other.cells && kind == other.kind &&
               memory == other.memory;
    }
};

void append(SavedState& state, const double* values, std::size_t count) {
    const auto* first = reinterpret_cast<const char*>(values);
    state.insert(state.end(), first, first + count * sizeof(double));
}

}  // namespace

BoxAdapter::BoxAdapter(std::filesystem::path folder) : folder_(std::move(folder)) {
    keep_freed_memory();
}

BoxAdapter::~BoxAdapter() = default;

Hello BoxAdapter::describe() const {
    Hello hello;
    hello.role = Role::fluid;
    hello.adapter = "box";
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = "none";
    hello.dimension = 3;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.effective_inertia = true;
    hello.capabilities.shapes = {"sphere"};
    return hello;
}

Box BoxAdapter::initialise(const Settings& settings, const ShapeTable& shapes) {
    std::filesystem::create_directories(folder_);
    store_ = std::make_unique<BoxStore>(settings, ranks_, folder_);
    window_ = std::make_unique<FluidWindow>(*store_, settings, shapes);
    return store_->box();
}

void BoxAdapter::advance(const Window& window) {
    window_->advance(window);
}

void BoxAdapter::let_fall(const Window&, const std::vector<GrainState>& grains) {
    window_->let_fall(grains);
}

void BoxAdapter::correct(const Window&, const std::vector<GrainState>& grains) {
    window_->correct(grains);
}

std::vector<FreeResponse> BoxAdapter::respond() {
    return window_->responses();
}

Kicks BoxAdapter::impose(const Window&) {
    return window_->impose();
}

SavedState BoxAdapter::save() const {
    window_->put_fields();
    BoxField& field = store_->field();
    const std::vector<double> memory = store_->step().memory();
    const Header header{field.first_layer(), field.owned_cells(), store_->step().kind(),
                        static_cast<std::int64_t>(memory.size())};
    SavedState state(sizeof header);
    std::memcpy(state.data(), &header, sizeof header);
    const auto cells = static_cast<std::size_t>(field.owned_cells());
    for (const double* u : field.velocities()) append(state, u, cells);
    append(state, field.pressure().data(), cells);
    append(state, memory.data(), memory.size());
    return state;
}

void BoxAdapter::restore(const SavedState& state) {
    BoxField& field = store_->field();
    const auto cells = static_cast<std::size_t>(field.owned_cells());
    std::vector<double> memory = store_->step().memory();
    const Header expected{field.first_layer(), field.owned_cells(), store_->step().kind(),
                          static_cast<std::int64_t>(memory.size())};
    Header header;
    if (state.size() >= sizeof header) std::memcpy(&header, state.data(), sizeof header);
    if (state.size() != sizeof header + (4 * cells + memory.size()) * sizeof(double) ||
        !(header == expected))
        throw Failure(ExitCode::bad_input,
                      "the saved state of the fluid is of another mesh, number of ranks or "
                      "fluid.splitting, or incomplete; continue with the same ones");
    const auto* values = reinterpret_cast<const double*>(state.data() + sizeof header);
    const auto take = [&values](double* to, std::size_t count) {
        std::memcpy(to, values, count * sizeof(double));
        values += count;
    };
    for (double* u : field.velocities()) take(u, cells);
    std::vector<double> p(cells);
    take(p.data(), cells);
    field.set_pressure(p.data(), 0.0);
    take(memory.data(), memory.size());
    store_->step().set_memory(memory);
    window_->fields_replaced();
}

}  // namespace turbidite
