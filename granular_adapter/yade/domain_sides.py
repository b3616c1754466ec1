# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's walls at those sides of the domain that grains cannot pass."""
from yade import *
from yade import utils

# For grains an inflow is a wall, as in granular_adapter/grains/borders.cpp.
SOLID = ('wall', 'inflow')
NAMES = ('left', 'right', 'bottom', 'top', 'front', 'back')


def in_space(settings):
    return settings.get('run.dimension') == '3'


def create_walls(settings, material):
    """Adds a wall per solid side; returns side by body id, in the order 0 left, 1 right, 2 bottom, 3 top, and in space
    4 front, 5 back."""
    sides = {'left': (0, 0.0, 1), 'right': (0, float(settings['run.size_x']), -1),
             'bottom': (1, 0.0, 1), 'top': (1, float(settings['run.size_y']), -1)}
    if in_space(settings):
        sides.update(front=(2, 0.0, 1), back=(2, float(settings['run.size_z']), -1))
    return {O.bodies.append(utils.wall(position, axis, sense=sense, material=material)): number
            for number, (side, (axis, position, sense)) in enumerate(sides.items())
            if settings['domain.' + side] in SOLID}
