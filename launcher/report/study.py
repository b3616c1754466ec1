# SPDX-License-Identifier: LGPL-2.1-or-later
"""study.py FOLDER: the results of a study, from FOLDER/study.json and the run folders it names.

Writes study.csv, one row per run, and study.html: per part the runs that differ in the seed alone taken
together, their curves, and what was measured against every swept number. Runs that are not done are listed, and left
out of means and figures.
"""
import csv
import io
import json
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use('Agg')
import numpy as np

import compare
import compare_page
import curves
import member_pictures
import run_data
import seeds
from measured import DRAWN, MEASURED, table
from document.own_files import Refusal, beginning, is_page, require_own
from document.page import Page, write_whole
from document.typeset import Code
from head import facts
from paper import add as paper
from paper.selection import is_done
from document.working import Progress

TITLE = 'Study '  # of the page, by which it is known
COLUMNS = ['part', 'run']  # the first of the table, by which it is known
MOST_PICTURES = 12
PICTURE_WIDTH = 280  # pixels
FIGURE_SETS = {'paper': paper.add}  # by the study's `figures`


@dataclass
class StudyRun:
    entry: dict                # of study.json
    data: run_data.RunData     # history None where the run is missing


def load(folder):
    """What study.json says, and the runs."""
    record = json.loads((folder / 'study.json').read_text())
    runs = []
    for entry in record['runs']:
        there = entry['status'] != 'missing'
        data = run_data.load_run(folder / entry['folder']) if there else run_data.RunData(folder / entry['folder'])
        runs.append(StudyRun(entry, data))
    return record, runs


def swept_keys(runs):
    return list(dict.fromkeys(key for run in runs for key in run.entry['values']))


# --- the table ----------------------------------------------------------------------------------------

def as_csv(runs):
    keys = swept_keys(runs)
    text = io.StringIO()
    rows = csv.writer(text, lineterminator='\n')
    rows.writerow([*COLUMNS, *keys, 'status', *[m.name for m in MEASURED], 'error'])
    for run in runs:
        values = [m.of(run.data) if run.data.history is not None else None for m in MEASURED]
        rows.writerow([run.entry['part'], run.entry['name'], *[run.entry['values'].get(key, '') for key in keys],
                        run.entry['status'], *['' if v is None else repr(float(v)) for v in values],
                        ' '.join(run.entry['error'].split())])
    return text.getvalue()


# --- the page -----------------------------------------------------------------------------------------

def make_page(title, runs, command=''):
    page = Page(TITLE + title)
    page.paragraph(progress(runs), 'verdict ' + ('holds' if all(run.entry['status'] == 'done' for run in runs) else 'doubt'))
    failed = [[Code(run.entry['folder']), f': {run.entry["status"]}. {run.entry["error"]}'] for run in runs
              if run.entry['status'] not in ('done', 'missing') or run.entry['error']]
    if failed:
        page.bullets(failed, 'bad')
    add_notes(page, runs, command)
    page.contents()
    for part in dict.fromkeys(run.entry['part'] for run in runs):
        add_part(page, part, [run for run in runs if run.entry['part'] == part])
    remarks = [[Code(run.entry['folder']), f': {remark}'] for run in runs for remark in run.data.remarks]
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    return page


def progress(runs):
    done = sum(run.entry['status'] == 'done' for run in runs)
    return f'{done} of {len(runs)} runs are done.'


def add_notes(page, runs, command):
    """How to read the page, and what made it."""
    page.paragraph('Runs that differ in random.seed alone are taken together: means, and in brackets the smallest and the '
                   'largest. Numbers of every run are in study.csv.', 'note')
    known = [run.data for run in runs if run.data.case]
    words = list(dict.fromkeys(facts.units_in_words(run) for run in known))
    if len(words) == 1:
        page.paragraph(words[0], 'note')
    if command:
        page.paragraph(['Made by: ', Code(command)], 'note')


def add_part(page, part, runs):
    """Answers first: what was measured against what was swept, then pictures, curves, and all numbers on demand."""
    page.heading(part)
    there = [run for run in runs if is_done(run)]
    if not there:
        page.paragraph('No run of this part is done yet.')
        return
    if left_out := [run.entry['name'] for run in runs if not is_done(run) and run.data.history is not None]:
        page.paragraph(f'Left out, since they are not done: {", ".join(left_out)}.', 'remark')
    if scales := facts.differing_scales([run.data for run in there]):
        page.paragraph(scales, 'remark')
    by_folder = {run.data.folder: run for run in there}
    members = seeds.members([run.data for run in there],
                            swept=lambda data: seeds.without_seed(by_folder[data.folder].entry['values']))
    keys = [key for key in swept_keys(runs) if key != seeds.SEED]
    values = {member.name: by_folder[member.runs[0].folder].entry['values'] for member in members}
    names = header_of(members, keys, values)
    page.table(table(answers(), members), css='numbers', header=names)
    for key in keys:
        shown = draw_against(key, members, values)
        if shown:
            page.panels([(figure, f'{part}-{key}-{name}') for figure, name in shown],
                        f'Against {key}' + ('; bars from the smallest to the largest of the seeds.' if any(
                            member.is_group() for member in members) else '.'))
    add_pictures(page, part, members, runs)
    comparison = compare.measure(members)
    page.legend(compare_page.legend_entries(members))
    page.panels(((figure, f'{part}-{name}') for figure, name in compare_page.draw_curves(comparison)),
                'All against t/t_c.' + (' Lines: means over the seeds; bands: smallest to largest.'
                                        if any(member.is_group() for member in members) else ''))
    with page.folded_part(f'All numbers of {part}'):
        page.table(table(MEASURED, members), css='numbers', header=names)


