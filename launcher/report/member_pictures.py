# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the members of a comparison side by side at the same times."""
import grain_files
import fluid_fields
import pictures
from differences import common_span
from document.typeset import plain
from space import scene, sequence
from space.camera import OBLIQUE

MOST_MEMBERS = 4
WIDTH_OF_LETTERS = 115.0  # points of size per inch and letter: a long name is not cut off
TIMES = 3  # the end of the common time, and equal parts of it


def add(page, members):
    """Of at most four members, the first seed of each; nothing where runs have no grains or share no time."""
    runs = [member.runs[0] for member in members[:MOST_MEMBERS]]
    rows = [row for run, row in zip(runs, map(series_of, runs)) if row and 'domain.size' in run.case]
    if len(rows) < len(runs):
        return
    span = rows[0][0][0], rows[0][-1][0]
    for row in rows[1:]:
        span = common_span(span, (row[0][0], row[-1][0]))
        if span is None:
            return
    times = [span[0] + (span[1] - span[0]) * k / TIMES for k in range(1, TIMES + 1)]
    whole = [[pictures.load(run, instant_near(run, row, time)) for time in times] for run, row in zip(runs, rows)]
    if any(picture.grains is None for row in whole for picture in row):
        return  # a file is missing or damaged, which the remarks say
    page.heading('Pictures')
    limit = common_limit(list(zip(runs, whole)))
    figures = [side_by_side(run, shown, limit) for run, shown in zip(runs, whole)]
    width = max(width_of(run, shown) for run, shown in zip(runs, whole))
    for k in range(TIMES):
        page.panels([titled(member, figures[i][k]) for i, member in enumerate(members[:MOST_MEMBERS])], '', width)
    page.paragraph(f'One scale of colours {"for all" if limit else "per run"}.' + (' Of groups the first seed.' if any(
        member.is_group() for member in members) else ''))


def side_by_side(run, shown, limit):
    """(figure, name) of a run's pictures; in space obliquely from above, coloured by the speed of the grains."""
    if not run.in_space():
        return pictures.panels(run, shown, limit)
    frame = scene.frame(run, [picture.grains for picture in shown], OBLIQUE)
    limit = limit or pictures.shown_limit(run, shown)
    return [(sequence.panel(run, frame, picture.grains, limit), f'sequence-{k}') for k, picture in enumerate(shown)]


def width_of(run, shown):
    """Pixels that a picture needs."""
    if run.in_space():
        return sequence.PANEL_WIDTH
    return pictures.panel_width(pictures.view(run, [picture.grains for picture in shown]))


def at_the_end(members):
    """(figure, name, report of the run or '') of the first run of each member at its last output, on one scale of colours;
    nothing for those without grains."""
    shown = [(member, picture) for member, picture in ((member, last(member.runs[0])) for member in members)
             if picture is not None and picture.grains is not None]
    if not shown:
        return []
    limit = common_limit([(member.runs[0], [picture]) for member, picture in shown])
    return [(*titled(member, (drawn(member.runs[0], picture, limit), 'end')), member.runs[0].folder / 'report.html')
            for member, picture in shown]


def last(run):
    if 'domain.size' not in run.case:
        return None
    every = pictures.all_instants(run) if (run.folder / 'grains' / 'grains.pvd').exists() else []
    return pictures.load(run, every[-1]) if every else None


def common_limit(shown):
    """Of the colours of all (run, pictures); None where some are those of a fluid and some of grains."""
    if len({pictures.shows_fluid(run) for run, _ in shown}) > 1:
        return None
    return max(pictures.shown_limit(run, some) for run, some in shown)


def drawn(run, picture, limit):
    return side_by_side(run, [picture], limit)[0][0]


def titled(member, picture):
    """(figure, name) with the member's name in title and file."""
    figure, name = picture
    axes = figure.axes[0]
    title = f'{member.name}, {axes.get_title()}'
    axes.set_title(title, fontsize=min(9.0, WIDTH_OF_LETTERS * figure.get_figwidth() / len(plain(title))))
    figure.set_label(f'{member.name}: {figure.get_label()}')
    return figure, f'{member.name}-{name}'.replace('/', '_')


def series_of(run):
    """(time [t_c], file of grains) of every output."""
    return [(time / run.scale('t_c'), path) for time, path in grain_files.quiet_series(run)]


def instant_near(run, row, time):
    """(time, grains, field or None) of the output nearest to `time`, as for pictures.load."""
    now, grains = min(row, key=lambda output: abs(output[0] - time))
    own = now * run.scale('t_c')
    near = [folder for at, folder in fluid_fields.field_times(run) if abs(at - own) <= 1e-6 * max(abs(own), 1.0)]
    return own, grains, near[0] if near else None
