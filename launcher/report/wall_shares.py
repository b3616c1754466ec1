# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wall time in seconds per window of each participant, stacked over the run."""
import matplotlib.pyplot as plt

import curves

COLOURS = {'fluid': '#4477aa', 'grains': '#ccbb44', 'coupling': '#ee6677', 'rest': '#bbbbbb'}
REST = 'rest (messages, waiting)'


def figure(wall):
    """`wall` is a findings.WallTime."""
    names = list(wall.parts) + [REST]
    seconds = list(wall.parts.values()) + [wall.rest()]
    result, axes = plt.subplots(figsize=(curves.PANEL[0], curves.PANEL[1] + 0.7), layout='constrained')
    labels = [f'{name}: {_share(wall, part)}' for name, part in zip(names, seconds)]
    colours = [COLOURS.get(name, COLOURS['rest']) for name in names]
    milliseconds = [1e3 * part for part in seconds]
    if len(wall.time) == 1:
        _one_bar(axes, wall.time[0], milliseconds, labels, colours)
    else:
        axes.stackplot(wall.time, milliseconds, labels=labels, colors=colours)
    axes.plot(wall.time, 1e3 * wall.window, color='black', linewidth=1.2, label='window',
              marker='.' if len(wall.time) == 1 else None)
    curves.decorate(axes, 'Wall time of a window', 'milliseconds')
    axes.set_ylim(bottom=0.0)
    handles, texts = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], texts[::-1], fontsize=8, loc='upper center', bbox_to_anchor=(0.5, -0.16), ncols=2,
                frameon=False)
    return result


def _share(wall, seconds):
    return f'{100.0 * wall.total(seconds) / wall.total(wall.window):.3g} %'


def _one_bar(axes, time, heights, labels, colours):
    bottom = 0.0
    for height, label, colour in zip(heights, labels, colours):
        axes.bar(time, height, bottom=bottom, label=label, color=colour)
        bottom += height
