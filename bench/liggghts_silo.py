#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The silo in full flow, LIGGGHTS beside ours from one state (docs/bulk-cases.md, figure liggghts_over_ours_silo).

    bench/liggghts_silo.py RUN@TIME [--seconds 0.05] [--turns 1] [--out FOLDER]    (TIME of an output, in t_c)
    bench/liggghts_silo.py --check          rebounds and a free fall in LIGGGHTS, beside what they should be

RUN is one of configs/silo.yaml; at TIME its gate has to be out of the way. Both codes get the spheres of that output
(places, velocities, spins, radii, densities), the silo without its gate, and restitution and friction by pair of materials.
What is timed is stepping alone, in wall time: LIGGGHTS' loop times, between which it writes the states that overlaps are
taken from; of ours the sum of `wall_step` over all windows. No start-up, no output, no checkpoint in either.

--sides names what is compared, in the order in which it is played: liggghts:E:STEP with Young's modulus of the spheres [Pa]
and the step [s], ours:WINDOW with the window [s]. The figure is the first of LIGGGHTS over the first of ours. Debian's
package liggghts is what runs.
"""
import argparse
import os
import re
import shlex
import statistics
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / 'launcher/report'))

import grain_files
import run_data

# E of M1, 1 GPa, with 1.5 us, the longest of the benchmark's 0.5 to 1.5 us, and with 3.3 us, a fifth of the Rayleigh time,
# which is the usual limit; then a hundredth of that E with the same shares of the Rayleigh time.
SIDES = 'liggghts:1e9:1.5e-6,ours:4e-4,ours:2e-4,liggghts:1e9:3.3e-6,liggghts:1e7:1.5e-5,liggghts:1e7:3.3e-5'
POISSON = 0.2
STEEL_OVER_GRAINS = 210.0  # of Young's moduli
SAMPLED = 1e-3             # s between the states that LIGGGHTS' overlaps are taken from
CORES = 2
QUIET = 0.5                # load at the start above which times are worth nothing
CHECK_TIMES = (2e-3, 0.05, 0.1)  # s: after the rebounds, before and after the sphere begins to roll

# Keys of the run that the comparison sets itself.
OWN_KEYS = ('grains.', 'time.', 'output.', 'checkpoint.', 'domain.walls_file', 'domain.motions.', 'random.', 'coupling.')
MPIRUN = ['mpirun', '--bind-to', 'none', '--mca', 'btl_vader_single_copy_mechanism', 'none']


# --- the state and the silo ---------------------------------------------------------------------------

@dataclass
class State:
    """The spheres of an output; SI units."""

    centres: np.ndarray     # (n, 3)
    velocities: np.ndarray  # (n, 3)
    spins: np.ndarray       # (n, 3)
    radii: np.ndarray
    densities: np.ndarray


@dataclass
class Silo:
    """Its axis is parallel to y; SI units."""

    x: float
    z: float
    lip: float          # y
    joint: float        # y of hopper and cylinder
    orifice: float      # radius
    radius: float       # of the cylinder
    size: tuple         # of the box
    gravity: float
    restitution: dict   # of 'grains' (with each other) and 'steel' (grains with steel)
    friction: dict

    def wall_radius(self, y):
        """Of hopper and cylinder at a height above the lip."""
        return np.interp(y, [self.lip, self.joint], [self.orifice, self.radius])

    def from_axis(self, centres):
        return np.hypot(centres[:, 0] - self.x, centres[:, 2] - self.z)

    def above_lip(self, centres):
        return centres[:, 1] > self.lip

    def outside(self, centres):
        """Number of centres above the lip that are behind a wall."""
        above = centres[self.above_lip(centres)]
        return int((self.from_axis(above) > self.wall_radius(above[:, 1])).sum())


def read_state(path, size):
    """Without those whose centre has left the box, as `turbidite run --from` leaves them out."""
    arrays = grain_files.read_arrays(path)
    triples = [arrays[name].reshape(-1, 3) for name in ('Points', 'velocity', 'angular_velocity')]
    inside = ((triples[0] >= 0.0) & (triples[0] <= size)).all(axis=1)
    return State(*(values[inside] for values in (*triples, arrays['radius'], arrays['density'])))


def silo_of(run):
    d, number = run.scale('D'), lambda key: float(run.case[key])
    cone, tube = (next(wall for wall in grain_files.walls_of(run) if wall['kind'] == kind)
                  for kind in ('cone', 'cylinder'))
    value = {key: number('contact.' + key) for key in ('restitution', 'friction')}
    steel = {key: min(value[key], number(f'contact.materials.{cone["material"]}.{key}')) for key in value}
    lengths = [float(cone['y']), float(cone['y']) + float(cone['ay']), float(cone['r1']), float(tube['r1'])]
    size = [float(v) * d for v in run.case['domain.size'].strip('[]').split(',')]
    return Silo(float(cone['x']) * d, float(cone['z']) * d, *(v * d for v in lengths), tuple(size),
                run.record['g'], *({'grains': value[key], 'steel': steel[key]} for key in value))


def state_at(run, time):
    """(path, seconds since the gate began to move) of the output at a time [t_c]."""
    t_c = run.scale('t_c')
    found = [path for t, path in grain_files.grain_series(run) if abs(t / t_c - time) < 1e-6]
    if not found:
        sys.exit(f'{run.folder} has no output at {time:g} t_c.')
    table = np.array([float(v) for v in run.case['domain.motions.gate.table'].strip('[]').split(',')]).reshape(-1, 4)
    still = table[(table[:, 1:] == 0.0).all(axis=1), 0].max()
    if time < table[-1, 0]:
        sys.exit(f'The gate moves until {table[-1, 0]:g} t_c: give a later time.')
    return found[0], (time - still) * t_c


# --- overlaps -----------------------------------------------------------------------------------------

def deepest_overlap(centres, radii, silo, facets):
    """Of spheres with each other and with the walls [m]; 0 if nothing overlaps."""
    return max(0.0, overlap_of_pairs(centres, radii), overlap_with_walls(centres, radii, silo, facets))


def overlap_of_pairs(centres, radii):
    """By cells as large as the largest sphere: each of a cell's spheres with those of half the cells around."""
    cell = np.floor((centres - centres.min(axis=0)) / (2.0 * radii.max())).astype(np.int64) + 1
    shape = cell.max(axis=0) + 2
    key = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    order = np.argsort(key, kind='stable')
    sorted_keys, deepest = key[order], -np.inf
    steps = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if (i, j, k) >= (0, 0, 0)]
    for i, j, k in steps:
        wanted = key + (i * shape[1] + j) * shape[2] + k
        first, last = (np.searchsorted(sorted_keys, wanted, side) for side in ('left', 'right'))
        for nth in range(int((last - first).max(initial=0))):
            a = np.flatnonzero(first + nth < last)
            b = order[first[a] + nth]
            a, b = a[a != b], b[a != b]
            if len(a):
                gaps = np.linalg.norm(centres[a] - centres[b], axis=1) - radii[a] - radii[b]
                deepest = max(deepest, -gaps.min())
    return deepest


