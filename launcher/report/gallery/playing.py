# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plays a case or a study by the program, and measures what it took."""
import os
import shlex
import signal
import subprocess

from records import Played


def command(program, file, is_study, form, out):
    verb = 'study' if is_study else 'run'
    return [program, verb, str(file), *form.arguments(), '--out', str(out), *([] if is_study else ['--force'])]


def shown(line):
    """As one would type it."""
    return shlex.join(['turbidite', *line[1:]])


def play(line, source):
    """Without a report, which would take part of the time. Ctrl-C reaches the program too, which then ends orderly; SIGTERM
    is passed on."""
    process = subprocess.Popen(line, stdin=subprocess.DEVNULL, env={**os.environ, 'TURBIDITE_REPORT': 'off'})
    before = signal.signal(signal.SIGTERM, lambda *_: process.send_signal(signal.SIGTERM))
    while True:
        try:
            _, status, used = os.wait4(process.pid, 0)
            break
        except KeyboardInterrupt:
            pass
    signal.signal(signal.SIGTERM, before)
    process.returncode = os.waitstatus_to_exitcode(status)
    return Played(source, process.returncode, used.ru_utime + used.ru_stime, used.ru_maxrss / 1000.0)