def answers():
    return [one for one in MEASURED if one.name in DRAWN]


def add_pictures(page, part, members, runs):
    """The end of the first run of each member, with a link to its report, and links to the reports of all runs."""
    reports = [(run.entry['name'], f'{run.entry["folder"]}/report.html') for run in runs
               if (run.data.folder / 'report.html').exists()]
    address = {run.data.folder: f'{run.entry["folder"]}/report.html' for run in runs}
    shown = [(figure, f'{part}-{name}', address[report.parent] if report.exists() else '')
             for figure, name, report in member_pictures.at_the_end(members[:MOST_PICTURES])]
    if shown:
        page.panels(shown, 'The last output, on one scale of colours'
                    + (', of the first seeds' if any(member.is_group() for member in members) else '')
                    + (f'; {MOST_PICTURES} of {len(members)}' if len(members) > MOST_PICTURES else '')
                    + '. A picture leads to the report of its run.', PICTURE_WIDTH)
    if reports:
        page.paragraph('Reports of the runs:')
        page.links(reports)


def header_of(members, keys, values):
    """What each member is called in a table: its swept values."""
    return ['', *[', '.join([*(f'{seeds_word(key)} {values[member.name][key]}'.strip() for key in keys
                               if values[member.name].get(key)),
                             f'{len(member.runs)} runs' if member.is_group() else '']).strip(', ')
                  or member.name for member in members]]


def numbers_of(key, members, values):
    """The swept values as numbers, None when they are not, and what they are called. Of lists that differ in one place
    alone, the numbers there."""
    try:
        lists = np.array([values[member.name][key].strip('[]').split(',') for member in members], dtype=float)
    except (KeyError, ValueError):
        return None, key
    varied = np.flatnonzero(np.ptp(lists, axis=0) > 0)
    if len(varied) != 1:
        return None, key
    return list(lists[:, varied[0]]), key if lists.shape[1] == 1 else f'{key}[{varied[0]}]'


def lines_of(key, members, values, abscissae):
    """{label of the other swept values: [(number, member)] in ascending order}."""
    lines = {}
    for x, member in zip(abscissae, members):
        others = [f'{seeds_word(k)} {v}' for k, v in values[member.name].items() if k not in (key, seeds.SEED)]
        lines.setdefault(', '.join(others), []).append((x, member))
    return {label: sorted(points, key=lambda point: point[0]) for label, points in lines.items()}


def seeds_word(key):
    return '' if key == 'variant' else key.rpartition('.')[2]


def draw_against(key, members, values):
    """(figure, name) per measured quantity; none where the key has no two numbers."""
    abscissae, title = numbers_of(key, members, values)
    if abscissae is None:
        return []
    shown = []
    for measured in (m for m in MEASURED if m.name in DRAWN):
        if not any(measured.of(run) is not None for member in members for run in member.runs):
            continue
        figure, axes = curves.panel(measured.title, title, measured.unit)
        for i, (label, points) in enumerate(lines_of(key, members, values, abscissae).items()):
            draw_line(axes, i, label.strip(), points, measured)
        if len(axes.get_legend_handles_labels()[1]) > 0:
            axes.legend(fontsize=8)
        shown.append((figure, measured.name))
    return shown


def draw_line(axes, i, label, points, measured):
    """Means over the seeds, joined; bars from the smallest to the largest."""
    found = [(x, [v for v in map(measured.of, member.runs) if v is not None]) for x, member in points]
    found = [(x, known) for x, known in found if known]
    if not found:
        return
    x = [place for place, _ in found]
    mean = np.array([np.mean(known) for _, known in found])
    # The mean of equal numbers may be off by rounding, and no bar may be negative.
    below = np.maximum(0.0, mean - [min(known) for _, known in found])
    above = np.maximum(0.0, np.array([max(known) for _, known in found]) - mean)
    spread = [below, above] if any(member.is_group() for _, member in points) else None
    axes.errorbar(x, mean, yerr=spread, marker=curves.MARKERS[i % len(curves.MARKERS)], markersize=4, capsize=3,
                  color=f'#{compare_page.colour_of(i)}', linestyle=curves.dash(i), label=label or None, linewidth=1.2)


def check_files(folder, figures):
    """What somebody keeps under the names of the results is not replaced by them."""
    page, table, statements = (folder / name for name in ('study.html', 'study.csv', 'paper.md'))
    files = {page: is_page(page, TITLE), table: beginning(table).startswith(','.join(COLUMNS) + ',')}
    if figures == 'paper':
        files[statements] = beginning(statements).startswith(paper.TITLE)
    require_own(files, 'It is not of a study. Rename it, and give the same line again: the runs are kept, and page and '
                'table are written.')


def write_results(folder):
    """True if everything was written."""
    record, runs = load(folder)
    figures = record.get('figures', '')
    check_files(folder, figures)
    working = Progress('study')
    working('tables and figures')
    page = make_page(record['study'], runs, shlex.join(record.get('command', [])))
    written = [FIGURE_SETS[figures](page, folder, runs)] if figures in FIGURE_SETS else []
    working.end()
    written += [page.write_pictures(folder / 'pictures'),
                write_whole(folder / 'study.csv', as_csv(runs)),
                write_whole(folder / 'study.html', page.text())]
    return all(written)


def main(arguments):
    if len(arguments) != 2:
        print('usage: study.py FOLDER   (of `turbidite study`)', file=sys.stderr)
        return 2
    try:
        return 0 if write_results(Path(arguments[1])) else 4
    except Refusal as refusal:
        print(f'turbidite study: {refusal}', file=sys.stderr)
        return 2


if __name__ == '__main__':
    sys.exit(main(sys.argv))
