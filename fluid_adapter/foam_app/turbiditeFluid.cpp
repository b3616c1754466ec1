// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-fluid -case RUN/fluid [-parallel]: OpenFOAM as the fluid participant. The coupler's
// messages become calls of FoamAdapter (coupler/participant), and these the steps of a window,
// which are listed in order in fluid_window.hpp. `-parallel` is OpenFOAM's option for several
// ranks; their number is known without it.
#include <cstdio>
#include <filesystem>
#include <string>

#include "coupler/participant/participant.hpp"
#include "coupler/transport/world_isolation.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"

int main(int argc, char** argv) {
    const bool case_given = argc >= 3 && std::string(argv[1]) == "-case";
    const bool parallel_given = argc == 4 && std::string(argv[3]) == "-parallel";
    if (!case_given || (argc != 3 && !parallel_given)) {
        std::fprintf(stderr,
                     "usage: turbidite-fluid -case RUN/fluid [-parallel]   (started by `turbidite "
                     "run`)\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    const std::filesystem::path foam_case = std::filesystem::absolute(argv[2]).lexically_normal();
    turbidite::FoamAdapter adapter(foam_case);

    turbidite::Launch launch{&argc, &argv, foam_case.parent_path().string()};
    launch.joined = [&adapter](int communicator) {
        turbidite::isolate_world(MPI_Comm_f2c(communicator));
        adapter.share(communicator);
    };
    return turbidite::run_fluid(adapter, launch);
}
