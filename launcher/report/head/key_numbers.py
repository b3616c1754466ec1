# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers of a run that one looks for first, from the quantities of docs/analysis.md."""
import measured

OF_COLLAPSES = ('end_front',)  # in a box full of grains the front is a wall
SHOWN = ('peak_velocity', 'peak_time', 'relaxation_time', 'relaxation_bound', 'rest_time', 'end_front', 'run_out',
         'heap_height', 'heap_slope', 'slip_angle', 'end_height', 'bed_height', 'bed_concentration', 'wall_seconds')


def rows(run):
    """(title, value with its unit) of those that the run tells."""
    by_name = {one.name: one for one in measured.MEASURED}
    names = [name for name in SHOWN if run.is_avalanche() or name not in OF_COLLAPSES]
    found = [(one, one.of(run)) for one in (by_name[name] for name in names)]
    return [(one.title, with_unit(one, value)) for one, value in found if value is not None]


def with_unit(one, value):
    unit = {measured.RELATIVE: '', '°': '°'}.get(one.plain_unit, f' {one.plain_unit}')
    return measured.number(value) + unit
