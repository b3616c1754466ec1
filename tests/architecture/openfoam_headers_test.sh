#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The header fetch against a fake archive: which sources it derives, what the flat folder holds, that a
# second call fetches nothing, and that a version mismatch is refused.
# usage: openfoam_headers_test.sh PROJECT_FOLDER
set -euo pipefail

fetch=$1/cmake/fetch-openfoam-headers
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sources=$work/archive/openfoam-1/src
mkdir -p "$work"/{bin,etc/sources.list.d} \
    "$sources"/{OpenFOAM/db,OSspecific/POSIX,finiteVolume,meshTools,surfMesh,fileFormats,lagrangian}

broken() {
    printf 'FAILED: %s\n' "$1" >&2
    find "$work" -path "$work/archive" -prune -o -type f -print >&2
    exit 1
}
same() { [[ $2 == "$3" ]] || broken "$1:"$'\n'"$2"$'\n'"expected:"$'\n'"$3"; }

# The machine: Debian entries in both formats, among others that must not be used.
cat >"$work/etc/sources.list" <<'LIST'
deb [signed-by=/k.gpg arch=amd64] http://mirror.example/debian bookworm main contrib # comment
deb-src http://deb.debian.org/debian bookworm main
# deb http://deb.debian.org/debian sid main
deb https://packages.example/apt stable main
deb http://deb.debian.org/debian bookworm non-free
LIST
cat >"$work/etc/sources.list.d/debian.sources" <<'SOURCES'
Types: deb
# a comment
URIs: http://deb.debian.org/debian
Suites: bookworm
 bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg

Types: deb
URIs: http://switched.off/debian
Suites: bookworm
Components: main
Enabled: no

Types: deb
URIs: https://deb.example.com/node
Suites: nodistro
Components: main
SOURCES

# The archive: a source package with a header, its template and a template of that template, a program,
# and a folder that is not wanted.
echo '#   include "list.C"' >"$sources/OpenFOAM/db/list.H"
echo '#include "listIO.C"' >"$sources/OpenFOAM/db/list.C"
touch "$sources"/{OpenFOAM/db/listIO.C,OpenFOAM/db/program.C,OSspecific/POSIX/POSIX.H} \
    "$sources"/{finiteVolume/fvCFD.H,meshTools/search.H,surfMesh/surface.H,fileFormats/ascii.H} \
    "$sources"/lagrangian/parcel.H
tar -C "$work/archive" -cjf "$work/archive/orig" openfoam-1

cat >"$work/bin/dpkg-query" <<'FAKE'
#!/bin/bash
case "$*" in
    *source:Version*) echo "installed ${FAKE_VERSION:-1-2}" ;;
    *source:Upstream-Version*) echo "installed 1" ;;
esac
FAKE
cat >"$work/bin/apt-get" <<FAKE
#!/bin/bash
echo "\$*" >>"$work/calls"
for argument; do
    case \$argument in
        Dir::Etc::sourceparts=*) rm -rf "$work/parts"; cp -r "\${argument#*=}" "$work/parts" ;;
        openfoam=1-2) cp "$work/archive/orig" openfoam_1.orig.tar.bz2 ;;
        openfoam=*) echo "E: Can not find version" >&2; exit 100 ;;
    esac
done
FAKE
chmod +x "$work"/bin/*
export PATH="$work/bin:$PATH" TURBIDITE_CACHE="$work/the cache" TURBIDITE_APT_ETC="$work/etc"

folder=$("$fetch" 2>/dev/null) || broken "the fetch failed"
same "folder" "$folder" "$work/the cache/openfoam-1/include"
same "headers and the templates they include" "$(cd "$folder" && LC_ALL=C && echo *)" \
    "POSIX.H ascii.H fvCFD.H list.C list.H listIO.C search.H surface.H"
same "one-line entries" "$(cat "$work"/parts/*.list)" \
    "deb-src [signed-by=/k.gpg arch=amd64] http://mirror.example/debian bookworm main contrib "
same "deb822 entries" "$(cat "$work"/parts/*.sources)" "Types: deb-src
URIs: http://deb.debian.org/debian
Suites: bookworm
 bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg"

calls=$(<"$work/calls")
"$fetch" >/dev/null || broken "the second call failed"
same "calls of apt-get after a second fetch" "$(<"$work/calls")" "$calls"

code=0
message=$(FAKE_VERSION=1-3 "$fetch" 2>&1) || code=$?
same "exit code for a version that the archive does not carry" "$code" 2
[[ $message == *"openfoam 1-3"*"another version"* ]] || broken "unclear refusal: $message"
[[ -f $folder/fvCFD.H ]] || broken "a failed fetch destroyed the headers that were there"
same "content of the cache" "$(find "$TURBIDITE_CACHE" -mindepth 1 -maxdepth 1 -printf '%f\n' | LC_ALL=C sort)" \
    ".openfoam.lock"$'\n'"openfoam-1"