def overlap_with_walls(centres, radii, silo, facets):
    """With the cylinder, and with the hopper of that many facets."""
    away, y = silo.from_axis(centres), centres[:, 1]
    height, run = silo.joint - silo.lip, silo.radius - silo.orifice
    cosine = height / np.hypot(height, run)
    part = 2.0 * np.pi / facets
    angle = np.arctan2(centres[:, 2] - silo.z, centres[:, 0] - silo.x)
    towards = away * np.cos(np.mod(angle + 0.5 * part, part) - 0.5 * part)  # the middle of the nearest facet
    to_hopper = (silo.orifice + (y - silo.lip) * run / height - towards) * cosine
    touches = y - radii * run / np.hypot(height, run)
    hopper = np.where((touches >= silo.lip) & (y < silo.joint), radii - to_hopper, -np.inf)
    tube = np.where(y >= silo.joint, radii + away - silo.radius, -np.inf)
    return max(hopper.max(), tube.max())


# --- LIGGGHTS -----------------------------------------------------------------------------------------

def stl_of_hopper(silo, facets, rings):
    """Facets that touch the cone from outside, so that no sphere overlaps them at the start."""
    angles = (np.arange(facets + 1) + 0.5) * 2.0 * np.pi / facets
    heights = np.linspace(silo.lip, silo.joint, rings + 1)
    radii = silo.wall_radius(heights) / np.cos(np.pi / facets)
    points = np.stack([silo.x + radii[:, None] * np.cos(angles), heights[:, None] + 0.0 * angles,
                       silo.z + radii[:, None] * np.sin(angles)], axis=-1)
    lines = ['solid hopper']
    for i in range(rings):
        for k in range(facets):
            a, b, c, d = points[i, k], points[i, (k + 1) % facets], points[i + 1, (k + 1) % facets], points[i + 1, k]
            lines += facet(a, b, c) + facet(a, c, d)
    return '\n'.join(lines + ['endsolid hopper', ''])


