# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the contact series of a run folder as force networks."""
import numpy as np

import force_network
import grain_files
import solid

MOST_NETWORKS = 4
FILM = 4  # the bit of `status` of points that a film of liquid holds apart


def networks(run):
    """Up to four times, evenly spaced over the outputs with contacts; none for runs without contacts."""
    index = run.folder / 'grains' / 'contacts.pvd'
    if not index.exists():
        return []
    contacts, grains = grain_files.series(run, index), dict(grain_files.grain_series(run))
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
    """Forces in units of the weight of a square (in space a cube) of D with the mean density of the grains. Points that
    a film holds apart are no contacts."""
    arrays = grain_files.read_arrays(contact_file)
    vectors = grain_files.in_space if run.in_space() else grain_files.in_plane
    ends = vectors(arrays['Points']) / run.scale('D')
    grains = grain_files.read_grains(time, grain_file)
    touch = touching(arrays)
    return force_network.Network(
        time / run.scale('t_c'), grains, ends.reshape(-1, 2, ends.shape[1])[touch],
        vectors(arrays['normal'])[touch], arrays['normal_force'][touch] / solid.unit_force(run, grains),
        arrays['id_a'][touch] >= 0, films=int(np.count_nonzero(~touch)))


def touching(arrays):
    """Which points no film holds apart: all in files without `status`."""
    status = arrays.get('status', np.zeros(len(arrays['id_a'])))
    return status.astype(int) & FILM == 0
