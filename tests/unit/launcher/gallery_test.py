# SPDX-License-Identifier: LGPL-2.1-or-later
"""The gallery on made-up runs: what is measured, what holds, what the file of expected numbers may say, and records."""
import contextlib
import datetime
import fcntl
import io
import json
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

from made_up_run import RunFolderTest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'launcher/report/gallery'))
import entries
import main
import playing
import quantities
import records
import run_data

EXPECTED = """# Head.
falling:   # a grain
  full:  # as it is
    expected:
      end_height: {is: 2.9, within: 0.1}
    recorded: {commit: "old", date: 2026-01-01, processor: 1, memory: 1}

  quick:
    set: {time.end: 1}
    expected:
      end_height: {below: 3}

# A comment.
other:
  full:
"""
TREE = {'falling': {'full': {'expected': {'end_height': {'is': 2.9, 'within': 0.1}, 'min(mean_velocity_y)': {'above': -0.3}}},
                    'quick': {'set': {'time.end': 1.0, 'domain.size': [4.0, 6.5], 'grains.shape': 'disc'},
                              'expected': {'end_height': {'below': 3.0}}}},
        'other': {'full': None}}
# In the place of the program: copies the made-up run to --out, or those of a study that are not there.
PROGRAM = """#!/usr/bin/python3
import json, pathlib, shutil, sys
version = pathlib.Path({made_up!r}).with_name('version').read_text().split()
if sys.argv[1] == '--version':
    sys.exit(print('turbidite', version[0], f'(commit {{version[1]}})' if version[1:] else ''))
made_up, out = pathlib.Path({made_up!r}), pathlib.Path(sys.argv[sys.argv.index('--out') + 1])
sets = [text for flag, text in zip(sys.argv, sys.argv[1:]) if flag == '--set']
if sys.argv[1] == 'study':
    (out / 'study.json').write_text(json.dumps({{'command': ['turbidite', *sys.argv[1:]]}}))
for folder in [file.parent for file in made_up.glob('*/*/run.json')] if sys.argv[1] == 'study' else [made_up]:
    to = out / folder.relative_to(made_up)
    if sys.argv[1] != 'study' or not (to / 'run.json').exists():
        shutil.rmtree(to, True)
        shutil.copytree(folder, to)
        record = json.loads((to / 'run.json').read_text())
        record['overrides'] = sets if sys.argv[1] == 'run' else []
        record['versions'] = dict(zip(('turbidite', 'commit'), [*version, '']))
        (to / 'run.json').write_text(json.dumps(record))
sys.exit({code})
"""


class Quantities(RunFolderTest):
    def setUp(self):
        super().setUp()
        self.write_all()
        self.write('history.csv', 'step,time,mean_speed,mean_position_y\n0,0,1,3\n1,1,5,2\n2,2,2,\n3,3,4,1\n')
        self.run_data = run_data.load_run(self.folder)

    def of(self, text):
        return quantities.quantity(text)(self.run_data)

    def test_of_columns(self):
        self.assertEqual([self.of(f'{name}(mean_speed)') for name in ('end', 'max', 'min')], [4.0, 5.0, 1.0])
        self.assertEqual((self.of('at(mean_speed, 2)'), self.of('mean(mean_speed, 1, 2)')), (2.0, 3.5))
        self.assertEqual(self.of('end(mean_position_y)'), 1.0)
        self.run_data.history['mean_position_y'][-1] = float('nan')
        self.assertIsNone(self.of('end(mean_position_y)'))          # the last row has none
        self.assertIsNone(self.of('end(gone)'))
        for text in ('at(mean_speed, 1.5)', 'mean(mean_speed, 1.2, 1.8)'):
            with self.assertRaisesRegex(ValueError, 'no row'):
                self.of(text)

    def test_a_mean_until_after_the_end_cannot_be_told(self):
        for end in (4, 4.5, 9):
            with self.assertRaisesRegex(ValueError, f'the last row is at 3 t_c, before {end:g}'):
                self.of(f'mean(mean_speed, 1, {end})')
        for end in (2, 3, 3.9):      # no row is lacking
            self.assertAlmostEqual(self.of(f'mean(mean_speed, 1, {end})'), 3.5 if end == 2 else 11.0 / 3.0)
        self.run_data.history['time'][-1] -= 1e-9
        self.assertAlmostEqual(self.of('mean(mean_speed, 1, 3)'), 11.0 / 3.0)
        self.assertEqual(self.of('mean(mean_position_y, 2, 3)'), 1.0)
        self.run_data.history['mean_position_y'][-1] = float('nan')     # no grain was left, and the run went on
        self.assertEqual(self.of('mean(mean_position_y, 0, 3)'), 2.5)

    def test_of_the_analysis(self):
        self.assertEqual(self.of('end_height'), 1.0)

    def test_unknown(self):
        for text in ('end_hight', 'end(a', 'last(mean_speed)', 'at(mean_speed)', 'end(mean_speed, 2)'):
            with self.assertRaises(quantities.Unknown, msg=text):
                quantities.quantity(text)
        with self.assertRaisesRegex(quantities.Unknown, 'Did you mean end_height'):
            quantities.quantity('end_hight')
        with self.assertRaisesRegex(quantities.Unknown, 'is no quantity. It is'):
            quantities.quantity('xyz')


