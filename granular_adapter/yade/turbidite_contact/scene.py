# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's bodies as input of the contact engine, or a refusal that names the body.

    Sphere             disc, in space a sphere; mass and moment of inertia are those of its state
    Polyhedra, Box     convex polygon: prisms whose axis is z; in the plane only
    Wall               half-plane, in space (where axis may be 2) a half-space
    Facet              segment, where it crosses the plane of motion; in the plane only

Bodies move in the plane, if free ones have blockedDOFs 'zXY' (or 'zXYZ', without rotation), or in space, if they have
'' (or 'XYZ'). All others are fixed or driven by their velocity ('xyzXYZ').
"""
import math

from yade.minieigenHP import Matrix3
from yade.wrapper import Omega

from . import outlines
from .materials import Materials
from .refusal import Refused, refuse

O = Omega()
FIXED, FREE, NO_ROTATION = set('xyzXYZ'), set('zXY'), set('zXYZ')
FREE_IN_SPACE, NO_ROTATION_IN_SPACE = set(), set('XYZ')
SAME_PLANE = 1e-6  # of a radius
SAME_INERTIA = 1e-9


def read_scene():
    """The present scene as a Scene; raises Refused."""
    in_space = moves_in_space()
    period = period_of_cell(in_space)
    builder = SpaceBuilder() if in_space else Builder()
    walls = []
    for body in O.bodies:
        check_body(body)
        kind = type(body.shape).__name__
        if kind in ('Wall', 'Facet'):
            walls.append(body)
        elif kind in builder.SHAPES:
            builder.add_body(body, kind)
        else:
            refuse(body, f'has a shape that is not supported {builder.WHERE} ({kind})',
                   f'supported are {", ".join(builder.SHAPES + builder.WALLS)}')
    for body in walls:
        builder.add_wall(body)
        period[getattr(body.shape, 'axis', 2)] = 0.0  # an axis bounded by a wall is not periodic
    return builder.scene(period)


def moves_in_space():
    """Whether some sphere is free to move along all axes."""
    return any(type(body.shape).__name__ == 'Sphere' and not body.isClumpMember
               and not set(body.state.blockedDOFs) & set('xyz') for body in O.bodies)


def period_of_cell(in_space):
    """Period of each axis [m], 0 if it is not periodic."""
    if not O.periodic:
        return [0.0, 0.0, 0.0]
    cell = O.cell
    # `velGrad = ...` sets the next one, which YADE's integrator takes over.
    if Matrix3(cell.velGrad) != Matrix3.Zero or Matrix3(cell.nextVelGrad) != Matrix3.Zero:
        raise Refused('turbidite_contact: the periodic cell deforms (O.cell.velGrad); only cells at rest are '
                      'supported')
    if any(cell.hSize[i][j] != 0 for i in range(3) for j in range(3) if i != j):
        raise Refused('turbidite_contact: the periodic cell is skewed (O.cell.hSize); only boxes are supported')
    return [cell.size[0], cell.size[1], cell.size[2] if in_space else 0.0]


def check_body(body):
    """Requirements on every body."""
    if body.isClump or body.isClumpMember:
        refuse(body, 'is a clump or part of one', 'clumps are not supported; use a Polyhedra')
    if body.shape is None:
        refuse(body, 'has no shape', 'erase it')
    numbers = [*body.state.pos, *body.state.vel, *body.state.angVel]
    if not all(math.isfinite(x) for x in numbers):
        refuse(body, 'has a position or velocity that is not finite', 'set it')


class Scene:
    """`layout`: input of the engine; `ids` of its bodies, in order; `wall_states` as in the layout."""

    def __init__(self, layout, ids, wall_states):
        self.layout, self.ids, self.wall_states = layout, ids, wall_states
        self.cell = present_cell()

    def walls(self):
        """Their ids."""
        return [wall['key'] for wall in self.layout['walls']]

    def members(self):
        """The ids of bodies and walls."""
        return self.ids + self.walls()

    def changed(self):
        """Whether the cell is another one, or a wall is free; the engine looks at the bodies themselves."""
        return present_cell() != self.cell or any(
            state.blockedDOFs != 'xyzXYZ' for state in self.wall_states)


def present_cell():
    """What the engine takes from O.cell; None without a periodic cell."""
    cell = O.cell
    return (Matrix3(cell.hSize), Matrix3(cell.velGrad), Matrix3(cell.nextVelGrad)) if O.periodic else None


class Builder:
    """Of scenes in the plane."""

    DIMENSION, WHERE = 2, 'in the plane'
    SHAPES, WALLS = ('Sphere', 'Polyhedra', 'Box'), ('Wall', 'Facet')

    def __init__(self):
        self.materials = Materials()
        self.shapes, self.walls, self.bodies, self.states, self.wall_states = [], [], [], [], []
        self.turns = []
        self.plane = None  # z of the plane of motion, and the body that defines it
        self.mask = ~0
        self.shape_numbers = {}

    def scene(self, period):
        layout = {'dimension': self.DIMENSION, 'shapes': self.shapes, 'frictions': self.materials.frictions, 'bodies': self.bodies,
                  'states': self.states, 'turns': self.turns, 'walls': self.walls,
                  'wall_states': self.wall_states, 'period': period, 'count': len(O.bodies),
                  'watched': list(O.bodies)}
        return Scene(layout, [record['id'] for record in self.bodies], self.wall_states)

    # ---- bodies ----

    def add_body(self, body, kind):
        outline = None if kind == 'Sphere' else outlines.prism_outline(body)
        radius = outline.radius if outline else body.shape.radius
        if not radius > 0:
            refuse(body, f'has radius {radius}', 'it must be positive')
        self.check_plane(body, radius)
        self.check_mask(body)
        blocked = self.check_freedom(body)
        axis = outline.axis if outline else 2
        self.bodies.append({
            'id': body.id, 'shape': self.shape_number(outline), 'radius': radius,
            'density': body.mat.density, 'mass': body.state.mass, 'inertia': body.state.inertia[axis],
            'material': self.materials.number(body), 'fixed': blocked == FIXED,
            'rotation_blocked': 'Z' in blocked})
        if blocked != FIXED:
            self.check_inertia(body, self.bodies[-1])
        self.states.append(body.state)
        self.turns.append(outline.turn if outline else None)

    def shape_number(self, outline):
        record = {'kind': 'polygon', 'vertices': outline.vertices} if outline else {'kind': 'disc', 'vertices': []}
        key = (record['kind'], *record['vertices'])
        if key not in self.shape_numbers:
            self.shape_numbers[key] = len(self.shapes)
            self.shapes.append(record)
        return self.shape_numbers[key]

    def check_plane(self, body, radius):
        if self.plane is None:
            self.plane = (body.state.pos[2], body.id)
        if abs(body.state.pos[2] - self.plane[0]) > SAME_PLANE * radius:
            refuse(body, f'lies at z = {body.state.pos[2]:g}, body {self.plane[1]} at z = {self.plane[0]:g}',
                   'all bodies must lie in one plane')

    def check_mask(self, body):
        self.mask &= body.mask
        if not self.mask:
            refuse(body, f'has mask {body.mask}, which shares no bit with the masks of all others',
                   'groups that do not collide are not supported; give all bodies a common bit')

    def check_freedom(self, body):
        """The blocked degrees of freedom as a set; refuses motion that is not planar."""
        blocked, state = set(body.state.blockedDOFs), body.state
        out_of_plane = (state.vel[2], state.angVel[0], state.angVel[1])
        if any(speed != 0 for speed in out_of_plane):
            refuse(body, 'moves out of the plane (vel[2], angVel[0], angVel[1])', 'set these to zero')
        if blocked in (FIXED, FREE, NO_ROTATION):
            return blocked
        refuse(body, f'is blocked in one direction only (blockedDOFs = {state.blockedDOFs!r})',
               "supported are 'zXY', 'zXYZ' and 'xyzXYZ'")

    def check_inertia(self, body, record):
        if not (record['mass'] > 0 and math.isfinite(record['mass'])):
            refuse(body, f'has mass {record["mass"]}', 'a body that moves needs a positive mass')
        if 'Z' not in body.state.blockedDOFs and not (record['inertia'] > 0 and math.isfinite(record['inertia'])):
            refuse(body, f'has moment of inertia {record["inertia"]} about z',
                   "it must be positive; or block rotation: 'zXYZ'")

    # ---- walls ----

    def add_wall(self, body):
        """Position and normal are relative to the body's position, in its axes."""
        self.check_mask(body)
        state = body.state
        if state.blockedDOFs != 'xyzXYZ':
            refuse(body, f'is free to move (blockedDOFs = {state.blockedDOFs!r})',
                   'walls and facets must be fixed or driven by their velocity')
        if any(speed != 0 for speed in (state.vel[2], state.angVel[0], state.angVel[1])):
            refuse(body, 'moves out of the plane (vel[2], angVel[0], angVel[1])', 'set these to zero')
        record = self.half_plane(body) if type(body.shape).__name__ == 'Wall' else self.segment(body)
        self.walls.append({**record, 'key': body.id, 'material': self.materials.number(body)})
        self.wall_states.append(state)

    def half_plane(self, body):
        axis, state = body.shape.axis, body.state
        if axis == 2 and self.DIMENSION == 2:
            refuse(body, 'has its normal along z', 'the motion is in the plane; use axis 0 or 1')
        if any(speed != 0 for speed in state.angVel):
            refuse(body, 'rotates', 'a Wall keeps its axis; use a Facet')
        normal = [0.0, 0.0, 0.0]
        normal[axis] = float(body.shape.sense or self.side_of(body, axis))
        for record, other in zip(self.bodies, self.states):
            if not record['fixed'] and (other.pos[axis] - state.pos[axis]) * normal[axis] < 0:
                refuse(body, f'has the centre of body {record["id"]} behind it', 'move the body or the wall')
        return {'point': [0.0, 0.0, 0.0], 'normal': normal, 'half_length': None}

    def side_of(self, wall, axis):
        """The side of the wall on which all moving bodies are: +1 or -1."""
        sides, place = {}, wall.state.pos[axis]
        for record, state in zip(self.bodies, self.states):
            if not record['fixed']:
                sides.setdefault(1 if state.pos[axis] >= place else -1, record['id'])
        if len(sides) == 2:
            refuse(wall, f'has bodies on both sides ({sides[1]} and {sides[-1]})',
                   'give it a sense, or use a Facet or Box')
        return next(iter(sides), 1)

    def segment(self, body):
        a, b = outlines.facet_segment(body, self.plane[0] if self.plane else 0.0)
        length = math.dist(a, b)
        return {'point': [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0],
                'normal': [(a[1] - b[1]) / length, (b[0] - a[0]) / length, 0.0], 'half_length': 0.5 * length}


