#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests that a change leaves every digit of the results unchanged: runs reference cases and compares them.

    bench/same_histories.py record FOLDER [--program turbidite] [--only NAME]...
    bench/same_histories.py compare BEFORE AFTER

`record` plays the runs that are not yet in FOLDER, with the given program (that of another checkout, to record its
histories); `--only` takes names of runs, `short` (all but the first eight, a minute on two cores) or `long` (those,
four minutes). `compare` requires every column of history.csv except the wall times (wall_*) to have identical text, as
well as every file of grains, contacts and probes; it prints where each run first differs, and exits with 1.
Columns that only one side has are named; the values of the others are still compared."""
import argparse
import csv
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# The default recovery before the case had its own, so that older programs can be compared.
SEDIMENTATION = ['fluid.cells_per_diameter=8', 'time.end=5', 'output.interval=0.1',
                 'contact.recovery_fraction=0.2']
COLUMN = ['time.end=5', 'output.interval=0.1']

# name: (case, keys)
LONG = {
    'quickstart-joint': ('configs/quickstart', ['coupling.scheme=joint', 'output.interval=0.25']),
    'quickstart-split': ('configs/quickstart', ['coupling.scheme=split', 'output.interval=0.25']),
    'sedimentation-1-rank': ('configs/sedimentation-discs', SEDIMENTATION),
    'sedimentation-2-ranks': ('configs/sedimentation-discs', SEDIMENTATION + ['fluid.ranks=2']),
    'column-yade': ('configs/avalanche-dry', COLUMN + ['grains.adapter=yade-nscd']),
    'column-standalone': ('configs/avalanche-dry', COLUMN + ['grains.adapter=standalone-nscd']),
    'triangles': ('configs/triangles-dry', ['time.end=14', 'output.interval=0.1']),
    'yade-md': ('configs/quickstart', ['grains.adapter=yade-md', 'coupling.scheme=split', 'time.end=30',
                                       'output.interval=0.25']),
}

FIRST_ORDER = ['fluid.time_scheme=first-order', 'fluid.transport_scheme=Gauss limitedLinearV 1']
EXPLICIT = ['fluid.splitting=explicit-multiplier']
IMPLICIT = ['fluid.splitting=implicit-multiplier']
YADE, YADE_MD = ['grains.adapter=yade-nscd'], ['grains.adapter=yade-md']
MD, LAMMPS = ['grains.adapter=standalone-md'], ['grains.adapter=lammps-md']
SUB_ITERATED = ['coupling.scheme=sub-iterated']
TRIANGLES = ['grains.shape=triangle', 'grains.radius=0.5', 'grains.generator=random', 'grains.count=18',
             'grains.region=[6,5]', 'grains.density_ratio=4', 'time.end=3']
TWO_RANKS, DRY = ['fluid.ranks=2'], ['fluid.enabled=false']


def case(name, **runs):
    return {f'{name}-{run.replace("_", "-")}': (f'bench/histories/{name}', keys) for run, keys in runs.items()}


SHORT = {
    # The splittings, in both orders and with every decomposition.
    **case('heap', joint=[], first_order=FIRST_ORDER, yade=YADE, split=['coupling.scheme=split'], two_ranks=TWO_RANKS,
           columns=TWO_RANKS + ['fluid.decomposition=columns'], interior=['fluid.points=interior'],
           stretched=['fluid.stretch_ratio=1.1', 'fluid.stretch_from=4.6'], own_solvers=['fluid.pressure_solver=PCG'],
           hydrodynamic_radius=['fluid.hydrodynamic_radius=0.9'],
           explicit=EXPLICIT, explicit_first_order=EXPLICIT + FIRST_ORDER, explicit_two_ranks=EXPLICIT + TWO_RANKS,
           implicit=IMPLICIT, implicit_first_order=IMPLICIT + FIRST_ORDER, implicit_two_ranks=IMPLICIT + TWO_RANKS,
           light=['grains.density_ratio=0.8']),
    # Every other grain code.
    **case('heap', md=MD, md_sub_iterated=MD + SUB_ITERATED, yade_md_sub_iterated=YADE_MD + SUB_ITERATED,
           lammps=LAMMPS, lammps_two_ranks=LAMMPS + ['grains.ranks=2'],
           external=['grains.adapter=external', 'contact.friction=0',
                     'grains.command=/usr/bin/python3 ../../examples/springs.py']),
    # Outlines.
    **case('heap', triangles=TRIANGLES, triangles_yade=TRIANGLES + YADE, triangles_explicit=TRIANGLES + EXPLICIT,
           triangles_md=TRIANGLES + MD),
    # Motions that the case gives, and sides that are no walls.
    **case('machine', joint=[], driven=['fluid.acceleration=[0.2,0]'], first_order=FIRST_ORDER, yade=YADE,
           split=['coupling.scheme=split'], explicit=EXPLICIT, implicit=IMPLICIT, two_ranks=TWO_RANKS, dry=DRY,
           dry_yade=DRY + YADE),
    **case('through', joint=[], first_order=FIRST_ORDER, explicit=EXPLICIT, yade=YADE),
    # Contacts alone: laws and solvers.
    **case('grains', discs=[], yade=YADE, triangles=['grains.shape=triangle'],
           triangles_yade=['grains.shape=triangle'] + YADE,
           rolling=['contact.rolling_friction=0.1', 'contact.law=static-dynamic', 'contact.static_friction=0.5'],
           bouncing=['contact.restitution=0.5'],
           central_path=['contact.solver=central-path'],
           cohesion=['contact.adhesion=cohesion', 'contact.adhesion_force=5', 'contact.adhesion_range=0.05',
                     'contact.adhesion_shear=1']),
    # The same on grains to which the fluid is tied, and springs without a fluid.
    **case('heap', rolling=['contact.rolling_friction=0.1'], dry_md=DRY + MD, dry_lammps=DRY + LAMMPS,
           dry_yade_md=DRY + YADE_MD),
}
# In two parts: to 1.05 t_c, out of turn of the output, then to the end.
RESUMED = {
    **case('heap', resumed=[], resumed_explicit=EXPLICIT, resumed_md=MD),
    **case('grains', resumed=YADE),
}
RUNS = {**LONG, **SHORT, **RESUMED}
GROUPS = {'long': list(LONG), 'short': [*SHORT, *RESUMED]}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest='command', required=True)
    record = commands.add_parser('record', help='play the reference runs')
    record.add_argument('folder', type=Path)
    record.add_argument('--program', default=str(ROOT / 'turbidite'), help='what runs a case')
    record.add_argument('--only', action='append', choices=[*RUNS, *GROUPS], metavar='NAME',
                        help='these runs only; may be repeated')
    compare = commands.add_parser('compare', help='compare two sets of them')
    compare.add_argument('before', type=Path)
    compare.add_argument('after', type=Path)
    return parser.parse_args()


def start(options, words):
    """Runs a job without the report, which takes longer than a short run; its exit code."""
    print(' '.join(words), file=sys.stderr, flush=True)
    line = subprocess.run([options.program, *words, '--dry-run'], stdout=subprocess.PIPE, check=False, text=True)
    if line.returncode != 0:
        return line.returncode
    return subprocess.run(line.stdout, shell=True, stdout=subprocess.DEVNULL, check=False).returncode


def play(options, name):
    """Plays one run, unless it is there; False if it failed."""
    folder, unfinished = options.folder / name, options.folder / 'unfinished'
    if folder.exists():
        return True
    case_file, keys = RUNS[name]
    settings = [word for key in keys for word in ('--set', key)]
    begin = ['run', str(ROOT / f'{case_file}.yaml'), '--out', str(unfinished), '--force', *settings]
    if name in RESUMED:
        end = re.search(r'^  end: (.*)$', (ROOT / f'{case_file}.yaml').read_text(), re.MULTILINE)[1]
        ended = start(options, [*begin, '--set', 'time.end=1.05'])
        ended = ended or start(options, ['resume', str(unfinished), '--set', f'time.end={end}'])
    else:
        ended = start(options, begin)
    if ended != 0:
        print(f'{name}: the run ended with code {ended}', file=sys.stderr)
        return False
    shutil.rmtree(unfinished / 'fluid', ignore_errors=True)  # nothing there is compared
    shutil.rmtree(unfinished / 'checkpoints', ignore_errors=True)
    unfinished.rename(folder)
    return True


def history(folder):
    """({column: texts}, number of rows) of a run, without the wall times."""
    with open(folder / 'history.csv', newline='', encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    names = [name for name in rows[0] if not name.startswith('wall_')]
    return {name: [row[name] for row in rows] for name in names}, len(rows)


def differences(before, after):
    """Sentences on the differences between two run folders; empty if they are equal. New columns are appended from
    version to version; they have nothing to be compared with."""
    (old, old_rows), (new, new_rows) = history(before), history(after)
    found = [f'the column {name} is gone' for name in sorted(set(old) - set(new))]
    if old_rows != new_rows:
        found.append(f'{old_rows} rows before, {new_rows} after')
    for name in [name for name in old if name in new]:
        for row, (x, y) in enumerate(zip(old[name], new[name])):
            if x != y:
                found.append(f'{name} differs from row {row} (t = {old["time"][row]} t_c) on: {x} before, {y} after')
                break
    return found


def files(folder):
    """{path: bytes} of what a run wrote besides its history and that depends on nothing else."""
    series = [folder / 'probes.csv', *(folder / 'grains').glob('*.vtp')]
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(series) if file.exists()}


def other_files(before, after):
    """Sentences on the other files of two run folders."""
    old, new = files(before), files(after)
    found = [name for name in sorted({*old, *new}) if old.get(name) != new.get(name)]
    return [f'{len(found)} of {len(old)} other files differ, first {found[0]}'] if found else []


def compare(options):
    names = [name for name in RUNS if (options.before / name / 'history.csv').exists()]
    if not names:
        sys.exit(f'{options.before} holds no reference run; make them with: {sys.argv[0]} record {options.before}')
    different = False
    for name in names:
        old, new = options.before / name, options.after / name
        if not (new / 'history.csv').exists():
            found = [f'{options.after} does not have this run']
        else:
            found = differences(old, new) + other_files(old, new)
        different = different or bool(found)
        print(f'{name}: ' + ('equal' if not found else '; '.join(found)))
    return 1 if different else 0


def main():
    options = arguments()
    if options.command == 'compare':
        return compare(options)
    names = [run for name in options.only or RUNS for run in GROUPS.get(name, [name])]
    options.folder.mkdir(parents=True, exist_ok=True)
    return 0 if all([play(options, name) for name in names]) else 1


if __name__ == '__main__':
    sys.exit(main())
