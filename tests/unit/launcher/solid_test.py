# SPDX-License-Identifier: LGPL-2.1-or-later
"""rho_s is the mean density of the grains that are there, whatever the case has as grains.density_ratio."""
import json
import unittest

import numpy as np
from made_up_run import CASE, RunFolderTest
from space_report_test import array, poly_data

import contact_files
import run_data
import solid
from analysis import energy, pore_pressure, rheology, snapshots, weight_balance
from grain_files import Grains

DISC = np.pi / 4.0


def grains(densities, radii=None, outlines=None):
    count = len(densities)
    return Grains(0.0, np.zeros((count, 2)), np.full(count, 0.5) if radii is None else np.array(radii),
                  outlines=outlines, densities=np.array(densities, dtype=float))


def run(space=False, **case):
    data = run_data.RunData('nowhere', {'D': 1.0, 'u_c': 1.0, 'g': 1.0, 'rho': 1.0})
    data.case = {'grains.density_ratio': '1.5', 'dimension': '3' if space else '2', **case}
    return data


class MeanDensity(unittest.TestCase):
    def test_volumes_count(self):
        self.assertAlmostEqual(solid.mean_density(run(), grains([2.0, 5.0], [1.0, 0.5])), (4 * 2 + 5) / 5)
        self.assertAlmostEqual(solid.mean_density(run(space=True), grains([2.0, 5.0], [1.0, 0.5])), (8 * 2 + 5) / 9)
        square = np.array([[0.0, 0.0], [np.pi, 0.0], [np.pi, 1.0], [0.0, 1.0]])  # as large as four of the discs
        self.assertAlmostEqual(solid.mean_density(run(), grains([2.0, 5.0], outlines={0: square})), (4 * 2 + 5) / 5)

    def test_that_of_the_case_where_there_is_no_other(self):
        without = grains([1.0])
        without.densities = None
        for there in (None, grains([]), without):
            self.assertEqual(solid.mean_density(run(), there), 1.5)

    def test_submerged_weights(self):
        # Of densities 1.5, 2 and 4, whose mean is 2.5: (rho - 1)/2.5 of the area each.
        there = grains([1.5, 2.0, 4.0])
        np.testing.assert_allclose(snapshots.submerged_weights(run(), there), DISC * np.array([0.5, 1.0, 3.0]) / 2.5)
        np.testing.assert_allclose(snapshots.submerged_weights(run(**{'fluid.enabled': 'false'}), there),
                                   DISC * np.array([1.5, 2.0, 4.0]) / 2.5)


def grain_file(ids, densities):
    count = len(ids)
    places = np.column_stack([np.arange(count) + 0.5, np.full(count, 0.5), np.zeros(count)])
    forces = np.tile([0.0, 6.0, 0.0], (count, 1))
    return poly_data(places, '', array('id', np.array(ids), 1) + array('radius', np.full(count, 0.5), 1)
                     + array('velocity', forces) + array('angular_velocity', 2.0 * forces[:, [0, 2, 1]]) + array('force', forces)
                     + array('density', densities, 1))


class InTheLiquid(unittest.TestCase):
    def test_a_grain_has_the_size_that_the_case_gives_it(self):
        two = grains([2.0, 2.0], [0.5, 0.25])
        self.assertEqual(solid.ratios_in_liquid(run(**{'fluid.hydrodynamic_radius': '0.8'}), two).tolist(), [0.8, 0.8])
        space = {'fluid.hydrodynamic_radius': '0.8', 'fluid.surface_shift': '0.3', 'fluid.cells_per_diameter': '10'}
        np.testing.assert_allclose(solid.ratios_in_liquid(run(space=True, **space), two), [0.8 + 0.06, 0.8 + 0.12])

    def test_gyration(self):
        square = np.array([[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]])
        two = grains([2.0, 2.0], [0.5, 1.0], {1: square})
        two.centres[1] = (1.5, 0.5)
        np.testing.assert_allclose(solid.square_gyrations(run(), two), [0.125, 1.0 / 6.0])
        np.testing.assert_allclose(solid.square_gyrations(run(space=True), grains([2.0])), [0.1])

    def test_cells_of_a_grain_are_no_motion_of_the_liquid(self):
        """V/2 (U^2 + k^2 w^2) of a body of 0.8 R, a disc of 0.4 D in the plane and a ball in space."""
        case = {'fluid.hydrodynamic_radius': '0.8', 'fluid.cells_per_diameter': '10'}
        one = grains([7.0])
        one.velocities, one.velocity_z, one.spins = np.array([[3.0, 4.0]]), np.zeros(1), np.array([[0.0, 0.0, 5.0]])
        self.assertAlmostEqual(energy.in_grains(run(**case), one), 0.5 * np.pi * 0.4**2 * (25 + 0.5 * 0.4**2 * 25))
        self.assertAlmostEqual(energy.in_grains(run(space=True, **case), one),
                               0.5 * 4 / 3 * np.pi * 0.4**3 * (25 + 0.4 * 0.4**2 * 25))


class Front(unittest.TestCase):
    def outputs(self, *free_at):
        """Of a free grain at these places, beside one that is held at x = 7."""
        data = run()
        for name, x in zip(('first', 'last'), free_at):
            there = Grains(0.0, np.array([[x, 1.0], [7.0, 1.0]]), np.array([0.5, 0.5]), prescribed=np.array([False, True]))
            data.measured[f'grain_files.{name}_grains'] = there
        return data

    def test_a_held_grain_is_no_front(self):
        self.assertTrue(self.outputs(7.5, 8.0).front_is_free())
        self.assertFalse(self.outputs(3.0, 8.0).front_is_free())
        self.assertFalse(self.outputs(7.9, 5.0).front_is_free())


