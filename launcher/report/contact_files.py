# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the contact series of a run folder as force networks."""
import numpy as np

import force_network
import grain_files
import solid

MOST_NETWORKS = 4


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
    """Forces in units of the weight of a square (in space a cube) of D with the mean density of the grains."""
    arrays = grain_files.read_arrays(contact_file)
    vectors = grain_files.in_space if run.in_space() else grain_files.in_plane
    ends = vectors(arrays['Points']) / run.scale('D')
    grains = grain_files.read_grains(time, grain_file)
    return force_network.Network(
        time / run.scale('t_c'), grains, ends.reshape(-1, 2, ends.shape[1]),
        vectors(arrays['normal']), arrays['normal_force'] / solid.unit_force(run, grains),
        arrays['id_a'] >= 0)
