# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a report by hand: the same run in SI and in units of one, columns by name, pressures of fields, works."""
import json
import shutil
import sys
import unittest
from pathlib import Path

import analysis_test
import numpy as np
from analysis_test import DISC, run, snapshot, with_snapshots
from made_up_run import CASE, COLUMNS, ROWS, RunFolderTest
from space_report_test import array, poly_data

import captions
import contact_files
import findings
import grain_files
import pictures
import plates
import run_data
import surface
from analysis import (concentration, deposit, dilatancy, energy, packing_triangles, pore_pressure, rheology, shear_band,
                      snapshots, weight_balance)
from head import key_numbers
from measured import MEASURED
from space import walls

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'bench'))
import liggghts_drum
import run_outs

SI = {'D': 0.01, 'u_c': 0.5, 't_c': 0.02, 'g': 9.81, 'rho': 1000.0, 'nu': 5e-4}
ONE = {'D': 1.0, 'u_c': 1.0, 't_c': 1.0, 'g': 9.81 * 0.01 / 0.5**2, 'rho': 1.0, 'nu': 0.1}


class Units(RunFolderTest):
    """The same column in units of D, u_c, rho_f and in SI: every number of it is the same."""

    def write_in(self, s):
        """Two outputs of a column that falls over, with a contact, and the liquid's fields."""
        d, u, t, rho, g = (s[name] for name in ('D', 'u_c', 't_c', 'rho', 'g'))
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace('[4, 6]', '[8, 6]').replace(
            'left: wall', 'left: wall\n  right: wall').replace('grains:', 'grains:\n  density_ratio: 1.5'))
        self.write('run.json', json.dumps({'status': 'done', 'reynolds': 10, **s}))
        self.write('history.csv', 'step,time,mean_velocity_norm,mean_velocity_y,mean_speed,kinetic_energy,'
                   'potential_energy,contact_work,fluid_work,grains\n0,0,0,0,0,0,5,,,6\n'
                   '10,1,0.5,-0.5,0.5,0.1,4,-0.2,-0.6,6\n')
        entries = contacts = ''
        for k, columns in enumerate(([3, 3], [3, 2, 1])):
            places = np.array([[i + 0.5, j + 0.5, 0] for i, count in enumerate(columns) for j in range(count)])
            n = len(places)
            speed = np.tile([0.0, -0.5 * k, 0.0], (n, 1))
            self.write(f'grains/grains_{k:08d}.vtp', poly_data(
                d * places, '', array('id', np.arange(n), 1) + array('radius', np.full(n, 0.5 * d), 1)
                + array('velocity', u * speed) + array('angular_velocity', np.tile([0, 0, 2.0 / t], (n, 1)))
                + array('density', np.full(n, 1.5 * rho), 1) + array('force', rho * u**2 * d * np.ones((n, 3)))))
            ends = np.array([[0.5, 0, 0], [0.5, 0.5, 0]])
            self.write(f'grains/c{k}.vtp', poly_data(d * ends, '', '', array('id_a', np.array([-3]), 1)
                       + array('id_b', np.array([0]), 1) + array('normal', [[0.0, 1.0, 0.0]])
                       + array('force', [[0.0, 2.0 * rho * g * d**2, 0.0]])
                       + array('normal_force', [2.0 * rho * g * d**2], 1)))
            entries += f'<DataSet timestep="{k * t}" part="0" file="grains_{k:08d}.vtp"/>'
            contacts += f'<DataSet timestep="{k * t}" part="0" file="c{k}.vtp"/>'
            j, i = np.mgrid[0:12, 0:16]
            for name, kind, values in (('U', 'vector', np.stack([u * i, u * j / 100, 0.0 * i], -1).reshape(-1, 3)),
                                       ('p', 'scalar', (u**2 * (i - 3.0 * j)).reshape(-1, 1))):
                head = b'format binary;\nclass vol;\ninternalField nonuniform List<%s> \n%d\n(' % (kind.encode(), len(values))
                self.write(f'fluid/{k * t:g}/{name}', head + values.astype('<f8').tobytes() + b')\n;\n')
        self.write('grains/grains.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
        self.write('grains/contacts.pvd', f'<VTKFile><Collection>{contacts}</Collection></VTKFile>')
        return run_data.load_run(self.folder)

    def numbers_of(self, data):
        return {one.name: one.of(data) for one in MEASURED}

    def arrays_of(self, data):
        """In D, u_c, t_c and what is made of them, in one row."""
        one, network = snapshots.snapshots(data)[1], contact_files.networks(data)[-1]
        shown = [pictures.load(data, instant) for instant in pictures.instants(data)]
        probes = pore_pressure.probes(data)
        arrays = (one.time, one.centres, one.radii, one.velocities, one.spins, one.areas, one.fluid_force, one.contacts.ends,
                  one.contacts.force, network.time, network.ends, network.forces, *energy.fluid_kinetic(data),
                  *surface.final_surface(data), energy.budget(data).splitting, probes.time, probes.values,
                  pictures.colour_limit(data, shown), pictures.view(data, [one.grains for one in shown]),
                  deposit.deposit(data).time)
        return np.concatenate([np.ravel(values) for values in arrays]), [pictures.in_words(data, one) for one in shown]

    def test_the_same_run_in_si_has_the_same_numbers(self):
        one = self.write_in(ONE)
        mine, (arrays, words) = self.numbers_of(one), self.arrays_of(one)
        shutil.rmtree(self.folder / 'fluid')
        other = self.write_in(SI)
        theirs, (si_arrays, si_words) = self.numbers_of(other), self.arrays_of(other)
        self.assertEqual(one.remarks + other.remarks, [])
        for name in ('run_out', 'heap_height', 'pressure_lowest', 'least_on_contacts', 'energy_defect', 'to_fluid'):
            self.assertIsNotNone(mine[name], name)
        self.assertEqual([name for name in mine if mine[name] is None], [name for name in theirs if theirs[name] is None])
        for name in (name for name in mine if mine[name] is not None):
            self.assertAlmostEqual(mine[name], theirs[name], places=9, msg=name)
        np.testing.assert_allclose(si_arrays, arrays, rtol=1e-9, atol=1e-9)
        self.assertEqual(words, si_words)
        self.assertIn('from 0 to 0.11 u_c', words[0])

    def test_gravity_of_a_sedimentation(self):
        """u_c = sqrt(g D)/2: I = 0.3/2/sqrt(1.5), J = 0.3/4/(10 1.5 1.5)."""
        found = rheology.cells(with_snapshots(run(record={'reynolds': 10.0, 'g': 4.0}),
                                             analysis_test.Rheology.pressed(None, 0.3)))
        self.assertAlmostEqual(float(np.median(found.inertial)), 0.15 / np.sqrt(1.5), delta=0.01)
        self.assertAlmostEqual(float(np.median(found.viscous)), 0.075 / 22.5, delta=0.0003)
        data = run({'time.step': '0.1'}, record={'g': 4.0}, time=[0, 1], grains=[7, 7], kinetic_energy=[0, 0],
                   potential_energy=[1, 1], contact_work=[np.nan, 0], fluid_work=[np.nan, 0], mean_velocity_y=[0, -0.5])
        # dt/2 (1 - 1/1.5) g dU_y
        self.assertAlmostEqual(energy.budget(data).splitting[-1], 0.05 / 3.0 * 4.0 * -0.5)


class Works(unittest.TestCase):
    def test_what_contacts_and_liquid_take(self):
        data = run({'time.step': '0.1'}, time=[0, 1], grains=[7, 7], kinetic_energy=[0, 0.1], potential_energy=[5, 4],
                   contact_work=[np.nan, -0.2], fluid_work=[np.nan, -0.7], mean_velocity_y=[0, 0])
        self.assertLess(energy.largest_defect(data), 1e-12)
        measure = {one.name: one.measure for one in MEASURED}
        self.assertAlmostEqual(measure['to_contacts'](data), 0.2)
        self.assertAlmostEqual(measure['to_fluid'](data), 0.7)
        self.assertIn('lose 1 m u_c² of potential energy each (mean): 10 % is their motion, 20 % went to contacts, '
                      '70 % to the liquid.', energy.caption(data, energy.budget(data)))

    def test_grains_that_begin_with_a_velocity_spend_it_too(self):
        data = run({'time.step': '0.1'}, time=[0, 1], grains=[7, 7], kinetic_energy=[4, 1], potential_energy=[5, 4],
                   contact_work=[np.nan, 0.0], fluid_work=[np.nan, -4], mean_velocity_y=[0, 0])
        measure = {one.name: one.measure for one in MEASURED}
        self.assertEqual(str(measure['to_contacts'](data)), '0.0')
        self.assertAlmostEqual(measure['to_fluid'](data), 1.0)
        self.assertIn('lose 1 m u_c² of potential energy each (mean), and 3 m u_c² of kinetic energy: 0 % went to contacts, '
                      '100 % to the liquid.', energy.caption(data, energy.budget(data)))


class Columns(unittest.TestCase):
    def test_every_column_is_the_number_that_it_names(self):
        data = run(time=[0, 1, 2], mean_velocity_norm=[0, 0.5, 1], mean_speed=[1, 1, 1e-5], step=[0, 10, 20],
                   wall_step=[np.nan, 0.1, 0.1], pore_volume=[10, 10.4, 10.2], mean_position_x=[5, 5.1, 5.25])
        put = lambda name, value: data.measured.__setitem__(f'analysis.{name}', value)
        put('snapshots.snapshots', [])
        put('deposit.deposit', deposit.Deposit(1.0, None, None, 2.0, 5.0, 3.0, 30.0, (3.0, -0.5)))
        put('shear_band.shear_band', shear_band.ShearBand(1.0, None, None, None, None, 45.0, 2.0, 0.25))
        put('pore_pressure.probes', pore_pressure.Probes(['a'], np.zeros((1, 2)), np.arange(3.0),
                                                         np.array([[9.0], [-2.0], [3.0]])))
        put('rheology.cells', rheology.Cells(np.zeros(24), np.repeat([0.3, 0.4, 0.6], 8), None,
                                             np.repeat([0.005, 0.05, 0.5], 8), None))
        share = np.array([1.0, 0.3, 0.8])
        put('weight_balance.carriers', weight_balance.Carriers(np.arange(3.0), share, *(3 * [0 * share]),
                                                              np.array([0, 0.5, 0.15]), share))
        found = {one.name: one.measure(data) for one in MEASURED}
        expected = {'peak_velocity': 1.0, 'peak_time': 2.0, 'run_out': 1.5, 'heap_height': 3.0, 'heap_slope': 30.0,
                    'slip_angle': 45.0, 'quiescent_share': 0.25, 'pore_change': 0.02, 'pore_extreme': 0.04,
                    'pressure_lowest': -2.0, 'pressure_highest': 3.0, 'least_on_contacts': 0.3, 'weight_defect': 0.05,
                    'friction_slow': 0.3, 'friction_fast': 0.6, 'wall_seconds': 2.0}
        for name, value in expected.items():
            self.assertAlmostEqual(found[name], value, msg=name)


class FieldPressures(RunFolderTest):
    """p = 3 x - 2 y [u_c^2] in 4 x 6 D; the discs reach x = 2.9 and y = 4.5 at first, in the unit (1.5 - 1) g D."""

    def test_places_and_level(self):
        for right, shift in (('wall', 0.25), ('free', 0.0)):   # -0.25 in the middle of the upper right cell
            self.write_all()
            self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace(
                'left: wall', f'left: wall\n  right: {right}').replace('grains:', 'grains:\n  density_ratio: 1.5'))
            path = self.folder / 'grains/grains_00000000.vtp'
            path.write_text(path.read_text().replace('1 4 0', '1 0.5 0'))   # one of them on the floor
            j, i = np.mgrid[0:ROWS, 0:COLUMNS]
            p = 3.0 * (i + 0.5) / 2 - 2.0 * (j + 0.5) / 2
            for time, factor in ((0, 100.0), (1, 1.0)):
                head = b'format binary;\ninternalField nonuniform List<scalar> \n%d\n(' % p.size
                self.write(f'fluid/{time}/p', head + (factor * p).astype('<f8').tobytes() + b')\n;\n')
            data = run_data.load_run(self.folder)
            found = pore_pressure.probes(data)
            np.testing.assert_allclose(found.places, [[1.5, 0.5], [0.5, 2.25], [1.5, 2.25]])
            np.testing.assert_allclose(found.values[1], (np.array([3.5, -3.0, 0.0]) + shift) / 0.5, atol=1e-12)
            self.assertAlmostEqual(pore_pressure.extreme(data, 1), shift / 0.5)


