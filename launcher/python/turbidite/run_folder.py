# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run folder as Python sees it."""
from functools import cached_property
from pathlib import Path

from . import case_values, fields, grains, tables
from .analysis import Analysis
from .errors import NoSuchRun, NotThere, did_you_mean, unknown
from .readers import reader


def load(folder):
    """The run in a folder that `turbidite run` wrote, finished or not; NoSuchRun otherwise.

    What is there now is read: load it again to see what a run at work has written since.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise NoSuchRun(f'there is no run {folder}{suggestion(folder)}')
    if not (folder / 'case.yaml').is_file():
        raise NoSuchRun(f'{folder} is not a run folder: it has no case.yaml\n'
                        '  Give a folder written by `turbidite run`.')
    return Run(folder)


def suggestion(folder):
    runs = [path.parent.name for path in folder.parent.glob('*/case.yaml')] if folder.parent.is_dir() else []
    meant = did_you_mean(folder.name, runs, lambda name: folder.parent / name)
    return f'. {meant.rstrip()}' if meant else ''


class Run:
    """Everything is dimensionless with D, u_c, t_c = D/u_c of `scales`, whatever the units of the files.

    folder: pathlib.Path. Data are read when they are asked for.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self._data = reader('run_data').load_run(folder)

    def __repr__(self):
        return f'<run {self.folder}: {self.state}>'

    @property
    def record(self):
        """run.json as a dict: versions, scales, ranks, maxima over all windows, warnings, how it ended."""
        return self._data.record

    @property
    def state(self):
        """'prepared' (also while it runs), 'done', 'failed', ...: `status` of run.json; 'unknown' without one."""
        return self.record.get('status', 'unknown')

    @property
    def scales(self):
        """{'D', 'u_c', 't_c', 'g', 'rho', 'nu'} in the units of the files: SI for `scales.kind: physical`."""
        return {name: self.record[name] for name in ('D', 'u_c', 't_c', 'g', 'rho', 'nu') if name in self.record}

    @cached_property
    def case(self):
        """The resolved case: {'time': {'step': 0.01, ...}, ...} with bool, int, float, str, None, list and dict."""
        return case_values.nested(self._data.case)

    @cached_property
    def history(self):
        """history.csv, a row per output: pandas.DataFrame, or a structured array without pandas; nan where empty."""
        if self._data.history is None:
            raise NotThere(f'{self.folder} has no history so far: ' + ' '.join(self.remarks))
        return tables.table(self._data.history)

    def column(self, name):
        """(times [t_c], values) of a column of the history, without the rows in which it is empty."""
        known = [] if self._data.history is None else list(self._data.history)
        if name not in known:
            raise unknown('column', name, known)
        return self._data.column(name)

    @cached_property
    def probes(self):
        """probes.csv, a row per output, as `history`: time, pressure_1, velocity_x_1, ... (docs/outputs.md)."""
        fields.require_fluid(self._data)
        path = self.folder / 'probes.csv'
        if not path.exists():
            raise NotThere(f'{self.folder} has no probes: its case sets no output.probes')
        return tables.table(reader('run_data').read_history(path))

    @cached_property
    def grains(self):
        """The grains at every output: `run.grains[-1]['velocity']`, `run.grains.at(20)`, `run.grains.over_time('position')`.

        id, shape, material, prescribed (n,); position [D], velocity [u_c], force of the fluid [rho_f u_c^2 D, in space
        D^2], contact_force [rho_s g D^2, in space D^3] (n, d) with d = 2 or 3; radius [D], density [rho_f] (n,);
        angular_velocity [1/t_c], torque (n,), in space (n, 3); orientation (n, 4), a quaternion, real part first.
        """
        return grains.grains(self._data)

    @cached_property
    def contacts(self):
        """The contact points at every output, as `grains`.

        id_a, id_b, feature, status (n,): docs/outputs.md; point, force on b, normal from a to b (n, d), ends (n, 2, d):
        lengths in D, forces in rho_s g D^2 (in space D^3); normal_force, tangential_force, gap (n,).
        """
        return grains.contacts(self._data)

    @cached_property
    def fields(self):
        """The fluid at every output of its fields: `run.fields[-1]['U']` [u_c], `['p']` [rho_f u_c^2], `.x`, `.y`, `.z`."""
        return fields.fields(self._data)

    @cached_property
    def slices(self):
        """[series, ...]: the planes of output.slices (space), as `fields`, with U, p and covered."""
        return fields.slices(self._data)

    @cached_property
    def analysis(self):
        """What the report measures, by name: `run.analysis.rest_time()`, `run.analysis.deposit()`."""
        return Analysis(self._data)

    @property
    def remarks(self):
        """What could not be read or measured so far, as sentences."""
        return self._data.remarks
