# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare on synthetic histories whose differences are known."""
import contextlib
import csv
import io
import json
import unittest

import matplotlib.pyplot as plt
import numpy as np
from made_up_run import CASE, VTP, RunFolderTest

import compare
import compare_page
import curves
import run_data
import seeds
from differences import common_span, difference


class Differences(unittest.TestCase):
    def test_of_two_straight_lines_sampled_differently(self):
        # q1 = 2 t on [0, 4], q2 = 3 t on [1, 3]: the difference is t there, rms^2 = int_1^3 t^2 dt / 2 = 13/3.
        coarse = np.linspace(0, 4, 5), 2 * np.linspace(0, 4, 5)
        fine = np.linspace(1, 3, 401), 3 * np.linspace(1, 3, 401)
        apart = difference(coarse, fine)
        self.assertEqual((apart.begin, apart.end), (1, 3))
        self.assertAlmostEqual(apart.rms**2, 13.0 / 3.0, places=12)
        self.assertAlmostEqual(apart.largest, 3.0)
        self.assertAlmostEqual(apart.mean, 2.0)  # int_1^3 t dt / 2
        self.assertAlmostEqual(apart.scale, 6.0)
        self.assertAlmostEqual(apart.relative(apart.largest), 0.5)

    def test_another_output_interval_changes_nothing(self):
        # The difference runs straight from -1 to 3 in 4 t_c: rms^2 = 28/12, mean of the size (0.5 + 4.5)/4.
        zero = np.array([0.0, 4.0]), np.zeros(2)
        for rows in (2, 3, 8, 41):
            times = np.linspace(0.0, 4.0, rows)
            apart = difference(zero, (times, times - 1.0))
            self.assertAlmostEqual(apart.rms**2, 28.0 / 12.0, places=12)
            self.assertAlmostEqual(apart.mean, 1.25, places=12)

    def test_rows_that_only_one_has_are_no_difference(self):
        # q = t^2 by both; at t = 0.25 the coarse one knows nothing, and linearly 0.125 instead of 0.0625.
        fine, coarse = np.arange(9) / 4.0, np.arange(5) / 2.0
        apart = difference((coarse, coarse**2), (fine, fine**2))
        self.assertEqual((apart.rms, apart.largest, apart.mean), (0.0, 0.0, 0.0))
        # Rows that do not coincide: the finer one is interpolated. 0.5 lies between 1/3 and 2/3.
        thirds = np.arange(7) / 3.0
        for first, second in ((coarse, thirds), (thirds, coarse)):
            apart = difference((first, first**2), (second, second**2))
            self.assertAlmostEqual(apart.largest, (0.5 - 1.0 / 3.0) * (2.0 / 3.0 - 0.5))

    def test_a_peak_between_the_rows_of_the_coarser_one_is_the_scale(self):
        """The first has its peak of 5 at t = 1.5, where the other has no row, and 8 after their common time."""
        first = np.array([0.0, 1.0, 1.5, 2.0, 5.0]), np.array([0.0, 1.0, 5.0, 2.0, 8.0])
        self.assertEqual(difference(first, (np.arange(3.0), np.zeros(3))).scale, 5.0)
        # At the end of the common time it has 4 by interpolation.
        self.assertAlmostEqual(difference(first, (np.array([1.7, 3.0]), np.zeros(2))).scale, 4.0)

    def test_two_curves_that_share_one_row_are_compared_between_it_and_the_end(self):
        early, late = (np.array([0.0, 2.0]), np.array([0.0, 2.0])), (np.array([1.0, 5.0]), np.array([1.5, 5.5]))
        apart = difference(early, late)
        self.assertEqual((apart.begin, apart.end), (1.0, 2.0))
        self.assertAlmostEqual(apart.mean, 0.5)

    def test_of_a_curve_from_itself_is_zero(self):
        curve = np.array([0.0, 1.0, 2.5]), np.array([1.0, -3.0, 2.0])
        apart = difference(curve, curve)
        self.assertEqual((apart.rms, apart.largest, apart.mean, apart.scale), (0.0, 0.0, 0.0, 3.0))

    def test_relative_to_zero_is_not_a_number_to_show(self):
        flat = np.array([0.0, 1.0]), np.array([0.0, 0.0])
        self.assertIsNone(difference(flat, flat).relative(0.0))

    def test_an_instant_is_no_span(self):
        self.assertIsNone(common_span(np.array([0.0, 1.0]), np.array([1.0, 2.0])))
        self.assertIsNone(common_span(np.array([]), np.array([1.0, 2.0])))
        self.assertIsNone(difference((np.array([0.0]), np.array([1.0])),
                                     (np.array([0.0]), np.array([1.0]))))


