// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contenders of the fluid benchmark on the case bench/fluid.yaml, in boxes given in D: our
// window, the array code, and icoFoam; and our window in the shipped sedimentation.
#pragma once

#include <string>
#include <vector>

#include "bench/timing/site.hpp"

namespace turbidite::bench {

struct BenchBox {
    double width = 0.0, height = 0.0;  ///< [D], multiples of 2.5
    int grains = 0;                    ///< 0: none; the initial flow is bench/fluid/start_flow.hpp
    double depth = 0.0;                ///< [D], a multiple of 2.5 in space; 0: the plane

    bool in_space() const { return depth > 0.0; }
    int cells_per_diameter() const { return in_space() ? 8 : 16; }
    double cells() const;
    std::string name() const;
};

struct Effort {
    int warm_up = 0, steps = 1;
};

/// Prepares the run folder at the first call. Grains start at rest and fall. Several ranks run
/// under mpirun, and require discs to drive the flow.
Sample our_window(Site& site, const BenchBox& box, const Effort& effort, int ranks = 1);

/// The shipped sedimentation, configs/sedimentation-discs.yaml, in mid-fall: starts from rest with
/// the discs at their positions after 12 t_c (bench/mid_fall.csv), so that after a warm-up of 100
/// windows they fall among contacts again.
Sample mid_fall_window(Site& site, const Effort& effort, int ranks = 1);

/// The same on one rank, with transport and viscosity of first or of second order in time.
Sample mid_fall_window_in_order(Site& site, const Effort& effort, bool second);

/// A shipped case in space under changed keys, with the grains of a CSV file of bench.
struct SpaceCase {
    std::string name;    ///< of its folder
    std::string grains;  ///< "mid_fall_spheres.csv"
    std::vector<std::string> sets;
    int ranks = 1;

    /// The changed keys, with the file of the grains among them.
    std::vector<std::string> changes(const Site& site) const;
};

/// Windows of configs/settling-spheres.yaml, from rest with the spheres where they were in mid-run.
Sample settling_window(Site& site, const SpaceCase& of, const Effort& effort);

Sample array_code_step(Site& site, const BenchBox& box, const Effort& effort);

/// Stock icoFoam on bench/icofoam: mean step time from the clock in its log (ExecutionTime).
Sample icofoam_step(Site& site, const BenchBox& box, const Effort& effort);

}  // namespace turbidite::bench
