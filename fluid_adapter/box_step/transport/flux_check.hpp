// SPDX-License-Identifier: GPL-2.0-or-later
//
// Divergence and Courant number of a flux, over this rank's cells. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_layers.hpp"
#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

/// Of the projected flux phi1, over this rank's cells.
struct FluxReport {
    double divergence = 0.0;       ///< max |div phi1| [1/s]
    double courant = 0.0;          ///< largest Courant number, as OpenFOAM defines it
    double carried_courant = 0.0;  ///< that of the flux with which transport carries u
};

class FluxCheck {
 public:
    explicit FluxCheck(const BoxLayers& layers);

    void begin();

    /// Takes a row of layer j: its x faces, those below and above it, and in space those behind and
    /// in front of it, else null.
    void add(int j, const double* along, const double* below, const double* above,
             const double* behind, const double* before);

    /// The same of all rows of the layer, one after the other.
    void add_layer(int j, const double* along, const double* below, const double* above,
                   const double* behind);

    /// Of the flux that has been added, with which transport carries u too.
    FluxReport over(double dt) const;

 private:
    const BoxLayers& layers_;
    std::vector<double> divergence_, largest_divergence_, largest_outflow_;
};

}  // namespace turbidite
