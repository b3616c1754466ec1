# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plays a case or a study by the program, and measures what it took."""
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

from records import Played

MEASURED = Path(__file__).with_name('measured_process.py')


def command(program, file, form, out, study, own_quick=False):
    """Of a case, or of a study, which may have a short form of its own."""
    verb, last = ('study', ['--quick'] if own_quick else []) if study else ('run', ['--force'])
    return [program, verb, str(file), *form.arguments(), '--out', str(out), *last]


def shown(line):
    """As one would type it."""
    return shlex.join(['turbidite', *line[1:]])


def play(line, source):
    """Without a report, which would take part of the time. Ctrl-C reaches the program too, which then ends orderly; SIGTERM
    is passed on."""
    told, tell = os.pipe()
    process = subprocess.Popen([sys.executable, '-I', '-S', '-B', str(MEASURED), str(tell), *line], pass_fds=[tell],
                               stdin=subprocess.DEVNULL, env={**os.environ, 'TURBIDITE_REPORT': 'off'})
    os.close(tell)
    before = signal.signal(signal.SIGTERM, lambda *_: process.send_signal(signal.SIGTERM))
    while True:
        try:
            code = process.wait()
            break
        except KeyboardInterrupt:
            pass
    signal.signal(signal.SIGTERM, before)
    with open(told, encoding='ascii') as answer:
        words = answer.read().split()
    if not words:  # killed, or it could not start the program
        return Played(source, code or 1, None, None)
    return Played(source, int(words[0]), float(words[1]), float(words[2]) / 1000.0)
