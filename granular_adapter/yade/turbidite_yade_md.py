# SPDX-License-Identifier: GPL-3.0-or-later
"""Molecular dynamics by YADE as the grains participant: `yade -n -x turbidite_yade_md.py RUN`, started by
`turbidite run` with grains.adapter: yade-md.

`-x` is needed: without it a Python error opens a prompt and the job waits for ever.
"""
import sys
import traceback

# First of all: mpy splits the world when it is imported, and every process of the job takes part in that
# one split now. Imported later (YADE does so at its exit) it would hang a finished job.
from yade import mpy

import yade.config


def abort():
    """Ends the whole job with the traceback of the present exception.

    An orderly exit would wait in MPI_Finalize for programs that wait for this one.
    """
    traceback.print_exc()
    sys.stderr.flush()
    mpy.MPI.COMM_WORLD.Abort(4)


try:
    import turbidite_yade
    from md_scene import Scene

    participant = turbidite_yade.MdParticipant(
        sys.argv[1], mpy.MPI._handleof(mpy.comm), Scene(), yade.config.version)
    if participant.start():
        while participant.step():
            pass
    code = participant.leave()
except Exception:
    abort()
sys.stdout.flush()
if code != 0:
    sys.exit(code)
