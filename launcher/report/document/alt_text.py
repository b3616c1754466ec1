# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a figure shows, in words, for those who do not see it: its label where it has one (`set_label`), otherwise what its
axes, lines and colour bars say."""
import numpy as np

from document.typeset import plain

LONGEST = 400  # characters


def described(figure):
    if figure.get_label():
        return figure.get_label()
    told = '. '.join(text for text in map(of_axes, figure.axes) if text)
    return told if len(told) <= LONGEST else told[:LONGEST].rsplit(' ', 1)[0] + ' …'


def of_axes(axes):
    title, across, up = plain(axes.get_title()), plain(axes.get_xlabel()), plain(axes.get_ylabel())
    if not title:  # a colour bar has its own label
        return f'Colour: {across or up}' if across or up else ''
    text = title
    if across and up:
        text += f': {up} against {across}'
    return text + reach(axes) + lines(axes)


def reach(axes):
    """Between which values the lines are."""
    seen = [np.asarray(line.get_ydata(), dtype=float) for line in axes.lines if line.get_transform() == axes.transData]
    values = np.concatenate(seen) if seen else np.empty(0)
    values = values[np.isfinite(values)]
    return f', from {values.min() + 0.0:.3g} to {values.max() + 0.0:.3g}' if len(values) else ''


def lines(axes):
    names = [plain(name) for name in axes.get_legend_handles_labels()[1]]
    return f'; lines: {"; ".join(names)}' if names else ''
