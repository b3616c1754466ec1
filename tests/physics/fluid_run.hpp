// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fluid adapter in this process with grains that only fall: no contacts, no messages. Run units:
// D = u_c = rho_f = 1.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/shapes/immersed_body.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"

namespace turbidite {

struct FluidRunSetup {
    double width = 4.0, height = 4.0;  ///< [D]
    std::string left_right = "wall", bottom = "wall", top = "wall";
    double reynolds = 100.0;
    double step = 0.01;
    int windows = 100;
    int cells_per_diameter = 16;
    double density_ratio = 1.5;
    double gravity = 0.0;
    std::string points = "interior+boundary";
    double tolerance = 1e-4;
    double hydrodynamic_radius = 1.0;
};

Settings settings_of(const FluidRunSetup& setup);

/// A case in a folder of its own, removed at the end.
class FluidRun {
   public:
    explicit FluidRun(const FluidRunSetup& setup);
    ~FluidRun();

    void add_disc(double x, double y, double vx = 0.0, double vy = 0.0);

    /// One window: grains fall freely, fluid corrects them, they move with the result.
    void advance(bool write_output = false);

    const FluidRunSetup& setup() const { return setup_; }
    const std::filesystem::path& folder() const { return folder_; }
    FoamAdapter& fluid() { return *fluid_; }
    std::vector<GrainState>& grains() { return grains_; }
    const std::vector<GrainState>& grains_given() const { return given_; }  ///< with U^{n+4/5}
    const Kicks& answer() const { return answer_; }
    ImmersedBody body() const;

   private:
    FluidRunSetup setup_;
    std::filesystem::path folder_;
    std::unique_ptr<FoamAdapter> fluid_;
    std::vector<GrainState> grains_, given_;
    Kicks answer_;
    std::int64_t window_ = 0;
};

}  // namespace turbidite
