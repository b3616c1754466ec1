# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can be expected of a run: a number of the analysis by its name (docs/analysis.md), or of a column of history.csv
`end(C)`, `max(C)`, `min(C)`, `at(C, TIME)`, `mean(C, FROM, TO)`, times in t_c."""
import difflib
import re

import numpy as np

from measured import MEASURED

CALL = re.compile(r'(\w+)\((\w+)((?:, *[-\d.e]+)*)\)$')


def did_you_mean(name, known):
    """'Did you mean NAME? ', or nothing if no name is like it."""
    return ''.join(f'Did you mean {found}? ' for found in difflib.get_close_matches(str(name), known, 1))


class Unknown(ValueError):
    """A quantity that is no quantity."""


def at(time, values, when):
    """At the row of that time."""
    row = int(np.argmin(np.abs(time - when)))
    if abs(time[row] - when) > 1e-6 * max(1.0, abs(when)):
        raise ValueError(f'there is no row at {when:g} t_c')
    return values[row]


def mean(time, values, begin, end):
    """Over the rows from begin to end."""
    inside = (time >= begin - 1e-9) & (time <= end + 1e-9)
    if not inside.any():
        raise ValueError(f'there is no row from {begin:g} to {end:g} t_c')
    return values[inside].mean()


def require_rows_until(time, end):
    """A mean until then is of another time where the run has ended before. Where the next row would be later than that,
    none is lacking: rows need not fall on it."""
    interval = np.median(np.diff(time)) if len(time) > 1 else 0.0
    rounding = 1e-6 * max(1.0, abs(end))
    if time[-1] < end - rounding and time[-1] + interval < end + rounding:
        raise ValueError(f'the last row is at {time[-1]:g} t_c, before {end:g}')


# Name: (function of times and values, how many times it takes).
CALLS = {
    'end': (None, 0),  # of the last row, which may be empty
    'max': (lambda time, values: values.max(), 0),
    'min': (lambda time, values: values.min(), 0),
    'at': (at, 1),
    'mean': (mean, 2),
}
NAMED = {one.name: one for one in MEASURED}


def quantity(text):
    """Function of a run that gives a float, or None where it cannot be told; Unknown for another text."""
    if text in NAMED:
        return NAMED[text].measure
    called = CALL.match(text)
    if not called:
        raise Unknown(f'"{text}" is no quantity. {did_you_mean(text, NAMED)}It is a name of the analysis, or one of '
                      'end(C), max(C), min(C), at(C, TIME), mean(C, FROM, TO) of a column C')
    name, column = called.group(1), called.group(2)
    try:
        times = [float(v) for v in called.group(3).split(',')[1:]]
    except ValueError:
        raise Unknown(f'"{text}" is no quantity: times are numbers, as in at(C, 2.5)') from None
    if name not in CALLS or len(times) != CALLS[name][1]:
        raise Unknown(f'"{text}" is no quantity: there are end(C), max(C), min(C), at(C, TIME), mean(C, FROM, TO)')
    return lambda run: of_column(run, column, CALLS[name][0], times)


def of_column(run, column, measure, times):
    if measure is None:
        return run.end(column)
    time, values = run.column(column)
    if measure is mean and len(values):
        require_rows_until(run.history['time'], times[1])
    return float(measure(time, values, *times)) if len(values) else None


def unit(text):
    """Of a number of the analysis, for the eye; empty for columns (docs/outputs.md has those)."""
    return NAMED[text].plain_unit if text in NAMED and NAMED[text].plain_unit != '-' else ''
