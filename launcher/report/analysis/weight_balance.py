# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who carries the weight of the grains: contacts (effective stress), the liquid, or nobody, so that they accelerate.

At a level y, of all grains whose centres are above it,

    N(y) + F(y) - W(y) = d/dt of their vertical momentum

N the vertical force that contacts hand up through the level (those between a grain above and one below or the floor,
and those of the grains above with side walls), F the vertical force of the liquid on them, buoyancy apart, W their
submerged weight. Forces are in units of the submerged weight of all grains. Grains with a prescribed motion are no part
of the balance: they carry the others as walls do.
"""
from dataclasses import dataclass

import numpy as np

import solid
from analysis import snapshots
from analysis.once import once_per_run

LEVELS = 1.0     # D apart
FLOOR = -3       # id of the bottom wall in contacts.pvd
SETTLED = 1e-3   # u_c: below this mean speed the balance has to close


@dataclass
class Profile:
    time: float           # t_c
    level: np.ndarray     # y [D]
    weight: np.ndarray    # W(y)
    contacts: np.ndarray  # N(y)
    fluid: np.ndarray     # F(y), 0 in dry runs


def submerged_share(run):
    """1 - rho_f/rho_s in a fluid, 1 in dry runs; rho_s of the grains at first."""
    return 1.0 - 1.0 / solid.first_mean_density(run) if run.is_wet() else 1.0


def weights_of(run, snapshot):
    """Submerged weights of the grains [rho_s g D^2]."""
    return snapshot.areas * submerged_share(run) if snapshot.weights is None else snapshot.weights


def on_free(run, snapshot):
    """(heights [D], submerged weights, vertical forces of the liquid [rho_s g D^2]) of the free grains."""
    free = snapshot.free()
    lift = np.zeros(len(free)) if snapshot.fluid_force is None else snapshot.fluid_force[:, 1]
    return snapshot.centres[free, 1], weights_of(run, snapshot)[free], lift[free]


def profile(run, snapshot):
    """None without contacts, or for grains that weigh nothing in the fluid."""
    heights, weights, lift = on_free(run, snapshot)
    total = weights.sum()
    if snapshot.contacts is None or not total > 0.0:
        return None
    level = np.arange(0.0, heights.max(), LEVELS)
    return Profile(snapshot.time, level, above(level, heights, weights) / total,
                   handed_up(snapshot.contacts, level, snapshot.prescribed_ids()) / total,
                   above(level, heights, lift) / total)


def above(level, heights, values):
    """Sums of the values whose height exceeds each level."""
    order = np.argsort(heights)
    sums = np.append(np.cumsum(values[order][::-1])[::-1], 0.0)
    return sums[np.searchsorted(heights[order], level, side='right')]


def handed_up(contacts, level, prescribed=()):
    """Vertical force on the free bodies above each level by contacts with what is not above it. Walls and the grains with
    `prescribed` ids are above no level."""
    held_a, held_b = held(contacts, prescribed)
    upper = np.where(held_b, -np.inf, contacts.ends[:, 1, 1])  # centre of b
    lower = np.where(held_a, -np.inf, contacts.ends[:, 0, 1])
    force = contacts.force[:, 1]    # on b; -force on a
    return above(level, upper, force) - above(level, lower, force)


def held(contacts, prescribed):
    """(a, b) of each contact: a wall, or a grain with one of these ids."""
    return (contacts.first < 0) | np.isin(contacts.first, prescribed), np.isin(contacts.second, prescribed)


def supports(contacts, prescribed, sides):
    """Vertical forces on the free grains by the bottom wall, by other `sides` of the box, by walls inside it, and by
    grains with these ids. Walls have the numbers below 0, first those of the sides."""
    force, (held_a, held_b) = contacts.force[:, 1], held(contacts, prescribed)
    wall, inside = contacts.first < 0, contacts.first < -sides
    floor = contacts.first == FLOOR
    return (force[floor & ~held_b].sum(), force[wall & ~floor & ~inside & ~held_b].sum(), force[inside & ~held_b].sum(),
            force[held_a & ~wall & ~held_b].sum() - force[~held_a & held_b].sum())


@dataclass
class Carriers:
    """Shares of the submerged weight of the grains whose motion is not prescribed, over the snapshots with contacts."""

    time: np.ndarray
    floor: np.ndarray
    sides: np.ndarray       # of the box
    inner: np.ndarray       # walls inside the box
    prescribed: np.ndarray  # grains with a prescribed motion
    fluid: np.ndarray
    all_contacts: np.ndarray  # the mean over the window: with springs the others are those of the last sub-step

    def contacts(self):
        return self.all_contacts

    def rest(self):
        """What is carried by nothing: it accelerates the grains downwards."""
        return 1.0 - self.contacts() - self.fluid


@once_per_run
def carriers(run):
    """None without contacts in the outputs."""
    rows = []
    for one in snapshots.snapshots(run):
        _, weights, lift = on_free(run, one)
        if one.contacts is None or not weights.sum() > 0.0:
            continue
        parts = supports(one.contacts, one.prescribed_ids(), 6 if run.in_space() else 4)
        # Those among free grains cancel.
        everything = sum(parts) if one.contact_force is None else one.contact_force[one.free(), 1].sum()
        rows.append((one.time, *np.array([*parts, lift.sum(), everything]) / weights.sum()))
    return Carriers(*np.array(rows).T) if rows else None


def final_defect(run):
    """|1 - what carries the weight| at the last output of grains at rest (mean speed below 1e-3 u_c); else None."""
    found, speed = carriers(run), run.end('mean_speed')
    if found is None or speed is None or speed > SETTLED:
        return None
    return float(abs(found.rest()[-1]))


def least_on_contacts(run):
    """Smallest share of the weight on floor, walls and prescribed grains after the start of an avalanche."""
    found = carriers(run)
    return float(found.contacts().min()) if found is not None and run.is_avalanche() else None
