# SPDX-License-Identifier: LGPL-2.1-or-later
"""The site: every page has a place, links hold, pictures and the search are there, and with doxygen the API reference."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / 'launcher/site/site.py'

needs_doxygen = unittest.skipUnless(shutil.which('doxygen'), 'doxygen is not installed')


def script(*words, path=os.environ['PATH']):
    return subprocess.run(['/usr/bin/python3', '-B', SCRIPT, *map(str, words)], capture_output=True, text=True, check=False,
                          env={**os.environ, 'PATH': path})


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = Path(cls.folder.name) / 'site'
        built = script('build', ROOT, cls.site)
        if built.returncode:
            raise AssertionError(built.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_its_links_lead_to_files_of_the_site(self):
        dead = []
        pages = list(self.site.rglob('*.html'))
        self.assertGreater(len(pages), 40)
        for page in pages:
            for target in re.findall(r'(?:href|src)="([^"#?:]+)["#?]', page.read_text()):
                if not target.startswith('/') and not (page.parent / target).exists():
                    dead.append((page.name, target))
        self.assertEqual(dead, [])

    def test_the_search_knows_a_key_and_a_word_of_the_questions(self):
        index = json.loads((self.site / 'search/search_index.json').read_text())
        for word in ('fluid.cells_per_diameter', 'Why does my dense column not move'):
            self.assertTrue(any(word in entry['text'] + entry['title'] for entry in index['docs']), word)

    def test_it_asks_nothing_of_the_internet(self):
        for page in self.site.rglob('*.html'):
            self.assertEqual(re.findall(r'<(?:script|link)[^>]+(?:src|href)="(https?:[^"]+)', page.read_text()), [], page.name)

    def test_it_is_shown_on_this_machine(self):
        with subprocess.Popen(['/usr/bin/python3', '-B', SCRIPT, 'show', self.site], stdout=subprocess.PIPE, text=True) as server:
            clock = threading.Timer(20, server.kill)
            clock.start()
            address = re.search(r'http://127\.0\.0\.1:\d+/', server.stdout.readline())[0]
            self.assertIn('OpenFOAM', urllib.request.urlopen(address + 'index.html').read().decode())
            server.terminate()
            clock.cancel()

    @needs_doxygen
    def test_the_table_of_contents_and_the_page_on_adapters_lead_to_it(self):
        page = (self.site / 'docs/write-an-adapter.html').read_text()
        for target in ('../api/index.html', '../api/adapter_8hpp.html', '../api/turbidite_8h.html'):
            self.assertTrue(f'href="{target}"' in page, target)

    @needs_doxygen
    def test_links_of_the_reference_lead_back(self):
        page = (self.site / 'api/index.html').read_text()
        self.assertTrue('href="../docs/write-an-adapter.html"' in page)
        self.assertTrue('"../index.html"' in (self.site / 'api/menudata.js').read_text())

    @needs_doxygen
    def test_the_reference_names_the_version(self):
        version = re.search(r'project\(\w+ VERSION ([\d.]+)', (ROOT / 'CMakeLists.txt').read_text())[1]
        shown = re.search(r'id="projectnumber">&#160;([^<]*)<', (self.site / 'api/index.html').read_text())[1]
        self.assertRegex(shown, rf'^{re.escape(version)}( \([0-9a-f]+\))?$')


class Fresh(unittest.TestCase):
    """As `turbidite docs` shows the site in a checkout."""

    def shown(self, site):
        with tempfile.TemporaryFile('w+') as said, \
                subprocess.Popen(['/usr/bin/python3', '-B', SCRIPT, 'fresh', ROOT, site], stdout=subprocess.PIPE, stderr=said,
                                 text=True) as server:
            clock = threading.Timer(120, server.kill)
            clock.start()
            found = re.search(r'http://127\.0\.0\.1:\d+/', server.stdout.readline())
            page = found and urllib.request.urlopen(found[0] + 'index.html').read().decode()
            server.send_signal(signal.SIGINT)
            clock.cancel()
            said.seek(0)
            self.assertTrue(page, said.read())
        return page

    def test_where_nothing_may_be_written(self):
        self.assertIn('OpenFOAM', self.shown('/proc/turbidite/site'))  # not even root may
        self.assertIn('/proc/turbidite/site cannot be written', script('build', ROOT, '/proc/turbidite/site').stderr)

    def test_what_was_there_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder) / 'site'
            site.mkdir()
            (site / 'index.html').write_text('old')
            (site / 'gone.html').write_text('old')
            self.assertIn('OpenFOAM', self.shown(site))
            self.assertFalse((site / 'gone.html').exists())
            self.assertEqual([path.name for path in Path(folder).iterdir()], ['site'])


class WithoutDoxygen(unittest.TestCase):
    def test_the_site_is_built_and_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            programs, site = Path(folder) / 'bin', Path(folder) / 'site'
            programs.mkdir()
            for name in ('mkdocs', 'git'):
                if found := shutil.which(name):
                    (programs / name).symlink_to(found)
            built = script('build', ROOT, site, path=str(programs))
            self.assertEqual((built.returncode, built.stdout), (0, ''), built.stderr)
            self.assertRegex(built.stderr, r'^[^\n]*without the reference[^\n]*doxygen\n$')
            self.assertFalse((site / 'api').exists())
            self.assertFalse('api/' in (site / 'docs/write-an-adapter.html').read_text())


class Faults(unittest.TestCase):
    def build(self, change):
        """Of a copy of the pages, after a change."""
        with tempfile.TemporaryDirectory() as folder:
            sources, site = Path(folder) / 'sources', Path(folder) / 'site'
            for name in ('docs', 'configs'):
                shutil.copytree(ROOT / name, sources / name)
            for page in ROOT.glob('*.md'):
                shutil.copy(page, sources)
            change(sources)
            built = script('build', sources, site)
            self.assertNotEqual(built.returncode, 0)
            self.assertFalse(site.exists())
            return built.stderr

    def test_a_page_without_a_place_is_named(self):
        self.assertIn('no place for docs/' + 'added.md', self.build(lambda root: (root / ('docs/' + 'added.md')).write_text('# Added\n')))

    def test_a_link_that_leads_nowhere_is_named(self):
        self.assertIn('nowhere.md', self.build(lambda root: (root / 'docs/studies.md').write_text('[x](nowhere.md)\n')))


if __name__ == '__main__':
    sys.exit(unittest.main())
