# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls inside the box in space (grains/walls.csv, launcher/case/walls/space_walls.hpp) as lines in a picture: rims and
edges, and lines along round walls. What lies behind the grains is drawn behind them, the rest thinly over them.
"""
import numpy as np
from matplotlib.collections import LineCollection

import grain_files
import plates

AROUND = 72           # pieces of a rim
LENGTHWISE = 12       # lines along a round wall
BEHIND = {'linewidths': 0.7, 'colors': '#6f6f6f', 'zorder': 0.5}
BEFORE = {'linewidths': 0.5, 'colors': '#3c3c3c', 'alpha': 0.45, 'zorder': 2}


def draw(axes, run, shown, time):
    """Adds the walls to the picture of a scene.Frame; `time` in t_c."""
    behind, before = [], []
    for wall in grain_files.walls_of(run):
        for line, outwards in lines(wall):
            points, outwards = placed(run, wall, time, line, outwards)
            facing = shown.camera.seen(outwards)[:, 2]
            seen = shown.camera.seen(points)[:, :2]
            for k in range(len(seen) - 1):
                (before if facing[k] + facing[k + 1] > 0.0 else behind).append(seen[k:k + 2])
    axes.add_collection(LineCollection(behind, **BEHIND))
    axes.add_collection(LineCollection(before, **BEFORE))


def extent(run):
    """(low, high) of all walls at t = 0 [D]; None without walls."""
    points = [line for wall in grain_files.walls_of(run) for line, _ in lines(wall)]
    return (np.concatenate(points).min(axis=0), np.concatenate(points).max(axis=0)) if points else None


def lines(wall):
    """(points (n, 3), directions away from the wall's middle (n, 3)) of each line at t = 0 [D]."""
    place, a = vector(wall, 'x', 'y', 'z'), vector(wall, 'ax', 'ay', 'az')
    if wall['kind'] == 'plate':
        b = vector(wall, 'bx', 'by', 'bz')
        corners = place + np.array([0 * a, a, a + b, b, 0 * a])
        return [(corners, corners - (place + 0.5 * (a + b)))]
    first = float(wall['r1'])
    second = float(wall['r2']) if wall['kind'] in ('cone', 'ring') else first
    end = place if wall['kind'] == 'ring' else place + a
    found = [rim for middle, radius in ((place, first), (end, second)) if radius > 0.0
             for rim in [circle(middle, a, radius)]]
    if wall['kind'] != 'ring':
        turns = np.linspace(0.0, AROUND, LENGTHWISE, endpoint=False).astype(int)
        rims = [circle(middle, a, max(radius, 1e-9)) for middle, radius in ((place, first), (end, second))]
        found += [(np.array([rims[0][0][k], rims[1][0][k]]), np.array([rims[0][1][k]] * 2)) for k in turns]
    return found


def circle(middle, axis, radius):
    """Its points and the directions away from its axis."""
    axis = axis / np.linalg.norm(axis)
    across = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.6 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    angle = np.linspace(0.0, 2.0 * np.pi, AROUND + 1)[:, None]
    outwards = np.cos(angle) * across + np.sin(angle) * np.cross(axis, across)
    return middle + radius * outwards, outwards


def placed(run, wall, time, points, directions):
    """Where a line and its directions are at a time [t_c]."""
    moved, turn = shift(run, wall, time)
    pivot = vector(wall, 'px', 'py', 'pz')
    rotation = rotation_of(turn)
    return pivot + moved + (points - pivot) @ rotation.T, directions @ rotation.T


def shift(run, wall, time):
    """(displacement [D], rotation vector) since t = 0."""
    name = wall.get('motion')
    if not name:
        return time * vector(wall, 'vx', 'vy', 'vz'), time * vector(wall, 'wx', 'wy', 'wz')
    kind = run.case[f'domain.motions.{name}.kind']
    return {'constant': _constant, 'harmonic': _harmonic, 'table': _table}[kind](run, name, time)


def rotation_of(turn):
    """(3, 3), by Rodrigues' formula."""
    angle = np.linalg.norm(turn)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = turn / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def vector(wall, *columns):
    return np.array([float(wall.get(column) or 0.0) for column in columns])


def _axis(run, name):
    axis = _numbers(run, name, 'axis', '[0, 0, 1]')
    return axis / np.linalg.norm(axis)


def _value(run, name, part, default='0'):
    return run.given(f'domain.motions.{name}.{part}') or default


def _numbers(run, name, part, default='[0, 0, 0]'):
    return np.array([float(v) for v in _value(run, name, part, default).strip('[]').split(',')])


def _constant(run, name, time):
    return time * _numbers(run, name, 'velocity'), time * float(_value(run, name, 'spin')) * _axis(run, name)


def _harmonic(run, name, time):
    phase, period = float(_value(run, name, 'phase')), float(_value(run, name, 'period', '1'))
    share = np.sin(2.0 * np.pi * time / period + phase) - np.sin(phase)
    return share * _numbers(run, name, 'amplitude'), share * float(_value(run, name, 'turn')) * _axis(run, name)


def _table(run, name, time):
    rows = _numbers(run, name, 'table').reshape(-1, 4)
    return np.array([np.interp(time, rows[:, 0], rows[:, k]) for k in (1, 2, 3)]), np.zeros(3)
