# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is drawn lies where it is and is as large as it is; means, bars and differences; the colour of a verdict."""
import json
import unittest
from pathlib import Path
from types import SimpleNamespace

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from made_up_run import CASE, VTP, RunFolderTest

import compare
import compare_page
import curves
import film
import force_network
import grain_drawing
import grain_files
import pictures
import report
import run_data
import seeds
import study


class Drawn(RunFolderTest):
    def test_rows_of_the_liquid_are_upwards_and_discs_as_large_as_they_are(self):
        self.write_all()
        data = run_data.load_run(self.folder)
        shown = [pictures.load(data, instant) for instant in pictures.instants(data)]
        for figure in (pictures.figure(data, shown), pictures.panels(data, shown)[1][0]):
            image = figure.axes[0].images[0]
            self.assertEqual((image.origin, list(image.get_extent())), ('lower', [0, 4, 0, 6]))
            self.assertEqual(image.get_array()[3, 5], 0.03)      # v of column 5, row 3 from below
        plt.close('all')


class Discs(unittest.TestCase):
    def test_are_as_large_as_they_are(self):
        """Radii of 1 and 0.5 in units of which D has two: pi (0.25 + 0.0625) D2 of 16 D2."""
        figure = plt.figure(figsize=(4, 4), dpi=100)
        axes = figure.add_axes((0, 0, 1, 1), xlim=(0, 4), ylim=(0, 4))
        axes.set_axis_off()
        grains = grain_files.Grains(0.0, np.array([[2.0, 2.0], [6.0, 4.0]]), np.array([1.0, 0.5]))
        image = grain_drawing.draw(axes, grains, 2.0, values=np.array([0.0, 1.0]), limits=(0.0, 1.0))
        figure.canvas.draw()
        seen = np.asarray(figure.canvas.buffer_rgba())[::-1, :, :3].min(axis=2) < 255
        self.assertAlmostEqual(seen[:200, :200].mean() * 4.0, np.pi * 0.25, delta=0.05)
        self.assertAlmostEqual(seen[150:250, 250:350].mean(), np.pi * 0.0625, delta=0.03)
        rows, columns = np.nonzero(seen[:, :200])
        np.testing.assert_allclose((columns.mean() / 100, rows.mean() / 100), (1.0, 1.0), atol=0.02)
        self.assertEqual(image.get_array().tolist(), [0.0, 1.0])
        plt.close(figure)


class CyclicSides(unittest.TestCase):
    """A box of 4 x 6 D, D = 2, cyclic in x: a disc that reaches through the left side, one that is three periods on,
    and a triangle one period before, which reaches through the right side."""

    def setUp(self):
        self.run_data = run_data.RunData(Path('nowhere'), {'D': 2.0}, {'domain.size': '[4, 6]', 'domain.left': 'cyclic',
                                                           'fluid.enabled': 'false'})
        corners = np.array([[-0.5, 2.0], [0.5, 2.0], [-0.5, 3.0]])
        self.grains = grain_files.Grains(0.0, np.array([[0.2, 2.0], [26.0, 4.0], [-0.5, 2.5]]),
                                         np.array([1.0, 1.0, 0.9]), outlines={2: corners},
                                         velocities=np.array([[1.0, 0], [2.0, 0], [3.0, 0]]))

    def test_grains_are_drawn_inside_with_their_images(self):
        seen = grain_drawing.with_images(self.run_data, self.grains)
        np.testing.assert_allclose(seen.centres[:, 0], [0.2, 2.0, 7.5, 8.2, -0.5])
        self.assertEqual(seen.speeds().tolist(), [1.0, 2.0, 3.0, 1.0, 3.0])
        np.testing.assert_allclose(seen.outlines[2][:, 0], [7.5, 8.5, 7.5])
        np.testing.assert_allclose(seen.outlines[4][:, 0], [-0.5, 0.5, -0.5])
        figure = pictures.panel(self.run_data, pictures.Picture(0.0, self.grains, None), 1.0, (4, 6))
        discs, polygons = figure.axes[0].collections
        np.testing.assert_allclose(discs.get_offsets()[:, 0], [0.1, 1.0, 4.1])
        self.assertEqual((discs.get_array().tolist(), polygons.get_array().tolist()), ([1.0, 2.0, 1.0], [3.0, 3.0]))
        plt.close(figure)

    def test_what_is_beyond_a_side_widens_no_picture(self):
        self.assertEqual(grain_drawing.reach(self.run_data, self.grains).tolist(), [4.0, 2.5])
        self.assertEqual(pictures.view(self.run_data, [self.grains]), (4, 4))
        self.assertIn('3 grains at t = 0 t_c, up to x = 4 D', pictures.in_words(
            self.run_data, pictures.Picture(0.0, self.grains, None)))
        self.assertEqual(pictures.view(self.run_data, [film.outermost(self.run_data, self.grains)]), (4, 4))
        inside = grain_files.Grains(0.0, np.array([[26.0, 4.0]]), np.array([0.4]))
        self.assertEqual(pictures.view(self.run_data, [inside]), (3, 4))
        self.assertEqual(pictures.view(self.run_data, [film.outermost(self.run_data, inside)]), (3, 4))

    def test_corners_of_a_box_that_is_cyclic_in_both_directions(self):
        self.run_data.case['domain.bottom'] = 'cyclic'
        one = grain_files.Grains(0.0, np.array([[8.1, -0.1]]), np.array([0.5]))
        seen = grain_drawing.with_images(self.run_data, one).centres
        self.assertEqual({tuple(np.round(place, 9)) for place in seen},
                         {(0.1, 11.9), (8.1, 11.9), (0.1, -0.1), (8.1, -0.1)})

    def test_lines_of_forces_follow_their_grains(self):
        ends = np.array([[[4.3, 1.0], [5.2, 1.0]], [[-0.3, 2.0], [0.5, 2.0]]])
        network = force_network.Network(0.0, self.grains, ends, np.zeros((2, 2)), np.array([1.0, 2.0]),
                                        np.ones(2, bool))
        seen = force_network.seen(self.run_data, network)
        np.testing.assert_allclose(seen.ends[:, :, 0], [[0.3, 1.2], [-0.3, 0.5], [3.7, 4.5]])
        self.assertEqual(seen.forces.tolist(), [1.0, 2.0, 2.0])


