#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The dry column of Topin et al. 2011 (Fig. 8a): packings, adapters and seeds compared (docs/dry-avalanche.md).

    bench/avalanche_dry.py [--adapters A,B] [--compacities 0.9069,0.84,0.7854] [--seeds 1,2,3]
                           [--variants 'name: key=value key=value'] [--set key=value]... [--out FOLDER]

Runs `./turbidite run configs/avalanche-dry.yaml` for each adapter, compacity, seed and variant, one after the
other. Runs already present in FOLDER are skipped, so that the script can be stopped and restarted. Then it calls
`./turbidite compare` for each compacity and for all runs, and prints the tables. A variant is a set of keys, e.g.
a smaller time step, whose runs are compared with those without it. Wall times are those of this machine."""
import argparse
import itertools
import json
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'launcher/report'))

import curves
import run_data
import seeds
from analysis.peaks import COLUMN

PLAIN = 'plain'
RUN_HEAD = ('runs', 'grains', 'peak of the mean curve [u_c]', 'at [t_c]', 'of single runs [u_c]', 'at [t_c]',
            'end: front [D]', 'end: height [D]', 'overlap [D]', 'windows beyond tolerance', 'wall time [s]')
PAIR_HEAD = ('mean velocity of', 'against', 'largest difference / peak', 'mean difference / peak')
FOR_ALL = 'all'
STYLES = ('-', (0, (1, 2)), '--', '-.')


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--case', default=str(ROOT / 'configs/avalanche-dry.yaml'))
    parser.add_argument('--adapters', default='yade-nscd,standalone-nscd,yade-md')
    parser.add_argument('--compacities', default='0.9069,0.84,0.7854')
    parser.add_argument('--seeds', default='1,2,3')
    parser.add_argument('--variants', action='append', default=[], metavar="'NAME: KEY=VALUE...'",
                        help='runs with these keys beside the plain ones; may be repeated')
    parser.add_argument('--only-variants', action='store_true', help='no plain runs')
    parser.add_argument('--set', action='append', default=[], help='key=value for every run')
    parser.add_argument('--program', default=str(ROOT / 'turbidite'), help='what runs a case')
    parser.add_argument('--out', default='runs/avalanche-dry', help='folder of the run folders')
    return parser.parse_args()


def variants_of(options):
    """{name: keys}; PLAIN has no keys."""
    variants = {} if options.only_variants else {PLAIN: []}
    for text in options.variants:
        name, _, keys = text.partition(':')
        if not keys.split() or not all('=' in key for key in keys.split()):
            sys.exit(f'--variants "{text}" is not of the form "NAME: KEY=VALUE KEY=VALUE"')
        variants[name.strip()] = keys.split()
    return variants


def is_done(folder):
    record = folder / 'run.json'
    return record.exists() and json.loads(record.read_text()).get('status') == 'done'


def play(options, group, settings, seed):
    """The folder of one run, which is started only if it is not there."""
    folder = Path(options.out) / f'{group}-seed{seed}'
    if is_done(folder):
        return folder
    command = [options.program, 'run', options.case, '--out', str(folder), '--force']
    for setting in settings + [f'random.seed={seed}'] + options.set:
        command += ['--set', setting]
    print(' '.join(command), file=sys.stderr, flush=True)
    ended = subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode
    if ended:
        sys.exit(f'the run in {folder} ended with exit code {ended}')
    return folder


def play_all(options):
    """{compacity: {group: run folders of its seeds}}; a group is `ADAPTER-COMPACITY[-VARIANT]`."""
    variants = variants_of(options)
    seeds = options.seeds.split(',')
    runs = {}
    for compacity, adapter, (variant, keys) in itertools.product(
            options.compacities.split(','), options.adapters.split(','), variants.items()):
        group = f'{adapter}-{compacity}' + ('' if variant == PLAIN else f'-{variant}')
        settings = [f'grains.adapter={adapter}', f'grains.compacity={compacity}'] + keys
        runs.setdefault(compacity, {})[group] = [play(options, group, settings, seed) for seed in seeds]
    return runs


def compare(options, name, groups):
    """The comparison's JSON; its page is FOLDER/compare-NAME.html."""
    folders = [str(folder) for folders in groups.values() for folder in folders]
    if len(folders) < 2:
        return None
    page = Path(options.out) / f'compare-{name}.html'
    subprocess.run([options.program, 'compare', *folders, '--out', str(page)],
                   stdout=subprocess.DEVNULL, check=True)
    return json.loads(page.with_suffix('.json').read_text())


