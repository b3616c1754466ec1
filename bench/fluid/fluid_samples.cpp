// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/fluid/fluid_samples.hpp"

#include <fmt/format.h>

namespace turbidite::bench {

double processor(const Sample& sample) {
    return sample.processor;
}
double wall(const Sample& sample) {
    return sample.wall;
}
double resident(const Sample& sample) {
    return sample.resident;
}

std::string milliseconds(const std::string& who, const std::vector<Sample>& samples) {
    return fmt::format("{} {:.4g} ms", who, 1e3 * median_of(samples, processor));
}

std::string per_cell(const std::string& box, double cells, const std::vector<Sample>& samples) {
    return fmt::format("{}: {:.4g} ns per cell", box, 1e9 * median_of(samples, processor) / cells);
}

void divide(Measured& measured, double by) {
    for (double* value : {&measured.value, &measured.lowest, &measured.highest}) *value /= by;
}

std::string profile(const std::vector<Sample>& samples) {
    std::string text = "our window:";
    for (const auto& [part, unused] : samples.front().parts) {
        const double seconds =
            median_of(samples, [&](const Sample& s) { return s.parts.at(part); });
        text += fmt::format(" {} {:.4g} ms,", part, 1e3 * seconds);
    }
    const double together = median_of(samples, wall);
    return text + fmt::format(" together {:.4g} ms of wall time", 1e3 * together);
}

}  // namespace turbidite::bench