def facet(a, b, c):
    normal = np.cross(b - a, c - a)
    return ['facet normal {:.9g} {:.9g} {:.9g}'.format(*(normal / np.linalg.norm(normal))), 'outer loop',
            *('vertex {:.9g} {:.9g} {:.9g}'.format(*corner) for corner in (a, b, c)), 'endloop', 'endfacet']


def data_file(state, size, types=None):
    """Spheres of these types, of 1 unless given; there is one type more, that of the walls."""
    number = range(1, len(state.radii) + 1)
    rows = lambda table: '\n'.join(' '.join(f'{v:.12g}' for v in row) for row in table)
    types = np.ones(len(state.radii)) if types is None else types
    # LIGGGHTS refuses places beyond its box; ours leaves grains there until no part of them is inside.
    margin = 2.0 * state.radii.max()
    bounds = '\n'.join(f'{-margin:.12g} {length + margin:.12g} {axis}lo {axis}hi' for axis, length in zip('xyz', size))
    atoms = np.column_stack([number, types, 2.0 * state.radii, state.densities, state.centres])
    motion = np.column_stack([number, state.velocities, state.spins])
    return (f'spheres\n\n{len(types)} atoms\n{types.max() + 1:g} atom types\n\n{bounds}\n\n'
            f'Atoms\n\n{rows(atoms)}\n\nVelocities\n\n{rows(motion)}\n')


def head_of_input(silo, modulus, step, skin, ranks):
    """Of spheres and steel. Two ranks meet in the plane through the silo's axis."""
    pairs = lambda of: [of['grains'], of['steel'], of['steel'], of['steel']]
    return head_of([modulus, modulus * STEEL_OVER_GRAINS], pairs(silo.restitution), pairs(silo.friction), silo.gravity, step,
                   skin, ranks)


def head_of(moduli, restitution, friction, gravity, step, skin, ranks):
    """Everything but walls and runs; moduli by type, restitution and friction by pair of types, row after row."""
    words = lambda values: ' '.join(f'{value:g}' for value in values)
    pairs = lambda values: f'{len(moduli)} {words(values)}'
    return f'''hard_particles yes
soft_particles yes
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
processors {ranks} 1 1
read_data state.data
neighbor {skin:g} bin
neigh_modify delay 0
fix young all property/global youngsModulus peratomtype {words(moduli)}
fix poisson all property/global poissonsRatio peratomtype {words(len(moduli) * [POISSON])}
fix restitution all property/global coefficientRestitution peratomtypepair {pairs(restitution)}
fix friction all property/global coefficientFriction peratomtypepair {pairs(friction)}
pair_style gran model hertz tangential history
pair_coeff * *
timestep {step:g}
fix gravity all gravity {gravity:g} vector 0.0 -1.0 0.0
fix motion all nve/sphere
thermo_style custom step atoms ke
thermo 1000000000
thermo_modify lost ignore norm no
'''


def silo_walls(silo):
    return f'''fix hopper all mesh/surface file hopper.stl type 2
fix inhopper all wall/gran model hertz tangential history mesh n_meshes 1 meshes hopper
fix intube all wall/gran model hertz tangential history primitive type 2 ycylinder {silo.radius:g} {silo.x:g} {silo.z:g}
'''


def runs(steps, parts):
    """So many steps in parts, after each of which the state is written, outside LIGGGHTS' clock."""
    ends = [round(k * steps / parts) for k in range(parts + 1)]
    lines = []
    for k, (first, last) in enumerate(zip(ends, ends[1:])):
        lines += [f'run {last - first} pre {"no" if k else "yes"} post no', written(f'state-{k + 1}.txt')]
    return '\n'.join(lines + [''])


def written(name, more=''):
    """All spheres, with more digits than by default."""
    columns = 'id radius x y z' + more
    return f'write_dump all custom {name} {columns} modify format "%d{" %.12g" * columns.count(" ")}"'


