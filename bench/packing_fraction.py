#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solid fraction of a packing of spheres at the end of a run, away from floor and surface:

    bench/packing_fraction.py RUN

Between 3 D above the floor and 3 D below the mean of the twenty highest centres; spheres are cut exactly.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'launcher/report'))

import grain_files
import run_data
from analysis.concentration import volume_below

BORDER = 3.0  # D
HIGHEST = 20


def fraction(run):
    """(fraction, lower level, upper level [D])"""
    grains = grain_files.read_grains(*grain_files.grain_series(run)[-1])
    height, radius = grains.centres[:, 1] / run.scale('D'), grains.radii / run.scale('D')
    low, high = BORDER, np.sort(height)[-HIGHEST:].mean() - BORDER
    solid = volume_below(height, radius, high).sum() - volume_below(height, radius, low).sum()
    return solid / ((high - low) * run.size()[0] * run.depth()), low, high


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print('%.4f between %.2f and %.2f D' % fraction(run_data.load_run(sys.argv[1])))
