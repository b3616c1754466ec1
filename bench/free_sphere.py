#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sphere that falls freely beside Uhlmann and Dusek (Int. J. Multiphase Flow 59 (2014) 221).

    bench/free_sphere.py RUN...

RUN are folders of runs of configs/validation/oblique-sphere.yaml, in which the liquid streams upwards (docs/spheres-in-liquid.md
has the commands). Prints the means of the speed of the fall and of that across, relative to the stream, over the last 30
t_c, their standard deviations over time, the slope of the path and the spin."""
import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import grain_files
import run_data

LAST = 30.0  # [t_c]
PUBLISHED = {144: (1.2853, 0.0, 0.0), 178: (1.3617, 0.1245, 0.0137)}  # by Galileo number: fall, across [u_c], spin [1/t_c]


def speeds(run):
    """(fall, across) [u_c] in the last outputs."""
    time, x = run.column('mean_velocity_x')
    last = time > time[-1] - LAST
    relative = [values[last] - run.column(flow)[1][-last.sum():] for values, flow in
                ((x, 'flow_x'), (run.column('mean_velocity_y')[1], 'flow_y'), (run.column('mean_velocity_z')[1], 'flow_z'))]
    return -relative[1], np.hypot(relative[0], relative[2])


def spin(run):
    """Mean of |omega| [1/t_c] in the last outputs."""
    series = grain_files.grain_series(run)
    last = [path for time, path in series if time > series[-1][0] - LAST * run.scale('t_c')]
    rates = [np.linalg.norm(grain_files.read_arrays(path)['angular_velocity']) for path in last]
    return float(np.mean(rates)) * run.scale('t_c')


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('runs', nargs='+', type=Path, metavar='RUN')
    print('| Ga | cells | shift | fall [u_c] | across [u_c] | slope [degrees] | spin [1/t_c] |')
    print('|---|---|---|---|---|---|---|')
    for folder in parser.parse_args().runs:
        run = run_data.load_run(folder)
        galileo = 1.0 / float(run.case['scales.viscosity'])
        fall, across = speeds(run)
        known = PUBLISHED.get(int(galileo + 0.01), (np.nan,) * 3)
        error = 100.0 * (fall.mean() / known[0] - 1.0)
        print(f'| {galileo:.0f} | D/{run.case["fluid.cells_per_diameter"]} | {run.case["fluid.surface_shift"]} | '
              f'{fall.mean():.4f} ± {fall.std():.4f} ({error:+.1f} % of {known[0]}) | {across.mean():.4f} ± {across.std():.4f} '
              f'(published {known[1]}) | {np.degrees(np.arctan2(across.mean(), fall.mean())):.1f} | {spin(run):.3f} '
              f'(published {known[2]}) |')


if __name__ == '__main__':
    main()
