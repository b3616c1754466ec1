# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE bodies that move in the plane: discs and convex polygons with a given thickness along z."""
import math

from turbidite_contact_engine import check_outline
from yade import utils
from yade.minieigenHP import Vector3
from yade.wrapper import Body, Polyhedra

from .refusal import Refused

PLANAR = 'zXY'


def disc(center, radius, thickness=1.0, fixed=False, **kw):
    """A Sphere with the mass and moment of inertia of a disc (rho pi R^2 t, m R^2 / 2) that moves in the plane.

    Other arguments are those of utils.sphere.
    """
    return make_disc(utils.sphere(center, radius, fixed=fixed, **kw), thickness)


def make_disc(body, thickness=1.0):
    """Gives a Sphere the mass, moment of inertia and degrees of freedom of a disc; fixed ones stay fixed."""
    radius, state = body.shape.radius, body.state
    state.mass = body.mat.density * math.pi * radius**2 * thickness
    state.inertia = Vector3(1, 1, 2) * (0.25 * state.mass * radius**2)
    if state.blockedDOFs != 'xyzXYZ':
        state.blockedDOFs = PLANAR
    return body


def polygon(vertices, thickness=None, z=0.0, fixed=False, material=-1, color=None, **kw):
    """A convex polygon as a Polyhedra: the prism over the vertices (x, y), which YADE can draw.

    Mass and moment of inertia are those of the prism; its position is the centre of mass. The default thickness
    is a tenth of the largest extent, thin enough for z to be one of YADE's axes of the body.
    """
    if len(vertices) < 3:
        raise Refused(f'turbidite_contact: a polygon has at least 3 vertices, not {len(vertices)}')
    check_vertices(vertices)
    extent = max(math.dist(a, b) for a in vertices for b in vertices)
    half = 0.5 * (0.1 * extent if thickness is None else thickness)
    corners = [Vector3(x, y, z + level) for level in (-half, half) for x, y in vertices]
    body = Body()
    body.shape = Polyhedra(v=corners, color=color if color else utils.randomColor(), **kw)
    centre, axes = body.shape.GetCentroid(), body.shape.GetOri()
    utils._commonBodySetup(body, body.shape.GetVolume(), body.shape.GetInertia(), material, pos=centre, fixed=fixed)
    body.state.ori = body.state.refOri = axes
    body.aspherical = True
    if not fixed:
        body.state.blockedDOFs = PLANAR
    return body


def check_vertices(vertices):
    """Polyhedra ends YADE for some of these, and makes a convex hull of others."""
    if not all(math.isfinite(coordinate) for vertex in vertices for coordinate in vertex):
        raise Refused(f'turbidite_contact: the vertices {list(vertices)} of a polygon must be finite')
    try:
        check_outline([coordinate for vertex in vertices for coordinate in vertex])
    except ValueError as error:
        raise Refused(f'turbidite_contact: the vertices {list(vertices)} are not those of a convex polygon '
                      f'({error})') from None
