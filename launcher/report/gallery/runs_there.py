# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs that are in a folder before and after the gallery plays there: which program played them, whether they are done,
and whether somebody plays them now."""
import fcntl
import json
import re
from dataclasses import dataclass
from pathlib import Path

from entries import Wrong

OLD = re.compile(r'-old-\d+$')  # set aside, by the gallery or by `turbidite study`


@dataclass
class RunThere:
    folder: Path
    record: dict  # run.json; empty where there is none

    def versions(self):
        """Of the program that began it, as `records.versions_of` has them."""
        told = self.record.get('versions') or {}
        return told.get('turbidite', ''), told.get('commit', '')

    def commits(self):
        """Of all programs that played a part of it; earlier versions of 0.1 did not note which one resumed a run."""
        resumed = [part['versions'] for part in self.record.get('parts', []) if 'versions' in part]
        return [self.versions()[1], *(told.get('commit', '') for told in resumed)]

    def was_resumed(self):
        return len(self.record.get('parts', [])) > 1

    def begun_with(self):
        """As `key=value`."""
        return self.record.get('overrides') or []

    def resumed_with(self):
        return [text for part in self.record.get('parts', []) for text in part.get('overrides') or []]

    def is_held(self):
        """Whether a process plays it: its file `lock` is locked as long as that lives."""
        try:
            with open(self.folder / 'lock', 'rb') as lock:
                fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except FileNotFoundError:
            return False
        except BlockingIOError:
            return True
        except OSError:  # a file system without locks
            return False
        return False


def run_there(folder):
    try:
        return RunThere(folder, json.loads((folder / 'run.json').read_text()))
    except (OSError, ValueError):
        return RunThere(folder, {})


def study_command(folder):
    """The words that played the study last; none where nothing says it."""
    try:
        return json.loads((folder / 'study.json').read_text()).get('command', [])
    except (OSError, ValueError):
        return []


def runs_of_study(folder):
    """In PART/RUN, those apart that were set aside."""
    return [run_there(file.parent) for file in sorted(folder.glob('*/*/run.json')) if not OLD.search(file.parent.name)]


def set_aside(runs, why):
    """Under the names that `turbidite study` gives, so that it plays them anew. Nothing is lost: they may have taken days."""
    held = [run.folder for run in runs if run.is_held()]
    if held:
        raise Wrong(f'{held[0]} is being played, and the gallery would have to play it anew: {why}. Wait for it, or '
                    'choose another --out.')
    names = [run.folder.rename(first_free(run.folder)).name for run in runs]
    if runs:
        print(f'{len(runs)} {"run" if len(runs) == 1 else "runs"} of before, now {names[0]}'
              f'{" and so on" if names[1:] else ""}, to be played anew: {why}', flush=True)


def first_free(folder):
    number = 1
    while (free := folder.with_name(f'{folder.name}-old-{number}')).exists():
        number += 1
    return free
