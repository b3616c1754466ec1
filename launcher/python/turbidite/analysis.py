# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the report measures, by name: numbers (docs/analysis.md, the columns of study.csv) and curves."""
from .errors import unknown
from .readers import reader

# Measurements that give more than a number: (module of the report, its function). Lengths in D, times in t_c.
CURVES = {
    'concentration': ('analysis.concentration', 'concentration'),
    'deposit': ('analysis.deposit', 'deposit'),
    'dilatancy': ('analysis.dilatancy', 'dilatancy'),
    'energy_budget': ('analysis.energy', 'budget'),
    'fluid_energy': ('analysis.energy', 'fluid_kinetic'),
    'phases': ('analysis.phases', 'phases'),
    'pore_curve': ('analysis.pores', 'pore_curve'),
    'pore_pressure': ('analysis.pore_pressure', 'probes'),
    'relaxation': ('analysis.relaxation', 'relaxation'),
    'rheology': ('analysis.rheology', 'cells'),
    'shear_band': ('analysis.shear_band', 'shear_band'),
    'snapshots': ('analysis.snapshots', 'snapshots'),
    'surface': ('surface', 'final_surface'),
    'wall_time': ('findings', 'wall_time'),
    'weight_carriers': ('analysis.weight_balance', 'carriers'),
}


class Analysis:
    """`run.analysis.rest_time()`: a float, or None where it cannot be told of this run. `run.analysis.deposit()`: an
    object with arrays, or None. `dir(run.analysis)` lists the names, `help(run.analysis.deposit)` explains one.
    """

    def __init__(self, data):
        self._data = data

    def __dir__(self):
        return ['numbers', *self._names()]

    def __getattr__(self, name):
        if name.startswith('_'):
            raise AttributeError(name)
        if name in CURVES:
            module, function = CURVES[name]
            measure = getattr(reader(module), function)
            return self._bound(name, measure, measure.__doc__)
        for one in reader('measured').MEASURED:
            if one.name == name:
                return self._bound(name, one.measure, f'{one.title} [{one.plain_unit}]')
        raise unknown('measurement', name, self._names())

    def numbers(self):
        """{name: float or None} of all that are numbers; None, and a remark of the run, also where files cannot be read."""
        return {one.name: one.of(self._data) for one in reader('measured').MEASURED}

    @staticmethod
    def _names():
        return sorted([*CURVES, *(one.name for one in reader('measured').MEASURED)])

    def _bound(self, name, measure, text):
        def measurement():
            return measure(self._data)
        measurement.__name__, measurement.__doc__ = name, text
        return measurement
