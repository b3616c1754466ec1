// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-partner -case RUN/fluid: a scripted fluid in the place of turbidite-fluid, a linear
// drag with a solution in closed form; partner of `turbidite adapter-test`.
#include <cstdio>
#include <filesystem>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"
#include "launcher/adapter_test/partner.hpp"

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: turbidite-partner -case RUN/fluid\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    turbidite::ScriptedFluid fluid(turbidite::partner_drag);
    const std::filesystem::path foam_case = argv[2];
    return turbidite::run_fluid(fluid, {&argc, &argv, foam_case.parent_path().string()});
}
