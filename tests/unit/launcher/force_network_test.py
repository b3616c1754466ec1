# SPDX-License-Identifier: LGPL-2.1-or-later
"""Force network pictures on contacts whose forces and directions are known."""
import unittest

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from made_up_run import CASE, RunFolderTest

import captions
import contact_files
import force_network
import report
import run_data
from document.typeset import typeset
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
        # Sorted by |f|; 0.1 of 4 is too thin to be visible.
        np.testing.assert_allclose(np.array(drawn.get_linewidths()) / force_network.WIDEST,
                                   [0.25, 0.5, 1.0])
        self.assertEqual([line[0][0] for line in drawn.get_segments()], [1.0, 2.0, 0.0])
        colours = [matplotlib.colors.to_hex(colour) for colour in drawn.get_colors()]
        self.assertEqual(colours, [force_network.PUSH, force_network.PULL, force_network.PUSH])

    def test_larger_forces_than_the_scale_are_not_wider(self):
        drawn = force_network.lines(network([8.0]), scale=4.0)
        self.assertEqual(list(drawn.get_linewidths()), [force_network.WIDEST])

    def test_an_impact_at_one_output_does_not_blank_the_others(self):
        calm = [network(np.linspace(0.0, 1.0, 101)) for _ in range(3)]
        impact = network(np.linspace(0.0, 500.0, 101))
        self.assertAlmostEqual(force_network.force_scale(calm + [impact]), 0.95)
        drawn = force_network.lines(calm[0], force_network.force_scale(calm + [impact]))
        self.assertGreater(len(drawn.get_linewidths()), 90)

    def test_the_scale_is_that_of_outputs_with_many_contacts(self):
        few, many = network([0.01] * 3), network([2.0] * 200)
        self.assertAlmostEqual(force_network.force_scale([few, few, many]), 2.0)
        self.assertEqual(force_network.force_scale([]), 1.0)

    def test_widths_have_a_legend(self):
        self.write_all()
        shown = [network([4.0] * 20)]
        (figure, _), = force_network.panels(run_data.load_run(self.folder), shown)
        legend = figure.axes[1].get_legend()
        widths = [line.get_linewidth() / force_network.WIDEST for line in legend.get_lines()]
        forces = [float(text.get_text().replace(r'$\geq$', '').split()[0]) for text in legend.get_texts()]
        np.testing.assert_allclose(np.array(forces), 4.0 * np.array(widths))
        self.assertEqual(widths[-1], 1.0)
        self.assertIn(r'\rho_s g D^2', legend.get_texts()[-1].get_text())
        plt.close('all')

    def test_distribution_is_a_density_over_the_mean(self):
        # 900 contacts of 0.5 and 100 of 5.5: mean 1; attractive contacts and walls are not counted.
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
        (forces, _), (directions, _) = force_network.statistics([network([1.0, 2.0] * 25), network([3.0] * 50)])
        self.assertEqual(len(forces.axes[0].lines), 2)
        self.assertEqual(len(directions.axes[0].lines), 2)
        plt.close('all')
        self.assertEqual(force_network.statistics([network([1.0] * 49)]), [])  # too few for a distribution


CONTACTS = """<VTKFile><PolyData><Piece><Points>
<DataArray Name="position" format="ascii">1 {y} 0 2.5 {y} 0 1 0 0 1 {y} 0</DataArray></Points><Lines>
<DataArray Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray Name="offsets" format="ascii">2 4</DataArray></Lines><PointData>
<DataArray Name="normal_force" format="ascii">3 3 6 6</DataArray></PointData><CellData>
<DataArray Name="id_a" format="ascii">4 -3</DataArray><DataArray Name="id_b" format="ascii">9 4</DataArray>
<DataArray Name="normal_force" format="ascii">3 6</DataArray>
<DataArray Name="force" format="ascii">3 0 0 0 6 0</DataArray>
<DataArray Name="normal" format="ascii">1 0 0 0 1 0</DataArray></CellData></Piece></PolyData></VTKFile>
"""


class ContactSeries(RunFolderTest):
    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('case.yaml', CASE.replace('standalone-nscd', 'standalone-nscd\n  density_ratio: 1.5'))
        self.write('grains/contacts.pvd', '<VTKFile><Collection><DataSet timestep="1" part="0" '
                   'file="contacts_1.vtp"/></Collection></VTKFile>')
        self.write('grains/contacts_1.vtp', CONTACTS.format(y=3))

    def test_networks_of_a_run(self):
        network, = contact_files.networks(run_data.load_run(self.folder))
        self.assertEqual(network.time, 1.0)
        self.assertEqual(network.ends.tolist(), [[[1, 3], [2.5, 3]], [[1, 0], [1, 3]]])
        self.assertEqual(network.forces.tolist(), [2.0, 4.0])  # over rho_s g D^2 = 1.5
        self.assertEqual(network.between_grains.tolist(), [True, False])
        self.assertEqual(network.normals.tolist(), [[1, 0], [0, 1]])

    def test_films_of_liquid_are_no_contacts(self):
        """Bit 4 of `status`, whatever the others are."""
        for status, forces, films in (('1 4', [2.0], 1), ('6 0', [4.0], 1), ('3 1', [2.0, 4.0], 0)):
            self.write('grains/contacts_1.vtp', CONTACTS.format(y=3).replace(
                '</CellData>', f'<DataArray Name="status" format="ascii">{status}</DataArray></CellData>'))
            run = run_data.load_run(self.folder)
            network, = contact_files.networks(run)
            self.assertEqual((network.forces.tolist(), network.films), (forces, films))
            for values in (network.ends, network.normals, network.between_grains):
                self.assertEqual(len(values), len(forces))
            caption = captions.force_network(run, [network])
            self.assertIn(f'Contacts with an impulse: {len(forces)} at t = 1 t_c', caption)
            self.assertEqual('; held apart by films of liquid, and not shown: 1 at t = 1 t_c.' in caption, films == 1)

    def test_the_report_shows_them(self):
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        page = (self.folder / 'report.html').read_text()
        self.assertIn('Force network', page)
        self.assertIn(typeset('2 at t = 1 t_c. Largest force: 4 rho_s g D^2'), page)
        # Forces 2 and 4: 95 % of them do not exceed 3.9.
        self.assertIn(typeset('the widest stand for 3.9 rho_s g D^2, which 95 % of the contacts'), page)
        self.assertIn('and for more (1 lines); those below 8 % of that are not drawn.', page)
        self.assertNotIn('Remarks', page)
        self.assertTrue((self.folder / 'pictures/force_network.png').exists())

    def test_a_broken_file_is_said(self):
        self.write('grains/contacts_1.vtp', CONTACTS.format(y=3)[:300])
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        self.assertIn('Contacts at 1:', (self.folder / 'report.html').read_text())


if __name__ == '__main__':
    unittest.main()
