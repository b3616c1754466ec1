#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark's drum in LIGGGHTS, from the state in which ours begins (docs/bulk-cases.md).

    bench/liggghts_drum.py RUN [--seconds 2] [--modulus 1e7] [--step 1.5e-5] [--ranks 2] [--out FOLDER]

RUN is the run in which the spheres have come to rest in the drum at rest; its last output is the state. Both codes have the
same spheres, the drum with its end walls, which turn, and restitution and friction by pair of materials. Printed is what
`bench/dem8.py drum` prints of ours. The drum is a mesh of facets that touch the cylinder from outside; Debian's package
liggghts is what runs.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'bench'))

import dem8
import grain_files
import liggghts_silo as liggghts
import run_data

MATERIALS = ('default', 'M2', 'steel')  # of M1, M2 and the drum
FACETS = 128
SPIN = 2.0      # rad/s, counter-clockwise about z
SAMPLED = 0.05  # s, about: in equal parts of the simulated time


def stl_of_drum(axis, radius, depth):
    angles = np.arange(FACETS + 1) * 2.0 * np.pi / FACETS
    rim = radius / np.cos(np.pi / FACETS) * np.column_stack([np.cos(angles), np.sin(angles)]) + axis
    lines = ['solid drum']
    for first, second in zip(rim, rim[1:]):
        a, b = (np.array([*first, z]) for z in (0.0, depth))
        c, d = (np.array([*second, z]) for z in (0.0, depth))
        lines += liggghts.facet(a, c, b) + liggghts.facet(c, d, b)
        for p, q, z in ((a, c, 0.0), (b, d, depth)):
            lines += liggghts.facet(np.array([axis, axis, z]), p, q)
    return '\n'.join(lines + ['endsolid drum', ''])


def coefficients(case, name):
    """Of each material with each, row by row: that of the pair, or the smaller one of the two."""
    own = [float(case.get(f'contact.materials.{material}.{name}', case[f'contact.{name}'])) for material in MATERIALS]

    def of_pair(i, j):
        given = [case.get(f'contact.pairs.{MATERIALS[a]}-{MATERIALS[b]}.{name}') for a, b in ((i, j), (j, i))]
        return next((float(value) for value in given if value), min(own[i], own[j]))
    return tuple(of_pair(i, j) for i in range(len(own)) for j in range(len(own)))


def input_of(options, run, axis):
    restitution, friction = (coefficients(run.case, name) for name in ('restitution', 'friction'))
    moduli = [options.modulus, options.modulus, options.modulus * liggghts.STEEL_OVER_GRAINS]
    return liggghts.head_of(moduli, restitution, friction, run.record['g'], options.step, options.skin, options.ranks) + f'''\
fix drum all mesh/surface file drum.stl type 3
fix walls all wall/gran model hertz tangential history mesh n_meshes 1 meshes drum
fix turning all move/mesh mesh drum rotate origin {axis:g} {axis:g} 0.0 axis 0.0 0.0 1.0 period {2.0 * np.pi / SPIN:.9g}
''' + liggghts.runs(round(options.seconds / options.step), max(1, round(options.seconds / SAMPLED)))


def times_of(count, seconds):
    """Of so many states, written at equal parts of the simulated time [s]."""
    return [seconds * (k + 1) / count for k in range(count)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('run', metavar='RUN')
    parser.add_argument('--seconds', type=float, default=2.0, help='simulated time')
    parser.add_argument('--modulus', type=float, default=1e7, help="Young's modulus of the spheres [Pa]")
    parser.add_argument('--step', type=float, default=1.5e-5, help='[s]')
    parser.add_argument('--ranks', type=int, default=2)
    parser.add_argument('--skin', type=float, default=2e-4, help="LIGGGHTS' neighbour skin [m]")
    parser.add_argument('--out', default='runs/liggghts-drum', help='folder of what is written')
    options = parser.parse_args()
    run = run_data.load_run(options.run)
    d, folder = run.scale('D'), Path(options.out)
    folder.mkdir(parents=True, exist_ok=True)
    size = [float(v) * d for v in run.case['domain.size'].strip('[]').split(',')]
    state = liggghts.read_state(grain_files.grain_series(run)[-1][1], size)
    small, axis = dem8.is_m1(state.radii, d), dem8.DRUM_AXIS * d
    (folder / 'state.data').write_text(liggghts.data_file(state, size, np.where(small, 1, 2)))
    (folder / 'drum.stl').write_text(stl_of_drum(axis, dem8.DRUM_RADIUS * d, dem8.DRUM_DEPTH * d))
    seconds = liggghts.run_liggghts(folder, input_of(options, run, axis), options.ranks)
    dumps = [liggghts.read_dump(folder / f'state-{k + 1}.txt') for k in range(len(seconds))]
    dem8.print_quarters([(0.0, state.centres, state.radii)] + [
        (time, liggghts.place(dump), dump['radius'])
        for time, dump in zip(times_of(len(dumps), options.seconds), dumps)], d)
    print(f'{sum(seconds):.4g} s of wall time, {len(dumps[-1]["radius"])} of {len(small)} spheres in the drum')


if __name__ == '__main__':
    main()
