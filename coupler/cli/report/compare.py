# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare.py PAGE RUN RUN...: the same quantities of several runs on one page, differences from the first run
quantified. Beside PAGE (compare.html) it writes the numbers as .csv and .json.
"""
import csv
import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

import curves
import findings
import run_data
from differences import common_span, difference
from page import Page, write_whole


class Refusal(Exception):
    """What the user should read; exit code 2."""


@dataclass
class Quantity:
    column: str
    title: str
    unit: str
    logarithmic: bool = False


QUANTITIES = [
    Quantity('mean_velocity_y', 'Mean vertical velocity', r'$\langle u_y \rangle\,/\,u_c$'),
    Quantity('mean_velocity_norm', 'Norm of the mean velocity', r'$|\langle u \rangle|\,/\,u_c$'),
    Quantity('mean_position_y', 'Mean vertical position', r'$\langle y \rangle\,/\,D$'),
    Quantity('front_x', 'Front', r'$\max(x+R)\,/\,D$'),
    Quantity('kinetic_energy', 'Kinetic energy', r'energy $/\,(\Sigma m\,u_c^2)$'),
    Quantity('max_penetration', 'Deepest overlap', r'overlap $/\,D$'),
    Quantity('contact_iterations', 'Contact solver', 'sweeps'),
    Quantity('contact_residual', 'Contact residual', 'scaled natural map', logarithmic=True),
    Quantity('multiplier_iterations', 'Multiplier solver', 'iterations'),
    Quantity('joint_rounds', 'Joint scheme', 'rounds'),
    Quantity('wall_step', 'Wall time of a window', 'seconds'),
]


@dataclass
class NamedRun:
    name: str
    data: run_data.RunData


def load(folders):
    """The runs under names that tell them apart: the folder's, or the path where these are equal."""
    names = [Path(folder).resolve().name for folder in folders]
    if len(set(names)) < len(names):
        names = [str(folder) for folder in folders]
    if len(set(names)) < len(names):
        names = [f'{name} ({i + 1})' for i, name in enumerate(names)]
    runs = [NamedRun(name, run_data.load_run(folder)) for name, folder in zip(names, folders)]
    for run in runs:
        if run.data.history is None:
            raise Refusal(f'{run.data.folder} has no history to compare: '
                          + ' '.join(run.data.remarks))
    return runs


def check_spans(runs):
    first = runs[0].data
    for run in runs[1:]:
        if common_span(first.history['time'], run.data.history['time']) is None:
            spans = [f'{r.folder} from {r.history["time"][0]:g} to {r.history["time"][-1]:g} t_c'
                     for r in (first, run.data)]
            raise Refusal('these runs have no common time span: ' + ', '.join(spans)
                          + '\n  Let the shorter one run on, or compare other runs.')


def parameters(runs):
    """(key, one value per run) of the keys in which the cases differ."""
    keys = dict.fromkeys(key for run in runs for key in run.data.case)
    rows = [(key, [run.data.case.get(key, '') for run in runs]) for key in keys]
    return [(key, values) for key, values in rows if len(set(values)) > 1]


def wall_seconds(run):
    """(of the run, of a window on average), of the windows that the history tells about."""
    wall = findings.wall_time(run.data)
    if wall is None:
        return None, None
    total = wall.total(wall.window)
    return total, total / float(wall.windows.sum())


def ratio(value, first):
    return value / first if value and first else None


def last_value(run, column):
    _, values = run.data.column(column)
    return float(values[-1]) if len(values) else None


def shared(runs):
    """The quantities that at least one run has."""
    return [q for q in QUANTITIES if any(len(run.data.column(q.column)[1]) for run in runs)]


def measure(runs):
    """{run: {quantity: numbers}}, what the page, the CSV and the JSON show. The first run has end values
    alone; what cannot be told is None."""
    return {run.name: {q.column: numbers(runs[0], run, q.column) for q in shared(runs)}
            for run in runs}


def numbers(first, run, column):
    result = dict.fromkeys(['begin', 'end', 'rms', 'max', 'rms_relative', 'max_relative'])
    result['end_value'] = last_value(run, column)
    apart = difference(first.data.column(column), run.data.column(column)) if run is not first else None
    if apart:
        result.update(begin=apart.begin, end=apart.end, rms=apart.rms, max=apart.largest,
                      rms_relative=apart.relative(apart.rms),
                      max_relative=apart.relative(apart.largest))
    return result


# --- the page ---------------------------------------------------------------------------------------

