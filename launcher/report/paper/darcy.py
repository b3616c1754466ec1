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

# k/D2 of the lattices with a hydrodynamic radius of 0.8, the geometric mean of both directions, at D/32
# (configs/validation/packed-lattice.yaml; docs/paper.md).
COMPACITY = (0.7854, 0.829, 0.85, 0.87, 0.9069)
PERMEABILITY = (1.69e-3, 1.53e-3, 1.45e-3, 1.34e-3, 1.03e-3)
LOOSEST = np.pi / 4.0


def time_to_dilate(compacity, reynolds, density_ratio):
    """[t_c]; `compacity` a number or an array from pi/4 on."""
    permeability = np.interp(compacity, COMPACITY, PERMEABILITY)
    return (compacity / LOOSEST - 1.0) / ((density_ratio - 1.0) * compacity * reynolds * permeability)
