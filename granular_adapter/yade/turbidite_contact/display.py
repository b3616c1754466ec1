# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts where YADE's own tools expect them: in O.interactions and O.forces.

YADE has one interaction between two bodies, so the points of a pair are combined at their common centre of force.
Forces are the impulses of the last contact problem over the step; the force of an interaction acts on id2.
"""
from yade import utils
from yade.minieigenHP import Vector3
from yade.wrapper import FrictPhys, Omega, ScGeom

O = Omega()


def show(contacts, impulses, dt):
    """Fills O.interactions and adds contact forces and torques to O.forces."""
    clear()
    for (id1, id2), points in by_pair(contacts).items():
        interaction = utils.createInteraction(id1, id2, True)
        interaction.geom, interaction.phys = geometry(id1, id2, points), forces(points)
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


def geometry(id1, id2, points):
    weight = sum(p.normal_force.norm() for p in points)
    geom = ScGeom()
    # Under traction at all points (cohesion) the same weights apply; without normal forces, the mean position.
    shares = [p.normal_force.norm() / weight if weight else 1 / len(points) for p in points]
    geom.contactPoint = sum((share * p.point for share, p in zip(shares, points)), Vector3.Zero)
    normal = sum((share * p.normal for share, p in zip(shares, points)), Vector3.Zero)
    geom.normal = normal / normal.norm()
    geom.refR1, geom.refR2 = ((geom.contactPoint - O.bodies[i].state.pos).norm() for i in (id1, id2))
    return geom


def forces(points):
    phys = FrictPhys()
    phys.normalForce = sum((p.normal_force for p in points), Vector3.Zero)
    phys.shearForce = sum((p.shear_force for p in points), Vector3.Zero)
    return phys