class Entries(unittest.TestCase):
    def read(self, **form):
        return entries.read_entries({'a': {'full': form}}, lambda name: False)['a'].forms['full']

    def test_bounds(self):
        found = self.read(expected={'end_height': {'is': 2.0, 'within': 0.5}, 'overlap': {'below': 1e-5}})
        height, overlap = found.expected
        self.assertEqual([height.holds(v) for v in (1.5, 2.5, 2.6, None)], [True, True, False, False])
        self.assertEqual([overlap.holds(v) for v in (0.0, 2e-5)], [True, False])
        self.assertEqual((height.told(), overlap.told()), ('1.5 to 2.5', 'at most 1e-05'))

    def test_faults_are_named(self):
        for form, text in (({'expectd': {}}, 'a.full: expectd is unknown. Did you mean expected'),
                           ({'expected': {'end_hight': {'above': 1}}}, 'Did you mean end_height'),
                           ({'expected': {'end_height': {'is': 1}}}, 'is and within belong together'),
                           ({'expected': {'end_height': {}}}, 'above, below'),
                           ({'expected': {'end_height': {'is': 1, 'within': 1, 'below': 1}}}, 'cannot be added'),
                           ({'expected': {'at(time, 1.2.3)': {'below': 1}}}, 'times are numbers'),
                           ({'recorded': {'date': '2026-01-01'}}, 'it has a commit, in quotes'),
                           ({'recorded': {'commit': 1234567890.0, 'date': '2026-01-01'}}, 'it has a commit, in quotes'),
                           ({'expected': {'end_height': {'above': 'high'}}}, 'above = high is no number'),
                           ({'expected': {'overlap': None}}, 'a.full.expected.overlap: a map is needed'),
                           ({'expected': ['overlap']}, 'a.full.expected: a map is needed'),
                           ({'set': 'time.end=5'}, 'a.full.set: a map is needed, for example {time.end: 5}'),
                           ({'recorded': {'comit': 'x'}}, 'Did you mean commit')):
            with self.assertRaisesRegex(entries.Wrong, text):
                self.read(**form)

    def test_of_a_study_they_stand_below_its_runs(self):
        tree = {'s': {'full': {'expected': {'part/run-1': {'overlap': {'below': 1}}}}}}
        (one,) = entries.read_entries(tree, lambda name: True)['s'].forms['full'].expected
        self.assertEqual((one.run, one.name()), ('part/run-1', 'part/run-1: overlap'))

    def test_overrides_as_they_are_typed(self):
        form = entries.read_entries(TREE, lambda name: False)['falling'].forms['quick']
        self.assertEqual(form.arguments(), ['--set', 'time.end=1', '--set', 'domain.size=[4, 6.5]', '--set', 'grains.shape=disc'])


    def test_texts_are_read_as_they_were_written(self):
        for text, typed in (('disc', 'disc'), ('my-code --all', 'my-code --all'), ('grains #2.csv', '"grains #2.csv"'),
                            ('a: b', '"a: b"'), ('~', '"~"'), ('null', '"null"'), ('', '""'), (None, 'null'), (True, 'true'),
                            (['a, b', 2.5], '["a, b", 2.5]')):
            self.assertEqual(entries.as_yaml(text), typed)


