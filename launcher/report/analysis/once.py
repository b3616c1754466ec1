# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is expensive to measure is measured once per run, however many figures and tables ask for it."""
import functools

# What reading and measuring damaged or unusual files can raise. The report shows the rest, and says what is missing.
UNREADABLE = (ValueError, KeyError, OSError, AttributeError, SyntaxError, IndexError, RuntimeError)


def or_remark(run, what, measure):
    """measure(), or None and a remark."""
    try:
        return measure()
    except UNREADABLE as error:
        remark = f'{what} cannot be measured: {type(error).__name__} {error}'
        if remark not in run.remarks:
            run.remarks.append(remark)
        return None


def once_per_run(measure):
    """Remembers measure(run) in `run.measured`; None is remembered too."""
    @functools.wraps(measure)
    def remembered(run):
        key = f'{measure.__module__}.{measure.__qualname__}'
        if key not in run.measured:
            run.measured[key] = measure(run)
        return run.measured[key]
    return remembered