def spread(peaks, what, form):
    values = [single[what] for single in peaks['single']]
    return f'{min(values):{form}} to {max(values):{form}}'


def run_cells(member):
    record = json.loads((Path(member['folder']) / 'run.json').read_text())
    end = lambda column: member['quantities'][column]['end_value']
    mean = member['peak']['mean']
    return (member['name'], record['grains'], f'{mean["value"]:.3f}', f'{mean["time"]:.2f}',
            spread(member['peak'], 'value', '.3f'), spread(member['peak'], 'time', '.2f'),
            f'{end("front_x"):.1f}', f'{max(member["surface"]["height"]):.1f}',
            f'{member["penetration"]:.1e}', f'{member["unconverged_windows"]:.0f}',
            f'{member["wall_seconds"]:.0f}')


def pair_cells(pair):
    return pair['first'], pair['second'], f'{100 * pair["largest"]:.1f} %', f'{100 * pair["mean"]:.1f} %'


def is_telling(pair, runs):
    """Whether the two groups have the same packing, or the same adapter and variant."""
    compacity = {group: value for value, groups in runs.items() for group in groups}
    # A group of one seed is named by its folder.
    of_folder = {Path(folder).name: group for groups in runs.values() for group, folders in groups.items()
                 for folder in folders}
    first, second = (of_folder.get(pair[name], pair[name]) for name in ('first', 'second'))
    rest = lambda group: group.replace(f'-{compacity[group]}', '', 1)
    return compacity[first] == compacity[second] or rest(first) == rest(second)


def print_table(head, rows):
    print('\n| ' + ' | '.join(head) + ' |')
    print('|' + '---|' * len(head))
    for row in rows:
        print('| ' + ' | '.join(str(cell) for cell in row) + ' |')


def draw(runs, file):
    """Fig. 8(a): means over the seeds with bands from the smallest to the largest value."""
    figure, axes = plt.subplots(figsize=(7.5, 4.2), layout='constrained')
    for i, groups in enumerate(runs.values()):
        for j, (group, folders) in enumerate(groups.items()):
            # One colour per compacity, one style per adapter; with a single compacity, one colour per adapter.
            colour = f'C{(i if len(runs) > 1 else j) % 10}'
            style = STYLES[j % len(STYLES)] if len(runs) > 1 else '-'
            member, = seeds.members([run_data.load_run(folder) for folder in folders])
            axes.plot(*member.data.column(COLUMN), color=colour, linestyle=style, linewidth=1.4,
                      label=group)
            axes.fill_between(*member.band(COLUMN), color=colour, alpha=0.15, linewidth=0.0)
    curves.decorate(axes, '', r'$|\langle u \rangle|\,/\,u_c$')
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=8)
    figure.savefig(file, dpi=110)


def main():
    options = arguments()
    runs = play_all(options)
    everything = {group: folders for groups in runs.values() for group, folders in groups.items()}
    whole = compare(options, FOR_ALL, everything)
    if whole is None:
        sys.exit('nothing to compare: ask for two runs at least')
    print_table(RUN_HEAD, [run_cells(member) for member in whole['runs']])
    print_table(PAIR_HEAD, [pair_cells(pair) for pair in whole['mean_velocity_pairs']
                            if is_telling(pair, runs)])
    for compacity, groups in runs.items():
        if len(runs) > 1:
            compare(options, compacity, groups)
    draw(runs, Path(options.out) / 'mean_velocity.png')
    print(f'\nPages: {options.out}/compare-*.html; Fig. 8(a): {options.out}/mean_velocity.png')


if __name__ == '__main__':
    main()
