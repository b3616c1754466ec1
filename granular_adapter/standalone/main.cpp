// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-grains RUN: the contact engine as a participant without a host code, on one rank or
// several.
#include <cstdio>
#include <optional>

#include "coupler/participant/participant.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "granular_adapter/nscd_ranks/mpi_exchange.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: turbidite-grains RUN   (started by `turbidite run`)\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    std::optional<turbidite::nscd::MpiExchange> ranks;
    turbidite::NscdAdapter adapter("standalone-nscd");
    adapter.set_run_folder(argv[1]);
    turbidite::Launch launch{&argc, &argv, argv[1]};
    launch.joined = [&](int communicator) {
        ranks.emplace(MPI_Comm_f2c(communicator));
        if (ranks->size() > 1) adapter.share_with(*ranks);
    };
    return turbidite::run_grains(adapter, launch);
}
