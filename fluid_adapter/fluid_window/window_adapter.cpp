// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/window_adapter.hpp"

namespace turbidite {

void WindowAdapter::advance(const Window& window) {
    window_->advance(window);
}

void WindowAdapter::let_fall(const Window&, const std::vector<GrainState>& grains) {
    window_->let_fall(grains);
}

void WindowAdapter::correct(const Window&, const std::vector<GrainState>& grains) {
    window_->correct(grains);
}

std::vector<FreeResponse> WindowAdapter::respond() {
    return window_->responses();
}

Kicks WindowAdapter::impose(const Window&) {
    return window_->impose();
}

Hello hello_of_window() {
    Hello hello;
    hello.role = Role::fluid;
    hello.adapter_version = TURBIDITE_VERSION;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.effective_inertia = true;
    return hello;
}

}  // namespace turbidite
