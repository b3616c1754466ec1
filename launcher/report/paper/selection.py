# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the runs of configs/paper.yaml by part and swept values."""
from dataclasses import dataclass, replace

import numpy as np

import seeds

COMPACITIES = ('0.7854', '0.829', '0.85', '0.87', '0.9069')
LOOSE, DENSE = COMPACITIES[0], COMPACITIES[-1]
REYNOLDS = ('89', '8.9', '0.89')
COLUMNS = ('immersed', 'closed-pores')  # parts with the immersed columns, one per hydrodynamic radius
ADDED = ('', '-again', '-viscous')      # parts of the study that add runs to the one of this name


@dataclass
class PaperRuns:
    runs: list                 # study.StudyRun
    columns: str = COLUMNS[0]  # which immersed columns a statement is about

    def with_columns(self, part):
        return replace(self, columns=part)

    def entries(self, part, **values):
        """The runs of this part and of those that add to it, played or not; `values` by the last word of their keys."""
        return [run for run in self.runs if run.entry['part'] in [part + suffix for suffix in ADDED]
                and all(value_of(run.entry, name) == value for name, value in values.items())]

    def of(self, part, **values):
        """RunData of those that are done."""
        return [run.data for run in self.entries(part, **values) if is_done(run)]

    def done(self):
        return [run for run in self.runs if is_done(run)]

    def immersed(self, **values):
        return self.of(self.columns, **values)

    def grid(self):
        """{Re: compacities} of the immersed columns of the study, in its order; None until all of them are played."""
        asked = self.entries(self.columns)
        if not asked or not all(map(is_done, asked)):
            return None
        found = {reynolds: [phi for phi in COMPACITIES if self.entries(self.columns, compacity=phi, reynolds=reynolds)]
                 for reynolds in REYNOLDS}
        return {reynolds: compacities for reynolds, compacities in found.items() if compacities}

    def member(self, part, **values):
        """The seeds taken together; None without runs."""
        found = self.of(part, **values)
        return seeds.members(found)[0] if found else None

    def numbers(self, measure, part, **values):
        """What a measure finds of each run, without None."""
        return [value for value in map(measure, self.of(part, **values)) if value is not None]

    def conditions(self, part):
        """Under which the runs of a part were played: mesh, hydrodynamic radius and splitting of those with a fluid."""
        return '; '.join(dict.fromkeys(condition(run) for run in self.of(part) if run.is_wet()))


def is_done(run):
    return run.entry['status'] == 'done' and run.data.history is not None and not run.data.is_cut_off()


def condition(run):
    radius = run.case.get('fluid.hydrodynamic_radius', '1')
    pores = "R_h = R, as in the paper's Eq. 10" if float(radius) == 1.0 else f'pores opened to {radius} R'
    known = [('D/{}', 'fluid.cells_per_diameter'), ('{}', 'fluid.splitting')]
    mesh, splitting = (form.format(run.case[key]) if key in run.case else '' for form, key in known)
    return ', '.join(part for part in (mesh, pores, splitting) if part)


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
