# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report on made-up run folders: whole, half empty, broken."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'coupler/cli/report'))
import pictures
import report
import run_data

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
  kind: avalanche
"""

VTP = """<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="2" NumberOfVerts="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
1 {y} 0
2.5 {y} 0
</DataArray></Points>
<Verts><DataArray type="Int64" Name="connectivity" format="ascii">0 1</DataArray></Verts>
<PointData><DataArray type="Int64" Name="id" format="ascii">4 9</DataArray>
<DataArray type="Float64" Name="radius" format="ascii">0.5 0.4</DataArray></PointData>
</Piece></PolyData></VTKFile>
"""

COLUMNS, ROWS = 8, 12  # 4 x 6 D at 2 cells per D


def velocities():
    """Cell (i, j) moves with (i, j / 100, 0), so that a swapped order is seen."""
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


class RunFolder(unittest.TestCase):
    def setUp(self):
        self._scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self._scratch.name)
        self.addCleanup(self._scratch.cleanup)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def write_all(self):
        self.write('case.yaml', CASE)
        self.write('run.json', json.dumps({
            'case': 'made-up', 'status': 'done', 'exit_code': 0, 'error': '', 'D': 1, 'u_c': 1,
            't_c': 1, 'g': 1, 'reynolds': 36, 'grains': 2, 'windows': 20, 'windows_done': 20}))
        self.write('history.csv', 'step,time,mean_velocity_y,mean_position_y,max_penetration,'
                   'contact_residual,wall_step\n0,0,0,3,,,\n10,1,-0.2,2.9,0,1e-4,0.1\n')
        entries = ''
        for k, binary in enumerate((True, False)):
            self.write(f'grains/grains_{k:08d}.vtp', VTP.format(y=4 - k))
            entries += f'<DataSet timestep="{k}" part="0" file="grains_{k:08d}.vtp"/>'
            self.write(f'fluid/{k}/U', foam_file(binary))
        self.write('grains/grains.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')

    def make(self):
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        return (self.folder / 'report.html').read_text()

    def test_whole_run(self):
        self.write_all()
        page = self.make()
        self.assertIn('made-up', page)
        self.assertEqual(page.count('src="data:image/png;base64,'), 2)  # pictures and curves
        self.assertIn('Status: done, exit code 0', page)
        self.assertNotIn('Remarks', page)
        self.assertNotIn('src="http', page)

    def test_field_order_in_both_formats(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        for time, folder in run_data.field_times(run):
            field = run_data.read_velocity(time, folder, run_data.mesh_cells(run))
            self.assertEqual(field.vertical.shape, (ROWS, COLUMNS))
            # Row 3, column 5 is the cell with i = 5, j = 3.
            self.assertEqual(field.horizontal[3, 5], 5.0)
            self.assertEqual(field.vertical[3, 5], 0.03)

    def test_uniform_field(self):
        data = b'format ascii;\ninternalField   uniform (0 1.5 0);\n'
        self.assertTrue((run_data.read_vectors(data, 6) == [0, 1.5, 0]).all())

    def test_pictures_pair_grains_and_fields(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        for time, grains, field in pictures.instants(run):
            self.assertEqual(grains.name, f'grains_{int(time):08d}.vtp')
            self.assertEqual(field.name, str(int(time)))
        grains = run_data.read_grains(*run_data.grain_series(run)[1])
        self.assertEqual(grains.centres.tolist(), [[1, 3], [2.5, 3]])
        self.assertEqual(grains.radii.tolist(), [0.5, 0.4])

    def test_colours_are_symmetric(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        field = run_data.read_velocity(0, self.folder / 'fluid/0', (COLUMNS, ROWS))
        # Largest vertical speed: row 11, 0.11 u_c.
        self.assertAlmostEqual(pictures.colour_limit(run, [field, None]), 0.11)

    def test_missing_history_and_fields_are_said(self):
        self.write_all()
        (self.folder / 'history.csv').unlink()
        for k in range(2):
            (self.folder / f'fluid/{k}/U').unlink()
        page = self.make()
        self.assertIn('history.csv is missing', page)
        self.assertIn('holds no velocity field', page)
        self.assertEqual(page.count('src="data:image/png;base64,'), 1)  # grains alone

    def test_empty_folder(self):
        page = self.make()
        for name in ('run.json', 'case.yaml', 'history.csv'):
            self.assertIn(f'{name} is missing', page)
        self.assertIn('nothing to draw', page)

    def test_broken_field_is_said(self):
        self.write_all()
        self.write('fluid/1/U', foam_file(True)[:200])
        self.write('fluid/0/U', foam_file(True)[:400])
        self.assertIn('U is cut off', self.make())

    def test_failed_run_shows_its_error(self):
        self.write_all()
        self.write('run.json', json.dumps({'status': 'physics refused', 'exit_code': 6,
                                           'error': 'grain 3 < wall'}))
        page = self.make()
        self.assertIn('physics refused, exit code 6: grain 3 &lt; wall', page)


if __name__ == '__main__':
    unittest.main()
