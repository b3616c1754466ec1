#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Every MPI call of OpenFOAM's libPstream that takes a communicator must be wrapped by the isolation layer.
# usage: isolated_calls.sh libturbidite_world_isolation.so
set -eu

pstream=$(ldconfig -p | awk '$1 == "libPstream.so" { print $NF; exit }')
[ -n "$pstream" ] || pstream=/usr/lib/libPstream.so
[ -e "$pstream" ] || { echo "no libPstream.so: is openfoam installed?"; exit 1; }

# Calls without a communicator.
harmless='MPI_Buffer_attach MPI_Buffer_detach MPI_Comm_free MPI_Finalized MPI_Get_count MPI_Group_free
MPI_Group_incl MPI_Initialized MPI_Test MPI_Wait MPI_Waitall'

called=$(nm -D --undefined-only "$pstream" | awk '$2 ~ /^MPI_/ { print $2 }')
answered=$(nm -D --defined-only "$1" | awk '$3 ~ /^MPI_/ { print $3 }')
[ -n "$called" ] || { echo "$pstream makes no MPI call: the serial dummy?"; exit 1; }

status=0
for call in $called; do
    if ! printf '%s\n' $harmless $answered | grep -qx "$call"; then
        echo "$pstream calls $call, which the isolation layer does not answer"
        status=1
    fi
done
[ $status = 0 ] && echo "all $(printf '%s\n' $called | wc -l) calls of $pstream are covered"
exit $status
