# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls inside the box (grains/walls.csv) where they are at a time: with their constant motion, or that of
domain.motions which they name (coupler/protocol/scene/prescribed_motion.hpp)."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

import grain_drawing
import grain_files

ENDS = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)  # angles of the points of a round end
THIN = 1.2  # points


def shift(run, wall, time):
    """(displacement [D], angle [rad]) of a wall since t = 0; `time` in t_c."""
    name = wall.get('motion')
    if not name:
        return time * _numbers(wall, 'vx', 'vy'), time * float(wall.get('spin') or 0.0)
    kind = run.case[f'domain.motions.{name}.kind']
    return {'constant': _constant, 'harmonic': _harmonic, 'table': _table}[kind](run, name, time)


def outline(run, wall, time):
    """Corners of a wall at a time [D], counter-clockwise, its ends round; two points without a thickness."""
    ends = np.array([_numbers(wall, 'x1', 'y1'), _numbers(wall, 'x2', 'y2')])
    half = 0.5 * float(wall.get('thickness') or 0.0)
    moved, angle = shift(run, wall, time)
    pivot = _numbers(wall, 'px', 'py') if wall.get('px') else ends.mean(axis=0)
    along = ends[1] - ends[0]
    turn = np.arctan2(along[1], along[0])
    if half > 0.0:
        cap = [np.column_stack([np.cos(turn + a + ENDS), np.sin(turn + a + ENDS)]) for a in (0.0, np.pi)]
        points = np.concatenate([ends[1] + half * cap[0], ends[0] + half * cap[1]])
    else:
        points = ends
    c, s = np.cos(angle), np.sin(angle)
    return pivot + moved + (points - pivot) @ np.array([[c, s], [-s, c]])


def draw(axes, run, time):
    """Adds the walls to a plot with axes in D; `time` in t_c."""
    outlines = [outline(run, wall, time) for wall in grain_files.walls_of(run)]
    thick, thin = [o for o in outlines if len(o) > 2], [o for o in outlines if len(o) == 2]
    if thick:
        axes.add_collection(PolyCollection(thick, facecolors=grain_drawing.EDGE, edgecolors='none'))
    if thin:
        axes.add_collection(LineCollection(thin, colors=grain_drawing.EDGE, linewidths=THIN))


def _numbers(wall, x, y):
    return np.array([float(wall.get(x) or 0.0), float(wall.get(y) or 0.0)])


def _value(run, name, part, default='0'):
    return run.given(f'domain.motions.{name}.{part}') or default


def _pair(text):
    return np.array([float(v) for v in text.strip('[]').split(',')])


def _constant(run, name, time):
    return time * _pair(_value(run, name, 'velocity', '[0, 0]')), time * float(_value(run, name, 'spin'))


def _harmonic(run, name, time):
    phase, period = float(_value(run, name, 'phase')), float(_value(run, name, 'period', '1'))
    share = np.sin(2.0 * np.pi * time / period + phase) - np.sin(phase)
    return share * _pair(_value(run, name, 'amplitude', '[0, 0]')), share * float(_value(run, name, 'turn'))


def _table(run, name, time):
    rows = _pair(_value(run, name, 'table')).reshape(-1, 3)
    return np.array([np.interp(time, rows[:, 0], rows[:, k]) for k in (1, 2)]), 0.0