class Played(RunFolderTest):
    def setUp(self):
        super().setUp()
        self.write_all()
        for name in ('falling', 'other'):
            self.write(f'configs/{name}.yaml', 'time:\n  step: 0.1\n')
        self.write('configs/expected.yaml', EXPECTED)
        self.play_with(0)

    def play_with(self, code):
        self.write_all()
        self.write('made-up/case.yaml', (self.folder / 'case.yaml').read_text())
        self.write('made-up/history.csv', (self.folder / 'history.csv').read_text())
        self.write('made-up/run.json', (self.folder / 'run.json').read_text())
        self.write('version', '0.1.0')
        self.write('program', PROGRAM.format(made_up=str(self.folder / 'made-up'), code=code))
        (self.folder / 'program').chmod(0o755)

    def study_of(self, *runs):
        """The made-up program plays them."""
        self.write('configs/sweep.yaml', 'parts:\n  column:\n    case: falling.yaml\n')
        for run in runs:
            for file in ('case.yaml', 'history.csv', 'run.json'):
                self.write(f'made-up/column/{run}/{file}', (self.folder / file).read_text())

    def act(self, *words, tree=None):
        """(exit code, what was printed)"""
        told = io.StringIO()
        arguments = [str(self.folder / 'program'), str(self.folder / 'configs'), str(self.folder / 'configs/expected.yaml'),
                     '--out', str(self.folder / 'out'), *words]
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told), \
                mock.patch.object(sys, 'stdin', io.StringIO(json.dumps(tree or TREE))):
            code = main.main(arguments)
        return code, told.getvalue()