def read_dump(path):
    """Columns by name, the spheres in the order of their numbers."""
    lines = path.read_text().splitlines()
    names = lines[8].split()[2:]
    table = np.array([line.split() for line in lines[9:]], dtype=float).reshape(-1, len(names))
    return dict(zip(names, table[np.argsort(table[:, 0])].T))


def place(dump):
    return np.column_stack([dump['x'], dump['y'], dump['z']])


def run_liggghts(folder, text, ranks):
    """The loop times of its runs [s]."""
    (folder / 'in.silo').write_text(text)
    command = [*MPIRUN, '-n', str(ranks), 'liggghts', '-in', 'in.silo', '-log', 'none']
    environment = {**os.environ, 'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1', 'OMP_NUM_THREADS': '1'}
    with open(folder / 'liggghts.log', 'w') as log:
        ended = subprocess.run(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT, env=environment, check=False)
    said = (folder / 'liggghts.log').read_text()
    if ended.returncode or 'ERROR' in said:
        sys.exit(f'LIGGGHTS failed: {folder}/liggghts.log')
    return [float(time) for time in re.findall(r'^Loop time of (\S+) on', said, flags=re.M)]


# --- the sides ----------------------------------------------------------------------------------------

@dataclass
class Side:
    """One column of the table; a turn adds to seconds what it took, and puts down what came out."""

    code: str
    step: float
    modulus: float = 0.0
    seconds: list = field(default_factory=list)  # of wall time
    steps: int = 0
    above: int = 0       # spheres above the lip at the end
    overlap: float = 0.0  # [D]
    outside: int = 0     # spheres behind a wall
    left: str = ''

    def name(self):
        what = f'E {self.modulus / 1e6:g} MPa, steps' if self.modulus else 'windows'
        return f'{"LIGGGHTS" if self.modulus else "ours"}, {what} of {self.step * 1e6:g} us'

    def is_liggghts(self):
        return self.code == 'liggghts'


def sides_of(text):
    sides = []
    for word in text.split(','):
        code, *numbers = word.split(':')
        if (code, len(numbers)) not in (('liggghts', 2), ('ours', 1)):
            sys.exit(f'--sides: "{word}" is neither liggghts:E:STEP nor ours:WINDOW')
        sides.append(Side(code, float(numbers[-1]), float(numbers[0]) if len(numbers) == 2 else 0.0))
    return sides


def rayleigh_time(modulus, radius, density):
    shear = modulus / (2.0 * (1.0 + POISSON))
    return np.pi * radius * np.sqrt(density / shear) / (0.1631 * POISSON + 0.8766)


def play_liggghts(side, options, state, silo, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'state.data').write_text(data_file(state, silo.size))
    (folder / 'hopper.stl').write_text(stl_of_hopper(silo, options.facets, options.rings))
    steps = round(options.seconds / side.step)
    parts = max(1, round(options.seconds / SAMPLED))
    spent = run_liggghts(folder, head_of_input(silo, side.modulus, side.step, options.skin, options.ranks)
                         + silo_walls(silo) + runs(steps, parts), options.ranks)
    if len(spent) != parts:
        sys.exit(f'{len(spent)} loop times for {parts} runs: {folder}/liggghts.log')
    files = [folder / f'state-{k + 1}.txt' for k in range(parts)]
    dumps = [read_dump(file) for file in files]
    for file in files[:-1]:
        file.unlink()
    d = 2.0 * state.radii.max()
    side.steps = steps
    side.seconds.append(sum(spent))
    side.above = int(silo.above_lip(place(dumps[-1])).sum())
    side.overlap = max(deepest_overlap(place(dump), dump['radius'], silo, options.facets) for dump in dumps) / d
    side.outside = max(silo.outside(place(dump)) for dump in dumps)
    side.left = f'{rayleigh_share(side, state):.0%} of the Rayleigh time; overlaps in {parts} states'


def rayleigh_share(side, state):
    return side.step / rayleigh_time(side.modulus, state.radii.min(), state.densities.min())


def kept_settings(run):
    """What the run changed of its case, but for what the comparison sets itself."""
    return [entry for entry in run.record.get('overrides', []) if not entry.startswith(OWN_KEYS)]


