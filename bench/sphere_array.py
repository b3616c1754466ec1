#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""sphere_array.py RUN...: drag in an array of fixed spheres beside two correlations, at its own Reynolds number.

    bench/sphere_array.py runs/spheres-in-liquid/sphere-array/*

RUN are folders of runs of configs/validation/sphere-array.yaml. F = a V/(N 3 pi nu D U), the force on a sphere with that of
the mean pressure gradient over Stokes's at the superficial velocity U, the mean of flow_x over the last fifth of the run.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'launcher/python'))
import turbidite  # noqa: E402

LAST = 0.2  # of the run


def tang(phi, reynolds):
    """Tang, Peters, Kuipers, Kriebitzsch and van der Hoef 2015, Eq. 21. Theirs is without the mean pressure gradient,
    1 - phi of the whole."""
    e = 1.0 - phi
    slow = 10.0 * phi / e**2 + e**2 * (1.0 + 1.5 * np.sqrt(phi))
    fast = 0.11 * phi * (1.0 + phi) - 0.00456 / e**4 + (0.169 * e + 0.0644 / e**4) * reynolds**-0.343
    return (slow + reynolds * fast) / e


def tenneti(phi, reynolds):
    """Tenneti, Garg and Subramaniam 2011."""
    e = 1.0 - phi
    alone = (1.0 + 0.15 * reynolds**0.687) / e**3
    return alone + 5.81 * phi / e**3 + 0.48 * np.cbrt(phi) / e**4 + phi**3 * reynolds * (0.95 + 0.61 * phi**3 / e**2)


def measured(folder):
    """Of a run: D/h, shift, phi, Re = U D/nu, F, and the change of U over its last fifth."""
    run = turbidite.load(folder)
    flow = np.asarray(run.history['flow_x'])
    last = flow[-max(2, int(LAST * len(flow))):]
    size = [float(length) for length in run.case['domain']['size']]
    spheres = float(run.history['grains'].tolist()[-1])
    fluid, volume = run.case['fluid'], np.prod(size)
    viscosity, a = 1.0 / float(fluid['reynolds']), float(fluid['acceleration'][0])
    force = a * volume / (spheres * 3.0 * np.pi * viscosity * last.mean())
    return (fluid['cells_per_diameter'], fluid['surface_shift'], spheres * np.pi / 6.0 / volume, last.mean() / viscosity,
            force, last[-1] / last[0] - 1.0)


def main(folders):
    print('| cells | shift | phi | Re | F | Tang et al. | Tenneti et al. | drift |\n|---|---|---|---|---|---|---|---|')
    for folder in folders:
        cells, shift, phi, reynolds, force, drift = measured(folder)
        published = [f'{value:.2f} ({100 * (force / value - 1):+.1f} %)' for value in (tang(phi, reynolds), tenneti(phi, reynolds))]
        print(f'| D/{cells} | {shift} | {phi:.3f} | {reynolds:.1f} | {force:.2f} | {published[0]} | {published[1]} | {drift:.0e} |')


if __name__ == '__main__':
    main(sys.argv[1:])
