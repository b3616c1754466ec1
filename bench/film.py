#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Up to which gap the cells of the fluid resolve the film between two spheres or discs: where contact.film has to begin.

    bench/film.py [--cells 8,12] [--shift 0.3] [--plane] [--offsets 4] [--program turbidite] [--keep DIR]

Two spheres (--plane: discs) are driven towards each other along y at a Reynolds number of 0.1 in a cyclic box, at random
places of the grid. Prints against the gap, in cells: the force of the fluid on each over the exact one (spheres: Brenner, Chem.
Eng. Sci. 16 (1961) 242; discs: below), to which the difference at a gap of three cells is added, since the box is not infinite;
mean and worst of the places; the cut-off g_c with which the film's law, 6 pi eta R*^2 (1/g - 1/g_c) u, of discs 3 sqrt(2) pi eta
R*^1.5 (g^-1.5 - g_c^-1.5) u, adds what is missing; and the force with the film of --cutoff over the exact one."""
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

BOX = {3: 5, 2: 10}  # side of the cyclic box [D]
REYNOLDS = 0.1   # of a sphere's diameter and the speed at which the gap closes
FARTHEST = 5     # gap at the start, which is sudden [cells]
REFERENCE = 3    # gap that the cells resolve [cells]
NEAREST = 0.04   # at the end [cells]
GAPS = (2.5, 2, 1.5, 1.2, 1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05)  # printed [cells]


def exact_drag_of_disc(gap):
    """F/(eta U) per depth of each of two equal discs that approach at U and -U; `gap` over R. In bipolar coordinates (xi, zeta)
    with the discs at xi = +-alpha, the stream function of Jeffery (Proc. R. Soc. A 101 (1922) 169), h psi = (C sinh 2 xi + D xi)
    sin zeta, has both components of the velocity on them if C sinh 2 alpha + D alpha = U and 2 C cosh 2 alpha + D = 0; the
    force is 4 pi eta |D|. For small gaps it is 3 pi eta U (R/gap)^1.5, that of lubrication."""
    alpha = np.arccosh(1.0 + gap / 2.0)
    return 8.0 * np.pi / (2.0 * alpha - np.tanh(2.0 * alpha))


def exact_drag_of_sphere(gap, terms=4000):
    """F/(6 pi eta R U) of each of two equal spheres that approach at U and -U; `gap` over R (Brenner 1961, Eq. 3.13)."""
    alpha = np.arccosh(1.0 + gap / 2.0)
    n = np.arange(1.0, terms + 1.0)
    n = n[(2 * n + 1) * alpha < 600.0]
    top = 4 * np.cosh((n + 0.5) * alpha) ** 2 + (2 * n + 1) ** 2 * np.sinh(alpha) ** 2
    bottom = 2 * np.sinh((2 * n + 1) * alpha) - (2 * n + 1) * np.sinh(2 * alpha)
    return 4.0 / 3.0 * np.sinh(alpha) * np.sum(n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (top / bottom - 1.0))


def exact_drag(dimension, gap):
    return exact_drag_of_sphere(gap) if dimension == 3 else exact_drag_of_disc(gap)


def case_text(dimension, cells, shift):
    step = 0.02 / cells  # a fiftieth of a cell
    space = dimension == 3
    sides = ['left', 'right', 'bottom', 'top'] + ['front', 'back'] * space
    return f'''
dimension: {dimension}
domain: {{size: {[BOX[dimension]] * dimension}, {', '.join(f'{side}: cyclic' for side in sides)}}}
grains: {{adapter: standalone-nscd, file: grains.csv, density_ratio: 2}}
fluid: {{cells_per_diameter: {cells}, splitting: explicit-multiplier{f', surface_shift: {shift}' * space}}}
scales: {{kind: physical, diameter: 1, gravity: 1e-6, fluid_density: 1, viscosity: {1.0 / REYNOLDS}, velocity: 1}}
time: {{step: {step}, end: {(FARTHEST - NEAREST) / cells}}}
output: {{interval: {step}, fields_interval: 10{', slices: none' * space}}}
'''


def grains_text(dimension, cells, offset):
    place = 0.5 * BOX[dimension] + offset / cells
    half = np.zeros(dimension)
    half[1] = 0.5 * (1.0 + FARTHEST / cells)
    rows = [[i + 1, *np.round(place + side * half, 9), -0.5 * side, 'driven'] for i, side in enumerate((-1, 1))]
    columns = ['id', *'xyz'[:dimension], 'vy', 'motion']
    return '\n'.join(','.join(map(str, row)) for row in [columns, *rows]) + '\n'


def unit_of_drag(dimension):
    """Of a sphere 6 pi eta R U, of a disc eta U; R = U = 1/2."""
    return (3.0 * np.pi if dimension == 3 else 1.0) / REYNOLDS * 0.5


def play(folder, options, cells, offset):
    """(gap [D], drag of each grain over unit_of_drag) against time."""
    folder.mkdir(parents=True)
    dimension = len(offset)
    (folder / 'case.yaml').write_text(case_text(dimension, cells, options.shift))
    (folder / 'grains.csv').write_text(grains_text(dimension, cells, offset))
    done = subprocess.run([options.program, 'run', folder / 'case.yaml', '--out', folder / 'run'], capture_output=True, text=True,
                          env={'PATH': '/usr/sbin:/usr/bin:/sbin:/bin', 'HOME': str(folder), 'TURBIDITE_REPORT': 'off'})
    if done.returncode:
        sys.exit(f'{folder}: exit code {done.returncode}\n{done.stdout}{done.stderr}')
    run = run_data.load_run(folder / 'run')
    gaps, drags = [], []
    for time, path in grain_files.grain_series(run)[1:]:
        grains = grain_files.read_grains(time, path)
        gaps.append(abs(np.diff(grains.centres[:, 1])[0]) - 1.0 + float(run.case['time.step']))  # where the force acted
        drags.append(0.5 * abs(np.diff(grains.forces[:, 1])[0]))
    return np.array(gaps), np.array(drags) / unit_of_drag(dimension)


def measured(options, cells, scratch):
    """For the printed gaps, (places, gaps) arrays: drag over the exact one, and what is missing over unit_of_drag."""
    dimension = 2 if options.plane else 3
    random = np.random.default_rng(1)
    shares, missing = [], []
    for place in range(options.offsets):
        gap, drag = play(scratch / f'{cells}-{place}', options, cells, random.uniform(-0.5, 0.5, dimension))
        found = np.interp(GAPS, (gap * cells)[::-1], drag[::-1])
        box = np.interp(REFERENCE, (gap * cells)[::-1], drag[::-1]) - exact_drag(dimension, 2.0 * REFERENCE / cells)
        exact = np.array([exact_drag(dimension, 2.0 * g / cells) for g in GAPS]) + box
        shares.append(found / exact)
        missing.append(exact - found)
    return np.array(shares), np.array(missing)


def film_law(plane):
    """(power, factor): a film adds factor (g^-power - g_c^-power) to a grain's drag over unit_of_drag, gaps in D."""
    # 6 pi eta R*^2 2 U over 6 pi eta R U, and 3 sqrt(2) pi eta R*^1.5 2 U over eta U; R* = R/2 = D/4.
    return (1.5, 6.0 * np.sqrt(2.0) * np.pi * 0.25 ** 1.5) if plane else (1.0, 0.25)


