// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ranks of our fluid when turbidite-bench-fluid runs alone under mpirun: does what the coupler
// does in a job, without its messages. Every rank moves all grains, passes those that touch its box
// to the fluid, and receives the kicks of all ranks.
#pragma once

#include <memory>
#include <optional>

#include "coupler/hub/exchange_plan.hpp"
#include "coupler/transport/world.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"

namespace turbidite::bench {

class FluidRanks {
 public:
    /// `parallel`: under mpirun. Otherwise there is one rank, and MPI is not initialised.
    FluidRanks(bool parallel, int* argc, char*** argv);

    bool first() const { return rank_ == 0; }

    /// Opens the case on every rank.
    void initialise(FoamAdapter& fluid, const Settings& settings, const ShapeTable& shapes);

    /// The grains needed by this rank's fluid.
    std::vector<GrainState> here(const std::vector<GrainState>& grains) const;

    /// Gathers the kicks of each rank's grains on all ranks.
    std::vector<Kick> all(const std::vector<Kick>& kicks) const;
    std::vector<FreeResponse> all(const std::vector<FreeResponse>& responses) const;

    /// Waits for all ranks.
    void meet() const;

 private:
    std::unique_ptr<MpiEnvironment> mpi_;
    int rank_ = 0;
    std::optional<ExchangePlan> plan_;
};

}  // namespace turbidite::bench
