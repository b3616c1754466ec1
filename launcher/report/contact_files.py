# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the contact series of a run folder as force networks."""
import numpy as np

import force_network
import grain_files

MOST_NETWORKS = 4


def networks(run):
    """Up to four times, evenly spaced over the outputs with contacts; none for runs without contacts."""
    index = run.folder / 'grains' / 'contacts.pvd'
    if not index.exists():
        return []
    contacts, grains = grain_files.series(index), dict(grain_files.grain_series(run))
    both = [(time, path, grains[time]) for time, path in contacts if time in grains]
    chosen = {int(round(i)) for i in np.linspace(0, len(both) - 1, MOST_NETWORKS + 1)[1:]} if both else ()
    found = []
    for time, contact_file, grain_file in [both[i] for i in sorted(chosen)]:
        try:
            found.append(read_network(run, time, contact_file, grain_file))
        except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
            run.remarks.append(f'Contacts at {time:g}: {error}')
    return [network for network in found if len(network.forces)]


def read_network(run, time, contact_file, grain_file):
    """Forces in units of the weight of a square (in space a cube) of D with the density of the grains."""
    arrays = grain_files.read_arrays(contact_file)
    vectors = grain_files.in_space if run.in_space() else grain_files.in_plane
    ends = vectors(arrays['Points']) / run.scale('D')
    return force_network.Network(
        time / run.scale('t_c'), grain_files.read_grains(time, grain_file), ends.reshape(-1, 2, ends.shape[1]),
        vectors(arrays['normal']), arrays['normal_force'] / unit_force(run),
        arrays['id_a'] >= 0)


def unit_force(run):
    """rho_s g D^2 per unit length out of the plane, in space rho_s g D^3. Dry runs in units of D, u_c use the density of
    a fictitious fluid as unit, so rho_s = density_ratio."""
    fluid = float(run.record.get('rho') or 1.0)
    density = fluid * float(run.case.get('grains.density_ratio', 1.0))
    return density * float(run.record.get('g') or 1.0) * run.scale('D')**(3 if run.in_space() else 2)
