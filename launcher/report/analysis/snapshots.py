# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains and contacts at the output times, dimensionless: what the other measurements start from."""
from dataclasses import dataclass

import numpy as np

import grain_files
import solid
from analysis.once import once_per_run

MOST_SNAPSHOTS = 41  # as many as a curve of a measurement over files has points


@dataclass
class Contacts:
    """Contact points with an impulse; at a wall `first` is -1 - wall (0 left, 1 right, 2 bottom, 3 top)."""

    first: np.ndarray   # (n,) id
    second: np.ndarray  # (n,) id
    ends: np.ndarray    # (n, 2, 2) [D], from a (or the contact point at a wall) to b
    force: np.ndarray   # (n, 2) on b [rho_s g D^2]

    def branches(self):
        """(n, 2) from the centre of a (or the contact point at a wall) to that of b [D]."""
        return self.ends[:, 1] - self.ends[:, 0]


@dataclass
class Snapshot:
    """Grains at one time, in space as they are seen along z. Solid areas are those of discs of the grains' circumscribed
    radius, or of their outlines; in space they are the volumes of spheres [D^3], and forces are over rho_s g D^3. rho_s is
    the mean density of these grains."""

    time: float             # t_c
    ids: np.ndarray         # (n,)
    centres: np.ndarray     # (n, 2) [D]
    radii: np.ndarray       # (n,) [D]
    velocities: np.ndarray  # (n, 2) [u_c]
    areas: np.ndarray       # (n,) solid [D^2]
    fluid_force: np.ndarray  # (n, 2) buoyancy apart [rho_s g D^2]; None without a fluid
    contacts: Contacts      # None where the adapter tells none
    weights: np.ndarray = None  # (n,) submerged [rho_s g D^2]
    density: float = 1.0    # rho_s/rho_f
    prescribed: np.ndarray = None  # (n,) bool; None: no grain is
    velocity_z: np.ndarray = None  # (n,) [u_c]; None: of no grain
    spins: np.ndarray = None       # (n, 3) [1/t_c]; None: of no grain
    contact_force: np.ndarray = None  # (n, 2) mean of the window [rho_s g D^2]; None where the adapter tells none

    def free(self):
        """(n,) bool: grains whose motion is not prescribed."""
        return np.ones(len(self.ids), bool) if self.prescribed is None else ~self.prescribed

    def moving(self):
        """(n,) bool: grains that move along any axis or turn."""
        parts = [part for part in (self.velocities, self.velocity_z, self.spins) if part is not None]
        return (np.column_stack(parts) != 0.0).any(axis=1)

    def prescribed_ids(self):
        return self.ids[~self.free()]


def evenly(count, most=MOST_SNAPSHOTS):
    """Indices of at most so many of `count` entries, first and last among them."""
    return sorted({int(round(i)) for i in np.linspace(0, count - 1, min(count, most))}) if count else []


@once_per_run
def snapshots(run):
    """At most 41 of the outputs, evenly spaced, the first and the last among them; without the damaged ones."""
    series = grain_files.quiet_series(run)
    index = run.folder / 'grains' / 'contacts.pvd'
    contacts = dict(grain_files.series(run, index)) if index.exists() else {}
    found = []
    for time, path in [series[i] for i in evenly(len(series))]:
        try:
            found.append(read_snapshot(run, time, path, contacts.get(time)))
        except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
            run.remarks.append(f'{path.name} cannot be analysed: {error}')
    return found


def read_snapshot(run, time, grain_file, contact_file):
    grains = grain_files.read_grains(time, grain_file)
    if grains.velocities is None or grains.ids is None:
        raise ValueError('it has no ids or no velocities')
    diameter = run.scale('D')
    force = None
    if run.is_wet() and grains.forces is not None:
        force = grains.forces / solid.unit_force(run, grains)
    return Snapshot(time / run.scale('t_c'), grains.ids, grains.centres / diameter, grains.radii / diameter,
                    grains.velocities / run.scale('u_c'), solid.volumes(run, grains), force,
                    read_contacts(run, contact_file, solid.unit_force(run, grains)) if contact_file else None,
                    submerged_weights(run, grains), solid.mean_density(run, grains), grains.prescribed,
                    None if grains.velocity_z is None else grains.velocity_z / run.scale('u_c'),
                    None if grains.spins is None else grains.spins * run.scale('t_c'),
                    None if grains.contact_forces is None else grains.contact_forces / solid.unit_force(run, grains))


def submerged_weights(run, grains):
    """(rho - rho_f) V of each grain over rho_s D^2, in space rho_s D^3; rho_f is 0 in dry runs."""
    own, fluid = solid.densities(run, grains), 1.0 if run.is_wet() else 0.0
    return solid.volumes(run, grains) * (own - fluid) / solid.mean_density(run, grains)


def read_contacts(run, path, unit_force):
    arrays = grain_files.read_arrays(path)
    return Contacts(arrays['id_a'].astype(np.int64), arrays['id_b'].astype(np.int64),
                    grain_files.in_plane(arrays['Points']).reshape(-1, 2, 2) / run.scale('D'),
                    grain_files.in_plane(arrays['force']) / unit_force)
