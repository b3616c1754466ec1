#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The bootstrap on a fake Debian. If packages are missing it must name all of them, install nothing and
# exit with 2. If all are installed it must build what the command needs and nothing else, and start the
# program. usage: bootstrap_test.sh PROJECT_FOLDER
set -euo pipefail

project=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/a checkout"
cp "$project/turbidite" "$work/a checkout/"
ln -s "$work/a checkout/turbidite" "$work/a link"

broken() {
    printf 'FAILED: %s\n--- output:\n%s\n' "$1" "$output" >&2
    exit 1
}

# Fake installers that record any call.
for name in apt-get sudo; do
    printf '#!/bin/bash\ntouch "%s/installed"\n' "$work" >"$work/bin/$name"
done
# Only yade and g++ are installed; cmake was removed but left its configuration.
cat >"$work/bin/dpkg-query" <<'FAKE'
#!/bin/bash
printf 'yade installed\ng++ installed\ncmake config-files\n'
exit 1
FAKE
chmod +x "$work"/bin/*

code=0
output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_NO_INSTALL=1 "$work/a link" --version 2>&1) || code=$?

[[ $code == 2 ]] || broken "exit code $code, expected 2"
for package in cmake openfoam ninja-build; do
    grep -q "^$package  *[A-Za-z]" <<<"$output" || broken "$package is not listed with its reason"
    grep -q "apt-get install .* $package\( \|$\)" <<<"$output" || broken "$package is not in the command"
done
if grep -qE '^(yade|g\+\+) ' <<<"$output"; then broken "an installed package is called missing"; fi
if grep -qE '^libgtest-dev ' <<<"$output"; then broken "a run needs no package of tests"; fi
for command in test bench docs; do
    output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_NO_INSTALL=1 "$work/a link" $command 2>&1) || true
    for package in cmake libgtest-dev; do
        grep -q "^$package  *[A-Za-z]" <<<"$output" || broken "\"$command\": $package is not listed"
    done
done
[[ ! -e $work/installed ]] || broken "an installer was called although TURBIDITE_NO_INSTALL forbids it"

# ---- a machine with all packages, and a build folder whose targets only record that they were built ----

cat >"$work/bin/dpkg-query" <<'FAKE'
#!/bin/bash
for name; do case $name in --*) ;; *) echo "$name installed" ;; esac; done
FAKE
build="$work/a checkout/build/release"
mkdir -p "$build/bin" "$work/headers"
printf '#!/bin/bash\necho "arguments: $*"\nexit 5\n' >"$build/bin/turbidite"
chmod +x "$build/bin/turbidite"
packages=$(sed -n "/<<'LIST'/,/^LIST/s/^\([a-z][a-z+0-9.-]*\) .*/\1/p" "$work/a checkout/turbidite")
configured() { printf 'root %s\nheaders %s\n%s\n' "$work/a checkout" "$work/headers" "$1" >"$build/.configured"; }
configured "$packages"
cat >"$build/build.ninja" <<NINJA
rule write
  command = echo \$out >>"$work/built"
build run_programs: write
build bench_programs: write run_programs
build tests: write bench_programs
build all: phony run_programs bench_programs tests
default all
NINJA

# $1 is the command, $2 what must be built, in one line.
builds() {
    rm -f "$work/built"
    code=0
    output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_OPENFOAM_INCLUDE="$work/headers" \
        "$work/a link" $1 2>&1) || code=$?
    [[ $code == 5 ]] || broken "\"$1\": exit code $code, expected the program's own, 5"
    [[ $output == *"arguments: $1"* ]] || broken "\"$1\": the arguments did not reach the program"
    [[ $(sort "$work/built" | xargs) == "$2" ]] || broken "\"$1\" built: $(xargs <"$work/built"); expected: $2"
}

builds "run a.yaml --out b" "run_programs"
builds "yade c.py" "run_programs"
builds "bench fluid" "bench_programs run_programs"
builds "test --unit" "bench_programs run_programs tests"
builds "" "run_programs"
builds "doctor" "run_programs"  # the program there knows no doctor

# What was configured before a package came would lack what needs it. (There is nothing that CMake could configure.)
configured "$(grep -v libsiconos <<<"$packages")"
code=0
output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_OPENFOAM_INCLUDE="$work/headers" "$work/a link" test 2>&1) || code=$?
[[ $code == 7 && $output == *"configuring failed"* ]] || broken "a package has come, and nothing was configured again"
configured "$packages"

# A program that can judge the installation is started as it is.
cp "$build/bin/turbidite" "$work/program"
printf '#!/bin/bash\n[[ $* != "doctor --help" ]] || exit 0\necho "arguments: $*"\nexit 5\n' >"$build/bin/turbidite"
rm -f "$work/built"
code=0
output=$(cd / && "$work/a link" doctor --no-job 2>&1) || code=$?
[[ $code == 5 && $output == "arguments: doctor --no-job" ]] || broken "doctor was not started at once"
[[ ! -e $work/built ]] || broken "doctor built: $(xargs <"$work/built")"
cp "$work/program" "$build/bin/turbidite"

for target in run_programs bench_programs; do
    grep -q "^ *add_custom_target($target " "$project/CMakeLists.txt" || broken "CMake has no target $target"
done

# A failing build is reported with its output and its own code, and the program is not started.
printf 'rule fail\n  command = echo the compiler is not well; false\nbuild run_programs: fail\n' >"$build/build.ninja"
code=0
output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_OPENFOAM_INCLUDE="$work/headers" "$work/a link" run 2>&1) || code=$?
[[ $code == 7 ]] || broken "exit code $code of a build that fails, expected 7"
[[ $output == *"the compiler is not well"* ]] || broken "the words of a build that fails are missing"
[[ $output != *"arguments:"* ]] || broken "a program was started although the build failed"
