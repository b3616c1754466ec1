# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the runs of configs/paper.yaml by part and swept values."""
from dataclasses import dataclass

import numpy as np

import seeds

COMPACITIES = ('0.7854', '0.829', '0.85', '0.87', '0.9069')
LOOSE, DENSE = COMPACITIES[0], COMPACITIES[-1]
REYNOLDS = ('89', '8.9', '0.89')


@dataclass
class PaperRuns:
    runs: list  # study.StudyRun

    def of(self, part, **values):
        """RunData of the runs with a history, of this part and of those that repeat it ("immersed-again"); `values`
        by the last word of their keys."""
        return [run.data for run in self.runs if run.entry['part'] in (part, f'{part}-again')
                and run.data.history is not None
                and all(value_of(run.entry, name) == value for name, value in values.items())]

    def member(self, part, **values):
        """The seeds taken together; None without runs."""
        found = self.of(part, **values)
        return seeds.members(found)[0] if found else None

    def numbers(self, measure, part, **values):
        """What a measure finds of each run, without None."""
        return [value for value in map(measure, self.of(part, **values)) if value is not None]


def value_of(entry, name):
    for key, value in entry['values'].items():
        if key.rpartition('.')[2] == name:
            return value
    return None


def spread(values, form='.3g'):
    """`mean (smallest to largest)`, or the one value."""
    if len(values) == 1:
        return f'{values[0]:{form}}'
    return f'{np.mean(values):{form}} ({min(values):{form}} to {max(values):{form}})'
