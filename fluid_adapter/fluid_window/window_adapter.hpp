// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What every fluid participant does alike: the functions of an adapter handed to its window. Valid
// C++17.
#pragma once

#include <memory>

#include "coupler/participant/adapter.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"

namespace turbidite {

/// An adapter whose fields a FluidWindow steps; `initialise` and the saved state are its own.
class WindowAdapter : public FluidAdapter {
 public:
    void advance(const Window& window) override;
    void let_fall(const Window& window, const std::vector<GrainState>& grains) override;
    void correct(const Window& window, const std::vector<GrainState>& grains) override;
    std::vector<FreeResponse> respond() override;
    Kicks impose(const Window& window) override;

 protected:
    std::unique_ptr<FluidWindow> window_;  ///< from `initialise` on
};

/// What every fluid of this kind says of itself; name, host and shapes are the adapter's.
Hello hello_of_window();

}  // namespace turbidite
