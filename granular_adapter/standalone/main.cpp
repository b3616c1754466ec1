// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-grains RUN: the contact engine as a participant without a host code. It is the smallest
// example of an adapter program.
#include <cstdio>

#include "coupler/participant/participant.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: turbidite-grains RUN   (started by `turbidite run`)\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    turbidite::NscdAdapter adapter("standalone-nscd");
    adapter.set_run_folder(argv[1]);
    return turbidite::run_grains(adapter, {&argc, &argv, argv[1]});
}