class Compare(RunFolderTest):
    def write_run(self, name, scale, times=range(5), case=CASE):
        self.write(f'{name}/case.yaml', case)
        self.write(f'{name}/run.json', json.dumps({'status': 'done'}))
        rows = ''.join(f'{10 * t},{t},{-scale * t},{scale * t},{"" if t == 0 else 0.1 * scale}\n'
                       for t in times)
        self.write(f'{name}/history.csv', 'step,time,mean_velocity_y,contact_iterations,wall_step\n' + rows)

    def run_it(self, *names):
        """(exit code, stderr)"""
        err = io.StringIO()
        with contextlib.redirect_stderr(err):
            code = compare.main(['compare.py', str(self.folder / 'page.html')]
                                + [str(self.folder / name) for name in names])
        return code, err.getvalue()

    def result(self):
        return json.loads((self.folder / 'page.json').read_text())

    def test_numbers_of_page_csv_and_json(self):
        self.write_run('one', 1.0)
        self.write_run('two', 1.5, case=CASE.replace('size: [4, 6]', 'size: [8, 6]'))
        self.assertEqual(self.run_it('one', 'two'), (0, ''))
        result = self.result()
        self.assertEqual(result['first'], 'one')
        self.assertEqual(result['parameters'], {'domain.size': ['[4, 6]', '[8, 6]']})
        velocity = result['runs'][1]['quantities']['mean_velocity_y']
        self.assertAlmostEqual(velocity['max'], 2.0)            # at t = 4: -6 against -4
        self.assertAlmostEqual(velocity['max_relative'], 0.5)
        self.assertEqual(velocity['end_value'], -6.0)
        self.assertIsNone(result['runs'][0]['quantities']['mean_velocity_y']['max'])
        self.assertAlmostEqual(result['runs'][0]['wall_seconds'], 4.0)  # 40 windows of 0.1 s
        self.assertAlmostEqual(result['runs'][1]['wall_ratio'], 1.5)
        rows = list(csv.DictReader((self.folder / 'page.csv').read_text().splitlines()))
        row, = [r for r in rows if (r['run'], r['quantity']) == ('two', 'mean_velocity_y')]
        self.assertEqual(float(row['max']), velocity['max'])
        page = (self.folder / 'page.html').read_text()
        self.assertIn('domain.size [D]', page)
        self.assertIn('50 %', page)
        self.assertIn('src="data:image/png;base64,', page)
        self.assertNotIn('Remarks', page)

    def test_a_page_says_nothing_twice(self):
        for k, name in enumerate(('one', 'two', 'three')):
            self.write_run(name, 1.0 + k)
        self.assertEqual(self.run_it('one', 'two', 'three')[0], 0)
        page = (self.folder / 'page.html').read_text()
        self.assertIn('The same for all: status: done; made by: turbidite ?, no date;', page)
        self.assertNotIn('<td>status</td>', page)
        self.assertNotIn('Courant', page)  # no run has one
        self.assertIn('<td>wall time [s]</td><td>4</td><td>8 (2 times)</td><td>12 (3 times)</td>', page)
        table = page[page.index('of the first</th>'):]
        self.assertEqual(table.count('<td>one</td>'), 0)
        self.assertEqual(table.count('Wall time of a window [s]'), 1)
        # Of the second row of a quantity the name and the first run's end are not said again.
        self.assertIn('<td>200 %</td><td>0.3</td><td></td>', table)
        self.assertNotIn('[-]', page)

    def test_a_page_leads_to_the_reports_and_says_its_command(self):
        for name in ('one', 'two'):
            self.write_run(name, 1.0)
        self.write('two/report.html', '')
        self.assertEqual(self.run_it('one', 'two')[0], 0)
        page = (self.folder / 'page.html').read_text()
        self.assertIn('<a href="two/report.html">two</a>', page)
        self.assertNotIn('one/report.html', page)
        self.assertIn(f'Made by: <code>turbidite compare {self.folder}/one {self.folder}/two '
                      f'--out {self.folder}/page.html</code>', page)

    def test_only_the_common_time_counts(self):
        self.write_run('one', 1.0)
        self.write_run('short', 2.0, times=range(3))
        self.assertEqual(self.run_it('one', 'short')[0], 0)
        velocity = self.result()['runs'][1]['quantities']['mean_velocity_y']
        self.assertEqual((velocity['begin'], velocity['end']), (0.0, 2.0))
        self.assertAlmostEqual(velocity['max'], 2.0)
        self.assertAlmostEqual(velocity['max_relative'], 1.0)  # relative to the first run's 2 within that time

    def test_equal_cases_and_equal_names(self):
        self.write_run('a/run', 1.0)
        self.write_run('b/run', 1.0)
        self.assertEqual(self.run_it('a/run', 'b/run')[0], 0)
        self.assertIn('The cases are the same', (self.folder / 'page.html').read_text())
        self.assertEqual(len({run['name'] for run in self.result()['runs']}), 2)

    def test_equal_names_have_the_folders_that_tell_them_apart(self):
        for study in ('first', 'second'):
            self.write_run(f'{study}/part/one', 1.0)
        self.assertEqual(self.run_it('first/part/one', 'second/../second/part/one'), (0, ''))
        self.assertEqual([run['name'] for run in self.result()['runs']], ['first/part/one', 'second/part/one'])

    def test_what_a_resumption_changed_is_a_difference(self):
        self.write_run('one', 1.0)
        self.write_run('two', 1.0)
        self.write('two/run.json', json.dumps({'status': 'done', 'parts': [
            {'from_window': 0}, {'from_window': 20, 'overrides': ['contact.friction=0.5']}]}))
        self.assertEqual(self.run_it('one', 'two'), (0, ''))
        self.assertEqual(self.result()['parameters'], {'resumed': ['', 'from window 20 on with contact.friction=0.5']})

    def test_values_of_the_case_can_be_copied(self):
        self.write_run('one', 1.0, case=CASE + 'contact:\n  tolerance: 1e-8\n')
        self.write_run('two', 1.0, case=CASE + 'contact:\n  tolerance: 1e-4\n')
        self.assertEqual(self.run_it('one', 'two'), (0, ''))
        self.assertIn('<td>contact.tolerance</td><td><code>1e-8</code></td><td><code>1e-4</code></td>',
                      (self.folder / 'page.html').read_text())

    def test_rest_of_a_group_is_that_of_its_runs(self):
        speeds = {'seed-1': (0, 1, 0, 0), 'seed-2': (0, 1, 1, 0), 'seed-3': (0, 1, 1, 1)}
        for name, values in speeds.items():
            self.write_run(name, 1.0, case=CASE + f'random:\n  seed: {name[-1]}\n')
            self.write(f'{name}/history.csv', 'step,time,mean_speed\n' + ''.join(
                f'{10 * t},{t},{value}\n' for t, value in enumerate(values)))
        self.write_run('other', 1.0, case=CASE.replace('size: [4, 6]', 'size: [8, 6]'))
        self.assertEqual(self.run_it(*speeds, 'other'), (0, ''))
        self.assertIsNone(self.result()['runs'][0]['rest_time'])
        self.assertIn('2.5 (2 to 3; 2 of 3 runs)', (self.folder / 'page.html').read_text())

    def test_a_quantity_that_one_run_lacks(self):
        self.write_run('one', 1.0)
        self.write_run('dry', 1.0)
        self.write('dry/history.csv', 'step,time,mean_velocity_y\n0,0,0\n10,1,-1\n')
        self.assertEqual(self.run_it('one', 'dry')[0], 0)
        lacking = self.result()['runs'][1]
        self.assertIsNone(lacking['quantities']['contact_iterations']['end_value'])
        self.assertIsNone(lacking['wall_ratio'])

    def test_other_scales_are_told_wherever_numbers_are(self):
        for name, speed in (('slow', 0.05), ('fast', 0.07)):
            self.write_run(name, 1.0)
            self.write(f'{name}/run.json', json.dumps({
                'status': 'done', 'D': 1e-3, 'u_c': speed, 't_c': 1e-3 / speed, 'g': 9.81}))
        self.assertEqual(self.run_it('slow', 'slow'), (0, ''))
        self.assertIsNone(self.result()['remark'])
        code, err = self.run_it('slow', 'fast')
        self.assertEqual(code, 0)
        for told in (err, self.result()['remark'], (self.folder / 'page.html').read_text()):
            self.assertIn('The scales of these runs differ', told)

    def test_no_common_time(self):
        self.write_run('one', 1.0)
        self.write_run('later', 1.0, times=range(5, 8))
        code, err = self.run_it('one', 'later')
        self.assertEqual(code, 2)
        self.assertIn('no common time span', err)
        self.assertIn('later from 5 to 7 t_c', err)
        self.assertFalse((self.folder / 'page.html').exists())

    def test_a_run_without_history_is_named(self):
        self.write_run('one', 1.0)
        self.write('bare/case.yaml', CASE)
        code, err = self.run_it('one', 'bare')
        self.assertEqual(code, 2)
        self.assertIn('bare has no history', err)

    def write_seed(self, name, seed, scale):
        """|<u>| rises to `scale` at 2 t_c and falls to 0 at 4 t_c."""
        self.write_run(name, scale, case=CASE + f'random:\n  seed: {seed}\n')
        self.write(f'{name}/history.csv', 'step,time,mean_velocity_norm,contact_iterations,contact_residual\n'
                   + ''.join(f'{10 * t},{t},{scale * (1 - abs(t - 2) / 2)},{"," if t == 0 else "7,1e-9"}\n'
                             for t in range(5)))
        self.write(f'{name}/run.json', json.dumps(
            {'status': 'done', 'maxima': {'penetration': 1e-4 * scale, 'unconverged_windows': seed}}))

    def test_an_empty_last_row_has_no_end_value(self):
        data = run_data.RunData('nowhere', history={'time': np.arange(3.0), 'front_x': np.array([1.0, 2.0, np.nan])})
        member = seeds.Member('one', data, [data])
        self.assertIsNone(compare.numbers(member, member, 'front_x')['end_value'])

    def test_pores_are_areas_in_the_plane_and_volumes_in_space(self):
        plane, space = [seeds.Member(name, run_data.RunData(name, case={'dimension': name}, history={
            'time': np.arange(2.0), 'pore_volume': np.ones(2)})) for name in '23']
        for members, unit, plain in (([plane], r'area $/\,D^2$', 'D^2'), ([space, space], r'volume $/\,D^3$', 'D^3'),
                                     ([plane, space], r'area $/\,D^2$ or volume $/\,D^3$', 'D^2 or D^3')):
            pores, = compare.quantities_of(members)
            self.assertEqual((pores.unit, pores.plain_unit), (unit, plain))

    def test_seeds_are_averaged(self):
        for seed, scale in ((1, 1.0), (2, 2.0), (3, 3.0)):
            self.write_seed(f'dense-seed{seed}', seed, scale)
        self.write_run('other', 1.0, case=CASE.replace('standalone', 'yade'))
        self.write('other/history.csv', (self.folder / 'dense-seed1/history.csv').read_text())
        self.assertEqual(self.run_it('dense-seed1', 'other', 'dense-seed2', 'dense-seed3'), (0, ''))
        result = self.result()
        mean, other = result['runs']
        self.assertEqual((mean['name'], other['name']), ('dense', 'other'))
        self.assertEqual(mean['seeds'], ['1', '2', '3'])
        self.assertEqual(len(mean['folders']), 3)
        self.assertEqual(mean['peak'], {'mean': {'value': 2.0, 'time': 2.0}, 'single': [
            {'value': value, 'time': 2.0} for value in (1.0, 2.0, 3.0)]})
        self.assertAlmostEqual(mean['penetration'], 3e-4)  # the largest of the three
        self.assertEqual(mean['unconverged_windows'], 3)
        self.assertEqual(mean['measured']['unconverged_windows'], [1, 2, 3])
        self.assertEqual(mean['quantities']['contact_iterations']['end_value'], 7)
        # Mean: a triangle of height 2; the other: of height 1. The difference is half the peak, 1/4 on average.
        pair, = result['mean_velocity_pairs']
        self.assertEqual((pair['first'], pair['second']), ('dense', 'other'))
        self.assertAlmostEqual(pair['largest'], 0.5)
        self.assertAlmostEqual(pair['mean'], 0.25)
        page = (self.folder / 'page.html').read_text()
        self.assertIn('dense: mean of dense-seed1 (seed 1), dense-seed2 (seed 2), dense-seed3 (seed 3)',
                      page)
        self.assertIn('1, 2, 3', page)
        self.assertIn('; lines: dense; other"', page)  # pictures have the names as well as the page

    def test_a_picture_has_a_legend_of_its_own(self):
        """Without one where it would hide the curves."""
        for count, shown in ((1, 0), (2, 2), (6, 6), (7, 0)):
            figure, axes = curves.panel('', '', '')
            for i in range(count):
                compare_page.draw_member(axes, i, 'a' * 30 + str(i), ([0, 1], [0, 1]), None)
            compare_page.name_lines(axes)
            legend = axes.get_legend()
            texts = [text.get_text() for text in legend.get_texts()] if legend else []
            self.assertEqual(texts, ['…' + 'a' * 22 + str(i) for i in range(shown)])
            plt.close(figure)

    def test_a_run_that_is_not_done_does_not_cut_its_group(self):
        for seed in (1, 2, 3):
            self.write_seed(f'dense-seed{seed}', seed, float(seed))
        self.write('dense-seed3/run.json', json.dumps({'status': 'failed'}))
        self.write('dense-seed3/history.csv', 'step,time,mean_velocity_norm\n0,0,0\n1,0.1,0.5\n')
        self.assertEqual(self.run_it('dense-seed1', 'dense-seed2', 'dense-seed3'), (0, ''))
        runs = self.result()['runs']
        self.assertEqual([(run['name'], len(run['seeds'])) for run in runs], [('dense', 2), ('dense-seed3', 1)])
        self.assertEqual(runs[0]['peak']['mean'], {'value': 1.5, 'time': 2.0})

    def test_the_worst_run_of_a_group_is_not_averaged_away(self):
        """The largest values of one are in its rows alone."""
        for seed in (1, 2):
            self.write_seed(f'dense-seed{seed}', seed, 1.0)
        self.write('dense-seed2/run.json', json.dumps({'status': 'done'}))
        self.write('dense-seed2/history.csv', 'step,time,mean_velocity_norm,max_penetration,unconverged\n'
                   '0,0,0,,\n10,1,0.5,0.02,7\n20,2,1,0.01,0\n')
        self.assertEqual(self.run_it('dense-seed1', 'dense-seed2'), (0, ''))
        mean, = self.result()['runs']
        self.assertEqual((mean['penetration'], mean['unconverged_windows']), (0.02, 7))

    def test_groups_are_called_after_what_their_folders_have_in_common(self):
        for names, common in ((('friction-0.3-seed-10', 'friction-0.3-seed-11', 'friction-0.3-seed-12'), 'friction-0.3'),
                              (('discs-1', 'discs-2'), 'discs'), (('glass-1', 'glass-2'), 'glass'), (('run1', 'run12'), 'run'),
                              (('dense_s1', 'dense_s2'), 'dense'), (('seed-1', 'seed-2'), 'seed-1 and 1 more')):
            self.assertEqual(seeds.name_of([run_data.RunData(self.folder / name) for name in names]), common)

    def test_each_keeps_seeds_apart(self):
        for seed in (1, 2):
            self.write_seed(f'run-{seed}', seed, float(seed))
        self.assertEqual(compare.main(['compare.py', '--each', str(self.folder / 'page.html')]
                                      + [str(self.folder / f'run-{seed}') for seed in (1, 2)]), 0)
        self.assertEqual([run['name'] for run in self.result()['runs']], ['run-1', 'run-2'])
        self.assertIsNone(self.result()['runs'][0]['quantities']['mean_velocity_norm']['max'])
        self.assertNotIn('averaged', (self.folder / 'page.html').read_text())

    def test_repetitions_of_a_seed_are_not_averaged(self):
        for name in ('before', 'after'):
            self.write_seed(name, 1, 1.0)
        self.assertEqual(self.run_it('before', 'after')[0], 0)
        self.assertEqual([run['name'] for run in self.result()['runs']], ['before', 'after'])

    def write_headed(self, name, seed, head, grains=''):
        self.write_seed(name, seed, 1.0)
        self.write(f'{name}/case.yaml', head + '\n' + CASE.replace('grains:\n', f'grains:\n{grains}')
                   + f'random:\n  seed: {seed}\n')

    def test_runs_with_other_walls_are_not_averaged(self):
        walls = '# Walls inside the box, fingerprint 00000000000000{}'
        for name, seed, number in (('a-1', 1, '0a'), ('a-2', 2, '0a'), ('b-1', 1, '0b'), ('b-2', 2, '0b')):
            self.write_headed(name, seed, walls.format(number))
        self.assertEqual(self.run_it('a-1', 'a-2', 'b-1', 'b-2')[0], 0)
        self.assertEqual([run['seeds'] for run in self.result()['runs']], [['1', '2'], ['1', '2']])
        self.assertEqual(self.result()['parameters'], {
            'Walls inside the box, fingerprint': ['000000000000000a', '000000000000000b']})
        self.assertNotIn('The cases are the same', (self.folder / 'page.html').read_text())

    def test_grains_count_where_they_are_not_made_by_the_seed(self):
        for grains, groups in (('  generator: random\n  file: ~\n', 1), ('  generator: poured\n  file: "a.csv"\n', 1),
                               ('  generator: lattice\n  file: "a.csv"\n', 2)):
            for seed in (1, 2):
                self.write_headed(f'run-{seed}', seed, f'# {seed} grains, fingerprint 000000000000000{seed}', grains)
            runs = [run_data.load_run(self.folder / f'run-{seed}') for seed in (1, 2)]
            self.assertEqual(len(seeds.members(runs)), groups, grains)

    def write_from(self, name, seed, **record):
        self.write_headed(name, seed, '# 3 grains, fingerprint 0000000000000001', '  generator: poured\n')
        self.write(f'{name}/run.json', json.dumps({'status': 'done', **record}))

    def test_extra_grains_of_other_content_are_another_case(self):
        for name, seed, extra in (('a-1', 1, '0a'), ('a-2', 2, '0a'), ('b-1', 1, '0b'), ('b-2', 2, '0b')):
            self.write_from(name, seed, extra_grains=extra)
        self.assertEqual(self.run_it('a-1', 'a-2', 'b-1', 'b-2')[0], 0)
        self.assertEqual([run['seeds'] for run in self.result()['runs']], [['1', '2'], ['1', '2']])
        self.assertEqual(self.result()['parameters'], {'grains.extra_file, fingerprint': ['0a', '0b']})

    def test_grains_of_another_run_are_not_those_poured_for_this_one(self):
        self.write_from('poured-1', 1, **{'from': 'cache', 'hash_before_pouring': 'c'})
        self.write_from('poured-2', 2, **{'from': 'cache', 'hash_before_pouring': 'd'})
        self.write_from('own-3', 3, **{'from': 'bed', 'hash_before_pouring': ''})
        self.assertEqual(self.run_it('poured-1', 'poured-2', 'own-3')[0], 0)
        self.assertEqual([run['seeds'] for run in self.result()['runs']], [['1', '2'], ['3']])
        self.assertEqual(self.result()['parameters']['--from'], ['', 'bed'])

    def test_a_group_covers_the_time_of_its_shortest_run(self):
        runs = []
        for seed, times in ((1, range(5)), (2, range(3))):
            self.write_run(f'run-{seed}', float(seed), times=times,
                           case=CASE + f'random:\n  seed: {seed}\n')
            runs.append(run_data.load_run(self.folder / f'run-{seed}'))
        group, = seeds.members(runs)
        time, values = group.data.column('mean_velocity_y')
        self.assertEqual(time.tolist(), [0, 1, 2])
        self.assertEqual(values.tolist(), [0.0, -1.5, -3.0])
        _, low, high = group.band('mean_velocity_y')
        self.assertEqual((low.tolist(), high.tolist()), ([0, -2, -4], [0, -1, -2]))
        # The first row has no wall time.
        self.assertEqual(group.data.column('wall_step')[0].tolist(), [1, 2])

    def test_surfaces_at_the_end(self):
        self.write_run('one', 1.0)
        self.write_run('two', 1.0)
        for name, y in (('one', 4), ('two', 3)):
            self.write(f'{name}/grains/grains.pvd', '<VTKFile><Collection><DataSet timestep="4" part="0" '
                       'file="grains_00000040.vtp"/></Collection></VTKFile>')
            self.write(f'{name}/grains/grains_00000040.vtp', VTP.format(y=y))
        self.assertEqual(self.run_it('one', 'two')[0], 0)
        # Discs of radius 0.5 at x = 1 and 0.4 at x = 2.5, in columns [0, 1], [1, 2], [2, 3], [3, 4].
        for run, y in zip(self.result()['runs'], (4, 3)):
            self.assertEqual(run['surface']['x'], [0.5, 1.5, 2.5, 3.5])
            self.assertEqual(run['surface']['height'], [y + 0.5, y + 0.5, y + 0.4, 0.0])
        self.assertIn('Surface at the end', (self.folder / 'page.html').read_text())

    def test_tables_of_others_stay(self):
        for name in ('a', 'b'):
            self.write_run(name, 1)
        self.write('notes.html', '<!DOCTYPE html><title>Comparison of my notes</title>')
        for page, file in (('a/run.html', 'a/run.json'), ('b/history.html', 'b/history.csv'),
                           ('notes.html', 'notes.html')):
            before = (self.folder / file).read_bytes()
            with self.assertRaisesRegex(compare.Refusal, 'would be overwritten'):
                compare.compare(self.folder / page, [self.folder / 'a', self.folder / 'b'])
            self.assertEqual((self.folder / file).read_bytes(), before)
        for _ in range(2):  # its own may be written anew
            self.assertTrue(compare.compare(self.folder / 'a/page.html', [self.folder / 'a', self.folder / 'b']))

    def test_a_page_that_cannot_be_written(self):
        self.write_run('one', 1.0)
        (self.folder / 'page.html').mkdir()
        code, err = self.run_it('one', 'one')
        self.assertEqual(code, 4)
        self.assertIn('cannot write', err)


if __name__ == '__main__':
    unittest.main()
