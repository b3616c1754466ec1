# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a study: what quantities are drawn against, and what comes first."""
import contextlib
import io
import json
import unittest
from types import SimpleNamespace

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
from made_up_run import CASE, VTP, RunFolderTest

import curves
import member_pictures
import study


def numbers(*texts):
    members = [SimpleNamespace(name=str(i)) for i in range(len(texts))]
    return study.numbers_of('grains.region', members, {str(i): {'grains.region': text} for i, text in enumerate(texts)})


class SweptValues(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual(numbers('0.3', '1e-2'), ([0.3, 0.01], 'grains.region'))

    def test_lists_that_differ_in_one_place(self):
        self.assertEqual(numbers('[15, 7.5]', '[15, 60]'), ([7.5, 60.0], 'grains.region[1]'))

    def test_nothing_to_draw_against(self):
        for texts in (('0.3', '0.3'), ('[15, 7.5]', '[10, 60]'), ('[1, 2]', '[1, 2, 3]'), ('yade-md', 'yade-nscd')):
            self.assertIsNone(numbers(*texts)[0], texts)


class Page(RunFolderTest):
    def write_study(self, statuses=None, **of_all):
        runs = []
        for part, friction, seed in (('sweep', 0.1, 1), ('sweep', 0.1, 2), ('sweep', 0.3, 1), ('other', 0.1, 1)):
            name = f'friction-{friction}-seed-{seed}'
            folder = f'{part}/{name}'
            self.write(f'{folder}/case.yaml', CASE + f'contact:\n  friction: {friction}\nrandom:\n  seed: {seed}\n')
            self.write(f'{folder}/run.json', json.dumps({'status': 'done'}))
            self.write(f'{folder}/report.html', '')
            self.write(f'{folder}/history.csv', 'step,time,mean_velocity_norm\n0,0,0\n'
                       f'10,1,{friction + seed}\n20,2,0\n')
            self.write(f'{folder}/grains/grains_20.vtp', VTP.format(y=3))
            self.write(f'{folder}/grains/grains.pvd', '<VTKFile><Collection>'
                       '<DataSet timestep="2" part="0" file="grains_20.vtp"/></Collection></VTKFile>')
            runs.append({'part': part, 'name': name, 'folder': folder, 'error': '',
                         'status': (statuses or {}).get(folder, 'done'),
                         'values': {'contact.friction': str(friction), 'random.seed': str(seed)}})
        self.write('study.json', json.dumps({'study': 'slopes', 'runs': runs, **of_all}))

    def pictures(self):
        return sorted(path.name for path in (self.folder / 'pictures').iterdir())

    def page(self):
        self.assertEqual(study.main(['study.py', str(self.folder)]), 0)
        return (self.folder / 'study.html').read_text()

    def refused(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            self.assertEqual(study.main(['study.py', str(self.folder)]), 2)
        return told.getvalue()

    def test_answers_come_first_then_pictures_curves_and_all_numbers(self):
        self.write_study(command=['turbidite', 'study', 'my slopes.yaml', '--set', 'time.end=2'])
        page = self.page()
        parts = ('4 of 4 runs are done', "turbidite study 'my slopes.yaml' --set time.end=2", '<nav>', 'id="sweep"',
                 'Peak of the mean velocity [u<sub>c</sub>]</td><td>1.6 (1.1 to 2.1)</td><td>1.3</td>', 'Against contact.friction',
                 '<a href="sweep/friction-0.3-seed-1/report.html"><img alt="friction-0.3-seed-1: 2 grains at t = 2 t_c',
                 'The last output, on one scale of colours, of the first seeds',
                 '<a href="sweep/friction-0.1-seed-2/report.html">friction-0.1-seed-2</a>', 'All against t/t', '<details',
                 'All numbers of sweep', 'id="other"')
        self.assertEqual([part for part in parts if part not in page], [])
        body = page[page.index('<body>'):]
        order = [body.index(part) for part in parts if part != 'All numbers of sweep']
        self.assertEqual(order, sorted(order))

    def test_pictures_are_those_of_the_page(self):
        self.write_study()
        self.page()
        first = self.pictures()
        self.assertGreater(len([name for name in first if name.startswith('other-')]), 1)
        record = json.loads((self.folder / 'study.json').read_text())
        self.write('study.json', json.dumps({**record, 'runs': record['runs'][:3]}))
        self.page()
        self.assertEqual(self.pictures(), [name for name in first if name.startswith('sweep-')])

    def test_files_of_others_stay(self):
        self.write_study(figures='paper')
        kept = {'study.csv': 'slope,run\n1,2\n', 'study.html': '<!DOCTYPE html><title>Study of slopes</title>',
                'paper.md': '# My paper\n'}
        for name, text in kept.items():
            self.write(name, text)
            self.assertIn(f'turbidite study: {self.folder / name} would be overwritten. It is not of a study. Rename',
                          self.refused())
            self.assertEqual((self.folder / name).read_text(), text)
            self.assertCountEqual([file.name for file in self.folder.iterdir() if file.is_file()], ['study.json', name])
            (self.folder / name).unlink()

    def test_results_are_written_anew(self):
        self.write_study()
        first = self.page()
        for lost in ('study.html', 'study.csv'):  # the other one is still known
            (self.folder / lost).unlink()
            self.assertEqual(self.page(), first)
            self.assertTrue((self.folder / lost).exists())

    def test_runs_that_are_not_done_are_in_no_mean(self):
        self.write_study({'sweep/friction-0.1-seed-2': 'interrupted', 'other/friction-0.1-seed-1': 'failed'})
        page = self.page()
        self.assertIn('Peak of the mean velocity [u<sub>c</sub>]</td><td>1.1</td><td>1.3</td>', page)
        self.assertIn('Left out, since they are not done: friction-0.1-seed-2.', page)
        self.assertIn('<a href="sweep/friction-0.1-seed-2/report.html">', page)
        self.assertIn('No run of this part is done yet.', page)
        rows = (self.folder / 'study.csv').read_text().splitlines()
        self.assertEqual([row.split(',')[4] for row in rows[1:]], ['done', 'interrupted', 'done', 'failed'])

    def test_a_run_whose_history_has_lost_its_end_is_in_no_mean(self):
        self.write_study()
        folder = 'sweep/friction-0.1-seed-2'
        self.write(f'{folder}/run.json', json.dumps({'status': 'done', 'windows_done': 30}))
        page = self.page()
        self.assertIn('Peak of the mean velocity [u<sub>c</sub>]</td><td>1.1</td><td>1.3</td>', page)
        self.assertIn(f'<code>{folder}</code>: history.csv is not whole: it ends with window 20, and run.json says '
                      'that 30 are done.', page)

    def test_what_a_longer_run_may_change_is_so_far(self):
        self.write_study()
        self.write('sweep/friction-0.3-seed-1/history.csv', 'step,time,mean_velocity_norm\n0,0,0\n10,1,0.5\n20,2,1.3\n')
        self.assertIn('Peak of the mean velocity [u<sub>c</sub>]</td><td>1.6 (1.1 to 2.1)</td><td>1.3 so far</td>', self.page())

    def test_other_scales_are_told(self):
        self.write_study()
        self.assertNotIn('scales of these runs differ', self.page())
        self.write('sweep/friction-0.3-seed-1/run.json', json.dumps({'status': 'done', 'u_c': 1, 'g': 2}))
        self.assertIn('The scales of these runs differ', self.page())

    def test_what_a_resumption_changed_is_told(self):
        self.write_study()
        self.write('sweep/friction-0.3-seed-1/run.json', json.dumps({'status': 'done', 'parts': [
            {'from_window': 0}, {'from_window': 5, 'overrides': ['contact.tolerance=0.1', 'time.end=2']}]}))
        self.assertIn('<code>sweep/friction-0.3-seed-1</code>: The run was resumed from window 5 on with '
                      'contact.tolerance=0.1.', self.page())

    def test_variants_are_not_averaged_though_their_cases_name_the_same_copies(self):
        self.write_study()
        record = json.loads((self.folder / 'study.json').read_text())
        for variant, run in zip('aabb', record['runs']):
            run['values'] = {'variant': variant, **run['values']}
        record['runs'][0]['values']['variant'] = 'c'
        self.write('study.json', json.dumps(record))
        self.assertNotIn('(1.1 to 2.1)', self.page())

    def test_its_command_can_be_copied(self):
        self.write_study()
        _, runs = study.load(self.folder)
        self.assertIn('Made by: <code>turbidite study a --set x=1e-4</code>',
                      study.make_page('a', runs, 'turbidite study a --set x=1e-4').text())

    def test_a_study_of_an_earlier_version_has_no_command(self):
        self.write_study()
        self.assertNotIn('Made by', self.page())


class Labels(unittest.TestCase):
    def test_long_names_fit_over_their_picture(self):
        figure, axes = plt.subplots(figsize=(3.7, 3.0))
        axes.set_title(r'$t = 12\,t_c$')
        figure, _ = member_pictures.titled(SimpleNamespace(name='compacity-0.7854-friction-0.3-adapter-yade-nscd-'
                                                           'restitution-0.25-seed-1'), (figure, 'end'))
        width = axes.title.get_window_extent(figure.canvas.get_renderer()).width
        self.assertLess(width, figure.get_figwidth() * figure.dpi)
        plt.close(figure)

    def test_ticks_of_less_than_a_decade_do_not_push_the_label_out(self):
        figure, axes = curves.panel('title', 'x', 'scaled natural map')
        axes.plot([0, 1], [2e-4, 7e-4])
        curves.logarithmic(axes)
        figure.canvas.draw()
        self.assertGreater(axes.yaxis.label.get_window_extent().x0, 0.0)
        self.assertTrue(axes.get_ylim()[0] < 2e-4 and axes.get_ylim()[1] > 7e-4)
        plt.close(figure)

    def test_wide_numbers_do_not_push_the_label_out(self):
        figure, axes = curves.panel('title', 'x', r'overlap $/\,D$')
        axes.plot([0, 1], [0.0, 0.000145])
        figure.canvas.draw()
        self.assertGreater(axes.yaxis.label.get_window_extent().x0, 0.0)
        plt.close(figure)


if __name__ == '__main__':
    unittest.main()
