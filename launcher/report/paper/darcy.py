# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long the liquid takes to flow into a packing that has to dilate before it can slide.

A layer one grain thick has to grow from the compacity phi to that of the loosest lattice, pi/4, at which rows pass over
each other: it takes up D (4 phi/pi - 1) of liquid per length. Darcy's law brings it at k p/(rho_f nu l) through the
packing between the layer and the free surface, l away; the pressure that draws it in is the submerged weight of the
same packing, p = (rho_s - rho_f) phi g l, so that l drops out:

    t/t_c = (4 phi/pi - 1) / ((rho_r - 1) phi Re_c k/D2),   t_c = sqrt(D/g), Re_c = D sqrt(g D)/nu

Nothing is fitted. The idea is that of Pailha, Nicolas and Pouliquen, Phys. Fluids 20 (2008) 111701: pore pressure and
dilatancy set the time of an immersed start.
"""
import numpy as np

from paper.selection import COMPACITIES

LOOSEST = np.pi / 4.0


def permeabilities(runs):
    """(compacities, k/D2) of the lattices of the part `permeability`: the geometric mean of both directions of
    k = nu U/a, U the mean flow at the end, a the body force per mass. None unless all of them are done."""
    found = [(float(phi), [permeability(run) for run in runs.of('permeability', variant=phi)]) for phi in COMPACITIES]
    asked = runs.entries('permeability')
    if not asked or len(asked) != sum(len(values) for _, values in found):
        return None
    phi, values = zip(*found)
    return np.array(phi), np.array([np.exp(np.mean(np.log(k))) for k in values])


def permeability(run):
    """In units of D, u_c and t_c nu = 1/Re."""
    flow = np.array([run.column(name)[1][-1] for name in ('flow_x', 'flow_y')])
    push = np.array([float(v) for v in run.case['fluid.acceleration'].strip('[]').split(',')])
    return float(flow @ push / (push @ push) / float(run.case['fluid.reynolds']))


def time_to_dilate(compacity, reynolds, density_ratio, lattices):
    """[t_c]; `compacity` a number or an array from pi/4 on, `lattices` what permeabilities() gives."""
    k = np.interp(compacity, *lattices)
    return (compacity / LOOSEST - 1.0) / ((density_ratio - 1.0) * compacity * reynolds * k)