class SpaceBuilder(Builder):
    """Of scenes in space: spheres and half-spaces."""

    DIMENSION, WHERE = 3, 'in space'
    SHAPES, WALLS = ('Sphere',), ('Wall',)

    def shape_number(self, outline):
        if not self.shapes:
            self.shapes.append({'kind': 'sphere', 'vertices': []})
        return 0

    def check_plane(self, body, radius):
        pass

    def check_freedom(self, body):
        """The blocked degrees of freedom as a set."""
        blocked = set(body.state.blockedDOFs)
        if blocked not in (FIXED, FREE_IN_SPACE, NO_ROTATION_IN_SPACE):
            refuse(body, f'is blocked in some directions (blockedDOFs = {body.state.blockedDOFs!r}), while others move '
                   'in space', "supported are '', 'XYZ' and 'xyzXYZ'; 'zXY' if all bodies move in the plane")
        return blocked

    def check_inertia(self, body, record):
        super().check_inertia(body, record)
        moments = body.state.inertia
        if 'Z' not in body.state.blockedDOFs and max(moments) - min(moments) > SAME_INERTIA * max(moments):
            refuse(body, f'has moments of inertia {tuple(moments)} and is free in space',
                   "those of a sphere are equal; a disc that moves in the plane has blockedDOFs = 'zXY'")

    def add_wall(self, body):
        """Position and normal are relative to the body's position."""
        if type(body.shape).__name__ != 'Wall':
            refuse(body, 'is a Facet while bodies move in space', 'in space use Wall')
        self.check_mask(body)
        if body.state.blockedDOFs != 'xyzXYZ':
            refuse(body, f'is free to move (blockedDOFs = {body.state.blockedDOFs!r})',
                   'walls must be fixed or driven by their velocity')
        self.walls.append({**self.half_plane(body), 'key': body.id, 'material': self.materials.number(body)})
        self.wall_states.append(body.state)