class Comparisons(RunFolderTest):
    def test_difference_is_that_from_the_first(self):
        t = np.arange(2.0)
        self.assertEqual(compare_page.difference_curve((t, 1.0 * t), (t, 3.0 * t))[1].tolist(), [0.0, 2.0])

    def test_surface_of_a_group_is_the_mean(self):
        runs = []
        for seed, y in ((1, 4), (2, 3), (3, 2)):
            self.write(f's{seed}/case.yaml', CASE + f'random:\n  seed: {seed}\n')
            self.write(f's{seed}/run.json', json.dumps({'status': 'done'}))
            more = '15,1.5,1\n' if seed == 3 else ''
            self.write(f's{seed}/history.csv', f'step,time,mean_speed\n0,0,0\n10,1,1\n{more}20,2,0\n')
            self.write(f's{seed}/grains/grains.pvd', '<VTKFile><Collection><DataSet timestep="1" part="0" file="g.vtp"/>'
                       '</Collection></VTKFile>')
            self.write(f's{seed}/grains/g.vtp', VTP.format(y=y))
            runs.append(run_data.load_run(self.folder / f's{seed}'))
        member, = seeds.members(runs)
        top = compare.member_surface(member)
        np.testing.assert_allclose((top.height.tolist(), top.low.tolist(), top.high.tolist()),
                         ([3.5, 3.5, 3.4, 0.0], [2.5, 2.5, 2.4, 0.0], [4.5, 4.5, 4.4, 0.0]))

    def test_lines_of_a_study_join_means_and_bars_reach_to_the_extremes(self):
        measured = SimpleNamespace(of=lambda one: one)
        figure, axes = curves.panel('', '', '')
        study.draw_line(axes, 0, '', [(0.3, SimpleNamespace(runs=[1.0, 2.0, 6.0], is_group=lambda: True))], measured)
        line, _, (bars,) = axes.containers[0]
        self.assertEqual(line.get_ydata().tolist(), [3.0])
        self.assertEqual(bars.get_segments()[0].tolist(), [[0.3, 1.0], [0.3, 6.0]])
        plt.close(figure)

    def test_seeds_that_agree_have_bars_of_no_length(self):
        """The mean of 0.7, 0.7 and 0.7 is 0.6999999999999998."""
        figure, axes = curves.panel('', '', '')
        study.draw_line(axes, 0, '', [(0.3, SimpleNamespace(runs=[0.7, 0.7, 0.7], is_group=lambda: True))],
                        SimpleNamespace(of=lambda one: one))
        _, _, (bars,) = axes.containers[0]
        np.testing.assert_allclose(bars.get_segments()[0], [[0.3, 0.7], [0.3, 0.7]])
        plt.close(figure)


class Verdicts(RunFolderTest):
    def test_the_colour_of_the_verdict(self):
        for status, overlap, css in (('done', 1e-4, 'holds'), ('done', 0.05, 'doubt'), ('failed', 1e-4, 'bad')):
            self.write_all()
            self.write('run.json', json.dumps({'status': status, 'maxima': {'penetration': overlap}}))
            self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
            self.assertIn(f'<p class="verdict {css}">', (self.folder / 'report.html').read_text())


if __name__ == '__main__':
    unittest.main()
