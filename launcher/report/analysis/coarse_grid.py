# SPDX-License-Identifier: LGPL-2.1-or-later
"""A coarse grid over the box: sums over what lies in its square cells."""
from dataclasses import dataclass

import numpy as np

CELL = 2.5  # D: some eight grains, or sixteen triangles


@dataclass
class Grid:
    columns: int
    rows: int
    cell: float = CELL  # D

    def sums(self, places, values):
        """(rows, columns) of the values at places (n, 2); what lies outside does not count."""
        index = np.floor(places / self.cell).astype(int)
        inside = ((index >= 0) & (index < [self.columns, self.rows])).all(axis=1)
        flat = index[inside, 1] * self.columns + index[inside, 0]
        return np.bincount(flat, np.asarray(values, dtype=float)[inside],
                           minlength=self.rows * self.columns).reshape(self.rows, self.columns)

    def means(self, places, values, weights):
        """Weighted means, nan in empty cells."""
        return ratio(self.sums(places, values * weights), self.sums(places, weights))

    def middles(self):
        """x (columns,), y (rows,) [D]."""
        return (np.arange(self.columns) + 0.5) * self.cell, (np.arange(self.rows) + 0.5) * self.cell

    def edges(self):
        return np.arange(self.columns + 1) * self.cell, np.arange(self.rows + 1) * self.cell


def grid_over(run, cell=CELL):
    width, height = run.size()
    return Grid(int(np.ceil(width / cell)), int(np.ceil(height / cell)), cell)


def ratio(part, whole):
    """nan where the whole is 0."""
    return np.divide(part, whole, out=np.full(np.shape(part), np.nan), where=np.asarray(whole) > 0.0)
