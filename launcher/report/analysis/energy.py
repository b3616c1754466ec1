# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the potential energy of the grains goes: their motion, contacts, the liquid.

Per window the coupler adds up the works of contacts and of the liquid on the grains (docs/outputs.md), so that

    d(E_kin + E_pot) = W_contacts + W_fluid + (dt/2) sum (M - m_f) g dU_y

The last term is that of grains that move with their new velocity; over any time it is at most (1 - rho_f/rho_s) g dt/2
times the change of the mean vertical velocity, weighted by the submerged weights of the grains. What the liquid receives,
-W_fluid, is its own kinetic energy (of the velocity fields, cells in grains taken off), and what viscosity dissipates or
flows out of the box: the rest.
Energies over (sum of m) u_c^2.
"""
from dataclasses import dataclass

import numpy as np

import fluid_fields
import grain_files
import solid
from analysis import snapshots
from analysis.once import UNREADABLE, once_per_run
from analysis.weight_balance import submerged_share, weights_of

MOST_FIELDS = 11
ROUNDING = 1e-9  # of files in ASCII
SAME_ROW = 1e-6  # of the time


@dataclass
class Budget:
    """From the first row on, while no grain has left."""

    time: np.ndarray       # t_c
    kinetic: np.ndarray    # change of the grains'
    potential: np.ndarray  # change, negative when they sink
    contacts: np.ndarray   # work on the grains, negative: dissipated
    fluid: np.ndarray
    splitting: np.ndarray  # the known term of the time integration
    known: np.ndarray      # bool: rows at which it is known

    def defect(self):
        """What remains unexplained, over the largest of the terms, at the known rows."""
        largest = max(np.abs(part).max() for part in (self.kinetic, self.potential, self.contacts, self.fluid))
        left = (self.kinetic + self.potential - self.contacts - self.fluid - self.splitting)[self.known]
        return left / largest if largest > 0.0 else left

    def spent(self):
        """Potential energy lost until the end, and kinetic energy if the grains end slower than they began."""
        return -self.potential[-1] - min(0.0, self.kinetic[-1])


@once_per_run
def budget(run):
    """None for runs of versions that do not write the works, where grains that leave at the bottom come in at the top,
    which changes their potential energy, where one leaves before the second row, and where grains are driven, on which
    nobody adds up the work."""
    time, contacts = run.column('contact_work')
    potential = run.column('potential_energy')[1]
    if not len(contacts) or len(potential) != len(contacts) + 1 or run.has_cyclic_floor() or drives_grains(run):
        return None
    whole = run.history['grains'] == run.history['grains'][0]
    rows = len(whole) if whole.all() else int(np.argmin(whole))
    if rows < 2:
        return None
    work = lambda name: np.append(0.0, np.nancumsum(run.history[name][1:rows]))
    change = lambda name: changes(run.history[name][:rows])
    step = float(run.case.get('time.step', 0.0)) * run.scale('t_c')
    gravity = float(run.record.get('g') or 1.0) / run.scale('u_c')
    fall, known = weighted_fall(run)
    return Budget(run.history['time'][:rows], change('kinetic_energy'), change('potential_energy'),
                  work('contact_work'), work('fluid_work') if run.is_wet() else np.zeros(rows),
                  0.5 * step * gravity * changes(fall[:rows]), known[:rows])


def drives_grains(run):
    return any((one.moving() & ~one.free()).any() for one in snapshots.snapshots(run))


def changes(values):
    return values - values[0]


def weighted_fall(run):
    """sum of (M - m_f) U_y over the sum of M at the rows [u_c], and at which of them it is known. The history has the
    number mean of U_y, which is all that equal grains need; how much that of unequal ones differs is known at the snapshots
    and taken linearly in between."""
    time = run.history['time']
    mean = submerged_share(run) * run.history['mean_velocity_y']
    there = [one for one in snapshots.snapshots(run) if len(one.ids)]
    if not there:
        return mean, np.ones(len(time), bool)
    apart = np.array([fall_of(run, one) - submerged_share(run) * one.velocities[:, 1].mean() for one in there])
    times = np.array([one.time for one in there])
    are_equal = np.ptp(apart) <= ROUNDING * max(1e-300, np.abs(mean).max())
    nearest = np.abs(time[:, None] - times).min(axis=1)
    return mean + np.interp(time, times, apart), are_equal | (nearest <= SAME_ROW * max(1.0, abs(time[-1])))


def fall_of(run, snapshot):
    """Masses and weights over rho_s D^2 (and g)."""
    weights = weights_of(run, snapshot)
    displaced = snapshot.areas / snapshot.density if run.is_wet() else 0.0
    return float((weights * snapshot.velocities[:, 1]).sum() / (weights + displaced).sum())


def largest_defect(run):
    found = budget(run)
    return None if found is None else float(np.abs(found.defect()).max())


def dissipated_share(run, part):
    """Of the energy that the grains have spent until the end, the share that went to contacts or to the fluid; None if they
    have spent none."""
    found = budget(run)
    if found is None or found.spent() <= 0.0:
        return None
    return float(0.0 - getattr(found, part)[-1] / found.spent())


@once_per_run
def fluid_kinetic(run):
    """(times [t_c], kinetic energy of the liquid outside grains) at up to 11 of the fields with grains; None without, and
    where walls inside the box move, whose cells would count as liquid."""
    there = snapshots.snapshots(run)
    if not run.is_wet() or not there or 'domain.size' not in run.case or grain_files.has_moving_walls(run):
        return None
    box = np.prod(run.size()) * (run.depth() if run.in_space() else 1.0)
    mass = there[0].areas.sum() * there[0].density  # in rho_f D^2, in space rho_f D^3
    times, fields = [], fluid_fields.field_times(run)
    for moment, folder in [fields[i] for i in snapshots.evenly(len(fields), MOST_FIELDS)]:
        try:
            grains = grain_files.grains_at(run, moment)
            square = fluid_fields.mean_square_velocity(run, moment, folder)
        except UNREADABLE as error:
            if run.in_space():  # the pictures of the plane note it
                run.remarks.append(f'Velocity of the liquid at {moment:g}: {error}')
            continue
        if grains is None or grains.velocities is None:
            continue
        whole = 0.5 * box * square / run.scale('u_c')**2
        times.append((moment / run.scale('t_c'), (whole - in_grains(run, grains)) / mass))
    return tuple(np.array(times).T) if times else None


def in_grains(run, grains):
    """Kinetic energy of the cells in grains, which move with them [rho_f D^2 u_c^2, in space D^3]: the sum of
    V/2 (f^d U^2 + f^(d+2) k^2 w^2), f = R_h/R, since the body in the liquid has the size f of the grain, k^2 = I/M."""
    f, dimensions = solid.ratios_in_liquid(run, grains), 3 if run.in_space() else 2
    speeds = (grains.speeds() / run.scale('u_c'))**2
    spins = 0.0 if grains.spins is None else (grains.spins**2).sum(axis=1) * run.scale('t_c')**2
    turning = f**(dimensions + 2) * solid.square_gyrations(run, grains) * spins
    return float(0.5 * (solid.volumes(run, grains) * (f**dimensions * speeds + turning)).sum())


def caption(run, found):
    share = lambda part: 0.0 - 100.0 * getattr(found, part)[-1] / found.spent()
    text = (f'Until t = {found.time[-1]:.4g} t_c the grains lose {-found.potential[-1]:.4g} m u_c² of potential energy each '
            '(mean)')
    if found.kinetic[-1] < 0.0:
        text += f', and {-found.kinetic[-1]:.4g} m u_c² of kinetic energy'
    if found.spent() > 0.0:
        parts = [f'{-share("kinetic"):.3g} % is their motion'] if found.kinetic[-1] >= 0.0 else []
        parts.append(f'{share("contacts"):.3g} % went to contacts')
        text += ': ' + ', '.join(parts + ([f'{share("fluid"):.3g} % to the liquid'] if run.is_wet() else []))
    return (text + f'. The budget closes to {np.abs(found.defect()).max():.1e} of its largest term, the part of the '
            f'time integration (at most {np.abs(found.splitting).max():.1e} m u_c²) included.')
