// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-fluid-box -case RUN/fluid [-parallel]: the fluid participant without OpenFOAM, for
// boxes in space (box_adapter.hpp). The arguments are those of turbidite-fluid.
#include <cstdio>
#include <filesystem>
#include <string>

#include "coupler/participant/participant.hpp"
#include "fluid_adapter/box_app/box_adapter.hpp"

int main(int argc, char** argv) {
    const bool case_given = argc >= 3 && std::string(argv[1]) == "-case";
    const bool parallel_given = argc == 4 && std::string(argv[3]) == "-parallel";
    if (!case_given || (argc != 3 && !parallel_given)) {
        std::fprintf(stderr, "usage: turbidite-fluid-box -case RUN/fluid [-parallel]\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    const std::filesystem::path folder = std::filesystem::absolute(argv[2]).lexically_normal();
    turbidite::BoxAdapter adapter(folder);
    turbidite::Launch launch{&argc, &argv, folder.parent_path().string()};
    launch.joined = [&adapter](int communicator) { adapter.share(MPI_Comm_f2c(communicator)); };
    return turbidite::run_fluid(adapter, launch);
}
