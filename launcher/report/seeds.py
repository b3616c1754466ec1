# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of one case with several seeds, averaged: the mean of their histories and their spread.

A `Member` is one line of a comparison, a single run or such a group. Its `data` has the interface of a single run, so
the same quantities are available for runs and groups.
"""
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import run_data
from differences import common_span

SEED = 'random.seed'


@dataclass
class Member:
    name: str
    data: run_data.RunData                    # of the run, or averaged over the group
    runs: list = field(default_factory=list)  # RunData of each

    def is_group(self):
        return len(self.runs) > 1

    def seeds(self):
        return [run.case.get(SEED, '?') for run in self.runs]

    def band(self, column):
        """Times [t_c], smallest and largest value over the runs; for a single run both are its value."""
        if not self.is_group():
            time, values = self.data.column(column)
            return time, values, values
        time = self.data.history['time']
        values = np.array([at_times(run, column, time) for run in self.runs])
        known = np.isfinite(values).all(axis=0)
        return time[known], values[:, known].min(axis=0), values[:, known].max(axis=0)


def members(runs, each=False, swept=lambda run: ()):
    """One member per run, or, unless `each`, per set of runs whose cases and files, and what a study has `swept`, differ
    only in the seed. Runs with equal seeds stay single: they are repetitions, whose mean is no average over seeds. So do
    those that are not done, which would cut the others to their length."""
    groups = [[run] for run in runs] if each else grouped(runs, swept)
    names = unique([name_of(group) for group in groups], groups)
    return [Member(name, group[0] if len(group) == 1 else average(group), group)
            for name, group in zip(names, groups)]


def grouped(runs, swept):
    """Lists of runs, in the order of their first runs."""
    alike = {}
    for run in runs:
        alike.setdefault((case_without_seed(run), swept(run)), []).append(run)
    order = []
    for group in alike.values():
        seeds = {run.case.get(SEED) for run in group}
        told_apart = len(seeds) == len(group) and None not in seeds and share_time(group)
        order += [group] if told_apart else [[run] for run in group]
    return sorted(order, key=lambda group: next(i for i, run in enumerate(runs) if run is group[0]))


def case_without_seed(run):
    """A run without a readable case, or that is not done, belongs to no group."""
    if not run.case or run.record.get('status') != 'done' or run.is_cut_off():
        return id(run)
    return without_seed(run.case), without_seed(run.files()), bool(run.began_from()), tuple(run.changes())


def without_seed(values):
    return tuple(sorted((key, value) for key, value in values.items() if key != SEED))


def share_time(runs):
    first = runs[0].history['time']
    return all(common_span(first, run.history['time']) for run in runs[1:])


# --- names --------------------------------------------------------------------------------------------

def name_of(group):
    """The name of the folder; for a group the common part of its folders' names, without a trailing `-seed`."""
    names = [run.folder.resolve().name for run in group]
    if len(group) == 1:
        return names[0]
    common = os.path.commonprefix(names)
    if any(name[len(common):][:1].isdigit() for name in names):  # 10 and 11 have a digit in common
        common = common.rstrip('0123456789')
    common = re.sub(r'((^|[-_.]+)(seeds?|s))?[-_.]*$', '', common)
    return common or f'{names[0]} and {len(names) - 1} more'


def unique(names, groups):
    """Unique names of the members: with as many folders above as tell them apart where the folders' names are equal."""
    paths = [group[0].folder.resolve() for group in groups]
    for above in range(1, max(len(path.parts) for path in paths) if paths else 0):
        if len(set(names)) == len(names):
            break
        names = ['/'.join(path.parts[-1 - above:]) for path in paths]
    if len(set(names)) < len(names):
        names = [f'{name} ({i + 1})' for i, name in enumerate(names)]
    return names


# --- averages -----------------------------------------------------------------------------------------

def at_times(run, column, time):
    """A quantity of a run interpolated linearly; nan outside the rows that contain it."""
    given, values = run.column(column)
    if not len(values):
        return np.full(len(time), np.nan)
    return np.interp(time, given, values, left=np.nan, right=np.nan)


def shared_times(runs):
    """Times of the rows of all runs within their common time [t_c]."""
    begin = max(run.history['time'][0] for run in runs)
    end = min(run.history['time'][-1] for run in runs)
    times = np.unique(np.concatenate([run.history['time'] for run in runs]))
    return times[(times >= begin) & (times <= end)]


def average(runs):
    """RunData of the group, of which all are done: mean history, largest maxima."""
    mean = run_data.RunData(runs[0].folder, record=average_record(runs), case=dict(runs[0].case),
                            fingerprints=runs[0].fingerprints)
    mean.case[SEED] = ', '.join(run.case[SEED] for run in runs)
    time = shared_times(runs)
    columns = [name for name in runs[0].history if all(name in run.history for run in runs)]
    mean.history = {name: np.mean([at_times(run, name, time) for run in runs], axis=0)
                    for name in columns if name != 'time'}
    mean.history['time'] = time
    for run in runs:
        mean.remarks += [f'{Path(run.folder).name}: {remark}' for remark in run.remarks]
    return mean


def average_record(runs):
    """The largest maxima over the runs; scales, which are the same for all."""
    record = dict(runs[0].record)
    tables = [run.record.get('maxima') or {} for run in runs]
    names = [name for name in tables[0] if all(table.get(name) is not None for table in tables)]
    record['maxima'] = {name: max(table[name] for table in tables) for name in names}
    return record
