// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/probes.hpp"

#include <sstream>

#include "fluid_adapter/multiplier/cell_stencil.hpp"

namespace turbidite {
namespace {

constexpr int per_point = 3;  // p, u, v

}  // namespace

Probes::Probes(const Settings& settings) {
    if (!settings.has("run.probes")) return;
    std::istringstream numbers(settings.text("run.probes"));
    for (std::array<double, 2> point; numbers >> point[0] >> point[1];) points_.push_back(point);
}

/// Each rank adds the shares of its own cells.
std::vector<double> Probes::values(const FluidFields& fields, const FoamFluidField& field) const {
    std::vector<double> values(per_point * points_.size(), 0.0);
    for (std::size_t k = 0; k < points_.size(); ++k)
        for (const StencilEntry& at : bilinear_stencil(field.grid(), points_[k])) {
            const int cell = field.cell(at.i, at.j, 0);
            if (cell < 0 || !field.owns(cell)) continue;
            double* value = &values[per_point * k];
            value[0] += at.weight * fields.p[cell];
            value[1] += at.weight * fields.U[cell].x();
            value[2] += at.weight * fields.U[cell].y();
        }
    if (!values.empty()) fields.ranks.sum(values.data(), static_cast<int>(values.size()));
    return values;
}

}  // namespace turbidite