class Gallery(Played):
    def test_all_holds(self):
        code, told = self.act('falling')
        self.assertEqual(code, 0, told)
        self.assertIn('holds   end_height = 2.9 D, expected 2.8 to 3\n', told)
        self.assertIn('2 of 2 numbers hold', told)

    def test_a_number_that_does_not_hold(self):
        broken = json.loads(json.dumps(TREE))
        broken['falling']['full']['expected']['end_height']['is'] = 3.5
        code, told = self.act('falling', tree=broken)
        self.assertEqual(code, 1)
        self.assertIn('FAILS   end_height = 2.9 D, expected 3.4 to 3.6\n', told)
        self.assertIn('1 of 2 numbers hold', told)

    def test_a_number_that_cannot_be_told_does_not_hold(self):
        code, told = self.act('falling', tree={'falling': {'full': {'expected': {'run_out': {'above': 0}}}}})
        self.assertEqual(code, 1)
        self.assertIn('run_out = cannot be told', told)

    def test_a_run_that_fails_gives_its_exit_code(self):
        self.play_with(6)
        code, told = self.act('falling')
        self.assertEqual(code, 6)
        self.assertIn('exit code 6', told)
        self.assertNotIn('holds', told)

    def test_nothing_is_played_after_an_interruption(self):
        tree = {'falling': TREE['falling'], 'other': TREE['falling']}
        self.assertEqual(self.act('falling', 'other', tree=tree)[0], 0)
        for code, told_code in ((130, 130), (143, 143), (-9, 137)):
            with mock.patch.object(playing, 'play', return_value=records.Played(None, code, 1.0, 2.0)) as play, \
                    mock.patch.object(records, 'save_played'):
                self.assertEqual(self.act('falling', 'other', tree=tree)[0], told_code)
            self.assertEqual(play.call_count, 1)

    def test_the_short_form(self):
        code, told = self.act('--quick', 'falling')
        self.assertEqual(code, 0)
        self.assertIn("--set time.end=1 --set 'domain.size=[4, 6.5]'", told)
        self.assertIn('falling-quick', told)
        self.assertEqual(self.act('--quick', 'other')[0], 2)

    def test_a_study_is_played_and_its_runs_compared(self):
        self.study_of('seed-1', 'seed-2')
        tree = {'sweep': {'full': {'expected': {'column/seed-1': {'end_height': {'is': 2.9, 'within': 0.1}},
                                                'column/seed-2': {'end_height': {'is': 3.9, 'within': 0.1}}}}}}
        code, told = self.act('sweep', tree=tree)
        self.assertEqual(code, 1)
        self.assertRegex(told, r'turbidite study \S+/configs/sweep.yaml --out \S+/out/sweep\n')
        self.assertIn('holds   column/seed-1: end_height = 2.9 D', told)
        self.assertIn('FAILS   column/seed-2: end_height = 2.9 D', told)

    def test_the_short_form_of_a_study_is_its_own_where_it_has_one(self):
        self.study_of('seed-1')
        form = {'expected': {'column/seed-1': {'end_height': {'is': 2.9, 'within': 0.1}}}}
        tree = {'sweep': {'full': form, 'quick': form}}
        self.assertNotIn('--quick', self.act('sweep', '--quick', tree=tree)[1])
        with open(self.folder / 'configs/sweep.yaml', 'a', encoding='utf-8') as study:
            study.write('    quick: {time.end: 1}\n')
        code, told = self.act('sweep', '--quick', tree=tree)
        self.assertEqual(code, 0, told)
        self.assertRegex(told, r'turbidite study \S+/configs/sweep.yaml --out \S+/out/sweep-quick --quick\n')
        self.assertNotIn('--quick', self.act('sweep', tree=tree)[1])

    def test_a_refused_run_leaves_what_is_known_of_the_one_before(self):
        self.act('falling')
        with mock.patch.object(playing, 'play', return_value=records.Played(None, 2, 0.1, 1.0)):
            self.assertEqual(self.act('falling')[0], 2)
        code, told = self.act('falling', '--judge')
        self.assertEqual(code, 0, told)
        self.assertIn('2 of 2 numbers hold', told)

    def test_a_run_that_was_killed_is_not_judged(self):
        self.act('falling')
        self.write('out/falling/run.json', json.dumps({'status': 'prepared'}))
        code, told = self.act('falling', '--judge')
        self.assertEqual(code, 2)
        self.assertIn('out/falling is not done, and cannot be judged: it is prepared', told)

    def test_a_run_that_was_cut_off_is_judged_once_it_has_been_resumed(self):
        self.write('program', (self.folder / 'program').read_text().replace('sys.exit(0)\n', 'sys.exit(143)\n'))
        self.assertEqual(self.act('falling')[0], 143)
        self.assertEqual(self.act('falling', '--judge')[0], 143)
        record = json.loads((self.folder / 'out/falling/run.json').read_text())
        self.write('out/falling/run.json', json.dumps({**record, 'parts': [{}, {'versions': record['versions']}]}))
        code, told = self.act('falling', '--judge')
        self.assertEqual(code, 0, told)
        self.assertIn('2 of 2 numbers hold; played in several parts, whose time is not known', told)

    def test_a_run_of_other_keys_is_not_judged(self):
        def refused(tree, text):
            code, told = self.act('--quick', '--judge', 'falling', tree=tree)
            self.assertEqual(code, 2, told)
            self.assertRegex(told, fr'falling: \S+/out/falling-quick was played {text}')
            self.assertNotIn('holds', told)

        def form(**sets):
            quick = {**TREE['falling']['quick'], 'set': {**TREE['falling']['quick']['set'], **sets}}
            return {'falling': {**TREE['falling'], 'quick': quick}}
        self.act('--quick', 'falling')
        self.assertEqual(self.act('--quick', '--judge', 'falling')[0], 0)
        refused(form(**{'time.end': 2}), 'with time.end = 1, and the quick form is with time.end = 2')
        refused(form(**{'domain.left': 'wall'}), 'without domain.left, and the quick form is with domain.left = wall')
        record = json.loads((self.folder / 'out/falling-quick/run.json').read_text())
        for resumed, text in (('time.end=3', 'with time.end = 3, and the quick form is with time.end = 1'),
                              ('limits.drift=1', 'with limits.drift = 1, and the quick form is without limits.drift')):
            self.write('out/falling-quick/run.json', json.dumps({**record, 'parts': [{}, {'overrides': [resumed]}]}))
            refused(TREE, text)

    def test_a_gallery_that_was_killed_leaves_no_time_of_an_earlier_run(self):
        self.act('falling')
        with mock.patch.object(playing, 'play', side_effect=KeyboardInterrupt):
            self.assertEqual(self.act('falling')[0], 130)
        code, told = self.act('falling', '--judge')
        self.assertEqual(code, 2)
        self.assertIn('no run of the gallery ended in', told)

    def test_the_folder_of_a_case_is_not_that_of_a_study(self):
        self.study_of('seed-1')
        self.write('configs/sweep/column.yaml', 'time:\n  step: 0.1\n')
        holds = {'end_height': {'is': 2.9, 'within': 0.1}}
        tree = {'sweep': {'full': {'expected': {'column/seed-1': holds}}}, 'sweep/column': {'full': {'expected': holds}}}
        for _ in range(2):
            code, told = self.act('sweep', 'sweep/column', tree=tree)
            self.assertEqual(code, 0, told)
        self.assertEqual(sorted(folder.name for folder in (self.folder / 'out').iterdir()), ['sweep', 'sweep-column'])

    def test_what_is_refused(self):
        for words, text in ((['faling'], 'Did you mean falling'), (['other'], 'no expected numbers so far')):
            code, told = self.act(*words)
            self.assertEqual(code, 2)
            self.assertIn(text, told)
        self.assertIn('there is no case', self.act(tree={'gone': None})[1])

    def test_the_list(self):
        code, told = self.act()
        self.assertEqual(code, 0)
        self.assertRegex(told, r'falling +not recorded')
        listed = json.loads(self.act('--json')[1])
        self.assertEqual(listed['falling']['full']['expected'][0],
                         {'run': '', 'what': 'end_height', 'lowest': 2.8, 'highest': 3.0})
        self.assertFalse(listed['other']['study'])
        code, told = self.act('--json', 'falling')
        self.assertEqual((code, list(json.loads(told))), (0, ['falling']))
        self.assertFalse((self.folder / 'out').exists())
        for flag in ('--record', '--judge'):
            code, told = self.act(flag)
            self.assertEqual(code, 2)
            self.assertIn(f'{flag} needs the name', told)


