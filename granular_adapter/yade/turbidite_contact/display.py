# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts where YADE's own tools expect them: in O.interactions and O.forces.

YADE has one interaction between two bodies, so the points of a pair are combined at their common centre of force.
Forces are the impulses of the last contact problem over the step; the force of an interaction acts on id2.
"""
from yade import utils
from yade.minieigenHP import Vector3, Vector3i
from yade.wrapper import FrictPhys, Omega, ScGeom

O = Omega()


def show(contacts, impulses, dt):
    """Fills O.interactions and adds contact forces and torques to O.forces."""
    clear()
    for (id1, id2), points in by_pair(contacts).items():
        interaction = utils.createInteraction(id1, id2, True)
        interaction.cellDist = Vector3i(0, 0, 0) if points[0].wall else periods(position(id1), position(id2))
        interaction.geom, interaction.phys = geometry(id1, id2, points, interaction.cellDist), forces(points)
    for body, impulse, moment in impulses:
        O.forces.addF(body, Vector3(*impulse) / dt)
        O.forces.addT(body, Vector3(*moment) / dt)
    for contact in contacts:
        if contact.wall:  # walls are not bodies of the engine
            O.forces.addF(contact.id1, -contact.force)
            O.forces.addT(contact.id1, (contact.point - O.bodies[contact.id1].state.pos).cross(-contact.force))
    if impulses:  # sum now: ForceResetter does not clear what was added since the last sum
        O.forces.f(impulses[0][0], True)


def clear():
    O.interactions.clear()


def by_pair(contacts):
    pairs = {}
    for contact in contacts:
        pairs.setdefault((contact.id1, contact.id2), []).append(contact)
    return pairs


def position(body):
    return O.bodies[body].state.pos


def periods(place, other):
    """How many periods of the cell lie between `other` and that of its images which is nearest to `place`."""
    if not O.periodic:
        return Vector3i(0, 0, 0)
    return Vector3i(*(round((place[k] - other[k]) / O.cell.size[k]) for k in range(3)))


def moved(place, cells):
    return place + O.cell.hSize * Vector3(*cells) if O.periodic else place


def geometry(id1, id2, points, cells):
    weight = sum(p.normal_force.norm() for p in points)
    geom = ScGeom()
    # Under traction at all points (cohesion) the same weights apply; without normal forces, the mean position.
    shares = [p.normal_force.norm() / weight if weight else 1 / len(points) for p in points]
    point = sum((share * p.point for share, p in zip(shares, points)), Vector3.Zero)
    # As YADE has it: at id1, beside the image of id2.
    geom.contactPoint = point if points[0].wall else moved(point, periods(position(id1), point))
    normal = sum((share * p.normal for share, p in zip(shares, points)), Vector3.Zero)
    geom.normal = normal / normal.norm()
    centres = position(id1), moved(position(id2), cells)
    geom.refR1, geom.refR2 = ((geom.contactPoint - centre).norm() for centre in centres)
    return geom


def forces(points):
    phys = FrictPhys()
    phys.normalForce = sum((p.normal_force for p in points), Vector3.Zero)
    phys.shearForce = sum((p.shear_force for p in points), Vector3.Zero)
    return phys