class OnHeldGrains(unittest.TestCase):
    """A column of 5 x 8 D that stands on a row of held discs over all of the floor of 40 D."""

    def setUp(self):
        free = [[0.5 + i, 1.5 + j] for i in range(5) for j in range(8)]
        held = [[0.5 + i, 0.5] for i in range(40)]
        one = snapshot(held + free)
        one.prescribed = np.arange(80) < 40
        self.run_data = with_snapshots(run({'domain.right': 'wall'}, time=[0, 1, 2], front_x=[40, 40, 40],
                                           mean_velocity_norm=[0, 0.5, 0.1], grains=[80, 80, 80]), one)
        self.run_data.measured['grain_files.first_grains'] = grain_files.Grains(
            0.0, one.centres, np.full(80, 0.5), prescribed=one.prescribed)

    def test_pressures_are_those_in_the_column(self):
        np.testing.assert_allclose(pore_pressure.natural_places(self.run_data), [[2.5, 0.5], [0.5, 4.5], [2.5, 4.5]])

    def test_their_front_is_no_front(self):
        self.assertTrue(self.run_data.is_avalanche())
        self.run_data.measured['analysis.deposit.deposit'] = None
        self.assertEqual(captions.front_caption(self.run_data), '')
        self.assertNotIn('Front', ' '.join(title for title, _ in key_numbers.rows(self.run_data)))
        self.run_data.measured.pop('grain_files.first_grains')
        self.assertIn('Front from 40 D', captions.front_caption(self.run_data))