@unittest.skipUnless(shutil.which('git'), 'records are of a checkout')
class Records(Played):
    def git(self, *words):
        subprocess.run(['git', '-C', str(self.folder), '-c', 'user.name=a', '-c', 'user.email=a@b', *words], check=True,
                       capture_output=True)

    def commit(self, *words):
        self.git('add', 'configs')
        self.git('commit', '-m', 'x', *words)

    def setUp(self):
        super().setUp()
        self.git('init')
        self.commit()
        self.build()

    def build(self):
        """The program says that it is of the commit that is checked out."""
        self.write('version', f'0.1.0 {records.commit(self.folder)}')

    def test_a_record_is_one_line_of_the_file(self):
        code, told = self.act('--record', 'falling')
        self.assertEqual(code, 0, told)
        lines = (self.folder / 'configs/expected.yaml').read_text().splitlines()
        kept = [line for line in lines if 'recorded' not in line]
        self.assertEqual(kept, [line for line in EXPECTED.splitlines() if 'recorded' not in line])
        (line,) = [line for line in lines if 'recorded' in line]
        self.assertIn(records.commit(self.folder), line)
        self.assertLess(lines.index(line), lines.index('  quick:'))
        self.act('--record', '--quick', 'falling')
        lines = (self.folder / 'configs/expected.yaml').read_text().splitlines()
        self.assertEqual([k for k, line in enumerate(lines) if 'recorded' in line], [5, 11])

    def test_nothing_is_recorded_when_a_number_does_not_hold(self):
        before = (self.folder / 'configs/expected.yaml').read_text()
        broken = {'falling': {'full': {'expected': {'end_height': {'above': 3}}}}}
        self.assertEqual(self.act('--record', 'falling', tree=broken)[0], 1)
        self.assertEqual((self.folder / 'configs/expected.yaml').read_text(), before)

    def test_what_is_not_committed_is_not_recorded(self):
        self.write('configs/falling.yaml', 'time:\n  step: 0.2\n')
        code, told = self.act('--record', 'falling')
        self.assertEqual(code, 2)
        self.assertIn('configs/falling.yaml is not committed', told)

    def test_what_cannot_be_recorded_is_refused_before_it_is_played(self):
        def refused(*words):
            with mock.patch.object(playing, 'play', side_effect=AssertionError):
                code, told = self.act('--record', *words, 'falling')
            self.assertEqual(code, 2, told)
            return told
        inline = EXPECTED.replace('  quick:\n    set: {time.end: 1}\n', '  quick: {set: {time.end: 1}}\n')
        self.write('configs/expected.yaml', inline + '  quick:\n')     # that of another entry
        self.assertIn('below `  quick:`, two columns in, below falling', refused('--quick'))
        (self.folder / 'configs/expected.yaml').unlink()
        (self.folder / 'configs/expected.yaml').mkdir()
        self.assertIn('Is a directory', refused())

    def test_empty_lines_and_comments_of_a_form(self):
        played = records.Played(records.Source('abc', [], '2026-01-01'), 0, 1.0, 2.0)
        text = 'a:\n  full:\n    set: {}\n\n# Why.\n    expected: {}\n    recorded: {}\n\n# Other.\nb:\n  full:\n'
        self.assertEqual(records.with_record(text, 'a', 'full', played), text.replace(
            '    recorded: {}', '    recorded: {commit: "abc", date: 2026-01-01, processor: 1, memory: 2}'))

    def test_old_records_are_told(self):
        recorded = {'commit': records.commit(self.folder), 'date': '2026-01-02', 'processor': 3, 'memory': 4}
        tree = {'falling': {'full': {**TREE['falling']['full'], 'recorded': recorded}}}
        self.assertNotIn('ago', self.act(tree=tree)[1])
        with mock.patch.object(records, 'OLD', 1):
            self.commit('--allow-empty')
            self.assertNotIn('ago', self.act(tree=tree)[1])
            self.commit('--allow-empty')
            self.assertIn('2026-01-02, 2 commits ago', self.act(tree=tree)[1])

    def test_the_commit_is_that_of_the_beginning(self):
        begin = records.commit(self.folder)

        def play(line, source):
            self.commit('--allow-empty')
            return records.Played(source, subprocess.run(line).returncode, 1.0, 2.0)
        with mock.patch.object(playing, 'play', play):
            self.assertEqual(self.act('--record', 'falling')[0], 0)
        self.assertNotEqual(records.commit(self.folder), begin)
        self.assertIn(begin, (self.folder / 'configs/expected.yaml').read_text())

    def test_a_run_is_judged_again_and_recorded_as_it_was_played(self):
        broken = {'falling': {'full': {'expected': {'end_height': {'above': 3}}}}}
        self.assertEqual(self.act('falling', tree=broken)[0], 1)
        played = records.load_played(self.folder / 'out/falling')
        self.commit('--allow-empty')
        with mock.patch.object(playing, 'play', side_effect=AssertionError):
            self.assertEqual(self.act('--judge', '--record', 'falling')[0], 0)
        self.assertIn(f'{{commit: "{played.source.commit}"', (self.folder / 'configs/expected.yaml').read_text())
        self.assertNotEqual(played.source.commit, records.commit(self.folder))

    def test_what_was_not_committed_when_it_was_played_is_not_recorded_later(self):
        self.write('configs/falling.yaml', 'time:\n  step: 0.2\n')
        self.act('falling')
        self.commit('-a')
        code, told = self.act('--judge', '--record', 'falling')
        self.assertEqual(code, 2)
        self.assertIn('configs/falling.yaml is not committed', told)

    def test_a_program_of_another_commit_is_not_recorded(self):
        self.commit('--allow-empty')
        code, told = self.act('--record', 'falling')
        self.assertEqual(code, 2)
        self.assertIn('Build the program anew', told)

    def test_runs_of_another_commit_are_not_recorded_as_of_this_one(self):
        self.act('falling')
        record = json.loads((self.folder / 'out/falling/run.json').read_text())
        self.write('out/falling/run.json', json.dumps({**record, 'versions': {'turbidite': '0.1.0', 'commit': '0123456789'}}))
        code, told = self.act('--judge', '--record', 'falling')
        self.assertEqual(code, 2)
        self.assertIn('is of 0123456789', told)

    def test_a_run_that_another_commit_resumed_is_not_recorded(self):
        self.act('falling')
        record = json.loads((self.folder / 'out/falling/run.json').read_text())
        for commit, code in ((record['versions']['commit'], 0), ('0123456789', 2)):
            parts = [{}, {'versions': {'turbidite': '0.1.0', 'commit': commit}}]
            self.write('out/falling/run.json', json.dumps({**record, 'parts': parts}))
            found, told = self.act('--judge', '--record', 'falling')
            self.assertEqual(found, code, told)
        self.assertIn('is of 0123456789', told)

    def test_commits_of_elsewhere_are_told(self):
        recorded = {'commit': '0123456789', 'date': '2026-01-02', 'processor': 3, 'memory': 4}
        tree = {'falling': {'full': {**TREE['falling']['full'], 'recorded': recorded}}}
        self.assertIn('0123456 2026-01-02, a commit that is not here', self.act(tree=tree)[1])

    def test_where_there_is_no_git_the_age_is_unknown(self):
        with mock.patch.object(subprocess, 'run', side_effect=FileNotFoundError):
            self.assertIsNone(records.commit(self.folder))
            self.assertEqual(records.told(self.folder, {'commit': 'abcdefgh', 'date': '2026-01-02'}), 'abcdefg 2026-01-02')
            self.assertIn('needs a checkout', self.act('--record', 'falling')[1])