def walls_without_gate(run, path):
    rows = [wall for wall in grain_files.walls_of(run) if not wall['motion']]
    lines = [','.join(rows[0])] + [','.join(wall.values()) for wall in rows]
    path.write_text('\n'.join(lines) + '\n')


def play_ours(side, options, run, silo, folder):
    folder.parent.mkdir(parents=True, exist_ok=True)
    walls_file = folder.parent / 'silo.csv'
    walls_without_gate(run, walls_file)
    step, end = (f'{value / run.scale("t_c"):.9g}' for value in (side.step, options.seconds))
    settings = [*kept_settings(run), 'grains.adapter=standalone-nscd', f'grains.ranks={options.ranks}', f'time.step={step}',
                f'time.end={end}', f'output.interval={end}', 'checkpoint.interval=0', 'checkpoint.wall_minutes=0',
                f'domain.walls_file={walls_file}']
    command = [*shlex.split(options.program), 'run', str(ROOT / 'configs/silo.yaml'), '--from', options.state, '--out',
               str(folder), '--force', *(word for setting in settings for word in ('--set', setting))]
    with open(folder.parent / (folder.name + '.log'), 'w') as log:
        ended = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False,
                               env={**os.environ, 'TURBIDITE_REPORT': 'off'})
    if ended.returncode:
        sys.exit(f'Our run failed: {folder}.log')
    played = run_data.load_run(folder)
    side.steps = int(played.record['windows_done'])
    if abs(side.steps * side.step - options.seconds) > 1e-9:
        sys.exit(f'{options.seconds:g} s are no whole number of windows of {side.step:g} s.')
    took_windows = np.diff(played.history['step'])
    side.seconds.append(float((played.history['wall_step'][1:] * took_windows).sum()))
    centres = grain_files.read_arrays(grain_files.grain_series(played)[-1][1])['Points'].reshape(-1, 3)
    side.above, side.outside = int(silo.above_lip(centres).sum()), silo.outside(centres)
    side.overlap = played.record['maxima']['penetration']
    side.left = f'{played.record["contact"]["unconverged_windows"]} windows unconverged; overlaps in every window'


def print_table(options, sides, state, silo):
    above = int(silo.above_lip(state.centres).sum())
    print(f'\n{len(state.radii)} spheres, {above} above the lip at the start; {options.seconds:g} s, '
          f'{options.ranks} ranks, {options.turns} turn(s)\n')
    print('| | steps | wall time [s] | per simulated second [s] | left the silo | above the lip | deepest overlap [D] | '
          'behind a wall | |\n|---|---|---|---|---|---|---|---|---|')
    for side in sides:
        took = statistics.median(side.seconds)
        spread = f' ({min(side.seconds):.3g}–{max(side.seconds):.3g})' if len(side.seconds) > 1 else ''
        print(f'| {side.name()} | {side.steps} | {took:.3g}{spread} | {took / options.seconds:.4g} | {above - side.above} | '
              f'{side.above} | {side.overlap:.2g} | {side.outside} | {side.left} |')
    print()
    ours, others = ([side for side in sides if side.is_liggghts() == theirs] for theirs in (False, True))
    for other in others:
        for mine in ours:
            turns = [a / b for a, b in zip(other.seconds, mine.seconds)]
            figure = 'liggghts_over_ours_silo: ' if (mine, other) == (ours[0], others[0]) else ''
            print(f'{figure}{other.name()}, over {mine.name()}: {statistics.median(turns):.3g}'
                  + (f' ({min(turns):.3g}–{max(turns):.3g})' if len(turns) > 1 else ''))


def compare(options):
    folder, _, time = options.state.rpartition('@')
    run = run_data.load_run(folder)
    if not run.case or not run.record:
        sys.exit(f'{folder} is no run folder.')
    path, since = state_at(run, float(time))
    silo, sides = silo_of(run), sides_of(options.sides)
    state = read_state(path, silo.size)
    load = os.getloadavg()[0]
    print(f'{path}, {since:.3g} s after the gate began to move; load {load:.2f} on {os.cpu_count()} cores')
    if load > QUIET:
        print('Other programs run: ranks wait for each other, so that these times measure nothing.')
    start = deepest_overlap(state.centres, state.radii, silo, options.facets) / (2.0 * state.radii.max())
    print(f'deepest overlap at the start: {start:.2g} D')
    for turn in range(options.turns):
        for k, side in enumerate(sides):
            place_of = Path(options.out).resolve() / f'{k}-{side.code}'
            if side.is_liggghts():
                play_liggghts(side, options, state, silo, place_of)
            else:
                play_ours(side, options, run, silo, place_of)
            print(f'turn {turn + 1}, {side.name()}: {side.seconds[-1]:.3f} s; load {os.getloadavg()[0]:.2f}', flush=True)
    print_table(options, sides, state, silo)


