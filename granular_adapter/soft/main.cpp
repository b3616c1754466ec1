// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-grains-md RUN: molecular dynamics of discs, polygons and spheres as a participant
// without a host code.
#include <cstdio>

#include "coupler/participant/participant.hpp"
#include "granular_adapter/md/md_adapter.hpp"
#include "granular_adapter/soft/soft_md_host.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: turbidite-grains-md RUN   (started by `turbidite run`)\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    turbidite::soft::SoftMdHost host;
    turbidite::MdAdapter adapter("standalone-md", host);
    return turbidite::run_grains(adapter, {&argc, &argv, argv[1]});
}
