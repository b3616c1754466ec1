# SPDX-License-Identifier: LGPL-2.1-or-later
"""terminal_test.py TURBIDITE: what commands print on a terminal of 60 columns, and on one that knows no escapes."""
import fcntl
import json
import os
import pty
import select
import struct
import subprocess
import sys
import tempfile
import termios
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv.pop()).resolve())
CONFIGS = Path(__file__).resolve().parents[3] / 'configs'
COLUMNS = 60


def printed(folder, *words, term='xterm'):
    """All that the program prints on a terminal, stdout and stderr."""
    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack('HHHH', 24, COLUMNS, 0, 0))
    child = subprocess.Popen([PROGRAM, *words], stdin=its, stdout=its, stderr=its, cwd=folder,
                             env=dict(os.environ, TERM=term))
    parts = []
    ended = False
    # Our own hold on the program's end keeps it open until all is read: a reader that the closing overtakes gets EIO
    # in the place of the last lines.
    while True:
        if select.select([ours], [], [], 0.05)[0]:
            parts.append(os.read(ours, 65536))
        elif ended:
            break
        ended = child.poll() is not None
    os.close(its)
    os.close(ours)
    return b''.join(parts).decode().replace('\r\n', '\n')


def breakable(line):
    """A line that is too wide, and could be narrower: a path cannot."""
    indent = len(line) - len(line.lstrip())
    return len(line) > COLUMNS and indent + max(map(len, line.split())) <= COLUMNS


class Terminal(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / 'case.yaml').write_text((CONFIGS / 'quickstart.yaml').read_text())
        (self.folder / 'grains.csv').write_text('id,x,y\n0,abc,1\n1,900,1\n')
        (self.folder / 'full').mkdir()
        (self.folder / 'full/diary').write_text('mine')

    def test_a_terminal_that_is_closed_ends_a_run_in_order(self):
        """Its SIGHUP comes when nothing can be printed any more."""
        ours, its = pty.openpty()
        settings = ['fluid.enabled=false', 'grains.adapter=standalone-nscd', 'time.end=2000', 'output.interval=1']
        child = subprocess.Popen([PROGRAM, 'run', 'case.yaml', '--out', 'run', *(f'--set={one}' for one in settings)],
                                 stdin=its, stdout=its, stderr=its, cwd=self.folder, start_new_session=True,
                                 preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
                                 env=dict(os.environ, TURBIDITE_REPORT='off'))
        os.close(its)
        history = self.folder / 'run/history.csv'
        while child.poll() is None and not (history.exists() and history.read_text().count('\n') > 2):
            if select.select([ours], [], [], 0.1)[0]:
                os.read(ours, 65536)
        os.close(ours)
        self.assertEqual(child.wait(60), 143)
        record = json.loads((self.folder / 'run/run.json').read_text())
        self.assertEqual(record['exit_code'], 143)
        self.assertIn(f'w{record["windows_done"]:08}', os.listdir(self.folder / 'run/checkpoints'))

    def test_no_word_is_broken(self):
        """By the terminal, at its edge."""
        for words, said in ((['--help'], 'go on with a run'), (['run', '--help'], 'overwrite an existing run'),
                            (['keys', 'contact.friction'], 'friction'), (['rnu'], 'there is no command'),
                            (['check', 'case.yaml'], 'valid'),
                            (['check', 'case.yaml', '--set', 'grains.file=grains.csv'], 'x = abc'),
                            (['check', 'case.yaml', '--set', 'grains.adapter=yade'], 'yade-md'),
                            (['run', 'case.yaml', '--out', 'full'], 'is not empty'),
                            (['resume', 'nowhere'], 'nowhere'), (['compare', 'nowhere'], 'at least two'),
                            (['study', str(CONFIGS / 'grain-codes.yaml'), '--dry-run', '--out', 'study'], 'lammps-md')):
            text = printed(self.folder, *words)
            self.assertIn(said, text, words)
            self.assertEqual([line for line in text.split('\n') if breakable(line)], [], words)

    def test_a_terminal_without_escapes_gets_none(self):
        for words in (['--help'], ['check', 'case.yaml'], ['run', 'case.yaml', '--out', 'full'], ['keys']):
            text = printed(self.folder, *words, term='dumb')
            self.assertGreater(len(text), 20)
            self.assertNotIn('\x1b', text)


if __name__ == '__main__':
    unittest.main()