def cutoffs(missing, cells, plane):
    """g_c [cells] that adds what is missing."""
    power, factor = film_law(plane)
    left = (np.array(GAPS) / cells) ** -power - missing / factor
    return np.where(left > 0.0, cells * np.where(left > 0.0, left, 1.0) ** (-1.0 / power), np.inf)


def film_drag(cells, cutoff, plane):
    """What the film's law adds at the printed gaps, for a cut-off in cells."""
    power, factor = film_law(plane)
    return factor * cells ** power * np.maximum(np.array(GAPS) ** -power - cutoff ** -power, 0.0)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--cells', default='8', help='per diameter, separated by commas')
    parser.add_argument('--shift', type=float, default=0.3, help='fluid.surface_shift of spheres [cells]')
    parser.add_argument('--plane', action='store_true', help='discs; the unit of what is missing is then eta U')
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
            mean = cutoffs(missing.mean(axis=0), cells, options.plane)
            kind = 'discs' if options.plane else f'shift {options.shift:g}'
            unit = 'eta U' if options.plane else '6 pi eta R U'
            print(f'\nD/{cells}, {kind}, {options.offsets} places')
            print(f'| gap [cells] | force over the exact one | worst | missing [{unit}] | g_c [cells] | with the film |')
            print('|---|---|---|---|---|---|')
            filmed = shares + film_drag(cells, options.cutoff, options.plane) * (1.0 - shares) / missing
            for k, gap in enumerate(GAPS):
                worst = shares[np.argmax(abs(shares[:, k] - 1.0)), k]
                print(f'| {gap:g} | {shares[:, k].mean():.3f} | {worst:.3f} | {missing[:, k].mean():.3f} | {mean[k]:.2f} | '
                      f'{filmed[:, k].mean():.3f} |')


if __name__ == '__main__':
    main()