def overview(runs):
    """Rows: what, then one cell per run."""
    wall = [wall_seconds(run) for run in runs]
    rest = [findings.rest_time(run.data) for run in runs]
    overlap = [findings.largest(run.data, 'max_penetration', 'penetration') for run in runs]
    return [
        ['status'] + [run.data.record.get('status', 'unknown') for run in runs],
        ['last row [t_c]'] + [number(run.data.history['time'][-1]) for run in runs],
        ['windows'] + [f'{run.data.history["step"][-1]:.0f}' for run in runs],
        ['wall time [s]'] + [number(total) for total, _ in wall],
        ['over the first\'s'] + [number(ratio(total, wall[0][0])) for total, _ in wall],
        ['wall time of a window [s]'] + [number(window) for _, window in wall],
        ['over the first\'s'] + [number(ratio(window, wall[0][1])) for _, window in wall],
        ['at rest from [t_c]'] + ['not at rest' if value is None else number(value) for value in rest],
        ['largest overlap of any window [D]'] + [number(value) for value in overlap],
    ]


def number(value):
    return '' if value is None else f'{value:.4g}'


def percent(value):
    return '' if value is None else f'{100.0 * value:.3g} %'


def draw(runs):
    quantities = shared(runs)
    rows = -(-len(quantities) // 2)
    figure, axes = plt.subplots(rows, 2, squeeze=False, layout='constrained',
                                figsize=(11.0, 3.2 * rows))
    for quantity, place in zip(quantities, axes.flat):
        for i, run in enumerate(runs):
            place.plot(*run.data.column(quantity.column), label=run.name, color=f'C{i % 10}',
                       linestyle='-' if i == 0 else '--', linewidth=1.4)
        curves.decorate(place, quantity.title, quantity.unit)
        if quantity.logarithmic:
            curves.logarithmic(place)
    for unused in list(axes.flat)[len(quantities):]:
        unused.set_axis_off()
    axes.flat[0].legend(fontsize=8)
    return figure


def difference_rows(runs, measured):
    titles = {q.column: q.title for q in QUANTITIES}
    return [[titles[column], run.name, number(n['rms']), percent(n['rms_relative']), number(n['max']),
             percent(n['max_relative']), number(n['end_value'])]
            for column in next(iter(measured.values())) for run in runs
            for n in [measured[run.name][column]]]


def make_page(runs, measured):
    page = Page('Comparison of ' + ', '.join(run.name for run in runs))
    page.table(overview(runs), header=[''] + [run.name for run in runs])
    page.heading('Parameters that differ')
    differing = parameters(runs)
    if differing:
        page.table([[key] + values for key, values in differing],
                   header=['key'] + [run.name for run in runs])
    else:
        page.paragraph('The cases are the same, key by key.')
    page.heading('Curves')
    page.figure(draw(runs), 'curves', f'All against t/t_c. Solid: {runs[0].name}, the first run.')
    page.heading(f'Differences from {runs[0].name}')
    page.paragraph('Over the time both runs cover, interpolated linearly; rms in time; relative to the '
                   'largest value of the first run. End values are those of each run\'s last row.')
    page.table(difference_rows(runs, measured), css='numbers',
               header=['quantity', 'run', 'rms', 'relative', 'largest', 'relative', 'end value'])
    remarks = [f'{run.name}: {remark}' for run in runs for remark in run.data.remarks]
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    return page


# --- for scripts ------------------------------------------------------------------------------------

def as_csv(measured):
    text = io.StringIO()
    fields = list(next(iter(next(iter(measured.values())).values())))
    table = csv.writer(text, lineterminator='\n')
    table.writerow(['run', 'quantity'] + fields)
    for run, quantities in measured.items():
        for column, values in quantities.items():
            table.writerow([run, column] + ['' if v is None else repr(v) for v in values.values()])
    return text.getvalue()


def as_json(runs, measured):
    wall = [wall_seconds(run) for run in runs]
    described = [{'name': run.name, 'folder': str(run.data.folder.resolve()),
                  'wall_seconds': total, 'wall_ratio': ratio(total, wall[0][0]),
                  'window_seconds': window, 'window_ratio': ratio(window, wall[0][1]),
                  'rest_time': findings.rest_time(run.data),
                  'quantities': measured[run.name]} for run, (total, window) in zip(runs, wall)]
    return json.dumps({'first': runs[0].name,
                       'parameters': {key: values for key, values in parameters(runs)},
                       'runs': described}, indent=2) + '\n'


def compare(page_file, folders):
    """Returns whether everything was written."""
    runs = load(folders)
    check_spans(runs)
    measured = measure(runs)
    return all([write_whole(page_file, make_page(runs, measured).text()),
                write_whole(page_file.with_suffix('.csv'), as_csv(measured)),
                write_whole(page_file.with_suffix('.json'), as_json(runs, measured))])


def main(arguments):
    if len(arguments) < 4:
        print('usage: compare.py PAGE RUN RUN...   (run folders of `turbidite run`)', file=sys.stderr)
        return 2
    try:
        return 0 if compare(Path(arguments[1]), arguments[2:]) else 4
    except Refusal as refusal:
        print(f'turbidite compare: {refusal}', file=sys.stderr)
        return 2


if __name__ == '__main__':
    sys.exit(main(sys.argv))
