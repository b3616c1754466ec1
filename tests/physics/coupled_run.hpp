// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fluid and contact adapters in one process, without hub or messages, called in the order that
// cases have with the splitting: that of `split`, or of `joint` where pressure and viscosity are
// corrected with rigid grains. Run units: D = u_c = rho_f = 1.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupler/shapes/immersed_body.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"

namespace turbidite {

struct CoupledSetup {
    ShapeRecord shape{"disc", {}};     ///< of all grains
    double width = 4.0, height = 4.0;  ///< [D]
    std::string left = "wall", right = "wall", bottom = "wall", top = "wall";
    std::string wall_motions, inflow_motions;  ///< as run.wall_motions
    std::string walls, grain_motions;          ///< as run.walls, run.grain_motions
    std::string left_profile = "uniform";
    std::string probes, fields;  ///< as run.probes, output.fields
    double reynolds = 100.0;
    double step = 0.01;
    int windows = 1000;
    int cells_per_diameter = 16;
    double density_ratio = 1.5;
    double gravity = 0.0;
    double acceleration_x = 0.0;  ///< uniform force on the fluid over rho_f
    std::string points = "interior+boundary";
    double tolerance = 1e-4;
    double splitting_tolerance = 1e-4;
    double joint_tolerance = 1e-4;  ///< as coupling.tolerance
    double contact_tolerance = 1e-3;
    std::int64_t multiplier_iterations = 200;
    double hydrodynamic_radius = 1.0;
    std::string transport_scheme = "Gauss limitedLinearV 1";
    std::string time_scheme = "first-order";
    std::string splitting = "marchuk-yanenko";
    double stretch_ratio = 1.0, stretch_from = 0.0;  ///< of rows; 1: all equal
    bool allow_coarse = false;
    std::string pressure_solver = "FFT", viscous_solver = "FFT";
    double pressure_tolerance = 1e-6, viscous_tolerance = 1e-8;  ///< of the iterative solvers
};

/// The four sides of a box, with the name of the test parameter.
struct Sides {
    const char* name;
    const char *left, *right, *bottom, *top;
};
CoupledSetup with_sides(const Sides& sides);

Settings settings_of(const CoupledSetup& setup);

/// In space: of so many cells along x, y and z, with transport of second order, cells inside grains
/// alone, and the surface shifted by 0.3 of a cell. Of `setup` width and height do not count.
Settings settings_in_space(CoupledSetup setup, const std::array<int, 3>& cells,
                           const std::string& front, const std::string& back);

/// A grain of the setup's shape with R = 1/2.
GrainState disc_at(const CoupledSetup& setup, double x, double y, double vx = 0.0, double vy = 0.0);

/// An empty folder, removed at the end.
class TemporaryFolder {
 public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

class CoupledRun {
 public:
    CoupledRun(const CoupledSetup& setup, std::vector<GrainState> grains);

    /// One window.
    void advance(bool write_output = false);

    const CoupledSetup& setup() const { return setup_; }
    const std::filesystem::path& folder() const { return folder_.path(); }
    FoamAdapter& fluid() { return fluid_; }
    const std::vector<GrainState>& before() const { return before_; }  ///< U^n
    /// U^{n+4/5}; under `joint` of the last contact solve
    const std::vector<GrainState>& between() const { return between_; }
    const std::vector<GrainState>& grains() const { return grains_; }  ///< U^{n+1}
    const Kicks& answer() const { return answer_; }
    /// With an impulse, summed over all windows.
    std::int64_t contacts() const { return contacts_; }
    ImmersedBody body() const;
    /// Under `joint`: contact solves of the last window, and the largest mismatch that the fluid
    /// told after the last of them.
    int rounds() const { return rounds_; }
    double mismatch() const { return mismatch_; }
    /// ContactReport::contact_violation of the last window.
    double contact_violation() const { return contact_violation_; }

 private:
    void solve_split(const Window& window);
    void solve_jointly(const Window& window);

    CoupledSetup setup_;
    TemporaryFolder folder_;
    FoamAdapter fluid_;
    NscdAdapter contact_;
    std::vector<GrainState> before_, between_, grains_;
    Kicks answer_;
    std::int64_t window_ = 0, contacts_ = 0;
    int rounds_ = 0;
    double mismatch_ = 0.0, contact_violation_ = 0.0;
};

/// Plays three windows of one, another course of the other, and restores the state of the first in
/// the second.
void resume_after_three(CoupledRun& straight, CoupledRun& resumed);

/// The fluid's steps 1 to 3 of the fourth window.
void advance_both(CoupledRun& straight, CoupledRun& resumed);

/// max |difference| of u, and of p dt over a cell of D, over columns and rows of cells.
double largest_difference(CoupledRun& a, CoupledRun& b, std::array<int, 2> cells);

}  // namespace turbidite
