# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a comparison: tables and figures of its members (seeds.Member), the first one solid."""
import matplotlib.pyplot as plt

import curves
import findings
import surface
from page import Page
from seeds import SEED


def number(value):
    return '' if value is None else f'{value:.4g}'


def percent(value):
    return '' if value is None else f'{100.0 * value:.3g} %'


def span(bounds):
    """`a to b`, or one number if they are equal."""
    low, high = (number(value) for value in bounds)
    return low if low == high else f'{low} to {high}'


def make_page(comparison):
    members = comparison.members
    page = Page('Comparison of ' + ', '.join(member.name for member in members))
    add_groups(page, members)
    page.table(overview(comparison), header=[''] + [member.name for member in members])
    add_parameters(page, comparison)
    page.heading('Curves')
    page.figure(draw_curves(comparison), 'curves', curves_caption(members))
    add_peaks(page, comparison)
    add_surfaces(page, comparison)
    add_differences(page, comparison)
    remarks = [f'{member.name}: {remark}' for member in members for remark in member.data.remarks]
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    return page


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


def overview(comparison):
    """Rows: a name, then one cell per member."""
    members, wall = comparison.members, comparison.wall
    rest = [findings.rest_time(member.data) for member in members]
    maxima = lambda name, column: [number(findings.largest(member.data, column, name))
                                   for member in members]
    ratios = lambda values: [number(v / values[0] if v and values[0] else None) for v in values]
    totals, windows = [total for total, _ in wall], [window for _, window in wall]
    return [
        ['status'] + [member.data.record.get('status', 'unknown') for member in members],
        ['last row [t_c]'] + [number(member.data.history['time'][-1]) for member in members],
        ['windows'] + [f'{member.data.history["step"][-1]:.0f}' for member in members],
        ['wall time [s]'] + [number(total) for total in totals],
        ['over the first\'s'] + ratios(totals),
        ['wall time of a window [s]'] + [number(window) for window in windows],
        ['over the first\'s'] + ratios(windows),
        ['at rest from [t_c]'] + ['not at rest' if value is None else number(value) for value in rest],
        ['largest overlap of any window [D]'] + maxima('penetration', 'max_penetration'),
        ['windows beyond contact.tolerance'] + maxima('unconverged_windows', ''),
    ]


def add_parameters(page, comparison):
    page.heading('Parameters that differ')
    if comparison.parameters:
        page.table([[key] + values for key, values in comparison.parameters],
                   header=['key'] + [member.name for member in comparison.members])
    else:
        page.paragraph('The cases are the same, key by key.')


# --- curves -------------------------------------------------------------------------------------------

def curves_caption(members):
    text = f'All against t/t_c. Solid: {members[0].name}, the first.'
    grouped = any(member.is_group() for member in members)
    return text + (' Lines: means over the seeds; bands: smallest to largest.' if grouped else '')


def draw_curves(comparison):
    quantities = comparison.quantities
    rows = -(-len(quantities) // 2)
    figure, axes = plt.subplots(rows, 2, squeeze=False, layout='constrained',
                                figsize=(11.0, 3.2 * rows))
    for quantity, place in zip(quantities, axes.flat):
        for i, member in enumerate(comparison.members):
            draw_member(place, i, member.name, member.data.column(quantity.column),
                        member.band(quantity.column) if member.is_group() else None)
        curves.decorate(place, quantity.title, quantity.unit)
        if quantity.logarithmic:
            curves.logarithmic(place)
    for unused in list(axes.flat)[len(quantities):]:
        unused.set_axis_off()
    axes.flat[0].legend(fontsize=8)
    return figure


def draw_member(axes, i, name, line, band):
    """Line and band (abscissae, low, high) of member `i`."""
    axes.plot(*line, label=name, color=f'C{i % 10}', linestyle='-' if i == 0 else '--', linewidth=1.4)
    if band is not None:
        axes.fill_between(*band, color=f'C{i % 10}', alpha=0.18, linewidth=0.0)


# --- the mean velocity --------------------------------------------------------------------------------

def add_peaks(page, comparison):
    rows = [[member.name, number(peaks.mean.value), number(peaks.mean.time), span(peaks.of('value')),
             span(peaks.of('time'))]
            for member in comparison.members for peaks in [comparison.peaks[member.name]] if peaks]
    if rows:
        page.heading('Peak of the mean velocity')
        page.paragraph('Largest |<u>| over u_c and its time over t_c: of the mean curve, and of the '
                       'single runs from the smallest to the largest.')
        page.table(rows, css='numbers', header=['', 'of the mean', 'at', 'of single runs', 'at'])
    if comparison.pairs:
        page.heading('Differences of the mean velocity')
        page.paragraph('Of |<u>|(t) between every two, over the time both cover, divided by the peak of '
                       'the first one.')
        page.table([[pair.first, pair.second, percent(pair.largest), percent(pair.mean),
                     f'{pair.begin:g} to {pair.end:g}'] for pair in comparison.pairs], css='numbers',
                   header=['', 'and', 'largest', 'mean over time', 't/t_c'])


def add_surfaces(page, comparison):
    shown = [(i, member.name, comparison.surfaces[member.name])
             for i, member in enumerate(comparison.members) if comparison.surfaces[member.name]]
    if not shown:
        return
    page.heading('Surface at the end')
    figure, axes = plt.subplots(figsize=(11.0, 4.0), layout='constrained')
    for i, name, found in shown:
        x, high, low, height = surface.trimmed(found.x, found.high, found.low, found.height)
        draw_member(axes, i, f'{name}, t = {found.time:g}', (x, height),
                    (x, low, high) if found.runs > 1 else None)
    surface.decorate(axes)
    page.figure(figure, 'surface', 'Highest point of the grains in each column of one D at the last '
                                   'output.')


# --- differences from the first -----------------------------------------------------------------------

def add_differences(page, comparison):
    page.heading(f'Differences from {comparison.members[0].name}')
    page.paragraph('Over the time both runs cover, interpolated linearly; rms in time; relative to the '
                   'largest value of the first run. End values are those of each run\'s last row.')
    page.table(difference_rows(comparison), css='numbers',
               header=['quantity', 'run', 'rms', 'relative', 'largest', 'relative', 'end value'])


def difference_rows(comparison):
    return [[quantity.title, member.name, number(n['rms']), percent(n['rms_relative']),
             number(n['max']), percent(n['max_relative']), number(n['end_value'])]
            for quantity in comparison.quantities for member in comparison.members
            for n in [comparison.measured[member.name][quantity.column]]]
