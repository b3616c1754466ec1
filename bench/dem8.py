#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark of bulk solids of Dosta et al. (Comput. Phys. Commun. 296 (2024) 109066): our runs beside other codes
(bench/dem8_silo.csv; docs/bulk-cases.md says where the numbers of drum and impact were read), and the grains of the drum.

    bench/dem8.py silo RUN [FROM TO]    of configs/silo.yaml: spheres above the lip since the gate opened, and the flow, ours
                                        and theirs from FROM to TO [s] as well
    bench/dem8.py drum RUN              of configs/drum.yaml: M1 in two quarters of the drum, per 30,000
    bench/dem8.py impact RUN            of configs/impact.yaml: how far the ball has come
    bench/dem8.py drum-grains [SHARE]   prints the grains of a SHARE of the drum's depth (1/5) as CSV: of all of it, 1,
                                        between end walls, of less between cyclic sides
"""
import csv
import random
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'launcher/report'))

import grain_files
import run_data

STEADY = (1.0, 3.0)  # s, between which the published flow is taken

# The drum in D = 2 mm: M1 of radius 0.5 D above M2 of radius 1 D.
DRUM_RADIUS, DRUM_DEPTH, DRUM_AXIS = 50.0, 30.0, 51.0
DRUM_LAYERS = ((8000, 1.0, 2.0, 'M2'), (30000, 0.5, 2.5, 'default'))  # count, radius [D], density, material
DRUM_M1 = DRUM_LAYERS[1][0]
TURN_WIDTH = 0.5    # s
DRUM_LIGGGHTS = ('17000 between 1.4 and 3.4 s, at which it is smallest', '12200 after that')
SPACING = 1.04      # over the diameter, along x and y
UNEVEN = 0.015      # of the diameter, so that it is no lattice

BALL_STARTS = 75.12  # D above the floor, at 5 m/s
IMPACTS = {25: 'deepest -0.139 and -0.138 m at 0.030 s, in the end -0.013 to -0.07 m among eight codes',
           50: 'deepest -0.139 m at 0.044 s, in the end -0.108 and -0.132 m',
           100: 'in the end -0.0909 and -0.0905 m, no rebound'}


def silo(run, between=None):
    lip, opened, published = silo_marks(run)
    ours = [(time - opened, int((grains.centres[:, 1] > lip).sum())) for time, grains in outputs(run)
            if time >= opened - 1e-9]
    rows = {float(row['t_s']): row for row in published_counts()}
    print(f'{"t [s]":>6} {"ours":>8} {"LIGGGHTS":>9} {"MUSEN":>8}   spheres above the lip since the gate opened')
    for time, count in ours:
        row = rows.get(round(time, 3), {})
        print(f'{time:6.2f} {count:8d} {row.get(published + "_liggghts", ""):>9} {row.get(published + "_musen", ""):>8}')
    print('\nflow [1000/s] in each interval: ' + ' '.join(
        f'{(n - m) / (t - s) / -1000:.1f}' for (s, m), (t, n) in zip(ours, ours[1:])))
    counts = {'ours': dict((round(time, 6), count) for time, count in ours)}
    for code in ('liggghts', 'musen'):
        counts[code] = {time: int(row[f'{published}_{code}']) for time, row in rows.items() if row.get(f'{published}_{code}')}
    for name, of_code in counts.items():
        for first, last in ([between] if between else []) + [STEADY]:
            times = [min(of_code, key=lambda time: abs(time - wanted)) for wanted in (first, last)] if of_code else []
            if not times or any(abs(time - wanted) > 0.026 for time, wanted in zip(times, (first, last))):
                continue  # not counted so far, or not at all
            flow = (of_code[times[0]] - of_code[times[1]]) / (times[1] - times[0]) / 1000
            print(f'{name}, {times[0]:.3g} to {times[1]:.3g} s: {flow:.2f}')


def silo_marks(run):
    """(y of the lip [m], time at which the gate begins to move [s], name of the orifice in the published counts)."""
    gate = next(wall for wall in grain_files.walls_of(run) if wall['motion'] == 'gate')
    table = np.array([float(v) for v in run.case['domain.motions.gate.table'].strip('[]').split(',')]).reshape(-1, 4)
    still = table[(table[:, 1:] == 0.0).all(axis=1), 0].max()
    radius = float(gate['r2']) * run.scale('D')
    return float(gate['y']) * run.scale('D'), still * run.scale('t_c'), 'large' if radius > 0.025 else 'small'


def published_counts():
    with open(ROOT / 'bench/dem8_silo.csv', newline='') as file:
        return list(csv.DictReader(line for line in file if not line.startswith('#')))


def outputs(run):
    """(time [s], grains) of every output."""
    for time, path in grain_files.grain_series(run):
        yield time, grain_files.read_grains(time, path)


def drum(run):
    print_quarters([(time, grains.centres, grains.radii) for time, grains in outputs(run)], run.scale('D'))


def print_quarters(states, d):
    """M1 in two quarters of the drum, of [(time [s], centres [m], radii [m])]."""
    rows = []
    print(f'{"t [s]":>6} {"right above":>12} {"left below":>11}   M1 in these quarters of the drum, per {DRUM_M1}')
    for time, centres, radii in states:
        x, y = (centres[:, k] - DRUM_AXIS * d for k in (0, 1))
        small = is_m1(radii, d)
        quarters = [DRUM_M1 * (small & side).sum() / small.sum() for side in ((x > 0) & (y > 0), (x < 0) & (y < 0))]
        rows.append((time, quarters[1]))
        print(f'{time:6.2f} {quarters[0]:12.0f} {quarters[1]:11.0f}')
    print('\nleft below, turns: ' + ', '.join(f'{count:.0f} at {time:.2f} s' for time, count in turns(rows)))
    print('LIGGGHTS:          ' + ', '.join(DRUM_LIGGGHTS))


def is_m1(radii, d):
    return radii < 0.75 * d


def turns(rows):
    """Of [(time, count)], those that are the largest or smallest within TURN_WIDTH on either side."""
    found = []
    for time, count in rows[1:-1]:
        near = [c for t, c in rows if abs(t - time) <= TURN_WIDTH]
        if count in (min(near), max(near)) and rows[0][0] + TURN_WIDTH <= time <= rows[-1][0] - TURN_WIDTH:
            found.append((time, count))
    return found


def impact(run):
    """The ball's displacement from where the benchmark's ball begins, 0.1502 m above the floor."""
    rows = []
    for time, grains in outputs(run):
        ball = int(grains.radii.argmax())
        rows.append((time, grains.centres[ball, 1] - BALL_STARTS * run.scale('D')))
    for time, way in rows[::max(1, len(rows) // 20)]:
        print(f'{time:7.4f} s {way:8.4f} m')
    time, deepest = min(rows, key=lambda row: row[1])
    print(f'\ndeepest {deepest:.4f} m at {time:.4f} s, in the end {rows[-1][1]:.4f} m at {rows[-1][0]:.4f} s')
    thousands = round(len(grains.radii) / 1000)
    if thousands in IMPACTS:
        print(f'LIGGGHTS and MUSEN, {thousands},000 spheres: {IMPACTS[thousands]}')


def drum_grains(share):
    """Rows from below, M2 first; no grain reaches into another one, the drum or, where the share is 1, its end walls."""
    numbers, depth = random.Random(1), share * DRUM_DEPTH
    grains, level = [], DRUM_AXIS - DRUM_RADIUS
    for count, radius, density, material in DRUM_LAYERS:
        left, spacing, row = round(share * count), 2.0 * radius * SPACING, 0
        while left > 0:
            y = level + (row + 0.5) * spacing
            half = np.sqrt(max(0.0, (DRUM_RADIUS - radius * SPACING)**2 - (abs(y - DRUM_AXIS) + 0.5 * spacing)**2))
            across, places = int(2.0 * half / spacing), along_axis(radius, depth, row, share == 1.0)
            if y > DRUM_AXIS and across == 0:
                raise ValueError(f'the drum is full, and {left} spheres of {material} are left')
            for i in range(across):
                for z in places[:left]:
                    shift = [UNEVEN * radius * numbers.uniform(-1, 1) for _ in range(3)]
                    grains.append((DRUM_AXIS + (i + 0.5 - 0.5 * across) * spacing + shift[0], y + shift[1], z, radius,
                                   density, material))
                left -= min(len(places), left)
            row += 1
        level += row * spacing
    return grains


def along_axis(radius, depth, row, walls_at_ends):
    """Places of the centres of a row; every second row lies between those of the one below."""
    count = int(depth / (2.0 * radius))
    if count == 0:
        raise ValueError(f'a depth of {depth:g} D has no room for spheres of radius {radius:g} D')
    if row % 2 == 0:
        return [(k + 0.5) * depth / count for k in range(count)]
    # Between cyclic sides the last place is on both of them.
    return [(k + 1.0) % count * depth / count for k in range(count - 1 if walls_at_ends else count)]


def print_grains(share):
    grains = drum_grains(share)
    print('id,x,y,z,radius,density,material')
    for number, (x, y, z, radius, density, material) in enumerate(grains):
        print(f'{number},{x:.3f},{y:.3f},{z:.3f},{radius:g},{density:g},{material}')


def main(words):
    if words[:1] == ['silo'] and len(words) in (2, 4):
        silo(run_data.load_run(words[1]), tuple(float(word) for word in words[2:]) or None)
    elif words[:1] == ['drum'] and len(words) == 2:
        drum(run_data.load_run(words[1]))
    elif words[:1] == ['impact'] and len(words) == 2:
        impact(run_data.load_run(words[1]))
    elif words and words[0] == 'drum-grains' and len(words) <= 2:
        try:
            print_grains(float(words[1]) if len(words) == 2 else 0.2)
        except ValueError as error:
            sys.exit(f'drum-grains: {error}')
    else:
        sys.exit(__doc__)


if __name__ == '__main__':
    main(sys.argv[1:])
