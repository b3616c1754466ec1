// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_adapter.hpp"

#include <utility>

#include "coupler/protocol/files/freed_memory.hpp"
#include "fluid_adapter/box_app/box_state.hpp"
#include "fluid_adapter/box_app/box_store.hpp"
#include "fluid_adapter/domain/grain_reach.hpp"

namespace turbidite {

BoxAdapter::BoxAdapter(std::filesystem::path folder) : folder_(std::move(folder)) {
    keep_freed_memory();
}

BoxAdapter::~BoxAdapter() = default;

Hello BoxAdapter::describe() const {
    Hello hello = hello_of_window();
    hello.adapter = "box";
    hello.host_code = "none";
    hello.dimension = 3;
    hello.capabilities.shapes = {"sphere"};
    return hello;
}

Box BoxAdapter::initialise(const Settings& settings, const ShapeTable& shapes) {
    std::filesystem::create_directories(folder_);
    store_ = std::make_unique<BoxStore>(settings, ranks_, folder_);
    window_ = std::make_unique<FluidWindow>(*store_, settings, shapes);
    return with_reach(store_->box(), settings);
}

void BoxAdapter::save_to(PieceWriter& file) const {
    window_->put_fields();
    write_state(store_->field(), store_->step(), file);
}

void BoxAdapter::restore_own(PieceReader& file) {
    std::vector<PieceReader> one;
    one.push_back(std::move(file));
    restore_parts(one);
}

void BoxAdapter::restore_parts(std::vector<PieceReader>& of_ranks) {
    read_state(of_ranks, store_->field(), store_->step());
    window_->fields_replaced();
}

}  // namespace turbidite
