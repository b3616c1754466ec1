#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#PBS -l select=1:ncpus=18:mpiprocs=18
#PBS -l walltime=12:00:00

cd "$PBS_O_WORKDIR" || exit
if [ -e column/case.yaml ]; then turbidite resume column &
else turbidite run column.yaml --set fluid.ranks=16 --out column & fi
trap 'touch column/STOP' TERM    # PBS may have sent it to turbidite as well: a second one would kill the job
wait $!; wait $!                 # the first one ends with the signal
