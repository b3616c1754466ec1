# SPDX-License-Identifier: GPL-3.0-or-later
"""The life of a YADE process in a coupled job: start and end, common to both participants.

Must be imported before anything else. YADE must be started with `-x`: otherwise a Python error opens a prompt, and
the job waits for ever.
"""
import builtins
import os
import sys
import traceback


def note_start(step):
    """Notes for the coupler that this program is about to take a step of its start (start_record.hpp)."""
    if 'TURBIDITE_MEMBER' in os.environ:
        with open(os.environ['TURBIDITE_MEMBER'], 'a') as record:
            record.write(step + '\n')


# Must come first: mpy initialises MPI and splits its world when it is imported, a collective operation that all
# processes of the job perform at this point. A later import (YADE does one at its exit) would hang a finished job.
note_start('split')
from yade import mpy

import yade.config


def abort():
    """Aborts the whole job with the traceback of the present exception.

    An orderly exit would wait in MPI_Finalize for programs that wait for this one.
    """
    traceback.print_exc()
    sys.stderr.flush()
    mpy.MPI.COMM_WORLD.Abort(4)


EXITS = ((sys, 'exit'), (builtins, 'exit'), (builtins, 'quit'))


def replace_exits(exits):
    """Sets sys.exit, exit and quit, and returns those before. An exit from within a step of YADE waits for ever."""
    before = [getattr(module, name) for module, name in EXITS]
    for (module, name), exit in zip(EXITS, exits):
        setattr(module, name, exit)
    return before


def refused_exit(*_):
    raise RuntimeError('grains.script must not end YADE (sys.exit, exit, quit): an error that it raises ends the run, and so '
                       'does a file STOP in the run folder')


def take_part(parts):
    """Runs the participant, and exits with the exit code of the run.

    parts() returns the participant's type (from turbidite_yade) and its scene: an object with the functions called
    from C++, and play(participant), which runs windows until there are no more.
    """
    exits = replace_exits([refused_exit] * len(EXITS))
    try:
        participant_type, scene = parts()
        participant = participant_type(
            sys.argv[1], mpy.MPI._handleof(mpy.comm), scene, yade.config.version)
        if participant.start():
            scene.play(participant)
        code = participant.leave()
    except Exception:
        abort()
    replace_exits(exits)
    sys.stdout.flush()
    if code != 0:
        sys.exit(code)
