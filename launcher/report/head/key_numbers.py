# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers of a run that one looks for first, from the quantities of docs/analysis.md."""
import measured
from analysis import deposit
from analysis.once import or_remark

OF_HEAPS = ('run_out', 'heap_height', 'heap_slope')
OF_COLLAPSES = ('end_front',)  # in a box full of grains the front is a wall
SHOWN = ('peak_velocity', 'peak_time', 'relaxation_time', 'relaxation_bound', 'rest_time', 'end_front', 'run_out',
         'heap_height', 'heap_slope', 'slip_angle', 'end_height', 'bed_height', 'bed_concentration', 'wall_seconds')


def rows(run):
    """(title, value with its unit) of those that the run tells."""
    by_name = {one.name: one for one in measured.MEASURED}
    left_out = [name for names, there in ((OF_COLLAPSES, run.is_avalanche() and run.front_is_free()), (OF_HEAPS, is_heap(run)))
                if not there for name in names]
    names = [name for name in SHOWN if name not in left_out]
    found = [(one, one.of(run)) for one in (by_name[name] for name in names)]
    return [(one.title, with_unit(one, value) + measured.so_far(one, [run], [value])) for one, value in found
            if value is not None]


def is_heap(run):
    found = or_remark(run, 'Heap', lambda: deposit.deposit(run))
    return found is not None and found.is_heap


def with_unit(one, value):
    unit = {measured.RELATIVE: '', '°': '°'}.get(one.plain_unit, f' {one.plain_unit}')
    return measured.number(value) + unit
