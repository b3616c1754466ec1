# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane outlines of YADE's shapes: prisms and triangles in space, in the plane of motion."""
import math

from turbidite_contact_engine import check_outline
from yade.minieigenHP import Quaternion, Vector3

from .refusal import refuse

# Rotations that bring a local axis to z, in the order in which they are tried.
_HALF = math.sqrt(0.5)
TURNS = {  # (index of the axis, its sign): w, x, y, z
    (2, 1): (1.0, 0.0, 0.0, 0.0), (2, -1): (0.0, 1.0, 0.0, 0.0),
    (0, 1): (_HALF, 0.0, -_HALF, 0.0), (0, -1): (_HALF, 0.0, _HALF, 0.0),
    (1, 1): (_HALF, _HALF, 0.0, 0.0), (1, -1): (_HALF, -_HALF, 0.0, 0.0),
}
TILT = 1e-6  # an axis that deviates more from z is refused


class Outline:
    """A convex polygon: vertices of unit circumradius, anticlockwise; `turn` rotates YADE's axes of the body to
    those of the outline; `axis` is the index of YADE's axis that is normal to the plane."""

    def __init__(self, vertices, radius, turn, axis):
        self.vertices, self.radius, self.turn, self.axis = vertices, radius, turn, axis


def prism_outline(body):
    """Outline of a Polyhedra or Box; refuses a body that is not a prism with its axis along z."""
    corners = box_corners(body.shape) if type(body.shape).__name__ == 'Box' else list(body.shape.v)
    axis = axis_along_z(body)
    if axis is None:
        refuse(body, 'has no axis along z', 'only prisms perpendicular to the plane of motion are supported')
    turn = Quaternion(*TURNS[axis])
    ends = split_by_level([turn * corner for corner in corners], body)
    vertices = anticlockwise(ends[1])
    check_prism(body, ends, vertices)
    check_convex(body, vertices)
    radius = max(math.hypot(x, y) for x, y in vertices)
    return Outline([c / radius for vertex in vertices for c in vertex], radius, TURNS[axis], axis[0])


def box_corners(shape):
    a, b, c = shape.extents
    return [Vector3(x, y, z) for x in (-a, a) for y in (-b, b) for z in (-c, c)]


def axis_along_z(body):
    """(index, sign) of the local axis that points along +z."""
    units = (Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ)
    for axis in TURNS:
        direction = axis[1] * (body.state.ori * units[axis[0]])
        if direction[2] > 0 and math.hypot(direction[0], direction[1]) < TILT:
            return axis
    return None


def split_by_level(corners, body):
    """Corners of the lower and of the upper end, as (x, y)."""
    low, high = min(c[2] for c in corners), max(c[2] for c in corners)
    if not high > low:
        refuse(body, 'is flat', 'a polygon is a prism of some thickness along z')
    ends = ([], [])
    for corner in corners:
        ends[corner[2] > 0.5 * (low + high)].append((corner[0], corner[1]))
    return ends


def anticlockwise(points):
    """Sorts anticlockwise about the origin, which is the centre of mass, from the negative x axis on."""
    return sorted(points, key=lambda point: math.atan2(point[1], point[0]))


def check_prism(body, ends, vertices):
    size = max(math.hypot(x, y) for x, y in vertices)
    other = anticlockwise(ends[0])
    if len(other) != len(vertices):
        refuse(body, 'is not a prism along z: its ends differ', 'extrude the polygon along z')
    for point in vertices:
        if min(math.dist(point, partner) for partner in other) > TILT * size:
            refuse(body, 'is not a prism along z: its ends differ', 'extrude the polygon along z')


def check_convex(body, vertices):
    try:
        check_outline([coordinate for vertex in vertices for coordinate in vertex])
    except ValueError as error:
        refuse(body, f'is not a convex polygon ({error})', 'give it other vertices')


def facet_segment(body, plane):
    """Ends ((x, y), (x, y)) of the line in which a facet crosses z = plane, in the facet's axes."""
    level = plane - body.state.pos[2]
    normal = body.state.ori * Vector3.UnitZ
    if normal[0] != 0 or normal[1] != 0:
        refuse(body, 'is tilted', 'its orientation may be a rotation about z only; move the vertices instead')
    corners = list(body.shape.vertices)
    rounding = TILT * max(corner.norm() for corner in corners)
    points = set()
    for a, b in zip(corners, corners[1:] + corners[:1]):
        below, above = a[2] - level, b[2] - level
        if abs(below) <= rounding:
            points.add((a[0], a[1]))
        elif abs(above) > rounding and below * above < 0:
            share = below / (below - above)
            points.add((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))
    if len(points) != 2:
        refuse(body, f'does not cross the plane of motion z = {plane:g} in a line',
               'use facets perpendicular to the plane')
    return sorted(points)
