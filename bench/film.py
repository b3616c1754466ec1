#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Up to which gap the cells of the fluid resolve the film between two spheres: where contact.film has to begin.

    bench/film.py [--cells 8,12] [--shift 0.3] [--offsets 4] [--program turbidite] [--keep DIR]

Two spheres are driven towards each other along y at a Reynolds number of 0.1 in a cyclic box, at random places of the grid.
Prints against the gap, in cells: the force of the fluid on a sphere over the exact one (Brenner, Chem. Eng. Sci. 16 (1961)
242), to which the difference at a gap of three cells is added, since the box is not infinite; mean and worst of the places;
the cut-off g_c with which the film's law, 6 pi eta R*^2 (1/g - 1/g_c) u, adds what is missing; and the force
with the film of --cutoff over the exact one."""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import grain_files
import run_data

BOX = 5          # side of the cyclic box [D]
REYNOLDS = 0.1   # of a sphere's diameter and the speed at which the gap closes
FARTHEST = 5     # gap at the start, which is sudden [cells]
REFERENCE = 3    # gap that the cells resolve [cells]
NEAREST = 0.04   # at the end [cells]
GAPS = (2.5, 2, 1.5, 1.2, 1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05)  # printed [cells]


def exact_drag(gap, terms=4000):
    """F/(6 pi eta R U) of each of two equal spheres that approach at U and -U; `gap` over R (Brenner 1961, Eq. 3.13)."""
    alpha = np.arccosh(1.0 + gap / 2.0)
    n = np.arange(1.0, terms + 1.0)
    n = n[(2 * n + 1) * alpha < 600.0]
    top = 4 * np.cosh((n + 0.5) * alpha) ** 2 + (2 * n + 1) ** 2 * np.sinh(alpha) ** 2
    bottom = 2 * np.sinh((2 * n + 1) * alpha) - (2 * n + 1) * np.sinh(2 * alpha)
    return 4.0 / 3.0 * np.sinh(alpha) * np.sum(n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (top / bottom - 1.0))


def case_text(cells, shift):
    step = 0.02 / cells  # a fiftieth of a cell
    return f'''
dimension: 3
domain: {{size: [{BOX}, {BOX}, {BOX}], left: cyclic, bottom: cyclic, front: cyclic, right: cyclic, top: cyclic, back: cyclic}}
grains: {{adapter: standalone-nscd, file: spheres.csv, density_ratio: 2}}
fluid: {{cells_per_diameter: {cells}, splitting: explicit-multiplier, surface_shift: {shift}}}
scales: {{kind: physical, diameter: 1, gravity: 1e-6, fluid_density: 1, viscosity: {1.0 / REYNOLDS}, velocity: 1}}
time: {{step: {step}, end: {(FARTHEST - NEAREST) / cells}}}
output: {{interval: {step}, fields_interval: 10, slices: none}}
'''


def spheres_text(cells, offset):
    half = 0.5 * (1.0 + FARTHEST / cells)
    x, y, z = 0.5 * BOX + offset / cells
    rows = [f'{i + 1},{x:.9f},{y + side * half:.9f},{z:.9f},{-0.5 * side},driven' for i, side in enumerate((-1, 1))]
    return '\n'.join(['id,x,y,z,vy,motion', *rows]) + '\n'


def play(folder, cells, shift, offset, program):
    """(gap [D], drag of each sphere over 6 pi eta R U) against time."""
    folder.mkdir(parents=True)
    (folder / 'case.yaml').write_text(case_text(cells, shift))
    (folder / 'spheres.csv').write_text(spheres_text(cells, offset))
    done = subprocess.run([program, 'run', folder / 'case.yaml', '--out', folder / 'run'], capture_output=True, text=True,
                          env={'PATH': '/usr/sbin:/usr/bin:/sbin:/bin', 'HOME': str(folder), 'TURBIDITE_REPORT': 'off'})
    if done.returncode:
        sys.exit(f'{folder}: exit code {done.returncode}\n{done.stdout}{done.stderr}')
    run = run_data.load_run(folder / 'run')
    gaps, drags = [], []
    for time, path in grain_files.grain_series(run)[1:]:
        grains = grain_files.read_grains(time, path)
        gaps.append(abs(np.diff(grains.centres[:, 1])[0]) - 1.0 + float(run.case['time.step']))  # where the force acted
        drags.append(0.5 * abs(np.diff(grains.forces[:, 1])[0]))
    return np.array(gaps), np.array(drags) / (3.0 * np.pi / REYNOLDS * 0.5)  # 6 pi eta R U, R = U = 1/2


def measured(options, cells, scratch):
    """For the printed gaps, (places, gaps) arrays: drag over the exact one, and what is missing over 6 pi eta R U."""
    random = np.random.default_rng(1)
    shares, missing = [], []
    for place in range(options.offsets):
        gap, drag = play(scratch / f'{cells}-{place}', cells, options.shift, random.uniform(-0.5, 0.5, 3), options.program)
        found = np.interp(GAPS, (gap * cells)[::-1], drag[::-1])
        box = np.interp(REFERENCE, (gap * cells)[::-1], drag[::-1]) - exact_drag(2.0 * REFERENCE / cells)
        exact = np.array([exact_drag(2.0 * g / cells) for g in GAPS]) + box
        shares.append(found / exact)
        missing.append(exact - found)
    return np.array(shares), np.array(missing)


def cutoffs(missing, cells):
    """g_c [cells] that adds what is missing: of drags F/(6 pi eta R U) the film has R/2 (1/g - 1/g_c)."""
    gaps = np.array(GAPS) / cells
    inverse = 1.0 / gaps - 4.0 * missing
    return np.where(inverse > 0.0, cells / np.where(inverse > 0.0, inverse, 1.0), np.inf)


def film_drag(cells, cutoff):
    """What the film's law adds at the printed gaps, for a cut-off in cells [6 pi eta R U]."""
    return 0.25 * cells * np.maximum(1.0 / np.array(GAPS) - 1.0 / cutoff, 0.0)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--cells', default='8', help='per diameter, separated by commas')
    parser.add_argument('--shift', type=float, default=0.3, help='fluid.surface_shift [cells]')
    parser.add_argument('--cutoff', type=float, default=1.2, help='contact.film_cutoff [cells]')
    parser.add_argument('--offsets', type=int, default=4, help='places of the grid')
    parser.add_argument('--program', default=ROOT / 'build/release/bin/turbidite')
    parser.add_argument('--keep', type=Path, help='keep the runs in this folder')
    return parser.parse_args()


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as temporary:
        scratch = options.keep or Path(temporary)
        for cells in map(int, options.cells.split(',')):
            shares, missing = measured(options, cells, scratch)
            mean = cutoffs(missing.mean(axis=0), cells)
            print(f'\nD/{cells}, shift {options.shift:g}, {options.offsets} places')
            print('| gap [cells] | force over the exact one | worst | missing [6 pi eta R U] | g_c [cells] | with the film |')
            print('|---|---|---|---|---|---|')
            filmed = shares + film_drag(cells, options.cutoff) * (1.0 - shares) / missing
            for k, gap in enumerate(GAPS):
                worst = shares[np.argmax(abs(shares[:, k] - 1.0)), k]
                print(f'| {gap:g} | {shares[:, k].mean():.3f} | {worst:.3f} | {missing[:, k].mean():.3f} | {mean[k]:.2f} | '
                      f'{filmed[:, k].mean():.3f} |')


if __name__ == '__main__':
    main()
