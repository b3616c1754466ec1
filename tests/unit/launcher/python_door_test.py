# SPDX-License-Identifier: LGPL-2.1-or-later
"""`import turbidite` on made-up run folders: values, units, coordinates, and errors in words."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from made_up_run import CASE, COLUMNS, ROWS, RunFolderTest, foam_file, velocities
from processor_fields_test import label_file
from space_report_test import array, poly_data, rectilinear_file, slice_file

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'launcher/python'))
import turbidite
from turbidite import case_values, places, tables

# Of a physical run: lengths in units of 10 mm, velocities of 0.5 m/s.
SI = {'D': 0.01, 'u_c': 0.5, 't_c': 0.02, 'g': 25.0, 'rho': 1000.0, 'nu': 1e-6}
PROGRAM = """#!/usr/bin/python3
import shutil, sys
words = sys.argv[1:]
if 'grains.count=3' in words:
    print('  folder: ' + words[words.index('--out') + 1])
    print('grains.count = 3 is odd\\n  Allowed: even numbers.', file=sys.stderr)
    sys.exit(2)
shutil.copytree({made_up!r}, words[words.index('--out') + 1])
print('quickstart: 2 grains\\n  folder: ' + words[words.index('--out') + 1] + '\\n100 %')
open({told!r}, 'w').write(repr(words))
"""


def series(*entries):
    told = ''.join(f'<DataSet timestep="{time}" part="0" file="{file}"/>' for time, file in entries)
    return f'<VTKFile><Collection>{told}</Collection></VTKFile>'


def grain_file(ids, places, velocities, spins):
    count = len(ids)
    data = array('id', np.array(ids), 1) + array('radius', np.full(count, 0.5), 1) + array('velocity', velocities)
    data += array('angular_velocity', spins) + array('contact_force', velocities) + array('force', velocities)
    return poly_data(places, array('connectivity', np.arange(count), 1), data + array('orientation', np.ones((count, 4)), 4))


class Door(RunFolderTest):
    def made_up(self):
        self.write_all()
        return turbidite.load(self.folder)


class Tables(Door):
    def test_history_without_pandas_is_a_structured_array(self):
        with mock.patch.dict(sys.modules, {'pandas': None}):
            history = self.made_up().history
        self.assertEqual(history['time'].tolist(), [0.0, 1.0])
        self.assertEqual(history.columns[:2], ['step', 'time'])
        self.assertTrue(np.isnan(history['max_penetration'][0]))
        with self.assertRaisesRegex(turbidite.UnknownName, 'Did you mean "mean_speed"'):
            history['mean_sped']
        with self.assertRaisesRegex(AttributeError, 'apt install python3-pandas'):
            history.plot()

    def test_history_with_pandas_is_a_data_frame(self):
        try:
            import pandas
        except ImportError:  # what matters here is that the columns reach it
            pandas = types.SimpleNamespace(DataFrame=lambda columns: ('frame', columns))
        with mock.patch.dict(sys.modules, {'pandas': pandas}):
            history = self.made_up().history
        columns = history[1] if isinstance(history, tuple) else history
        self.assertEqual(list(columns['time']), [0.0, 1.0])

    def test_column_leaves_out_empty_rows(self):
        time, values = self.made_up().column('max_penetration')
        self.assertEqual((time.tolist(), values.tolist()), ([1.0], [0.0]))

    def test_history_that_is_not_there(self):
        run = self.made_up()
        (self.folder / 'history.csv').unlink()
        self.assertEqual(len(run.column('time')[0]), 2)  # what was loaded stays
        with self.assertRaisesRegex(turbidite.NotThere, 'history.csv is missing'):
            turbidite.load(self.folder).history

    def test_probes(self):
        with self.assertRaisesRegex(turbidite.NotThere, 'output.probes'):
            self.made_up().probes
        self.write('probes.csv', 'time,pressure_1\n1,0.25\n')
        self.assertEqual(list(turbidite.load(self.folder).probes['pressure_1']), [0.25])
        self.write('probes.csv', 'time,pressure_1\n1,0.25\n2,0.')  # a kill cut it off
        self.assertEqual(list(turbidite.load(self.folder).probes['pressure_1']), [0.25])


class Case(Door):
    def test_values_have_types(self):
        case = self.made_up().case
        self.assertEqual(case['domain'], {'size': [4, 6], 'left': 'wall'})
        self.assertIs(case['fluid']['enabled'], True)
        self.assertEqual(case['time'], {'step': 0.1})
        self.assertEqual(case['dimension'], 2)

    def test_lists_and_maps(self):
        for text, expected in (('~', None), ('1e-06', 1e-6), ('[[0, 1], [2.5, a b]]', [[0, 1], [2.5, 'a b']]), ('[]', []),
                               ('{gate: {kind: table, table: [0, -1]}, c: ~}',
                                {'gate': {'kind': 'table', 'table': [0, -1]}, 'c': None}),
                               ('{cmd: "a, b: [c]", time: 12:30}', {'cmd': 'a, b: [c]', 'time': '12:30'}),
                               (r'["say \"a\"", "1", "C:\\"]', ['say "a"', '1', 'C:\\']), ('"a" b "c"', '"a" b "c"')):
            self.assertEqual(case_values.value(text), expected)
        with self.assertRaises(ValueError):
            case_values.value('[1, 2] 3')

    def test_record_and_state(self):
        run = self.made_up()
        self.assertEqual((run.state, run.record['reynolds'], run.scales['u_c']), ('done', 36, 1))

    def test_folders_that_are_no_runs(self):
        self.write('runs/rough/case.yaml', CASE)
        with self.assertRaisesRegex(turbidite.NoSuchRun, 'Did you mean .*/runs/rough'):
            turbidite.load(self.folder / 'runs/ruogh')
        with self.assertRaisesRegex(turbidite.NoSuchRun, 'no run .*/runs/17$'):
            turbidite.load(self.folder / 'runs/17')
        with self.assertRaisesRegex(turbidite.NoSuchRun, 'no case.yaml'):
            turbidite.load(self.folder / 'runs')


class Grains(Door):
    """Two grains that move, then one of them: in SI."""

    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('run.json', json.dumps({'status': 'running', **SI}))
        first = grain_file([9, 4], np.array([[0.01, 0.02, 0], [0.03, 0.02, 0]]), np.array([[0.5, 0, 0], [0, 1.0, 0]]),
                           np.array([[0, 0, 50.0], [0, 0, 0]]))
        last = grain_file([4], np.array([[0.03, 0.01, 0]]), np.zeros((1, 3)), np.zeros((1, 3)))
        self.write('grains/a.vtp', first)
        self.write('grains/b.vtp', last)
        self.write('grains/grains.pvd', series((0, 'a.vtp'), (0.02, 'b.vtp')))
        self.run_folder = turbidite.load(self.folder)

    def test_arrays_are_dimensionless(self):
        grains = self.run_folder.grains
        self.assertEqual(grains.times.tolist(), [0.0, 1.0])
        first = grains[0]
        np.testing.assert_allclose(first['position'], [[1, 2], [3, 2]])
        np.testing.assert_allclose(first['velocity'], [[1, 0], [0, 2]])
        np.testing.assert_allclose(first['angular_velocity'], [1, 0])     # 50/s at u_c/D = 50/s
        np.testing.assert_allclose(first['force'][0, 0], 0.5 / (1000 * 0.5**2 * 0.01))
        np.testing.assert_allclose(first['contact_force'][0, 0], 0.5 / (1000 * 25 * 0.01**2))
        self.assertEqual(first['id'].tolist(), [9, 4])
        self.assertEqual(first['orientation'].shape, (2, 4))
        self.assertNotIn('connectivity', first)

    def test_outputs_by_number_and_time(self):
        grains = self.run_folder.grains
        self.assertEqual([output.time for output in grains], [0.0, 1.0])
        self.assertEqual((grains[-1].time, grains.at(0.8).time, len(grains[:1])), (1.0, 1.0, 1))
        with self.assertRaises(IndexError):
            grains[2]
        with self.assertRaisesRegex(turbidite.NotThere, '0 to 1 t_c, not at 3'):
            grains.at(3)
        with self.assertRaisesRegex(KeyError, 'Did you mean "velocity"'):
            grains[0]['velocty']

    def test_times_are_those_of_the_rows(self):
        # Nine digits of seconds are not the row's time in t_c: a table joined by it lost all rows but the first.
        self.write('grains/grains.pvd', series((0, 'a.vtp'), (0.0200000001, 'b.vtp')))
        run = turbidite.load(self.folder)
        self.assertEqual(run.grains.times.tolist(), run.history['time'].tolist())
        self.assertEqual(run.grains[1].time, 1.0)
        self.write('grains/grains.pvd', series((0, 'a.vtp'), (0.0201, 'b.vtp')))  # no row is near
        self.assertAlmostEqual(turbidite.load(self.folder).grains[1].time, 1.005)

    def test_over_time_follows_ids(self):
        ids, positions = self.run_folder.grains.over_time('position')
        self.assertEqual(ids.tolist(), [4, 9])
        np.testing.assert_allclose(positions[:, 0], [[3, 2], [3, 1]])
        self.assertTrue(np.isnan(positions[1, 1]).all())

    def test_table_has_a_column_per_component(self):
        with mock.patch.dict(sys.modules, {'pandas': None}):
            table = self.run_folder.grains[0].table()
        np.testing.assert_allclose(table['velocity_y'], [0, 2])
        self.assertIn('orientation_w', table.columns)
        self.assertNotIn('velocity_z', table.columns)

    def test_an_empty_box_keeps_its_shapes(self):
        self.write('grains/empty.vtp', grain_file([], *3 * [np.empty((0, 3))]))
        self.write('grains/grains.pvd', series((0, 'a.vtp'), (0.02, 'empty.vtp')))
        grains = turbidite.load(self.folder).grains
        shapes = {name: values.shape for name, values in grains[1].items()}
        self.assertEqual(shapes, {name: (0, *values.shape[1:]) for name, values in grains[0].items()})
        self.assertEqual(shapes['velocity'], (0, 2))
        ids, positions = grains.over_time('position')
        self.assertEqual((ids.tolist(), positions.shape), ([4, 9], (2, 2, 2)))
        self.assertTrue(np.isnan(positions[1]).all())
        with mock.patch.dict(sys.modules, {'pandas': None}):
            self.assertEqual(grains[1].table().columns, grains[0].table().columns)
            self.assertEqual(len(grains[1].table()), 0)

    def test_an_output_without_contacts_keeps_its_shapes(self):
        cells = lambda count: (array('id_a', np.full(count, -3), 1) + array('id_b', np.full(count, 4), 1)
                               + array('normal_force', np.ones(count), 1) + array('force', np.ones((count, 3))))
        for count in (0, 1):
            self.write(f'grains/c{count}.vtp', poly_data(np.zeros((2 * count, 3)), '', '', cells(count)))
        self.write('grains/contacts.pvd', series((0, 'c0.vtp'), (0.02, 'c1.vtp')))
        none, one = turbidite.load(self.folder).contacts
        self.assertEqual([none[name].shape for name in ('id_a', 'force', 'ends')], [(0,), (0, 2), (0, 2, 2)])
        with mock.patch.dict(sys.modules, {'pandas': None}):
            self.assertEqual(none.table().columns, one.table().columns)

    def test_an_index_that_is_being_written(self):
        self.write('grains/grains.pvd', '<VTKFile><Coll')
        with self.assertRaisesRegex(turbidite.NotThere, 'at work'):
            self.run_folder.grains
        whole = series((0, 'a.vtp'), (0.02, 'b.vtp'))
        self.write('grains/grains.pvd', whole[:whole.index('b.vtp')])
        run = turbidite.load(self.folder)
        self.assertEqual(run.grains.times.tolist(), [0.0])
        self.assertIn('after 1 whole entries', ' '.join(run.remarks))

    def test_contacts(self):
        with self.assertRaisesRegex(turbidite.NotThere, 'no contacts'):
            self.run_folder.contacts
        cells = array('id_a', np.array([-3]), 1) + array('id_b', np.array([4]), 1) + array('normal_force', [12.5], 1)
        self.write('grains/c.vtp', poly_data(np.array([[0.03, 0, 0], [0.03, 0.005, 0]]),
                                             array('connectivity', np.array([0, 1]), 1), '', cells))
        self.write('grains/contacts.pvd', series((0.02, 'c.vtp')))
        contacts = turbidite.load(self.folder).contacts
        self.assertEqual((contacts[0]['id_a'].tolist(), contacts[0].time), ([-3], 1.0))
        np.testing.assert_allclose(contacts[0]['ends'], [[[3, 0], [3, 0.5]]])
        np.testing.assert_allclose(contacts[0]['normal_force'], 12.5 / (1000 * 25 * 0.01**2))
        with mock.patch.dict(sys.modules, {'pandas': None}):
            self.assertEqual(contacts[0].table()['end_y'].tolist(), [0.5])


    def test_forces_of_contacts_are_over_the_mean_density_of_the_grains(self):
        """Of all that are there: 3 and 5 times that of the liquid, then 3 alone."""
        cells = array('id_a', np.array([-3]), 1) + array('id_b', np.array([4]), 1) + array('normal_force', [12.5], 1)
        for name, densities in (('a', [5000.0, 3000.0]), ('b', [3000.0])):
            file = self.folder / f'grains/{name}.vtp'
            file.write_text(file.read_text().replace('<PointData>', '<PointData>' + array('density', densities, 1)))
            self.write(f'grains/c{name}.vtp', poly_data(np.array([[0.03, 0, 0], [0.03, 0.005, 0]]), '', '', cells))
        self.write('grains/contacts.pvd', series((0, 'ca.vtp'), (0.02, 'cb.vtp')))
        run, weight = turbidite.load(self.folder), 1000 * 25 * 0.01**2
        np.testing.assert_allclose(run.grains[0]['contact_force'][0, 0], 0.5 / (4 * weight))
        np.testing.assert_allclose([one['normal_force'][0] for one in run.contacts], 12.5 / weight / np.array([4, 3]))


class Fields(Door):
    def test_cells_have_coordinates(self):
        field = self.made_up().fields[-1]
        self.assertEqual((field['U'].shape, field.z), ((ROWS, COLUMNS, 2), None))
        self.assertEqual((field.x[5], field.y[3]), (2.75, 1.75))          # two cells per D
        np.testing.assert_allclose(field['U'][3, 5], [5.0, 0.03])
        self.assertEqual(list(field), ['U'])
        with self.assertRaisesRegex(turbidite.UnknownName, 'There are: U'):
            field['p']

    def test_several_ranks_and_si(self):
        self.write_all()
        self.write('run.json', json.dumps({'status': 'done', **SI}))
        halves = np.array_split(np.arange(ROWS * COLUMNS)[::-1], 2)
        for rank, cells in enumerate(halves):
            body = velocities()[cells].astype('<f8').tobytes()
            head = foam_file(True).split(b'internalField')[0]
            self.write(f'fluid/processor{rank}/0.02/U',
                       head + b'internalField   nonuniform List<vector> \n%d\n(' % len(cells) + body + b')\n;\n')
            self.write(f'fluid/processor{rank}/constant/polyMesh/cellProcAddressing', label_file(cells.tolist(), True))
        fields = turbidite.load(self.folder).fields
        self.assertEqual(fields.times.tolist(), [0.0, 1.0, 50.0], 'those of one rank before and after')
        for k in (1, 2):
            np.testing.assert_allclose(fields[k]['U'][3, 5], [10.0, 0.06])  # u_c = 0.5 m/s

    def test_slices(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace('[4, 6]', '[6, 5, 4]'))
        self.write('fluid/slices/a.vtr', slice_file(0, 2.0))
        self.write('fluid/slices/slices.pvd', series((1, 'a.vtr')))
        (plane,) = turbidite.load(self.folder).slices
        one = plane.at(1)
        self.assertEqual((one.x, one.y.shape, one.z.shape, one['p'].shape), (2.0, (10,), (8,), (10, 8)))
        np.testing.assert_allclose(one['U'][4, 6], [2.0, one.y[4], one.z[6]])

    def test_outputs_are_read_without_what_draws(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace('[4, 6]', '[6, 5, 4]'))
        self.write('fluid/slices/a.vtr', slice_file(0, 2.0))
        self.write('fluid/slices/slices.pvd', series((1, 'a.vtr')))
        code = ('import sys; sys.modules["matplotlib"] = None; import turbidite; run = turbidite.load(sys.argv[1]); '
                'print(run.slices[0].at(1)["p"].shape, len(run.fields), len(run.grains))')
        told = subprocess.run([sys.executable, '-B', '-c', code, str(self.folder)], capture_output=True, text=True,
                              env={**os.environ, 'PYTHONPATH': str(places.HERE.parent)})
        self.assertEqual(told.stdout, '(10, 8) 2 2\n', told.stderr)

    def test_fields_of_space_keep_their_layers(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace('[4, 6]', '[4, 3, 1]'))
        field = turbidite.load(self.folder).fields[0]
        self.assertEqual((field['U'].shape, field.z.tolist()), ((2, 6, COLUMNS, 3), [0.25, 0.75]))

    def test_fields_of_the_box_program(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace('[4, 6]', '[1, 3, 1]')
                   .replace('cells_per_diameter: 2', 'cells_per_diameter: 2\n  stretch_ratio: 1.5'))
        self.write('run.json', json.dumps({'status': 'done', 'fluid_program': 'box', **SI}))
        heights = 0.01 * np.array([0, 0.5, 1, 3])
        cells = np.arange(12, dtype=float).reshape(2, 3, 2)  # z, y, x
        self.write('fluid/fields/a.vtr', rectilinear_file({
            'x': [0, 0.005, 0.01], 'y': heights, 'z': [0, 0.005, 0.01], 'p': cells.ravel(),
            'U': np.stack([cells, -cells, 2 * cells], axis=-1).ravel()}))
        self.write('fluid/fields/fields.pvd', series((0.02, 'a.vtr')))
        field = turbidite.load(self.folder).fields[0]
        self.assertEqual((field.time, list(field), field['p'].shape), (1.0, ['U', 'p'], (2, 3, 2)))
        np.testing.assert_allclose(field['p'], cells / 0.5**2)
        np.testing.assert_allclose(field['U'][1, 2, 0], np.array([10, -10, 20]) / 0.5)
        np.testing.assert_allclose((field.x, field.z), ([0.25, 0.75], [0.25, 0.75]))
        np.testing.assert_allclose(field.y, [0.25, 0.75, 2.0])

    def test_fields_of_the_box_program_that_do_not_fit_their_mesh(self):
        self.write('a.vtr', rectilinear_file({'x': [0, 1], 'y': [0, 1], 'z': [0, 1], 'p': [1, 2]}))
        with self.assertRaisesRegex(ValueError, 'p has 2 values for 1 x 1 x 1 cells'):
            turbidite.readers.reader('fluid_fields').cell_values(None, self.folder / 'a.vtr', 'p')

    def test_a_run_without_fluid_has_none(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('enabled: true', 'enabled: false'))
        for name in ('fields', 'slices', 'probes'):
            with self.assertRaisesRegex(turbidite.NotThere, 'run without fluid'):
                getattr(turbidite.load(self.folder), name)


class Measurements(Door):
    def test_names_of_the_report(self):
        analysis = self.made_up().analysis
        self.assertEqual(analysis.end_height(), 2.9)
        self.assertIsNone(analysis.run_out())
        self.assertEqual(analysis.numbers()['end_height'], 2.9)
        self.assertEqual(analysis.concentration().shares.shape, (2, 6))
        self.assertIn('weight_carriers', dir(analysis))
        self.assertIn('[D]', analysis.end_height.__doc__)
        with self.assertRaisesRegex(turbidite.UnknownName, 'Did you mean "rest_time"'):
            analysis.rest_tim

    def test_every_name_leads_to_a_measurement(self):
        analysis = self.made_up().analysis
        for name in dir(analysis):
            self.assertTrue(callable(getattr(analysis, name)), name)

    def test_modules_of_the_report_stay_apart(self):
        """One's own module `surface` is neither taken for the report's nor replaced by it."""
        code = ('import turbidite, sys, surface; turbidite.load(sys.argv[1]).analysis.numbers(); '
                'print(sys.modules["surface"].mine, "pores" in sys.modules)')
        self.write_all()
        self.write('own/surface.py', 'mine = 7\n')
        environment = {**os.environ, 'PYTHONPATH': f'{self.folder / "own"}:{places.HERE.parent}'}
        told = subprocess.run([sys.executable, '-B', '-c', code, str(self.folder)], env=environment, capture_output=True,
                              text=True)
        self.assertEqual(told.stdout, '7 False\n', told.stderr)


class Play(Door):
    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('bin/turbidite', PROGRAM.format(made_up=str(self.folder), told=str(self.folder / 'told')))
        (self.folder / 'bin/turbidite').chmod(0o755)
        environment = mock.patch.dict(os.environ, {'TURBIDITE_PROGRAM': str(self.folder / 'bin/turbidite')})
        environment.start()
        self.addCleanup(environment.stop)
        self.out = self.folder.parent / (self.folder.name + '-out')
        self.addCleanup(shutil.rmtree, self.out, True)

    def test_the_finished_run_is_returned(self):
        run = turbidite.run('a.yaml', out=self.out, set={
            'domain.size': np.array([4, 6]), 'fluid.enabled': True, 'grains.shape': 'disc', 'time.step': 0.1})
        self.assertEqual((run.folder, run.state), (self.out, 'done'))
        self.assertEqual((self.folder / 'told').read_text(), repr([
            'run', 'a.yaml', '--set', 'domain.size=[4, 6]', '--set', 'fluid.enabled=true', '--set', 'grains.shape="disc"',
            '--set', 'time.step=0.1', '--out', str(self.out)]))

    def test_an_older_run_makes_way_if_it_may(self):
        turbidite.run('a.yaml', out=self.out, force=True)
        self.assertEqual((self.folder / 'told').read_text(), repr(['run', 'a.yaml', '--out', str(self.out), '--force']))

    def test_a_failure_has_message_and_code(self):
        with self.assertRaises(turbidite.RunFailed) as caught:
            turbidite.run('a.yaml', set={'grains.count': 3}, out=self.out)
        self.assertEqual((caught.exception.exit_code, caught.exception.folder), (2, str(self.out)))
        self.assertIn('Allowed: even numbers.\n(exit code 2)', str(caught.exception))


class Places(unittest.TestCase):
    def test_report_and_program_of_an_installed_tree(self):
        """share/turbidite holds the package as a checkout does, and finds bin/turbidite."""
        package = 'share/turbidite/launcher/python/turbidite'
        with tempfile.TemporaryDirectory() as prefix:
            prefix = Path(prefix).resolve()
            for file in ('share/turbidite/launcher/report/run_data.py', 'bin/turbidite', f'{package}/places.py'):
                (prefix / file).parent.mkdir(parents=True, exist_ok=True)
                (prefix / file).touch()
            with mock.patch.object(places, 'HERE', prefix / package), mock.patch.dict(os.environ, TURBIDITE_PROGRAM=''):
                self.assertEqual(places.report_folder(), prefix / 'share/turbidite/launcher/report')
                self.assertEqual(places.program(), str(prefix / 'bin/turbidite'))

    def test_without_the_report_it_says_so(self):
        with mock.patch.object(places, 'HERE', Path('/nowhere/a/b')), self.assertRaisesRegex(turbidite.Error, 'Install'):
            places.report_folder()


class SpaceInSI(Door):
    """D = 0.01 m, u_c = 0.5 m/s, g = 16 m/s2, rho = 1000 kg/m3."""

    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace('[4, 6]', '[6, 5, 4]'))
        self.write('run.json', json.dumps({'status': 'done', **SI, 'g': 16.0}))

    def test_forces_are_over_areas_and_volumes(self):
        three = np.array([[1.0, 2.0, 3.0]])
        self.write('grains/a.vtp', poly_data(np.array([[0.01, 0.02, 0.03]]), '', array('id', np.array([4]), 1)
                   + array('radius', [0.005], 1)
                   + ''.join(array(name, three) for name in ('force', 'torque', 'contact_force'))))
        self.write('grains/grains.pvd', series((0, 'a.vtp')))
        one = turbidite.load(self.folder).grains[0]
        np.testing.assert_allclose(one['force'][0], three[0] / 0.025)          # rho u_c^2 D^2
        np.testing.assert_allclose(one['torque'][0], three[0] / 2.5e-4)        # rho u_c^2 D^3
        np.testing.assert_allclose(one['contact_force'][0], three[0] / 0.016)  # rho g D^3

    def test_contacts(self):
        cells = (array('id_a', np.array([-3]), 1) + array('id_b', np.array([4]), 1) + array('gap', [0.001], 1)
                 + array('tangential_force', [1.0], 1) + array('point', [[0.01, 0.02, 0.03]])
                 + array('rolling_moment', [[1.0, 2.0, 3.0]]))
        self.write('grains/c.vtp', poly_data(np.zeros((2, 3)), '', '', cells))
        self.write('grains/contacts.pvd', series((0.5, 'c.vtp')))
        one = turbidite.load(self.folder).contacts[0]
        np.testing.assert_allclose(one['gap'], 0.1)
        np.testing.assert_allclose(one['point'], [[1, 2, 3]])
        np.testing.assert_allclose(one['tangential_force'], 1.0 / 0.016)
        np.testing.assert_allclose(one['rolling_moment'][0, 1], 2.0 / 1.6e-4)

    def test_slices_and_fields(self):
        self.write('fluid/slices/a.vtr', slice_file(0, 2.0))
        self.write('fluid/slices/slices.pvd', series((0.02, 'a.vtr')))
        one = turbidite.load(self.folder).slices[0][0]
        self.assertEqual((one.time, one.x), (1.0, 200.0))
        np.testing.assert_allclose((one['p'][3, 5], one['U'][3, 5, 1]), (53 / 0.25, 1.75 / 0.5))
        for name, kind, text in (('lambda', 'volVectorField', '(1 2 3)'), ('vorticity', 'volVectorField', '(1 2 3)')):
            self.write(f'fluid/0/{name}', f'FoamFile\n{{\nclass {kind};\n}}\ninternalField uniform {text};\n')
        self.write('fluid/0/U', 'FoamFile\n{\nclass volVectorField;\n}\ninternalField uniform (1 2 3);\n')
        field = turbidite.load(self.folder).fields[0]
        np.testing.assert_allclose(field['U'][0, 0, 0], [2, 4, 6])
        np.testing.assert_allclose(field['lambda'][0, 0, 0], np.array([1, 2, 3]) / 25000.0)
        np.testing.assert_allclose(field['vorticity'][0, 0, 0], np.array([1, 2, 3]) / 50.0)


if __name__ == '__main__':
    unittest.main()
