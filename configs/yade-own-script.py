# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-alone YADE script with the contact engine of Turbidite: grains in a rotating drum.

    ./turbidite yade configs/yade-own-script.py            # 12 s of rotation, then 3 s from the saved scene
    ./turbidite yade configs/yade-own-script.py 2 40       # end time [s] and number of grains

Discs, triangles and squares of different sizes, two materials, and a drum of facets driven by RotationEngine.
Everything else is plain YADE: plot.addData, VTKRecorder, O.save and O.load. Results go to runs/yade-drum/.
"""
import math
import os
import random
import sys

import turbidite_contact
from yade import plot, utils

end_time = float(sys.argv[1]) if len(sys.argv) > 1 else 12.0
count = int(sys.argv[2]) if len(sys.argv) > 2 else 250
drum_radius, sides, turns_per_second = 0.25, 48, 0.1
folder = 'runs/yade-drum'
os.makedirs(folder, exist_ok=True)
draw = random.Random(1)

# ---- materials: a contact has the smaller friction of the two bodies ----
O.materials.append(FrictMat(density=2500, frictionAngle=math.atan(0.4), label='grains'))
O.materials.append(FrictMat(density=2500, frictionAngle=math.atan(0.8), label='drum'))

# ---- the drum: facets along the axis z ----
rim = [(drum_radius * math.cos(2 * math.pi * k / sides), drum_radius * math.sin(2 * math.pi * k / sides))
       for k in range(sides + 1)]
drum = [O.bodies.append(utils.facet([(*a, 0), (*b, 0), (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.1)],
                                    material='drum'))
        for a, b in zip(rim, rim[1:])]


# ---- a loose cloud of grains on a grid of positions inside the drum ----
def grain(x, y):
    radius = 0.009 * draw.uniform(0.6, 1.0)
    corners = draw.choice((0, 3, 4))
    if corners == 0:
        return turbidite_contact.disc((x, y, 0), radius, material='grains')
    turn = draw.uniform(0, math.pi)
    return turbidite_contact.polygon(
        [(x + radius * math.cos(turn + 2 * math.pi * k / corners), y + radius * math.sin(turn + 2 * math.pi * k / corners))
         for k in range(corners)], material='grains')


places = [(0.0195 * i, 0.0195 * j) for j in range(-12, 13) for i in range(-12, 13)]
inside = [place for place in places if math.hypot(*place) < drum_radius - 0.012]
grains = [O.bodies.append(grain(*place)) for place in inside[:count]]

# ---- two lines attach the engine; the drum's motion goes before it, recorders after it ----
O.dt = 5e-4
engines = turbidite_contact.engines(gravity=(0, -9.81, 0), restitution=0.1, show=200)
drive = RotationEngine(ids=drum, rotationAxis=(0, 0, 1), angularVelocity=2 * math.pi * turns_per_second,
                       rotateAroundZero=True, zeroPoint=(0, 0, 0))
O.engines = engines[:1] + [drive] + engines[1:] + [
    PyRunner(command='add_data()', iterPeriod=200),
    VTKRecorder(fileName=folder + '/', recorders=['spheres', 'facets', 'intr'], iterPeriod=2000),
]


def add_data():
    report = turbidite_contact.report()
    weight = sum(O.bodies[i].state.mass for i in grains) * 9.81
    plot.addData(t=O.time, kinetic_energy=utils.kineticEnergy(), contacts=report['contacts'],
                 sweeps=report['iterations'], residual=report['residual'],
                 # Vertical force on the drum, in units of the grains' weight: 1 on average.
                 carried=-sum(O.forces.f(i, True)[1] for i in drum) / weight,
                 torque=sum((O.bodies[i].state.pos.cross(O.forces.f(i, True)) + O.forces.t(i))[2] for i in drum))


plot.plots = {'t': ('kinetic_energy', None, 'torque')}

O.run(round(end_time / O.dt), True)
O.save(folder + '/scene.yade.gz')
print('saved at t = %.2f s:' % O.time, turbidite_contact.report(), flush=True)

# The loaded scene continues as if uninterrupted, in this process or another one.
O.load(folder + '/scene.yade.gz')
O.run(round(0.25 * end_time / O.dt), True)
plot.saveDataTxt(folder + '/drum.txt')
plot.plot(noShow=True).savefig(folder + '/drum.png')
print('done at t = %.2f s:' % O.time, turbidite_contact.report())
