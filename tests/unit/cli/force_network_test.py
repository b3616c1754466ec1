# SPDX-License-Identifier: LGPL-2.1-or-later
"""Force network pictures on contacts whose forces and directions are known."""
import unittest

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from made_up_run import RunFolderTest

import force_network
import run_data
from grain_files import Grains


def network(forces, normals=None, between=None):
    count = len(forces)
    ends = np.stack([np.stack([np.arange(count), np.zeros(count)], 1),
                     np.stack([np.arange(count), np.ones(count)], 1)], 1).astype(float)
    grains = Grains(2.0, np.array([[1.0, 1.0], [2.0, 1.0]]), np.array([0.5, 0.5]))
    return force_network.Network(
        2.0, grains, ends, np.tile([0.0, 1.0], (count, 1)) if normals is None else normals,
        np.array(forces, dtype=float), np.ones(count, bool) if between is None else between)


class ForceNetwork(RunFolderTest):
    def test_lines_are_as_wide_as_their_force(self):
        drawn = force_network.lines(network([4.0, 1.0, -2.0, 0.1]), scale=4.0)
        # Sorted by |f|; 0.1 of 4 is too thin to be seen.
        np.testing.assert_allclose(np.array(drawn.get_linewidths()) / force_network.WIDEST,
                                   [0.25, 0.5, 1.0])
        self.assertEqual([line[0][0] for line in drawn.get_segments()], [1.0, 2.0, 0.0])
        colours = [matplotlib.colors.to_hex(colour) for colour in drawn.get_colors()]
        self.assertEqual(colours, [force_network.PUSH, force_network.PULL, force_network.PUSH])

    def test_larger_forces_than_the_scale_are_not_wider(self):
        drawn = force_network.lines(network([8.0]), scale=4.0)
        self.assertEqual(list(drawn.get_linewidths()), [force_network.WIDEST])

    def test_distribution_is_a_density_over_the_mean(self):
        # 900 contacts of 0.5 and 100 of 5.5: mean 1; pulls and walls do not count.
        forces = [0.5] * 900 + [5.5] * 100 + [-3.0, 50.0]
        between = np.ones(1002, bool)
        between[-1] = False
        middles, density = force_network.distribution(network(forces, between=between))
        width = force_network.LARGEST_FORCE / force_network.BINS_FORCE
        np.testing.assert_allclose(density * width, [0.9, 0.1])
        self.assertLess(abs(middles[0] - 0.5), width)
        self.assertLess(abs(middles[1] - 5.5), width)

    def test_directions_count_both_ways(self):
        angle = np.deg2rad(47.0)
        normals = np.tile([np.cos(angle), np.sin(angle)], (10, 1))
        angles, density = force_network.directions(network([1.0] * 10, normals))
        width = 2.0 * np.pi / force_network.BINS_ANGLE
        full = np.rad2deg(angles[:-1][density[:-1] > 0.0])
        np.testing.assert_allclose(full, [45.0, 225.0])
        self.assertAlmostEqual(density[:-1].sum() * width, 1.0)
        self.assertEqual(density[0], density[-1])  # closed

    def test_pictures_of_a_run(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        shown = [network([1.0, 2.0]), network([3.0, 0.5])]
        picture = force_network.figure(run, shown)
        self.assertEqual(len([axes for axes in picture.axes if axes.collections]), 2)
        plt.close(picture)
        told = force_network.statistics(shown)
        self.assertEqual(len(told.axes[0].lines), 2)
        plt.close(told)
        self.assertIsNone(force_network.statistics([network([1.0])]))


if __name__ == '__main__':
    unittest.main()
