# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a comparison: tables and figures of its members (seeds.Member), the first one solid."""
import os

import matplotlib.pyplot as plt
import numpy as np

import curves
import findings
import measured
import member_pictures
import run_data
import surface
from analysis import concentration
from differences import compared_times
from document.page import Page
from document.typeset import Code
from head import facts
from seeds import SEED

TITLE = 'Comparison of '  # of the page, by which it is known
LONGEST_LABEL = 24  # characters; legends must not hide the curves
MOST_LABELS = 6
SVG_DASHES = ('', '10 4', '10 3 2 3', '2 3', '12 3 2 3 2 3', '16 5', '5 5')


def number(value):
    return '' if value is None else f'{value:.4g}'


def percent(value):
    return '' if value is None else f'{100.0 * value:.3g} %'


def span(bounds):
    """`a to b`, or one number if they are equal."""
    low, high = (number(value) for value in bounds)
    return low if low == high else f'{low} to {high}'


def make_page(comparison, folder, command):
    """`folder` is that of the page, from which it links to the reports of the runs."""
    members = comparison.members
    page = Page(TITLE + ', '.join(member.name for member in members))
    add_groups(page, members)
    page.links(report_links([run for member in members for run in member.runs], folder))
    page.paragraph(facts.units_in_words(members[0].data), 'note')
    if comparison.remark:
        page.paragraph(comparison.remark, 'remark')
    page.paragraph(['Made by: ', Code(command)], 'note')
    page.contents()
    add_overview(page, comparison)
    add_parameters(page, comparison)
    member_pictures.add(page, members)
    page.heading('Curves')
    add_curves(page, comparison)
    add_peaks(page, comparison)
    add_surfaces(page, comparison)
    add_concentration(page, members)
    add_analysis(page, members)
    add_differences(page, comparison)
    remarks = [f'{member.name}: {remark}' for member in members for remark in member.data.remarks]
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    return page


def report_links(runs, folder):
    """(name of the run, address) of the reports that are there."""
    reports = [(run.folder.resolve().name, run.folder / 'report.html') for run in runs]
    return [(name, os.path.relpath(path, folder)) for name, path in reports if path.exists()]


def add_groups(page, members):
    groups = [member for member in members if member.is_group()]
    if not groups:
        return
    page.paragraph(f'Runs whose cases differ in {SEED} alone are averaged and shown as one (--each keeps '
                   'them apart); bands in the figures reach from the smallest to the largest of their '
                   'values.')
    page.bullets([f'{member.name}: mean of '
                  + ', '.join(f'{run.folder.name} (seed {seed})'
                              for run, seed in zip(member.runs, member.seeds()))
                  for member in groups])


def add_overview(page, comparison):
    """What is the same for all is said once; what no member has is left out."""
    page.heading('Overview')
    rows = [row for row in overview(comparison) if any(row[1:])]
    same = [f'{name}: {values[0]}' for name, *values in rows if len(set(values)) == 1]
    page.table([row for row in rows if len(set(row[1:])) > 1], header=[''] + [member.name for member in comparison.members])
    if same:
        page.paragraph('The same for all: ' + '; '.join(same) + '.')


def with_ratios(values):
    """Numbers, and how many times the first they are."""
    first = values[0]
    return [number(value) + (f' ({value / first:.3g} times)' if k and value and first else '')
            for k, value in enumerate(values)]


def overview(comparison):
    """Rows: a name, then one cell per member."""
    members, wall = comparison.members, comparison.wall
    rest = [measured.spread([findings.rest_time(run) for run in member.runs]) for member in members]
    worst = lambda measure: [number(findings.of_worst(member.runs, measure)) for member in members]
    maxima = lambda name, column: worst(lambda run: findings.largest(run, column, name))
    wet = lambda name, column: [text if member.data.is_wet() else '' for text, member in
                                zip(maxima(name, column), members)]
    totals, windows = [total for total, _ in wall], [window for _, window in wall]
    return [
        ['status'] + [member.data.record.get('status', 'unknown') for member in members],
        ['made by'] + [made_by(member.data) for member in members],
        ['last row [t_c]'] + [number(member.data.history['time'][-1]) for member in members],
        ['windows'] + [f'{member.data.history["step"][-1]:.0f}' for member in members],
        ['wall time [s]'] + with_ratios(totals),
        ['wall time of a window [s]'] + with_ratios(windows),
        ['at rest from [t_c]'] + [text or 'not at rest' for text in rest],
        ['largest overlap of any window [D]'] + maxima('penetration', 'max_penetration'),
        ['windows beyond contact.tolerance'] + worst(findings.unconverged_windows),
        ['largest defect of the grains\' momentum'] + maxima('grain_balance', 'grain_balance'),
        ['largest defect of the fluid\'s momentum'] + wet('fluid_balance', 'fluid_balance'),
        ['largest Courant number'] + wet('courant', ''),
    ]


