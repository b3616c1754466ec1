#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests that a change leaves every digit of the histories unchanged: runs reference cases and compares them.

    bench/same_histories.py record FOLDER [--program turbidite] [--only NAME]...
    bench/same_histories.py compare BEFORE AFTER

`record` plays the runs that are not yet in FOLDER, with the given program (that of another checkout, to record its
histories). `compare` requires every column of history.csv except the wall times (wall_*) to have identical text; it
prints where each run first differs, and exits with 1. Columns that only one side has are named; the values of the
others are still compared. Takes about four minutes on two cores."""
import argparse
import csv
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# The default recovery before the case had its own, so that older programs can be compared.
SEDIMENTATION = ['fluid.cells_per_diameter=8', 'time.end=5', 'output.interval=0.1',
                 'contact.recovery_fraction=0.2']
COLUMN = ['time.end=5', 'output.interval=0.1']

# name: (case, keys)
RUNS = {
    'quickstart-joint': ('quickstart', ['coupling.scheme=joint', 'output.interval=0.25']),
    'quickstart-split': ('quickstart', ['coupling.scheme=split', 'output.interval=0.25']),
    'sedimentation-1-rank': ('sedimentation-discs', SEDIMENTATION),
    'sedimentation-2-ranks': ('sedimentation-discs', SEDIMENTATION + ['fluid.ranks=2']),
    'column-yade': ('avalanche-dry', COLUMN + ['grains.adapter=yade-nscd']),
    'column-standalone': ('avalanche-dry', COLUMN + ['grains.adapter=standalone-nscd']),
    'triangles': ('triangles-dry', ['time.end=14', 'output.interval=0.1']),
    'yade-md': ('quickstart', ['grains.adapter=yade-md', 'coupling.scheme=split', 'time.end=30',
                               'output.interval=0.25']),
}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest='command', required=True)
    record = commands.add_parser('record', help='play the reference runs')
    record.add_argument('folder', type=Path)
    record.add_argument('--program', default=str(ROOT / 'turbidite'), help='what runs a case')
    record.add_argument('--only', action='append', choices=list(RUNS), help='this run only; may be repeated')
    compare = commands.add_parser('compare', help='compare two sets of them')
    compare.add_argument('before', type=Path)
    compare.add_argument('after', type=Path)
    return parser.parse_args()


def play(options, name):
    """Plays one run, unless it is there; False if it failed."""
    folder = options.folder / name
    if (folder / 'report.html').exists():
        return True
    case, keys = RUNS[name]
    command = [options.program, 'run', str(ROOT / f'configs/{case}.yaml'), '--out', str(folder), '--force']
    for key in keys:
        command += ['--set', key]
    print(' '.join(command), file=sys.stderr, flush=True)
    ended = subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode
    if ended != 0:
        print(f'{name}: the run ended with code {ended}', file=sys.stderr)
    return ended == 0


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


def compare(options):
    names = [name for name in RUNS if (options.before / name / 'history.csv').exists()]
    if not names:
        sys.exit(f'{options.before} holds no reference run; make them with: {sys.argv[0]} record {options.before}')
    different = False
    for name in names:
        if not (options.after / name / 'history.csv').exists():
            found = [f'{options.after} does not have this run']
        else:
            found = differences(options.before / name, options.after / name)
        different = different or bool(found)
        print(f'{name}: ' + ('equal' if not found else '; '.join(found)))
    return 1 if different else 0


def main():
    options = arguments()
    if options.command == 'compare':
        return compare(options)
    return 0 if all([play(options, name) for name in options.only or RUNS]) else 1


if __name__ == '__main__':
    sys.exit(main())
