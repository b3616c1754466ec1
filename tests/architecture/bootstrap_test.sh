#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The bootstrap on a machine where packages are missing, played by a fake dpkg-query: it must name all
# of them, install nothing and leave with 2. usage: bootstrap_test.sh PROJECT_FOLDER
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

# Every installer that could do harm writes a witness.
for name in apt-get sudo; do
    printf '#!/bin/bash\ntouch "%s/installed"\n' "$work" >"$work/bin/$name"
done
# Only yade and g++ are there; cmake was removed but left its configuration.
cat >"$work/bin/dpkg-query" <<'FAKE'
#!/bin/bash
printf 'yade installed\ng++ installed\ncmake config-files\n'
exit 1
FAKE
chmod +x "$work"/bin/*

code=0
output=$(cd / && PATH="$work/bin:$PATH" TURBIDITE_NO_INSTALL=1 "$work/a link" --version 2>&1) || code=$?

[[ $code == 2 ]] || broken "exit code $code, expected 2"
for package in cmake openfoam ninja-build libgtest-dev; do
    grep -q "^$package  *[A-Za-z]" <<<"$output" || broken "$package is not listed with its reason"
    grep -q "apt-get install .* $package\( \|$\)" <<<"$output" || broken "$package is not in the command"
done
if grep -qE '^(yade|g\+\+) ' <<<"$output"; then broken "an installed package is called missing"; fi
[[ ! -e $work/installed ]] || broken "an installer was called although TURBIDITE_NO_INSTALL forbids it"