def made_by(run):
    version = (run.record.get('versions') or {}).get('turbidite', '?')
    return f'turbidite {version}, {run.record.get("prepared", "")[:10] or "no date"}'


def add_parameters(page, comparison):
    page.heading('Parameters that differ')
    if comparison.parameters:
        case = comparison.members[0].runs[0].folder / 'case.yaml'
        units = run_data.read_units(case) if case.exists() else {}
        page.table([[f'{key} [{units[key]}]' if key in units else key] + list(map(Code, values))
                    for key, values in comparison.parameters],
                   header=['key'] + [member.name for member in comparison.members])
    else:
        page.paragraph('The cases are the same, key by key.')


# --- curves -------------------------------------------------------------------------------------------

def curves_caption(members):
    text = f'All against t/t_c. The right one of two panels is the difference from {members[0].name}, the first.'
    grouped = any(member.is_group() for member in members)
    return text + (' Lines: means over the seeds; bands: smallest to largest.' if grouped else '')


def legend_entries(members):
    return [(member.name, f'#{colour_of(i)}', SVG_DASHES[i % len(SVG_DASHES)], member.is_group())
            for i, member in enumerate(members)]


def colour_of(i):
    return ('1f77b4', 'd95f02', '2c9e4b', 'c2185b', '6a3d9a', '8c564b', 'b8860b', '17a2b8', '555555', '9acd32')[i % 10]


def add_curves(page, comparison):
    page.legend(legend_entries(comparison.members))
    page.panels((panel for quantity in comparison.quantities for panel in quantity_panels(comparison, quantity)),
                curves_caption(comparison.members))


def curve_panel(comparison, quantity):
    """(figure, name) of the curves of all members."""
    members = comparison.members
    figure, axes = curves.panel(quantity.title, curves.TIME_LABEL, quantity.unit)
    for i, member in enumerate(members):
        draw_member(axes, i, member.name, member.data.column(quantity.column),
                    member.band(quantity.column) if member.is_group() else None)
    if quantity.logarithmic:
        curves.logarithmic(axes)
    name_lines(axes)
    return figure, f'curves-{quantity.column}'


def quantity_panels(comparison, quantity):
    """The curves of all members, and, unless logarithmic, their differences from the first."""
    members, shown = comparison.members, [curve_panel(comparison, quantity)]
    apart = [] if quantity.logarithmic else [
        (i, difference_curve(members[0].data.column(quantity.column), member.data.column(quantity.column)))
        for i, member in enumerate(members[1:], 1)]
    if any(curve is not None for _, curve in apart):
        other, beside = curves.panel(f'{quantity.title}: difference', curves.TIME_LABEL, quantity.unit)
        for i, curve in apart:
            if curve is not None:
                draw_member(beside, i, members[i].name, curve, None)
        beside.axhline(0.0, color=f'#{colour_of(0)}', linewidth=1.0, label=label_of(members[0].name))
        name_lines(beside)
        shown.append((other, f'difference-{quantity.column}'))
    return shown


def difference_curve(first, second):
    """(times, second - first) over their common time; None without one."""
    times, span = compared_times(first[0], second[0])
    if span is None:
        return None
    return times, np.interp(times, *second) - np.interp(times, *first)