class WrittenGrains(RunFolderTest):
    """Grains of densities 2 and 4, of which the heavy one leaves; density_ratio of the case is 1.5."""

    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('case.yaml', CASE.replace('grains:', 'grains:\n  density_ratio: 1.5'))
        self.write('run.json', json.dumps({'D': 1, 'u_c': 1, 't_c': 1, 'g': 1, 'rho': 1, 'reynolds': 10}))
        self.write('grains/grains_00000000.vtp', grain_file([4, 9], [2.0, 4.0]))
        self.write('grains/grains_00000001.vtp', grain_file([4], [2.0]))
        cells = array('id_a', np.array([-3]), 1) + array('id_b', np.array([4]), 1) + array('normal_force', [6.0], 1)
        cells += array('force', [[0.0, 6.0, 0.0]]) + array('normal', [[0.0, 1.0, 0.0]])
        for k in range(2):
            self.write(f'grains/c{k}.vtp', poly_data(np.array([[0.5, 0, 0], [0.5, 0.5, 0]]), '', '', cells))
        entries = ''.join(f'<DataSet timestep="{k}" part="0" file="c{k}.vtp"/>' for k in range(2))
        self.write('grains/contacts.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
        self.run_data = run_data.load_run(self.folder)

    def test_forces_of_an_output_are_over_the_density_of_its_grains(self):
        first, last = snapshots.snapshots(self.run_data)
        self.assertEqual((first.density, last.density), (3.0, 2.0))
        np.testing.assert_allclose([first.contacts.force[0, 1], last.contacts.force[0, 1]], [2.0, 3.0])
        np.testing.assert_allclose([first.fluid_force[0, 1], last.fluid_force[0, 1]], [2.0, 3.0])
        np.testing.assert_allclose([float(one.forces[0]) for one in contact_files.networks(self.run_data)], [2.0, 3.0])

    def test_prescribed_grains_are_known(self):
        self.assertTrue(snapshots.snapshots(self.run_data)[0].free().all())
        file = self.folder / 'grains/grains_00000000.vtp'
        file.write_text(file.read_text().replace('<PointData>', '<PointData>' + array('prescribed', np.array([0, 1]), 1)))
        self.assertEqual(snapshots.snapshots(run_data.load_run(self.folder))[0].prescribed_ids().tolist(), [9])

    def test_spins_are_read(self):
        self.assertEqual(snapshots.snapshots(self.run_data)[0].spins.tolist(), 2 * [[0.0, 0.0, 12.0]])

    def test_pressures_are_over_the_density_of_the_first_grains(self):
        self.assertAlmostEqual(pore_pressure.unit(self.run_data), 2.0)
        self.assertAlmostEqual(weight_balance.submerged_share(self.run_data), 2.0 / 3.0)
        (self.folder / 'grains/grains_00000000.vtp').write_text('damaged')
        self.assertAlmostEqual(pore_pressure.unit(run_data.load_run(self.folder)), 1.0)

    def test_the_fall_is_over_the_mass_of_the_grains(self):
        # (M - m_f) over M of all: 4/6 at the speed 6 of both, and 1/2.
        first, last = snapshots.snapshots(self.run_data)
        self.assertAlmostEqual(energy.fall_of(self.run_data, first), 6.0 * 4.0 / 6.0)
        self.assertAlmostEqual(energy.fall_of(self.run_data, last), 6.0 * 0.5)

    def test_the_energy_of_the_liquid_is_over_the_mass_of_the_grains(self):
        ours = energy.fluid_kinetic(self.run_data)[1]
        self.run_data.measured.clear()
        for k, densities in enumerate(([4.0, 8.0], [4.0])):
            self.write(f'grains/grains_{k:08d}.vtp', grain_file([4, 9][:2 - k], densities))
        np.testing.assert_allclose(energy.fluid_kinetic(self.run_data)[1], ours / 2.0)

    def test_walls_that_move_are_no_liquid(self):
        for wall, there in (('0,0,0', True), ('0,0,0.1', False), ('-1,0,0', False)):
            self.write('grains/walls.csv', f'id,x1,y1,x2,y2,vx,vy,spin\n1,0,0,1,0,{wall}\n')
            self.assertEqual(energy.fluid_kinetic(run_data.load_run(self.folder)) is not None, there, wall)

    def test_no_energy_is_left_where_only_the_cells_of_grains_move(self):
        self.write('case.yaml', CASE.replace('fluid:', 'fluid:\n  hydrodynamic_radius: 0.8'))
        # A disc of 0.4 D in 24 D2 with U = 6 u_c and w = 12/t_c has the energy of all cells with u^2 = share (U^2 + k^2 w^2).
        square = 0.4**2 * np.pi / 24.0 * (6.0**2 + 0.5 * 0.4**2 * 12.0**2)
        self.write('fluid/1/U', f'internalField uniform (0 {np.sqrt(square):.17g} 0);')
        self.assertAlmostEqual(energy.fluid_kinetic(run_data.load_run(self.folder))[1][1], 0.0)

    def test_the_viscous_number_is_of_the_same_density(self):
        first, last = snapshots.snapshots(self.run_data)
        # eta rate/p with p = 6 [rho_f u_c^2]: 2 rho_s g D at first, 3 at the end.
        for one, pressure in ((first, 2.0), (last, 3.0)):
            self.assertAlmostEqual(rheology.viscous_number(self.run_data, one, 0.3, pressure, 1.0), 0.3 / (10.0 * 6.0))


if __name__ == '__main__':
    unittest.main()
