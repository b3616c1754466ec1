#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which pores count: dV/V0 of a column, as `pore_volume` of history.csv, for other limits of the circumradius.

    bench/pore_limit.py RUN... [--limits 0.75,0.8,1,1.5] [--at 0.02,0.05,0.1,0.2,0.3]

Pores are those of the Delaunay triangles of the centres up to a circumradius [D]: history.csv takes 1. Prints, for each
avalanche and limit, the change at displacements dx/x0 of the centre of gravity, between the outputs of the grains."""
import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import run_data
from analysis import packing_triangles, snapshots


def arguments():
    numbers = lambda text: [float(number) for number in text.split(',')]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('runs', nargs='+', type=Path, metavar='RUN')
    parser.add_argument('--limits', type=numbers, default=[0.75, 0.8, 1.0, 1.5], help='largest circumradii [D]')
    parser.add_argument('--at', type=numbers, default=[0.02, 0.05, 0.1, 0.2, 0.3], help='displacements dx/x0')
    return parser.parse_args()


def changes(outputs, limit, displacements):
    """dV/V0 at these displacements; nan beyond the last output."""
    places = np.maximum.accumulate([output.centres[:, 0].mean() for output in outputs])
    pores = np.array([packing_triangles.triangles(output, limit).pores().sum() for output in outputs])
    return np.interp(displacements, places / places[0] - 1.0, pores / pores[0] - 1.0, right=np.nan)


def main():
    options = arguments()
    print('| run | limit [D] | ' + ' | '.join(f'{at:g}' for at in options.at) + ' |')
    print('|' + '---|' * (2 + len(options.at)))
    for folder in options.runs:
        outputs = snapshots.snapshots(run_data.load_run(folder))
        if len(outputs) < 2:
            sys.exit(f'{folder}: fewer than two outputs of grains')
        for limit in options.limits:
            cells = [f'{change:+.3f}' if np.isfinite(change) else '–' for change in changes(outputs, limit, options.at)]
            print(f'| {folder.name} | {limit:g} | ' + ' | '.join(cells) + ' |')


if __name__ == '__main__':
    main()