def draw_member(axes, i, name, line, band):
    """Line and band (abscissae, low, high) of member `i`: its own dashes, colour and, far apart, markers, so that curves
    that coincide show."""
    every = max(1, len(line[0]) // 8)
    axes.plot(*line, color=f'#{colour_of(i)}', linestyle=curves.dash(i), linewidth=1.4, label=label_of(name),
              marker=curves.MARKERS[i % len(curves.MARKERS)], markersize=3.5, markevery=(i * every // 3, every))
    if band is not None:
        axes.fill_between(*band, color=f'#{colour_of(i)}', alpha=0.18, linewidth=0.0)


def label_of(name):
    """The end of a long name tells members apart."""
    return (name if len(name) <= LONGEST_LABEL else '…' + name[1 - LONGEST_LABEL:]).replace('$', r'\$')


def name_lines(axes):
    """Pictures are used without the page and its legend as well."""
    if 1 < len(axes.get_legend_handles_labels()[1]) <= MOST_LABELS:
        axes.legend(fontsize=7.5, framealpha=0.7)


def draw_curves(comparison):
    """(figure, name) of the curves alone, for a study."""
    return (curve_panel(comparison, quantity) for quantity in comparison.quantities)


# --- the mean velocity --------------------------------------------------------------------------------

def add_peaks(page, comparison):
    found = [(member.name, comparison.peaks[member.name]) for member in comparison.members
             if comparison.peaks[member.name]]
    if found:
        page.heading('Peak of the mean velocity')
        grouped = any(member.is_group() for member in comparison.members)
        page.paragraph('Largest |<u>| over u_c and its time over t_c' + (
            ': of the mean curve, and of the single runs from the smallest to the largest.' if grouped else '.'))
        page.table([peak_row(name, peaks, grouped) for name, peaks in found], css='numbers',
                   header=['', 'peak [u_c]', 'at [t_c]'] + (['of single runs [u_c]', 'at [t_c]'] if grouped else []))
    between_others = [pair for pair in comparison.pairs if pair.first != comparison.members[0].name]
    if between_others:
        page.heading('Differences of the mean velocity')
        page.paragraph('Of |<u>|(t) between every two but the first, over the time both cover, divided by the '
                       'largest value of the first named in that time.')
        page.table([[pair.first, pair.second, percent(pair.largest), percent(pair.mean),
                     f'{pair.begin:g} to {pair.end:g}'] for pair in between_others], css='numbers',
                   header=['', 'and', 'largest', 'mean over time', 't/t_c'])


def peak_row(name, peaks, grouped):
    of_single = [span(peaks.of('value')), span(peaks.of('time'))] if grouped else []
    return [name, number(peaks.mean.value), number(peaks.mean.time), *of_single]


def add_surfaces(page, comparison):
    shown = [(i, member.name, comparison.surfaces[member.name])
             for i, member in enumerate(comparison.members) if comparison.surfaces[member.name]]
    if not shown:
        return
    page.heading('Surface at the end')
    figure, axes = plt.subplots(figsize=curves.PANEL, layout='constrained')
    for i, name, found in shown:
        x, high, low, height = surface.trimmed(found.x, found.high, found.low, found.height)
        draw_member(axes, i, name, (x, height), (x, low, high) if found.runs > 1 else None)
    surface.decorate(axes)
    page.panels([(figure, 'surface')], 'Highest point of the grains in each column of one D at the last output: '
                + ', '.join(f'{name} at t = {found.time:g} t_c' for _, name, found in shown) + '.')


def add_concentration(page, members):
    """Solid share over height at the end, of runs that are no avalanches."""
    found = [(i, concentration.concentration(member.runs[0])) for i, member in enumerate(members)
             if not member.data.is_avalanche()]
    found = [(i, one) for i, one in found if one is not None]
    if not found:
        return
    figure, axes = curves.panel('Concentration over height at the end', 'solid share', r'$y\,/\,D$')
    for i, one in found:
        draw_member(axes, i, members[i].name, (one.shares[-1], 0.5 * (one.edges[1:] + one.edges[:-1])), None)
    name_lines(axes)
    page.heading('Concentration over height')
    page.panels([(figure, 'concentration')], 'Solid share of layers of one D'
                + (', first seeds.' if any(member.is_group() for member in members) else '.'))


def add_analysis(page, members):
    """The numbers of docs/analysis.md; of groups mean, smallest and largest."""
    rows = measured.table(measured.ANALYSIS, members)
    if rows:
        page.heading('Analysis')
        page.table(rows, header=[''] + [member.name for member in members], css='numbers')


# --- differences from the first -----------------------------------------------------------------------

def add_differences(page, comparison):
    page.heading(f'Differences from {comparison.members[0].name}')
    page.paragraph('Over the time both runs cover, at the rows of the run with fewer where the other has them too, otherwise '
                   'interpolated linearly at the rows of both; rms in time; relative to the largest value of the first '
                   'run in that time, by all of its own rows. End values are those of each run\'s last row.')
    page.table(difference_rows(comparison), css='numbers',
               header=['quantity', 'run', 'rms', 'relative', 'largest', 'relative', 'end value', 'of the first'])


def difference_rows(comparison):
    """Of each quantity a row per member but the first, whose end value stands in the first of them."""
    first, *others = comparison.members
    rows = []
    for quantity in comparison.quantities:
        for k, member in enumerate(others):
            n = comparison.measured[member.name][quantity.column]
            of_first = comparison.measured[first.name][quantity.column]['end_value']
            rows.append([measured.titled(quantity) if k == 0 else '', member.name, number(n['rms']),
                         percent(n['rms_relative']), number(n['max']), percent(n['max_relative']), number(n['end_value']),
                         number(of_first) if k == 0 else ''])
    return rows
