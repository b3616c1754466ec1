# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the walls inside a box are drawn."""
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

import made_up_run  # puts launcher/report on the path

import matplotlib
import numpy as np

import grain_files
import plates
import run_data

matplotlib.use('Agg')
import matplotlib.pyplot as plt

CASE = {'domain.motions.m.kind': 'harmonic', 'domain.motions.m.amplitude': '[0.4, 0]', 'domain.motions.m.period': '2',
        'domain.motions.t.kind': 'table', 'domain.motions.t.table': '[0, 0, 0, 2, -1, 0.5]'}
WALLS = '''id,x1,y1,x2,y2,thickness,vx,vy,spin,px,py,motion
1,1,2,3,2,0.2,0,0,0.5,1,2,
2,0,5,4,5,0,0,0,0,2,5,m
3,0,6,4,6,0,0,0,0,2,6,t
'''


class Plates(unittest.TestCase):
    def setUp(self):
        folder = TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_data = run_data.RunData(Path(folder.name), case=CASE)
        (Path(folder.name) / 'grains').mkdir()
        (Path(folder.name) / 'grains' / 'walls.csv').write_text(WALLS)
        self.walls = grain_files.walls_of(self.run_data)

    def outline(self, k, time):
        return plates.outline(self.run_data, self.walls[k], time)

    def test_a_thick_wall_turns_about_its_pivot_and_keeps_its_size(self):
        at_rest, turned = self.outline(0, 0.0), self.outline(0, np.pi)  # a quarter of a turn
        np.testing.assert_allclose(at_rest.min(axis=0), [0.9, 1.9], atol=1e-12)
        np.testing.assert_allclose(at_rest.max(axis=0), [3.1, 2.1], atol=1e-12)
        np.testing.assert_allclose(turned.min(axis=0), [0.9, 1.9], atol=1e-12)
        np.testing.assert_allclose(turned.max(axis=0), [1.1, 4.1], atol=1e-12)

    def test_named_motions_displace_thin_walls(self):
        np.testing.assert_allclose(self.outline(1, 0.5), [[0.4, 5], [4.4, 5]], atol=1e-12)
        np.testing.assert_allclose(self.outline(2, 1.0), [[-0.5, 6.25], [3.5, 6.25]], atol=1e-12)
        np.testing.assert_allclose(self.outline(2, 9.0), [[-1, 6.5], [3, 6.5]], atol=1e-12)

    def test_all_are_drawn_and_a_box_without_walls_has_none(self):
        _, axes = plt.subplots()
        plates.draw(axes, self.run_data, 0.0)
        self.assertEqual(sum(len(c.get_paths()) for c in axes.collections), 3)
        (self.run_data.folder / 'grains' / 'walls.csv').unlink()
        _, empty = plt.subplots()
        plates.draw(empty, self.run_data, 0.0)
        self.assertEqual(len(empty.collections), 0)


if __name__ == '__main__':
    unittest.main()
