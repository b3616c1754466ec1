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
import pandas

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
    """Of a run: solid fraction, V [u_c], spread, and the particle Reynolds number V D/nu."""
    run = turbidite.load(folder)
    history = run.history
    slip = (history['flow_y'] - history['mean_velocity_y'])[history['time'] > history['time'].iloc[-1] / 3]
    parts = [part.mean() for part in np.array_split(slip.to_numpy(), 10)]
    case = run.case
    size = [float(n) for n in case['domain']['size']]
    count = float(history['grains'].iloc[-1])
    return {'run': Path(folder).name, 'phi': count * np.pi / 6 / np.prod(size), 'V': np.mean(parts),
            'spread': np.std(parts) / np.sqrt(len(parts)), 'Re': np.mean(parts) / float(case['scales']['viscosity']),
            'drift': history['flow_y'].iloc[-1]}


def main(folder):
    runs = pandas.DataFrame(measured(path) for path in sorted(Path(folder).iterdir()) if (path / 'history.csv').is_file())
    runs['group'] = runs['run'].str.rsplit('-', n=1).str[0]
    for group, rows in runs.groupby('group'):
        rows = rows.sort_values('phi')
        n, start = np.polyfit(np.log1p(-rows['phi']), np.log(rows['V']), 1)
        alone = np.exp(start)
        reynolds = alone * (rows['Re'] / rows['V']).iloc[0]
        print(rows.to_string(index=False, columns=['run', 'phi', 'V', 'spread', 'Re', 'drift'], float_format='%.4g'))
        print(f'{group}: n = {n:.2f}, k V_t = {alone:.4g} u_c, Re = {reynolds:.3g}; '
              f'Rowe {rowe(reynolds):.2f}, Garside and Al-Dibouni {garside(reynolds):.2f}')


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
