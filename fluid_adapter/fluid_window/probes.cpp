// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/probes.hpp"

#include <sstream>

#include "coupler/protocol/run_values.hpp"
#include "fluid_adapter/multiplier/cell_stencil.hpp"

namespace turbidite {
Probes::Probes(const Settings& settings) : dimension_(run_values(settings).dimension) {
    if (!settings.has("run.probes")) return;
    std::istringstream numbers(settings.text("run.probes"));
    const auto read = [&](Vec3& point) {
        for (int axis = 0; axis < dimension_; ++axis) numbers >> point[axis];
        return !numbers.fail();
    };
    for (Vec3 point{}; read(point);) points_.push_back(point);
}

/// Each rank adds the shares of its own cells.
std::vector<double> Probes::values(const StoredField& field, const RankGroup& ranks) const {
    const std::size_t per_point = 1 + dimension_;
    std::vector<double> values(per_point * points_.size(), 0.0);
    for (std::size_t k = 0; k < points_.size(); ++k)
        for (const StencilEntry& at : linear_stencil(field.grid(), points_[k])) {
            const int cell = field.cell(at.i, at.j, at.k);
            if (cell < 0 || !field.owns(cell)) continue;
            double* value = &values[per_point * k];
            const Vec3 u = field.shown_velocity(cell);
            value[0] += at.weight * field.shown_pressure(cell);
            for (int axis = 0; axis < dimension_; ++axis) value[1 + axis] += at.weight * u[axis];
        }
    if (!values.empty()) ranks.sum(values.data(), static_cast<int>(values.size()));
    return values;
}

}  // namespace turbidite
