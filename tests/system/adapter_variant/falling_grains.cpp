// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-falling-grains RUN: a grains adapter for one test, whose grains fall without contacts.
#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"

int main(int argc, char** argv) {
    turbidite::ScriptedGrains grains("falling");
    return turbidite::run_grains(grains, {&argc, &argv, argv[1]});
}
