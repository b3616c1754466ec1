#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A settling sphere beside the experiment of ten Cate, Nieuwstad, Derksen and Van den Akker (Phys. Fluids 14 (2002) 4012).

    bench/ten_cate.py RUN... [--figure FILE.png]

RUN are folders of the parts ten-cate* of configs/spheres-in-liquid.yaml; the density of the oil tells the experiment. Prints
the largest speed, the time of arrival (gap to the floor below 0.05 D) and, where points of the published trajectory are
known, the time between two of its gaps: the published one starts 0.16 D higher than its text says. --figure draws speed
and gap against time."""
import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import run_data

FLOOR = 0.05  # gap at arrival [D]


@dataclass
class Experiment:
    peak: float        # largest speed in the box [m/s]: table of the paper
    arrival: float     # at the floor [s]: read off its curves
    gaps: tuple = ()   # (time [s], gap [D]), read off
    speeds: tuple = () # (time [s], speed [m/s]), read off: 1 to 4 % of noise


EXPERIMENTS = {
    'E1': Experiment(0.0360, 4.12, ((0.102, 8.18), (0.612, 7.10), (1.097, 5.98), (1.90, 4.09), (2.50, 2.75),
                                    (3.30, 0.986), (3.918, 0.166), (4.124, 0.13))),
    'E2': Experiment(0.0572, 2.49),
    'E3': Experiment(0.0873, 1.60),
    'E4': Experiment(0.1222, 1.19, ((0.011, 8.15), (0.323, 6.79), (0.617, 4.68), (0.861, 2.72), (1.114, 0.590),
                                    (1.188, 0.045)),
                     ((0.068, 0.0379), (0.152, 0.0678), (0.262, 0.0941), (1.0, 0.1233), (1.177, 0.1088))),
}
OILS = {970: 'E1', 965: 'E2', 962: 'E3', 960: 'E4'}  # density [kg/m3]
WAYS = {'E1': (7.10, 0.986), 'E4': (6.79, 0.590)}  # gaps between which the time is compared [D]


class Fall:
    """Speed [m/s] and gap [D] of a run against time [s]."""

    def __init__(self, folder):
        self.run = run_data.load_run(folder)
        self.name = OILS[round(self.run.scale('rho'))]
        time, velocity = self.run.column('mean_velocity_y')
        height = self.run.column('mean_position_y')[1]
        self.time = time * self.run.scale('t_c')
        self.speed = -velocity * self.run.scale('u_c')
        self.gap = height - 0.5
        self.cells = int(self.run.case['fluid.cells_per_diameter'])

    def time_at(self, gap):
        """When the gap first falls below this one; nan if it never does."""
        below = np.flatnonzero(self.gap <= gap)
        if not len(below):
            return np.nan
        last = below[0]
        return np.interp(-gap, -self.gap[last - 1:last + 1], self.time[last - 1:last + 1])

    def time_between(self, first, last):
        return self.time_at(last) - self.time_at(first)


def published_between(points, first, last):
    times = {gap: time for time, gap in points}
    return times[last] - times[first]


def against(value, published, form):
    return f'{value:{form}} ({100.0 * (value / published - 1.0):+.1f} %)'


def row(fall):
    known = EXPERIMENTS[fall.name]
    way = '–'
    if fall.name in WAYS:
        way = against(fall.time_between(*WAYS[fall.name]), published_between(known.gaps, *WAYS[fall.name]), '.3f')
    case = fall.run.case
    return (f'| {fall.name} | D/{fall.cells} | {case["fluid.surface_shift"]} | {case["fluid.splitting"]} | '
            f'{case["time.step"]} | {against(fall.speed.max(), known.peak, ".4f")} | '
            f'{against(fall.time_at(FLOOR), known.arrival, ".2f")} | {way} |')


def draw(falls, file):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    figure, (speeds, gaps) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    for fall in falls:
        known = EXPERIMENTS[fall.name]
        colour = f'C{list(EXPERIMENTS).index(fall.name)}'
        line = {9: ':', 12: '-'}.get(fall.cells, '--')
        label = f'{fall.name}, D/{fall.cells}'
        speeds.plot(fall.time, fall.speed, line, color=colour, label=label)
        gaps.plot(fall.time, fall.gap, line, color=colour)
        speeds.plot([0.0, known.arrival], 2 * [known.peak], color=colour, linewidth=0.6)
        if known.speeds:
            speeds.plot(*np.transpose(known.speeds), 'o', color=colour, fillstyle='none')
        if known.gaps:
            gaps.plot(*np.transpose(known.gaps), 'o', color=colour, fillstyle='none')
        gaps.plot(known.arrival, 0.0, '|', markersize=14, color=colour)
    speeds.set(xlabel='t [s]', ylabel='speed [m/s]', xlim=(0.0, 4.4), ylim=(-0.012, None))
    gaps.set(xlabel='t [s]', ylabel='gap to the floor [D]', xlim=(0.0, 4.4))
    speeds.legend(fontsize='small')
    figure.savefig(file, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('runs', nargs='+', type=Path, metavar='RUN')
    parser.add_argument('--figure', type=Path)
    options = parser.parse_args()
    falls = [Fall(folder) for folder in options.runs]
    print('| | cells | shift | splitting | step [t_c] | largest speed [m/s] | arrival [s] | between two gaps [s] |')
    print('|---|---|---|---|---|---|---|---|')
    for fall in sorted(falls, key=lambda fall: (fall.name, fall.cells)):
        print(row(fall))
    if options.figure:
        draw(falls, options.figure)


if __name__ == '__main__':
    main()
