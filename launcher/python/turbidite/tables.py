# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables are pandas' DataFrames where pandas is installed, and structured arrays of numpy otherwise. What both can is
`table['time']`, `len(table)` and `table.columns`."""
import numpy as np

from .errors import unknown

INSTALL = 'DataFrames need pandas: apt install python3-pandas'


class Table(np.ndarray):
    """(n,) rows, a float or integer per column."""

    @property
    def columns(self):
        return list(self.dtype.names or ())

    def __getitem__(self, key):
        if isinstance(key, str) and key not in self.columns:
            raise unknown('column', key, self.columns)
        found = super().__getitem__(key)
        return np.asarray(found) if isinstance(key, str) else found

    def __getattr__(self, name):
        raise AttributeError(f'"{name}": without pandas a table is a structured array of numpy. {INSTALL}')


def table(columns):
    """Of {name: (n,) array}."""
    try:
        import pandas
    except ImportError:
        return structured(columns)
    return pandas.DataFrame(columns)


def structured(columns):
    kinds = [(name, values.dtype) for name, values in columns.items()]
    rows = np.empty(len(next(iter(columns.values()))), dtype=kinds)
    for name, values in columns.items():
        rows[name] = values
    return rows.view(Table)


def split(name, values):
    """{column: (n,) array} of an array (n,) or (n, m): force_x, force_y, ...; of quaternions orientation_w, ..."""
    if values.ndim == 1:
        return {name: values}
    letters = 'wxyz' if values.shape[1] == 4 else 'xyz'
    return {f'{name}_{letter}': values[:, k] for k, letter in zip(range(values.shape[1]), letters)}
