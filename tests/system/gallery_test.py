# SPDX-License-Identifier: LGPL-2.1-or-later
"""`turbidite gallery`: every shipped study has an entry (cases: ShippedCases), what cases say about coming to rest is
expected of them, a short form holds, and a wrong number is found.

usage: gallery_test.py PROJECT_FOLDER PROGRAM
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REST = re.compile(r'\bat\s+rest\s+(by|from|after|at)\s+(?:about\s+)?([\d.]+)\s+t_c')


def said(text):
    """[('from', 46.0), ...] of the sentences about coming to rest."""
    return [(word, float(time)) for word, time in REST.findall(text)]


def comments(yaml):
    return ' '.join(line.lstrip('# ') for line in yaml.splitlines() if line.startswith('#'))


def agrees(word, time, lowest, highest):
    """What is said about a rest time with what is expected of it."""
    if highest is None:
        return False
    return highest <= time if word in ('by', 'after') else (lowest or 0.0) <= time <= highest


class Gallery(unittest.TestCase):
    root = program = None

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.configs = self.root / 'configs'

    def gallery(self, *words):
        return subprocess.run([self.program, 'gallery', *words], cwd=self.folder, capture_output=True, text=True)

    def entries(self):
        return json.loads(self.gallery('--json').stdout)

    def test_every_study_has_an_entry(self):
        studies = {path.stem for path in self.configs.glob('*.yaml') if re.search('^(parts|case):', path.read_text(), re.M)}
        self.assertGreater(len(studies), 5)
        self.assertEqual({name for name, entry in self.entries().items() if entry['study']}, studies)

    def test_what_is_expected_of_a_study_is_of_its_parts(self):
        found = set()
        for name, entry in self.entries().items():
            parts = re.findall(r'^  ([\w-]+):', (self.configs / f'{name}.yaml').read_text().partition('\nparts:')[2], re.M)
            expected = {one['run'].partition('/')[0] for form in ('full', 'quick') if form in entry
                        for one in entry[form]['expected'] if '/' in one['run']}
            self.assertLessEqual(expected, set(parts or [name]), name)
            found |= expected
        self.assertGreater(len(found), 5)

    def test_the_list_names_what_is_recorded(self):
        listed = self.gallery()
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertRegex(listed.stdout, r'\nquickstart +[0-9a-f]{7} 20\d\d-')
        other = self.folder / 'expected.yaml'
        other.write_text('silo:\n  full:\n')
        self.assertRegex(self.gallery('--expected', str(other)).stdout, r'\nsilo +not recorded')

    def test_what_cases_say_about_rest_is_expected_of_them(self):
        entries, rows = self.entries(), dict(re.findall(r'^\| `([\w-]+)` \|(.*)$', (self.configs / 'README.md').read_text(), re.M))
        found = 0
        for name, entry in entries.items():
            sentences = said(comments((self.configs / f'{name}.yaml').read_text())) + said(rows.get(name, ''))
            bounds = [one for one in entry['full']['expected'] if one['what'] == 'rest_time']
            for word, time in sentences:
                found += 1
                self.assertTrue(bounds, f'{name} says "at rest {word} {time:g} t_c", and no rest_time is expected of it')
                self.assertTrue(agrees(word, time, bounds[0]['lowest'], bounds[0]['highest']),
                                f'{name} says "at rest {word} {time:g} t_c", and expected is {bounds[0]}')
        self.assertGreater(found, 5)

    def test_a_short_form_holds(self):
        played = self.gallery('--quick', 'quickstart')
        self.assertEqual(played.returncode, 0, played.stdout + played.stderr)
        self.assertIn('  holds   peak_velocity = 0.1', played.stdout)
        self.assertIn('4 of 4 numbers hold', played.stdout)
        self.assertTrue((self.folder / 'runs/gallery/quickstart-quick/history.csv').exists())

    def test_a_wrong_number_is_found(self):
        wrong = self.folder / 'expected.yaml'
        wrong.write_text('quickstart:\n  quick:\n    set: {fluid.enabled: false, grains.adapter: standalone-nscd, time.end: 1.5}\n'
                         '    expected:\n      at(mean_velocity_y, 1.5): {is: -1.325, within: 1e-2}\n      end_height: {above: 7}\n')
        played = self.gallery('--quick', 'quickstart', '--expected', str(wrong))
        self.assertEqual(played.returncode, 1, played.stdout + played.stderr)
        self.assertIn('  holds   at(mean_velocity_y, 1.5) = -1.3', played.stdout)
        self.assertIn('  FAILS   end_height = 6.', played.stdout)

        before = (self.folder / 'runs/gallery/quickstart-quick/run.json').stat().st_mtime_ns
        wrong.write_text(wrong.read_text().replace('above: 7', 'above: 6'))
        again = self.gallery('--quick', 'quickstart', '--expected', str(wrong), '--judge')
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.assertIn('  holds   end_height = 6.', again.stdout)
        self.assertIn(played.stdout.splitlines()[-1].split('; ')[1], again.stdout)  # what it took
        self.assertEqual((self.folder / 'runs/gallery/quickstart-quick/run.json').stat().st_mtime_ns, before)

    def test_what_was_not_played_is_not_compared(self):
        answer = self.gallery('--quick', 'quickstart', '--judge')
        self.assertEqual(answer.returncode, 2, answer.stdout)
        self.assertIn('no run of the gallery ended in runs/gallery/quickstart-quick', answer.stderr)

    def test_faults_of_the_file_are_named(self):
        wrong = self.folder / 'expected.yaml'
        for text, told in (('quickstart: [1', 'expected.yaml:'), ('quickstrat:\n  full:\n', 'there is no case or study'),
                           ('quickstart:\n  ful:\n', 'Did you mean full?')):
            wrong.write_text(text)
            answer = self.gallery('--expected', str(wrong))
            self.assertEqual(answer.returncode, 2, answer.stdout + answer.stderr)
            self.assertIn(told, answer.stderr)
        self.assertEqual(self.gallery('--expected', 'nowhere.yaml').returncode, 2)


class Folders(unittest.TestCase):
    root = None

    def test_no_run_goes_into_the_folder_of_another_entry(self):
        sys.path.insert(0, str(self.root / 'launcher/report/gallery'))
        from main import Gallery as Player, parsed
        names = [name for name in re.findall(r'^([\w/-]+):', (self.root / 'configs/expected.yaml').read_text(), re.M)]
        folders = []
        for words in ([], ['--quick']):
            player = Player(parsed(['turbidite', str(self.root / 'configs'), '', '--out', 'out', *words]), {})
            folders += [player.folder(name) for name in names]
        self.assertEqual(len(set(folders)), 2 * len(names))
        self.assertFalse([folder for folder in folders if set(folder.parents) & set(folders)])


class Itself(unittest.TestCase):
    def test_sentences(self):
        self.assertEqual(said('at rest from 46 t_c. at\nrest at about 50 t_c, at rest by 2.5 t_c'),
                         [('from', 46.0), ('at', 50.0), ('by', 2.5)])
        self.assertEqual([agrees('by', 30, None, 25), agrees('by', 20, None, 25), agrees('from', 20, 15, 25), agrees('from', 30, 15, 25)],
                         [True, False, True, False])


if __name__ == '__main__':
    Gallery.program, Gallery.root = sys.argv.pop(), Path(sys.argv.pop()).resolve()
    Folders.root = Gallery.root
    unittest.main()
