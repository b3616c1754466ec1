# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is expensive to measure is measured once per run, however many figures and tables ask for it."""
import functools


def once_per_run(measure):
    """Remembers measure(run) in `run.measured`; None is remembered too."""
    @functools.wraps(measure)
    def remembered(run):
        key = f'{measure.__module__}.{measure.__qualname__}'
        if key not in run.measured:
            run.measured[key] = measure(run)
        return run.measured[key]
    return remembered
