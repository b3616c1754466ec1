#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The three orders of a window on one case and several time steps, as a table (docs/schemes.md).

    bench/schemes.py [--case FILE] [--set key=value]... [--steps 0.02,0.01,0.005] [--out FOLDER]

Runs `./turbidite run` once per row, unless the row's run folder exists, and compares the mean histories with those of
`joint` at the smallest step. Times are wall times of this machine, and comparable only within one table."""
import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))
import run_data  # access to the contents of a run folder
from avalanche_dry import is_done

SCHEMES = {
    'split, corrected': ['coupling.scheme=split', 'coupling.positions=corrected'],
    'split, contact': ['coupling.scheme=split', 'coupling.positions=contact'],
    'joint': ['coupling.scheme=joint'],
}
HEAD = ('scheme', 'step [t_c]', 'largest overlap [D]', 'contact sweeps, mean', 'largest', 'rounds, mean',
        'multiplier iterations, mean', 'fastest fall [u_c]', 'fall: rms difference', 'end height [D]',
        'end mean speed [u_c]', 'fluid, grains [ms/window]', 'wall time [s]')


class Run:
    """One run folder's history and record."""

    def __init__(self, folder):
        run = run_data.load_run(folder)
        self.record, self.history = run.record, run.history

    def column(self, name):
        return self.history[name]

    def mean(self, name):
        values = self.column(name)[1:]
        return float(np.nanmean(values)) if np.isfinite(values[-1]) else None


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--case', default=str(ROOT / 'configs/sedimentation-discs.yaml'))
    parser.add_argument('--set', action='append', default=[], help='key=value for every run')
    parser.add_argument('--steps', default='0.02,0.01,0.005', help='time steps in t_c')
    parser.add_argument('--program', default=str(ROOT / 'turbidite'), help='what runs a case')
    parser.add_argument('--out', default='runs/schemes', help='folder of the run folders')
    return parser.parse_args()


def play(options, scheme, step):
    """The run of one row, which is started only if it is not there."""
    folder = Path(options.out) / f'{scheme.replace(", ", "-")}-{step}'
    if not is_done(folder):
        command = [options.program, 'run', options.case, '--out', str(folder), '--force']
        for setting in SCHEMES[scheme] + [f'time.step={step}'] + options.set:
            command += ['--set', setting]
        print(' '.join(command), file=sys.stderr, flush=True)
        subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    return Run(folder)


def difference(run, reference):
    """rms difference of the mean vertical velocities, over the largest value of the reference."""
    times = reference.column('time')
    fall = np.interp(times, run.column('time'), run.column('mean_velocity_y'))
    wanted = reference.column('mean_velocity_y')
    return float(np.sqrt(np.mean((fall - wanted) ** 2)) / np.max(np.abs(wanted)))


def cells(scheme, step, run, reference):
    number = lambda value, form: '' if value is None else format(value, form)
    return (scheme, step, number(run.record['maxima']['penetration'], '.1e'),
            number(run.mean('contact_iterations'), '.0f'),
            number(float(np.nanmax(run.column('contact_iterations'))), '.0f'),
            number(run.mean('joint_rounds'), '.2f') if scheme == 'joint' else '',
            number(run.mean('multiplier_iterations'), '.1f'),
            number(-float(np.min(run.column('mean_velocity_y'))), '.4f'),
            'reference' if run is reference else number(100.0 * difference(run, reference), '.2f') + ' %',
            number(run.column('mean_position_y')[-1], '.4f'),
            number(run.column('mean_speed')[-1], '.1e'),
            f'{1e3 * run.mean("wall_fluid"):.1f}, {1e3 * run.mean("wall_grains"):.1f}',
            number(run.record['wall_seconds'], '.0f'))


def main():
    options = arguments()
    steps = options.steps.split(',')
    runs = {(scheme, step): play(options, scheme, step) for step in steps for scheme in SCHEMES}
    reference = runs['joint', min(steps, key=float)]
    print('| ' + ' | '.join(HEAD) + ' |')
    print('|' + '---|' * len(HEAD))
    for (scheme, step), run in runs.items():
        print('| ' + ' | '.join(cells(scheme, step, run, reference)) + ' |')


if __name__ == '__main__':
    main()