# --- is LIGGGHTS given what the table says? -----------------------------------------------------------

def check(options):
    """A sphere onto a floor of steel, two spheres onto each other, one that falls, one that slides; each on its own."""
    run_folder = Path(options.out).resolve() / 'check'
    run_folder.mkdir(parents=True, exist_ok=True)
    radius, speed, e, mu = 0.002, 0.5, {'grains': 0.5, 'steel': 0.4}, {'grains': 0.3, 'steel': 0.2}
    silo = Silo(0.1, 0.1, 0.0, 0.0, 0.0, 0.0, (0.2, 0.4, 0.2), 9.81, e, mu)
    centres = np.array([[0.02, radius + 1e-6, 0.1], [0.05, 0.2, 0.1], [0.05 + 2 * radius + 1e-6, 0.2, 0.1], [0.1, 0.35, 0.1],
                        [0.14, radius, 0.1]])
    velocities = np.array([[0, -speed, 0], [0.5 * speed, 0, 0], [-0.5 * speed, 0, 0], [0, 0, 0], [speed, 0, 0]])
    state = State(centres, velocities, np.zeros((5, 3)), np.full(5, radius), np.full(5, 2500.0))
    (run_folder / 'state.data').write_text(data_file(state, silo.size))
    floor = 'fix floor all wall/gran model hertz tangential history primitive type 2 yplane 0.0\n'
    for side in (side for side in sides_of(options.sides) if side.is_liggghts()):
        print(side.name())
        ends = [round(time / side.step) for time in CHECK_TIMES]
        run_liggghts(run_folder, head_of_input(silo, side.modulus, side.step, options.skin, 1) + floor + ''.join(
            f'run {last - first} pre {"no" if first else "yes"} post no\n{written(f"at-{last}.txt", " vx vy vz")}\n'
            for first, last in zip([0] + ends, ends)), 1)
        early, middle, late = (read_dump(run_folder / f'at-{end}.txt') for end in ends)
        g, (time, sliding, _) = silo.gravity, (end * side.step for end in ends)
        print_check('restitution on steel', (early['vy'][0] + g * time) / speed, e['steel'])
        print_check('restitution of two spheres', (early['vx'][2] - early['vx'][1]) / speed, e['grains'])
        print_check('y after a fall [mm]', 1e3 * (early['y'][3] - centres[3, 1]), -0.5e3 * g * time**2)
        print_check('friction of steel under a sphere that slides', (speed - middle['vx'][4]) / (g * sliding), mu['steel'])
        print_check('its velocity in the end, over that at first', late['vx'][4] / speed, 5.0 / 7.0)


def print_check(what, found, expected):
    print(f'  {what}: {found:.4f}, expected {expected:.4f}')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('state', nargs='?', metavar='RUN@TIME')
    parser.add_argument('--check', action='store_true')
    parser.add_argument('--seconds', type=float, default=0.05, help='simulated time')
    parser.add_argument('--sides', default=SIDES, help=f'default {SIDES}')
    parser.add_argument('--turns', type=int, default=1, help='how often all sides are played, one after the other')
    parser.add_argument('--ranks', type=int, default=CORES)
    parser.add_argument('--skin', type=float, default=4e-4, help="LIGGGHTS' neighbour skin [m]")
    parser.add_argument('--facets', type=int, default=64, help='around the hopper that LIGGGHTS gets')
    parser.add_argument('--rings', type=int, default=6, help='of them along the hopper')
    parser.add_argument('--program', default=str(ROOT / 'turbidite'), help='what runs our case')
    parser.add_argument('--out', default='runs/liggghts-silo', help='folder of what both write')
    options = parser.parse_args()
    if options.check:
        check(options)
    elif options.state and '@' in options.state:
        compare(options)
    else:
        parser.error('give RUN@TIME or --check')


if __name__ == '__main__':
    main()
