# SPDX-License-Identifier: LGPL-2.1-or-later
"""A page of docs/ whose blocks are played in the order in which they are printed:

    ```yaml, ```python     whose first line is `# NAME.EXT`: written as this file
    ```console             lines after `$ ` are commands, of one shell for the block; each must end with 0, and give what
                           stands below it, where `...` is any text
    ```pycon               one session of Python for the page

usage: page_test.py PROJECT_FOLDER PROGRAM PAGE
"""
import doctest
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BLOCK = re.compile(r'^```(\w+)\n(.*?)^```', re.MULTILINE | re.DOTALL)
NAME = re.compile(r'# ([\w.-]+\.(?:yaml|py))\n')
FEWEST = 3  # answers that are compared: a page that asserts next to nothing would pass
MARK = '--- end of a command: '


def commands(block):
    """[(command, expected output), ...] of a console block; a command goes on in the next line after a backslash."""
    found = []
    for line in block.splitlines(keepends=True):
        if line.startswith('$ '):
            found.append([line[2:], ''])
        elif found and not found[-1][1] and found[-1][0].endswith('\\\n'):
            found[-1][0] += line
        elif found:
            found[-1][1] += line
        else:
            raise ValueError(f'a console block begins with output: {line}')
    return found


def played(script):
    """[(output, exit code), ...] of commands of one shell."""
    text = ''.join(f'{command}\necho "{MARK}$?"\n' for command, _ in script)
    out = subprocess.run(['bash', '-c', text], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
    parts = re.split(re.escape(MARK) + r'(\d+)\n', out)
    return list(zip(parts[::2], map(int, parts[1::2])))


class Page(unittest.TestCase):
    root = program = page = None

    def setUp(self):
        self.compared, self.session = 0, {}
        self.checker = doctest.OutputChecker()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        os.symlink(self.root / 'configs', 'configs')
        os.symlink(self.program, 'turbidite')
        os.environ.update(TURBIDITE_PROGRAM=self.program, TURBIDITE_REPORT='off')
        sys.path.insert(0, str(self.root / 'launcher/python'))
        os.environ['PYTHONPATH'] = sys.path[0]

    def test_blocks_give_what_is_printed(self):
        play = {'console': self.console, 'pycon': self.python, 'yaml': self.file, 'python': self.file}
        text = (self.root / self.page).read_text()
        blocks = [(kind, block) for kind, block in BLOCK.findall(text) if kind in play]
        self.assertEqual(len(blocks), sum(text.count(f'```{kind}\n') for kind in play))
        for kind, block in blocks:
            play[kind](block)
        self.assertGreaterEqual(self.compared, FEWEST)

    def file(self, block):
        if name := NAME.match(block):
            Path(name[1]).write_text(block)

    def console(self, block):
        script = commands(block)
        answers = played(script)
        self.assertEqual(len(answers), len(script), answers)
        for (command, expected), (out, code) in zip(script, answers):
            self.assertEqual(code, 0, f'{command}{out}')
            if expected:
                self.compare(command, expected, out)

    def compare(self, what, expected, out):
        self.compared += 1
        self.assertTrue(self.checker.check_output(expected, out, doctest.ELLIPSIS),
                        f'{self.page}: {what} should give\n{expected}and gives\n{out}')

    def python(self, block):
        test = doctest.DocTestParser().get_doctest(block, self.session, self.page, self.page, 0)
        told, runner = [], doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        runner.run(test, out=told.append, clear_globs=False)
        self.session = test.globs
        self.compared += sum(bool(example.want) for example in test.examples)
        self.assertEqual(runner.failures, 0, ''.join(told))


if __name__ == '__main__':
    Page.page, Page.program, Page.root = sys.argv.pop(), sys.argv.pop(), Path(sys.argv.pop()).resolve()
    unittest.main()
