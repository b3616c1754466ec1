// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/probe_series.hpp"

#include <fmt/format.h>

#include "coupler/output/output_state.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {

void ProbeSeries::begin(std::size_t points) {
    out_.open(file_, std::ios::trunc);
    out_ << "time";
    for (std::size_t k = 1; k <= points; ++k)
        out_ << fmt::format(",pressure_{0},velocity_x_{0},velocity_y_{0}", k)
             << (run_.dimension == 3 ? fmt::format(",velocity_z_{}", k) : "");
    out_ << std::endl;
}

void ProbeSeries::resume(std::int64_t length) {
    cut_to(file_, length);
    out_.open(file_, std::ios::in | std::ios::out | std::ios::ate);
}

std::int64_t ProbeSeries::length() {
    return out_.is_open() ? static_cast<std::int64_t>(out_.tellp()) : -1;
}

void ProbeSeries::append(double time, const std::vector<double>& values) {
    // A fluid without probes sends none, and there is no file.
    if (values.empty()) return;
    const std::size_t per_point = 1 + static_cast<std::size_t>(run_.dimension);
    if (!out_.is_open()) begin(values.size() / per_point);
    const double u = run_.velocity;
    out_ << fmt::format("{:.10g}", time / run_.time);
    for (std::size_t k = 0; k < values.size(); ++k)
        // p/rho_f over u_c^2, then the velocities over u_c
        out_ << fmt::format(",{:.10g}", values[k] / (k % per_point == 0 ? u * u : u));
    out_ << std::endl;
    if (!out_)
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file_.string() + ": is the disk full?");
}

}  // namespace turbidite
