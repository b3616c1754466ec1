#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#SBATCH --ntasks=18              # coupler, 16 of the fluid, 1 of the grains
#SBATCH --time=12:00:00
#SBATCH --signal=B:USR1@300      # to this script, five minutes before the end
#SBATCH --requeue
#SBATCH --open-mode=append       # what all parts of the run print, in one file

ranks="--set fluid.ranks=$((SLURM_NTASKS - 2))"
if [ -e column/case.yaml ]; then turbidite resume column $ranks &
else turbidite run column.yaml $ranks --out column & fi
trap 'trap "" USR1; kill -USR1 $!' USR1    # once: a second one would kill the job
wait $!; wait $!                 # the first one ends with the signal
code=$?
case $code in                    # 138: the signal came before the programs were started, or during the report
    138|143) scontrol requeue "$SLURM_JOB_ID" ;;
esac
exit $code