class Installed(Played):
    def test_the_program_says_its_commit(self):
        self.assertEqual(records.versions_of(self.folder / 'program'), ('0.1.0', ''))
        self.assertEqual(records.versions_of('/bin/true'), ('', ''))
        self.write('version', '0.1.0 0123456789')
        code, told = self.act('--record', 'falling')
        self.assertEqual(code, 0, told)
        self.assertIn('commit: "0123456789"', (self.folder / 'configs/expected.yaml').read_text())


class Studies(Played):
    """What is there of a study when the gallery plays it."""
    height = {'end_height': {'is': 2.9, 'within': 0.1}}
    tree = {'sweep': {'full': {'expected': {'column/seed-1': height, 'column/seed-2': height}}}}

    def setUp(self):
        super().setUp()
        self.study_of('seed-1', 'seed-2')
        self.write('version', '0.1.0 0123456789')

    def act(self, *words, tree=None):
        return super().act(*words, tree=tree or self.tree)

    def record_of(self, run):
        return json.loads((self.folder / f'out/sweep/column/{run}/run.json').read_text())

    def change(self, run, **values):
        self.write(f'out/sweep/column/{run}/run.json', json.dumps({**self.record_of(run), **values}))

    def recorded(self):
        self.write('configs/expected.yaml', 'sweep:\n  full:\n')
        self.assertEqual(self.act('--record', 'sweep')[0], 0)
        return (self.folder / 'configs/expected.yaml').read_text().splitlines()[-1]

    def test_runs_of_another_commit_are_played_anew(self):
        self.act('sweep')
        self.change('seed-1', versions={'turbidite': '0.1.0', 'commit': '9876543210'})
        code, told = self.act('sweep')
        self.assertEqual(code, 0, told)
        self.assertIn('1 run of before, now seed-1-old-1', told)
        self.assertEqual(self.record_of('seed-1')['versions']['commit'], '0123456789')
        self.assertEqual(self.record_of('seed-1-old-1')['versions']['commit'], '9876543210')
        self.assertFalse((self.folder / 'out/sweep/column/seed-2-old-1').exists())
        self.assertNotIn('of before', self.act('sweep')[1])     # those that were set aside stay

    def test_runs_of_sources_that_were_not_committed_are_played_anew(self):
        with mock.patch.object(records, 'changed', return_value=['coupler/hub.cpp']):
            self.act('sweep')
            self.assertIn('2 runs of before', self.act('sweep')[1])
        self.assertIn('2 runs of before', self.act('sweep')[1])
        self.assertNotIn('of before', self.act('sweep')[1])

    def test_the_time_of_a_part_is_not_recorded_for_the_whole(self):
        self.assertIn('processor: ', self.recorded())
        shutil.rmtree(self.folder / 'out/sweep/column/seed-2')
        self.assertEqual(self.recorded(), f'    recorded: {{commit: "0123456789", date: {datetime.date.today()}}}')
        self.assertEqual(self.act(tree={'sweep': {'full': {'recorded': {'commit': '0123456789', 'date': '2026-01-02'}}}})[0], 0)

    def test_runs_that_others_play_are_not_judged(self):
        self.act('sweep')
        self.write('out/sweep/column/seed-2/history.csv', 'step,time\n0,0\n')
        with open(self.folder / 'out/sweep/column/seed-2/lock', 'wb') as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            code, told = self.act('sweep')
        self.assertEqual(code, 2)
        self.assertIn('column/seed-2 is not done, and cannot be judged: it is being played', told)
        self.assertNotIn('FAILS', told)

    def test_what_cannot_be_judged_does_not_keep_others_from_being_played(self):
        shutil.rmtree(self.folder / 'made-up/column/seed-2')
        code, told = self.act('sweep', 'falling', tree={**self.tree, **TREE})
        self.assertEqual(code, 2)
        self.assertIn('falling: 2 of 2 numbers hold', told)

    def test_the_time_is_not_recorded_where_another_call_has_played_too(self):
        def play(line, source):
            records.save_played(self.folder / 'out/sweep', records.Played(source, None, None, None, 1))
            return records.Played(source, subprocess.run(line).returncode, 1.0, 2.0)
        with mock.patch.object(playing, 'play', play):
            self.assertNotIn('processor', self.recorded())

    def test_a_study_of_other_keys_is_not_judged(self):
        def judged(**form):
            return self.act('--judge', 'sweep', tree={'sweep': {'full': {**self.tree['sweep']['full'], **form}}})
        self.act('sweep')
        self.assertEqual(judged()[0], 0)
        code, told = judged(set={'time.end': 2})
        self.assertEqual(code, 2)
        self.assertRegex(told, r'sweep: \S+/out/sweep was played without time.end, and the full form is with time.end')
        self.change('seed-2', parts=[{}, {'overrides': ['time.end=3']}])
        self.assertIn('was played with time.end = 3, and the full form is without time.end', judged()[1])

    def test_the_short_form_of_a_study_that_has_got_its_own_is_played_anew(self):
        tree = {'sweep': {'full': {}, 'quick': self.tree['sweep']['full']}}
        self.act('--quick', 'sweep', tree=tree)
        with open(self.folder / 'configs/sweep.yaml', 'a', encoding='utf-8') as study:
            study.write('    quick: {time.end: 1}\n')
        code, told = self.act('--quick', '--judge', 'sweep', tree=tree)
        self.assertEqual(code, 2)
        self.assertIn('was played without --quick, and the quick form is with it', told)

    def test_runs_that_are_not_there_are_not_judged(self):
        shutil.rmtree(self.folder / 'made-up/column/seed-2')
        code, told = self.act('sweep')
        self.assertEqual(code, 2)
        self.assertIn('it is not there', told)

    def test_a_run_that_is_being_played_is_not_set_aside(self):
        self.act('sweep')
        self.change('seed-1', versions={'turbidite': '0.0.9'})
        with open(self.folder / 'out/sweep/column/seed-1/lock', 'wb') as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            code, told = self.act('sweep')
        self.assertEqual(code, 2)
        self.assertIn('seed-1 is being played', told)


