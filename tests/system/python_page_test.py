# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sessions on docs/python.md give what stands there.

usage: python_page_test.py PROJECT_FOLDER PROGRAM
"""
import doctest
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

SESSION = re.compile(r'^```pycon\n(.*?)^```', re.MULTILINE | re.DOTALL)
FEWEST = 20  # examples: a page whose blocks are not found would pass


def session(page):
    """All blocks of the page as one session."""
    return doctest.DocTestParser().get_doctest('\n'.join(SESSION.findall(page)), {}, 'docs/python.md', None, 0)


class Page(unittest.TestCase):
    root = program = None

    def test_sessions_are_as_printed(self):
        found = session((self.root / 'docs/python.md').read_text())
        self.assertGreater(len(found.examples), FEWEST)
        sys.path.insert(0, str(self.root / 'launcher/python'))
        os.environ['TURBIDITE_PROGRAM'] = self.program
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            os.symlink(self.root / 'configs', 'configs')
            told = []
            runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
            runner.run(found, out=told.append)
            os.chdir(self.root)
        self.assertEqual(runner.failures, 0, ''.join(told))
        self.assertEqual(runner.tries, len(found.examples))


if __name__ == '__main__':
    Page.program, Page.root = sys.argv.pop(), Path(sys.argv.pop()).resolve()
    unittest.main()
