# SPDX-License-Identifier: GPL-3.0-or-later
"""How a YADE process takes part in a coupled job: what both participants begin and end with.

To be imported before anything else. YADE is started with `-x`: without it a Python error opens a prompt and the
job waits for ever.
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


def take_part(parts):
    """The whole life of the process; leaves with the exit code of the run.

    parts() returns the participant's type (turbidite_yade) and a scene for it: with the functions that the
    C++ side calls, and play(participant), which plays windows until there are no more.
    """
    try:
        participant_type, scene = parts()
        participant = participant_type(
            sys.argv[1], mpy.MPI._handleof(mpy.comm), scene, yade.config.version)
        if participant.start():
            scene.play(participant)
        code = participant.leave()
    except Exception:
        abort()
    sys.stdout.flush()
    if code != 0:
        sys.exit(code)
