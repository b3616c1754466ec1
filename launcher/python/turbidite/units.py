# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run's files are divided by, so that all is dimensionless as history.csv is. (Files of grains and fields are in
the run's own units: SI for `scales.kind: physical`, otherwise D = u_c = rho_f = 1.)"""
import numpy as np

from .readers import reader

SAME_TIME = 1e-8  # of a time: files of series tell nine digits


def in_t_c(data, time):
    """A time of files [t_c]: that of the row of history.csv of this output, digit by digit, so that tables can be joined
    by it."""
    own = time / data.scale('t_c')
    rows = data.history['time'] if data.history is not None else ()
    if not len(rows):
        return own
    nearest = float(rows[np.abs(rows - own).argmin()])
    return nearest if abs(nearest - own) <= SAME_TIME * abs(own) else own



def of_grains(data, grains):
    """{array: unit} of one output, grain_files.Grains. Forces and torques of the fluid over rho_f u_c^2 D and
    rho_f u_c^2 D^2 (in space D^2 and D^3), the force of contacts over rho_s g D^2 (D^3) with the mean density rho_s of
    these grains: as the columns fluid_force_x and mean_normal_force of history.csv are."""
    diameter, speed = data.scale('D'), data.scale('u_c')
    fluid_force = data.scale('rho') * speed**2 * diameter**(2 if data.in_space() else 1)
    return {'position': diameter, 'radius': diameter, 'velocity': speed, 'angular_velocity': speed / diameter,
            'density': data.scale('rho'), 'force': fluid_force, 'torque': fluid_force * diameter,
            'contact_force': of_contact_forces(data, grains)}


def of_contacts(data, grains):
    """{array: unit} of the contacts of these grains."""
    diameter, force = data.scale('D'), of_contact_forces(data, grains)
    return {'ends': diameter, 'point': diameter, 'gap': diameter, 'force': force, 'normal_force': force,
            'tangential_force': force, 'rolling_moment': force * diameter, 'torsion_moment': force * diameter}


def of_contact_forces(data, grains):
    return reader('solid').unit_force(data, grains)


def of_fields(data):
    """{field: unit}; fields that are not here, such as those of function objects, stay as they are in the files."""
    diameter, speed = data.scale('D'), data.scale('u_c')
    return {'U': speed, 'p': speed**2, 'lambda': data.scale('rho') * speed**2 / diameter, 'vorticity': speed / diameter}