class Others(unittest.TestCase):
    def test_solid_of_a_triangle_is_by_its_angles(self):
        one = snapshot([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        one.areas = np.array([8.0, 16.0, 32.0]) / 64.0
        mesh = packing_triangles.triangles(one)   # angles of 90, 45 and 45 degrees: 1/4, 1/8, 1/8
        self.assertAlmostEqual(float(mesh.solid[0]), (8 / 4 + 16 / 8 + 32 / 8) / 64.0)

    def test_quiescent_grains(self):
        speeds = np.repeat([1.0, 0.3, 0.05], [20, 30, 50])
        one = snapshot([[k % 10, k // 10] for k in range(100)], np.column_stack([speeds, 0 * speeds]))
        self.assertAlmostEqual(shear_band.quiescent_share(one), 0.5)   # below 0.1 of 1
        one.prescribed = speeds == 0.05
        self.assertAlmostEqual(shear_band.quiescent_share(one), 0.0)

    def test_layers_of_a_box_that_is_no_whole_number_high(self):
        data = with_snapshots(run({'domain.size': '[4, 5.4]'}), snapshot([[1, 0.6], [3, 2.0]]))
        found = concentration.concentration(data)                      # five layers of 1.08 D
        self.assertEqual(len(found.edges), 6)
        self.assertAlmostEqual(float(found.shares.sum()) * 4 * 1.08, 2 * DISC)

    def test_motions_with_a_phase_begin_where_the_wall_is(self):
        motion = {'m.kind': 'harmonic', 'm.amplitude': '[0.4, 0]', 'm.period': '2', 'm.phase': f'{np.pi / 2}', 'm.turn': '0.1',
                  'c.kind': 'constant', 'c.velocity': '[1, 2]', 'c.spin': '3'}
        case = {'dimension': '2', **{f'domain.motions.{name}': value for name, value in motion.items()}}
        data = run_data.RunData('nowhere', case=case)
        for time, share in ((0.0, 0.0), (0.5, -1.0), (1.0, -2.0)):      # sin(pi t + pi/2) - 1
            moved, turn = plates.shift(data, {'motion': 'm'}, time)
            np.testing.assert_allclose([*moved, turn], [0.4 * share, 0.0, 0.1 * share], atol=1e-12)
        moved, turn = plates.shift(data, {'motion': 'c'}, 2.0)
        np.testing.assert_allclose([*moved, turn], [2.0, 4.0, 6.0])
        case.update({'domain.motions.m.amplitude': '[0.4, 0, 0.2]', 'domain.motions.m.axis': '[0, 2, 0]',
                     'dimension': '3'})
        moved, turn = walls.shift(data, {'motion': 'm'}, 1.0)
        np.testing.assert_allclose([*moved, *turn], [-0.8, 0, -0.4, 0, -0.2, 0], atol=1e-12)


class More(unittest.TestCase):
    def test_the_dilatancy_of_the_start_is_over_time(self):
        data = run(time=[0, 1, 4, 8], mean_velocity_norm=[0, 0.1, 0.5, 1])
        data.measured['analysis.dilatancy.dilatancy'] = dilatancy.Dilatancy(
            np.array([0.0, 1.0, 4.0]), np.array([0.0, 0.4, 0.0]), np.ones(3))
        # 0.2 over the first t_c, 0.6 over the three after it: 0.8/4
        self.assertAlmostEqual(dilatancy.initial_angle(data), np.degrees(np.arcsin(0.2)))

    def test_means_of_groups(self):
        at = lambda t: run(time=range(6), mean_speed=[1.0 * (k < t) for k in range(6)])
        self.assertEqual(findings.mean_rest_time([at(2), at(3), at(5)]), 10.0 / 3.0)
        data = run(time=[0, 1, 2], step=[0, 10, 40], wall_step=[np.nan, 0.1, 0.3])
        self.assertAlmostEqual(findings.wall_seconds(data)[0], 10.0)
        self.assertAlmostEqual(findings.wall_seconds(data)[1], 0.25)


class Benchmarks(unittest.TestCase):
    def test_laws_are_drawn_where_the_data_are(self):
        """Lube: up to a = 1.8 and from 2.8 on."""
        for low, high, ends in ((0.5, 5.0, [(0.5, 1.8), (2.8, 5.0)]), (0.5, 1.2, [(0.5, 1.2)]),
                                (3.0, 9.0, [(3.0, 9.0)]), (2.0, 2.5, [])):
            found = run_outs.curves_within(run_outs.LUBE, low, high)
            np.testing.assert_allclose([(a[0], a[-1]) for a, _ in found], np.reshape(ends, (-1, 2)).tolist())
        np.testing.assert_allclose(run_outs.curves_within(run_outs.LUBE, 0.5, 1.0)[0][1][[0, -1]], [0.6, 1.2])

    def test_states_of_the_drum_are_at_equal_parts_of_its_time(self):
        np.testing.assert_allclose(liggghts_drum.times_of(3, 0.16), [0.16 / 3, 0.32 / 3, 0.16])


if __name__ == '__main__':
    unittest.main()
