#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a sphere rebounds from the floor of a box with liquid, beside Gondret, Lance and Petit (Phys. Fluids 14 (2002) 643).

    bench/rebound.py RUN...

RUN are folders of runs of configs/validation/rebound.yaml (docs/spheres-in-liquid.md has the commands). U is the largest speed downwards before the first
contact, e the speed a tenth of a t_c after it over U (in between the liquid that came down with the sphere gives back its
momentum), St = (rho_s/rho_f) U D/(9 nu); beside e/e_dry stands exp(-35/St), a curve through measurements (Legendre, Daniel
and Guiraud, Phys. Fluids 17 (2005) 097105)."""
import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import run_data

AFTER = 0.1  # [t_c]


def rebound(run):
    """(St, e/e_dry, smallest gap [D])."""
    time, speed = run.column('mean_velocity_y')
    gap = run.column('mean_position_y')[1] - 0.5
    fall = -speed.min()
    up = np.flatnonzero(speed > 0.0)
    after = np.interp(time[up[0]] + AFTER, time, speed) if len(up) else 0.0
    stokes = float(run.case['grains.density_ratio']) * fall / (9.0 * float(run.case['scales.viscosity']))
    return stokes, max(after, 0.0) / fall / float(run.case['contact.restitution']), gap.min()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('runs', nargs='+', type=Path, metavar='RUN')
    print('| run | film | St | e/e_dry | exp(-35/St) | smallest gap [D] |')
    print('|---|---|---|---|---|---|')
    for folder in parser.parse_args().runs:
        run = run_data.load_run(folder)
        stokes, share, gap = rebound(run)
        print(f'| {folder.name} | {run.case["contact.film"]} | {stokes:.1f} | {share:.3f} | {np.exp(-35.0 / stokes):.3f} | {gap:.2e} |')


if __name__ == '__main__':
    main()
