// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS' granular package as a host of molecular dynamics, on any number of ranks. It integrates
// with velocity Verlet: positions and velocities belong to the same time.
//
// In every sub-step LAMMPS calls act() after all contact forces. There the loads of the window and
// the weight are added, impulses are summed, and overlaps are looked for.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "granular_adapter/lammps/lammps_library.hpp"
#include "granular_adapter/lammps/round_grains.hpp"
#include "granular_adapter/lammps/scene.hpp"
#include "granular_adapter/lammps/touching.hpp"
#include "granular_adapter/md/md_host.hpp"

namespace turbidite::lammps {

class LammpsMdHost final : public MdHost {
 public:
    /// Starts LAMMPS on the ranks of the participant; before all other calls, of which save()
    /// and those that are not const are collective.
    void join(MPI_Comm communicator);

    std::string code() const override;
    std::int32_t dimension() const override { return both_dimensions; }
    std::vector<std::string> shapes() const override { return {"disc", "sphere"}; }
    bool repeats() const override { return true; }
    double velocity_lag() const override { return 0.0; }
    void create(const Settings& settings, const ShapeTable& shapes,
                const nscd::Bodies& bodies) override;
    void read(nscd::Bodies& bodies) const override;
    void write(const nscd::Bodies& bodies) override;
    SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) override;
    void keep(const std::vector<std::uint8_t>& mask) override;
    SavedState save() const override;
    void restore(const SavedState& state) override;

    bool shares_bodies() const override { return ranks_.size > 1; }
    bool migrated() const override { return migrated_; }
    std::vector<char> migrate(const std::vector<char>& rows, std::size_t row_size) override;
    bool on_all_ranks(bool here) override;
    std::vector<GrainId> from_all_ranks(const std::vector<GrainId>& ids) override;

 private:
    struct Ranks {
        MPI_Comm communicator = MPI_COMM_NULL;
        int own = 0, size = 1;
    };

    /// The sub-steps of the present window, counted by LAMMPS.
    struct Present {
        std::int64_t first = 0, last = 0;
        double step = 0.0;  ///< delta [s]
        bool detailed = false;
        double deepest = 0.0;
        std::int64_t contacts = 0;  ///< at the last probe
        std::vector<ContactRecord> touching{};
    };

    void start_engines();
    void load_grains(const std::vector<Load>& loads);
    static void on_substep(void* host, std::int64_t substep, int count, int* tags,
                           double** positions, double** forces);
    void act(std::int64_t substep);
    void add_loads(double weight_of_forces, bool begins);
    void probe();
    void list_contacts();
    void follow_grains();
    void find_neighbours();
    void collect_impulses(SubstepReport& report) const;

    Ranks ranks_;
    std::unique_ptr<Library> lammps_;
    std::optional<RoundGrains> grains_;
    std::optional<SoftLaw> law_;
    std::optional<MassClasses> classes_;
    std::vector<Border> borders_;
    std::vector<std::string> walls_;  ///< their fixes
    Vec3 size_{};                     ///< of the domain [m]
    double gravity_ = 0.0, skin_ = 0.0;
    std::int64_t stride_ = 1;  ///< sub-steps between two probes for overlaps
    Present present_;
    std::vector<Origin> order_;  ///< where the bodies were before the last migration
    bool migrated_ = false;
};

}  // namespace turbidite::lammps
