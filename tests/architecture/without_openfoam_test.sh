#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# TURBIDITE_OPENFOAM=OFF: the build is configured where there are no headers of OpenFOAM, and no command of it names any
# part of OpenFOAM.
# usage: without_openfoam_test.sh PROJECT_FOLDER
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

broken() {
    printf 'FAILED: %s\n' "$1" >&2
    exit 1
}

cmake -S "$1" -B "$work" -G Ninja -DTURBIDITE_OPENFOAM=OFF -DTURBIDITE_OPENFOAM_INCLUDE=/nonexistent >"$work/log" 2>&1 ||
    { cat "$work/log"; broken "cmake"; }
commands=$(ninja -C "$work" -t commands run_programs)
[[ $commands == *turbidite-fluid-box* ]] || broken "the box program is not built"
for part in foam_app foam_solver libOpenFOAM libfiniteVolume fvCFD; do
    [[ $commands != *"$part"* ]] || broken "$part is built or linked"
done
