# SPDX-License-Identifier: LGPL-2.1-or-later
"""Starts `turbidite run` and waits for it."""
import json
import os
import subprocess
import tempfile

from . import places
from .errors import RunFailed
from .run_folder import load

FOLDER = '  folder: '  # in the summary that the program prints


def run(case, set=None, out=None, from_run=None, report=True, show=False, force=False):
    """Plays a case and returns the finished run (see load).

    case: path of a case file. set: {'time.end': 10, 'domain.size': [12, 14]}, as --set of the program. out: run folder,
    new or empty; by default one in runs/ named after the case. from_run: folder of a run, or 'DIR@TIME', whose grains it
    starts from. report: whether report.html is written. show: whether the progress is printed. force: an older run in `out`
    makes way for this one.

    RunFailed, with the program's message and exit code, unless it ends with 0.
    """
    with tempfile.TemporaryFile('w+') as errors:
        code, told, folder = played(words(case, set or {}, out, from_run, force), report, show, errors)
        errors.seek(0)
        message = errors.read().strip() or told
    if code != 0:
        raise RunFailed(message, code, folder)
    return load(folder)


def words(case, overrides, out, from_run, force=False):
    line = [places.program(), 'run', os.fspath(case)]
    for key, value in overrides.items():
        line += ['--set', f'{key}={as_yaml(value)}']
    line += ['--out', os.fspath(out)] if out is not None else []
    line += ['--force'] if force else []
    return line + (['--from', os.fspath(from_run)] if from_run is not None else [])


def as_yaml(value):
    """JSON is YAML; arrays of numpy become lists, paths strings."""
    plain = lambda other: other.tolist() if hasattr(other, 'tolist') else os.fspath(other)
    return json.dumps(value, default=plain, ensure_ascii=False)


def played(line, report, show, errors):
    """(exit code, what it printed, the run folder or None). Ctrl-C reaches the program too, which then ends orderly."""
    environment = {**os.environ, **({} if report else {'TURBIDITE_REPORT': 'off'})}
    told, folder = [], None
    with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=errors, text=True, env=environment) as process:
        for text in process.stdout:
            told.append(text)
            if text.startswith(FOLDER):
                folder = text[len(FOLDER):].strip()
            if show:
                print(text, end='', flush=True)
    return process.returncode, ''.join(told).strip(), folder