class Playing(unittest.TestCase):
    def test_a_request_to_end_is_passed_on(self):
        """As a batch system sends it."""
        begin = ('import os, signal, time\nsignal.signal(signal.SIGTERM, lambda *_: os._exit(143))\n'
                 f'os.kill({os.getpid()}, signal.SIGTERM)\ntime.sleep(60)')
        self.assertEqual(playing.play([sys.executable, '-c', begin], None).code, 143)

    def test_what_a_program_took_is_its_own(self):
        """A large one before does not count."""
        large = playing.play([sys.executable, '-c', 'x = bytearray(200_000_000)'], None)
        small = playing.play([sys.executable, '-c', 'import sys\nfor k in range(3_000_000): pass\nsys.exit(3)'], None)
        self.assertEqual((large.code, small.code), (0, 3))
        self.assertGreater(large.memory, 200.0)
        self.assertLess(small.memory, 100.0)
        self.assertGreater(small.processor, 0.02)

    def test_the_memory_of_the_gallery_is_not_that_of_the_program(self):
        self.assertIn('numpy', sys.modules)
        self.assertLess(playing.play(['/bin/true'], None).memory, 15.0)

    def test_a_program_that_is_not_there_has_failed(self):
        self.assertEqual(playing.play(['/no/such/program'], None).code, 1)


if __name__ == '__main__':
    unittest.main()
