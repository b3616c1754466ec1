#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""run_outs.py RUN... [--picture FILE]: run-outs and heights of dry columns beside published experiments (docs/spheres.md).

    bench/run_outs.py runs/run-outs/height/* --picture docs/images/run-outs.png

a = H0/L0: mean height of the column's surface over its foot, both at t = 0. Run-out (L - L0)/L0 and height H/L0 of the last
output, as docs/analysis.md defines them. Experiments between parallel walls, as Lagree, Staron and Popinet, J. Fluid Mech.
686 (2011) 378, Eqs. 3.1 and 3.2, cite them:

    Lube et al. 2005         (L - L0)/L0 = 1.2 a, a < 1.8, and 1.9 a^(2/3), a > 2.8;    H/L0 = a^0.4, a > 1.15
    Lajeunesse et al. 2005   (L - L0)/L0 = 1.8 a, a < 3,   and 2.3 a^(2/3), a > 3
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / 'launcher/report'))
import findings  # noqa: E402
import grain_files  # noqa: E402
import run_data  # noqa: E402
import surface  # noqa: E402
from analysis import deposit  # noqa: E402


# (from, to, law) of the aspect ratio.
EVER = 100.0
LUBE = ((0.0, 1.8, lambda a: 1.2 * a), (2.8, EVER, lambda a: 1.9 * a**(2 / 3)))
LAJEUNESSE = ((0.0, 3.0, lambda a: 1.8 * a), (3.0, EVER, lambda a: 2.3 * a**(2 / 3)))
LUBE_HEIGHT = ((0.0, 1.15, lambda a: a), (1.15, EVER, lambda a: a**0.4))


def of_law(laws, a):
    """As text; of both laws where neither is told."""
    found = [law(a) for begin, end, law in laws if begin <= a < end] or [law(a) for _, _, law in laws]
    return ' to '.join(f'{value:.2f}' for value in sorted(found))


def measured(folder):
    """(aspect ratio, run-out, height over L0, slope, from when at rest or None)."""
    run = run_data.load_run(folder)
    found = deposit.deposit(run)
    x, height = surface.surface(run, grain_files.first_grains(run))
    column = height[x + 0.5 <= found.first_foot].mean()
    return column / found.first_foot, found.run_out, found.top / found.first_foot, found.slope, findings.rest_time(run)


def print_table(rows):
    print('| run | a | run-out | Lube | Lajeunesse | H/L0 | Lube | slope | at rest from [t_c] |')
    print('|---|---|---|---|---|---|---|---|---|')
    for name, (a, run_out, height, slope, rest) in rows:
        angle, since = '' if slope is None else f'{slope:.0f}°', 'it moves' if rest is None else f'{rest:.0f}'
        print(f'| {name} | {a:.2f} | {run_out:.2f} | {of_law(LUBE, a)} | {of_law(LAJEUNESSE, a)} | {height:.2f} | '
              f'{of_law(LUBE_HEIGHT, a)} | {angle} | {since} |')


def curves_within(laws, low, high):
    """(ratios, values) of each part of a law that reaches into these ratios."""
    reaches = [(max(low, begin), min(high, end), law) for begin, end, law in laws]
    ratios = [(np.geomspace(begin, end, 50), law) for begin, end, law in reaches if begin < end]
    return [(a, law(a)) for a, law in ratios]


def draw(rows, file):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.9), layout='constrained')
    ratios = np.array([row[0] for _, row in rows])
    low, high = 0.8 * ratios.min(), 1.25 * ratios.max()
    for axes, k, laws in ((left, 1, (('Lube et al. 2005', '-', LUBE), ('Lajeunesse et al. 2005', '--', LAJEUNESSE))),
                          (right, 2, (('Lube et al. 2005', '-', LUBE_HEIGHT),))):
        axes.loglog(ratios, [row[k] for _, row in rows], 'o', color='C0', label='spheres')
        for label, dash, parts in laws:
            for n, curve in enumerate(curves_within(parts, low, high)):
                axes.loglog(*curve, color='black', linewidth=1.0, linestyle=dash, label=label if n == 0 else None)
        axes.set_xlabel('$a = H_0/L_0$')
        axes.grid(True, which='both', alpha=0.25)
    left.set_ylabel('run-out $(L_\\infty - L_0)/L_0$')
    right.set_ylabel('height $H_\\infty/L_0$')
    left.legend(fontsize=8)
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('runs', nargs='+', metavar='RUN')
    parser.add_argument('--picture', metavar='FILE')
    options = parser.parse_args()
    rows = [(Path(folder).name, measured(folder)) for folder in options.runs]
    print_table(rows)
    if options.picture:
        draw(rows, options.picture)


if __name__ == '__main__':
    main()
