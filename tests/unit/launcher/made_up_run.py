# SPDX-License-Identifier: LGPL-2.1-or-later
"""A synthetic run folder for the tests of report and compare."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'launcher/report'))
from document import page

page.RESOLUTION = 40  # the drawing of pixels would take most of the tests' time

CASE = """# Resolved case: every key, defaults filled in.
dimension: 2
domain:
  size: [4, 6]  # D
  left: wall
grains:
  adapter: standalone-nscd
fluid:
  enabled: true
  cells_per_diameter: 2
time:
  step: 0.1  # t_c
scales:
  kind: sedimentation
"""

VTP = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="2" NumberOfVerts="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
1 {y} 0
2.5 {y} 0
</DataArray></Points>
<Verts><DataArray type="Int64" Name="connectivity" format="ascii">0 1</DataArray></Verts>
<PointData><DataArray type="Int64" Name="id" format="ascii">4 9</DataArray>
<DataArray type="Float64" Name="radius" format="ascii">0.5 0.4</DataArray>
<DataArray type="Float64" Name="velocity" NumberOfComponents="3" format="ascii">0 0 0 0 0 0</DataArray></PointData>
</Piece></PolyData></VTKFile>
"""

COLUMNS, ROWS = 8, 12  # 4 x 6 D at 2 cells per D


def velocities():
    """Cell (i, j) has the velocity (i, j / 100, 0), so that a swapped order is detected."""
    j, i = np.mgrid[0:ROWS, 0:COLUMNS]
    return np.stack([i, j / 100.0, 0.0 * i], axis=-1).reshape(-1, 3).astype(float)


def foam_file(binary):
    values = velocities()
    head = ('FoamFile\n{\n    version 2.0;\n    format %s;\n    class volVectorField;\n}\n'
            'dimensions [0 1 -1 0 0 0 0];\n\ninternalField   nonuniform List<vector> \n%d\n(' %
            ('binary' if binary else 'ascii', len(values)))
    if binary:
        body = values.astype('<f8').tobytes() + b')\n;\n'
    else:
        body = ('\n' + '\n'.join('(%r %r %r)' % tuple(v) for v in values.tolist())
                + '\n)\n;\n').encode()
    return head.encode() + body + b'\nboundaryField\n{\n    left { type noSlip; }\n}\n'


class RunFolderTest(unittest.TestCase):
    def setUp(self):
        self._scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self._scratch.name)
        self.addCleanup(self._scratch.cleanup)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def write_all(self):
        """A complete run of two outputs, t = 0 and 1 t_c, ten windows apart."""
        self.write('case.yaml', CASE)
        self.write('run.json', json.dumps({
            'case': 'made-up', 'status': 'done', 'exit_code': 0, 'error': '', 'D': 1, 'u_c': 1,
            't_c': 1, 'g': 1, 'reynolds': 36, 'grains': 2, 'windows': 10, 'windows_done': 10}))
        self.write('history.csv', 'step,time,mean_velocity_y,mean_speed,mean_position_y,max_penetration,'
                   'contact_residual,wall_step,wall_fluid,wall_grains\n'
                   '0,0,0,0,3,,,,,\n10,1,-0.2,0.2,2.9,0,1e-4,0.1,0.06,0.01\n')
        entries = ''
        for k, binary in enumerate((True, False)):
            self.write(f'grains/grains_{k:08d}.vtp', VTP.format(y=4 - k))
            entries += f'<DataSet timestep="{k}" part="0" file="grains_{k:08d}.vtp"/>'
            self.write(f'fluid/{k}/U', foam_file(binary))
        self.write('grains/grains.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
