#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""column_in_liquid.py RUN...: what the tables of a column in a liquid hold (docs/spheres-in-liquid.md), at chosen times.

    bench/column_in_liquid.py runs/column-spheres runs/column-spheres-dense [--times 0.5 1 2 4 10]

speed: |<u>| of the grains [u_c]. front: the foremost grain's edge [D]. pores: pore volume over that at the start. base: pore
pressure at the base [rho_f u_c^2], the mean over 0 < x < 12 D in the lowest half D of the middle plane, cells that grains
cover left out, less that of the liquid at the same height beyond x = 50 D. A single output scatters by some tenths, so from
4 t_c on base is the mean of the outputs within 1 t_c.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'launcher/python'))
import turbidite  # noqa: E402

UNDER_COLUMN, BEYOND, HEIGHT = 12.0, 50.0, 0.5  # D
TIMES = (0.5, 1, 2, 4, 6, 8, 10, 12, 16, 20, 24, 28, 32, 36, 40)  # t_c
SCATTERS_FROM, WITHIN = 4.0, 1.0  # t_c


def base_pressure(field):
    """Of one output of the middle plane [rho_f u_c^2]."""
    low, liquid = field.y < HEIGHT, field['covered'] == 0
    pressure = np.where(liquid, field['p'], np.nan)[low]
    return np.nanmean(pressure[:, field.x < UNDER_COLUMN]) - np.nanmean(pressure[:, field.x > BEYOND])


def base_pressures(run, times):
    plane = run.slices[0]
    of_plane = np.asarray(plane.times)

    def around(time):
        within = WITHIN if time >= SCATTERS_FROM else 0.0
        outputs = np.flatnonzero(np.abs(of_plane - time) < within + 1e-6)
        return np.mean([base_pressure(plane[number]) for number in outputs])
    return [around(time) for time in times]


def print_run(folder, times):
    run = turbidite.load(folder)
    times = [time for time in times if time <= run.column('time')[0][-1] + 1e-6]

    def at(name):
        return np.interp(times, *run.column(name))
    rows = {'t [t_c]': times, 'speed': at('mean_velocity_norm'), 'front': at('front_x'),
            'pores': at('pore_volume') / run.column('pore_volume')[1][0], 'base': base_pressures(run, times)}
    print(folder)
    for name, values in rows.items():
        print(f'  {name:8}' + ''.join(f'{value:8.3g}' if name == 't [t_c]' else f'{value:8.3f}' for value in values))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('runs', nargs='+', metavar='RUN')
    parser.add_argument('--times', nargs='+', type=float, default=TIMES, help='t_c; those that a run has not reached are left out')
    options = parser.parse_args()
    for folder in options.runs:
        print_run(folder, options.times)


if __name__ == '__main__':
    main()
