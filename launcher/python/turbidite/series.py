# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outputs of a run one after the other: by number, by time, or all of them."""
from collections.abc import Mapping, Sequence

import numpy as np

from .errors import NotThere, unknown
from .tables import split, table

TOLERANCE = 1e-6  # of the last time: how far outside a run a time may be asked for


class Output(Mapping):
    """Arrays by name, at one time.

    time: t_c. `output['velocity']`, `list(output)`.
    """

    def __init__(self, time, arrays):
        self.time = time
        self._arrays = arrays

    def __getitem__(self, name):
        if name not in self._arrays:
            raise unknown('array', name, list(self._arrays))
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def __repr__(self):
        shapes = ', '.join(f'{name} {array.shape}' for name, array in self._arrays.items())
        return f'<{type(self).__name__} at {self.time:g} t_c: {shapes}>'


class Points(Output):
    """Grains or contacts: arrays (n,) and (n, d).

    outlines: {id of a polygon: its corners (k, 2) [D]}; empty for contacts, discs and spheres.
    """

    def __init__(self, time, arrays, outlines=None):
        super().__init__(time, arrays)
        self.outlines = outlines or {}

    def table(self):
        """A row per grain or contact, vectors as columns velocity_x, velocity_y, ... (a DataFrame with pandas)."""
        flat = {name: values.reshape(len(values), np.prod(values.shape[1:])) if values.ndim > 2 else values
                for name, values in self.items()}
        columns = {}
        for name, values in flat.items():
            if name == 'ends':
                half = values.shape[1] // 2
                columns |= split('begin', values[:, :half]) | split('end', values[:, half:])
            else:
                columns |= split(name, values)
        return table(columns)


class Series(Sequence):
    """The outputs of one kind, read when they are asked for.

    times: (n,) t_c. `series[0]`, `series[-1]`, `series.at(20)`, `for output in series`.
    """

    def __init__(self, what, times, read):
        self.times = np.array(times, dtype=float)
        self._what = what
        self._read = read  # of the number of an output

    def __len__(self):
        return len(self.times)

    def __getitem__(self, number):
        if isinstance(number, slice):
            return [self._read(k) for k in range(*number.indices(len(self)))]
        if not -len(self) <= number < len(self):
            raise IndexError(f'there is no output {number} of the {self._what}: there are {len(self)}')
        return self._read(number % len(self))

    def at(self, time):
        """The output nearest to a time [t_c], whose own is its `.time`; NotThere outside the run."""
        slack = TOLERANCE * abs(self.times[-1])
        if not self.times[0] - slack <= time <= self.times[-1] + slack:
            raise NotThere(f'there are {self._what} from {self.times[0]:g} to {self.times[-1]:g} t_c, not at {time:g}')
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __repr__(self):
        return f'<{len(self)} outputs of the {self._what}, {self.times[0]:g} to {self.times[-1]:g} t_c>'


class Trajectories(Series):
    """A series of grains, which have ids."""

    def over_time(self, name):
        """(ids (m,), values (n, m, ...)) of one array at all n outputs; nan where a grain is not in the box."""
        kept = [(output['id'], output[name]) for output in self]  # of all arrays of an output, two
        ids = np.unique(np.concatenate([of_output for of_output, _ in kept]))
        found = np.full((len(kept), len(ids), *kept[0][1].shape[1:]), np.nan)
        for values, (of_output, given) in zip(found, kept):
            values[np.searchsorted(ids, of_output)] = given
        return ids, found
