# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of turbidite in Python: what they wrote as arrays and tables, what the report measures, and new runs.

    import turbidite
    run = turbidite.load('runs/quickstart')
    run.history['mean_speed'], run.grains[-1]['velocity'], run.fields.at(30)['U'], run.analysis.rest_time()

docs/python.md is a tutorial.
"""
try:
    import numpy as _
except ImportError:
    raise ImportError('turbidite needs numpy: apt install python3-numpy, which is for /usr/bin/python3') from None

from .errors import Error, NoSuchRun, NotThere, RunFailed, UnknownName
from .play import run
from .run_folder import Run, load

__all__ = ['Error', 'NoSuchRun', 'NotThere', 'Run', 'RunFailed', 'UnknownName', 'load', 'run']

for _error in (Error, NoSuchRun, NotThere, RunFailed, UnknownName):
    _error.__module__ = __name__  # as tracebacks and documentation name them
