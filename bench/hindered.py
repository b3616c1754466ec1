#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""hindered.py FOLDER: the exponent n of Richardson and Zaki, from the runs of part `hindered-settling` of a study.

    bench/hindered.py runs/spheres-in-liquid/hindered-settling

Runs are named GROUP-COUNT; of each the mean of mean_velocity_y - flow_y over the last two thirds is taken, V. A line is fitted
to log V = log(k V_t) + n log(1 - phi) of a group. `spread` is the standard deviation of V's means over ten equal intervals,
divided by their root: an idea of how far a mean of one run can be trusted.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'launcher/python'))
import turbidite  # noqa: E402


def rowe(reynolds):
    """n of Rowe 1987."""
    power = 0.175 * reynolds ** 0.75
    return 2.35 * (2 + power) / (1 + power)


def garside(reynolds):
    """n of Garside and Al-Dibouni 1977: (5.1 - n)/(n - 2.7) = 0.1 Re^0.9."""
    power = 0.1 * reynolds ** 0.9
    return (5.1 + 2.7 * power) / (1 + power)


def measured(folder):
    """Of a run: its group, solid fraction, V [u_c], spread, particle Reynolds number V D/nu, and the flow at its end."""
    run = turbidite.load(folder)
    time, flow, fall = (np.asarray(run.history[name]) for name in ('time', 'flow_y', 'mean_velocity_y'))
    slip = (flow - fall)[time > time[-1] / 3]
    parts = [part.mean() for part in np.array_split(slip, 10)]
    volume = np.prod([float(length) for length in run.case['domain']['size']])
    phi = float(run.history['grains'].tolist()[-1]) * np.pi / 6 / volume
    speed = np.mean(parts)
    return (Path(folder).name.rsplit('-', 1)[0], phi, speed, np.std(parts) / np.sqrt(len(parts)),
            speed / float(run.case['scales']['viscosity']), flow[-1])


def print_group(group, runs):
    phi, speed, spread, reynolds, drift = np.array(sorted(run[1:] for run in runs)).T
    print('phi      V [u_c]  spread   Re       flow at the end')
    for row in zip(phi, speed, spread, reynolds, drift):
        print('  '.join(f'{value:<7.4g}' for value in row))
    n, start = np.polyfit(np.log1p(-phi), np.log(speed), 1)
    alone = np.exp(start)
    of_alone = alone * reynolds[0] / speed[0]
    print(f'{group}: n = {n:.2f}, k V_t = {alone:.4g} u_c, Re = {of_alone:.3g}; '
          f'Rowe {rowe(of_alone):.2f}, Garside and Al-Dibouni {garside(of_alone):.2f}\n')


def main(folder):
    runs = [measured(path) for path in sorted(Path(folder).iterdir()) if (path / 'history.csv').is_file()]
    for group in sorted({run[0] for run in runs}):
        print_group(group, [run for run in runs if run[0] == group])


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
