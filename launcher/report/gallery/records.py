# SPDX-License-Identifier: LGPL-2.1-or-later
"""When and with which commit the expected numbers of a form last held, one line of configs/expected.yaml; and what a run
of the gallery took, in its folder, so that it can be compared again."""
import datetime
import json
import re
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

from entries import Wrong

OLD = 100  # commits
PLAYED = 'gallery.json'


@dataclass
class Source:
    """What is played."""
    commit: str    # None: neither a checkout nor built from one
    changed: list  # files that differ from the commit
    date: str
    checkout: str = None  # where the cases are, if that is another commit than the program's


@dataclass
class Played:
    source: Source
    code: int          # exit code; None: it has begun
    processor: float   # s, of all programs of the job together; None where earlier or other calls played a part
    memory: float      # MB, of the largest of them; None as above
    begun: int = None  # ns, of a study: another call that begins writes another one


def source(configs, expected, program):
    here, (_, built) = commit(configs), versions_of(program)
    elsewhere = here if here and built and not same_commit(here, built) else None
    return Source(built or here, changed(configs, Path(expected).name), datetime.date.today().isoformat(), elsewhere)


def same_commit(one, other):
    """Of two abbreviations."""
    return one.startswith(other) or other.startswith(one)


def save_played(folder, played):
    if folder.is_dir():  # else it was refused before it began
        (folder / PLAYED).write_text(json.dumps(asdict(played)) + '\n')


class KeptRun:
    """What an earlier run of a case took, forgotten before another one, which may be killed; to be restored where that one
    was refused, and the earlier is still there."""

    def __init__(self, folder):
        self.file, self.run = folder / PLAYED, folder / 'run.json'
        self.text, self.stamp = self.file.read_text() if self.file.is_file() else None, self._stamp()
        self.file.unlink(missing_ok=True)

    def is_still_there(self):
        return self.stamp is not None and self.stamp == self._stamp()

    def restore(self):
        if self.text is not None:
            self.file.write_text(self.text)

    def _stamp(self):
        """None without a run."""
        if not self.run.is_file():
            return None
        found = self.run.stat()
        return found.st_ino, found.st_mtime_ns


def load_played(folder):
    """None where the gallery has played nothing."""
    file = folder / PLAYED
    if not file.is_file():
        return None
    read = json.loads(file.read_text())
    return Played(Source(**read.pop('source')), **read)


def git(folder, *words):
    """What git says, or None: not a checkout, or no git."""
    try:
        done = subprocess.run(['git', '-C', str(folder), *words], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def commit(folder):
    return git(folder, 'rev-parse', '--short=10', 'HEAD')


def versions_of(program):
    """Version and commit of what was built, by its own words; empty where it does not say."""
    try:
        told = subprocess.run([str(program), '--version'], capture_output=True, text=True).stdout
    except FileNotFoundError:
        return '', ''
    found = re.match(r'turbidite (\S+)(?: \(commit (\w+)\))?', told)
    return (found[1], found[2] or '') if found else ('', '')


def changed(folder, expected):
    """Files that differ from the commit, the expected numbers apart."""
    told = git(folder, 'status', '--porcelain', '--untracked-files=no', '--', ':/', f':!{expected}')
    return [line.split()[-1] for line in told.splitlines()] if told else []


def age(folder, recorded):
    """Commits since then; None where that cannot be told."""
    told = git(folder, 'rev-list', '--count', f'{recorded["commit"]}..HEAD')
    return int(told) if told else None


def told(folder, recorded):
    """'at 903593a, 2026-11-25', and how old that is when it is old."""
    if recorded is None:
        return 'not recorded'
    commits = age(folder, recorded)
    old = f', {commits} commits ago' if commits is not None and commits > OLD else ''
    if commits is None and commit(folder):
        old = ', a commit that is not here'
    return f'{recorded["commit"][:7]} {recorded["date"]}{old}'


def line(played):
    spent = '' if played.processor is None else f', processor: {played.processor:.0f}, memory: {played.memory:.0f}'
    return f'    recorded: {{commit: "{played.source.commit}", date: {played.source.date}{spent}}}'


def with_record(text, name, form, played):
    """The document with the `recorded` line of a form replaced, or added as its last. Entries begin in the first column,
    forms two further to the right, their keys four; Wrong where they do not."""
    lines = text.splitlines()
    begin, end = lines_of(lines, 0, len(lines), f'{name}:', f'{name} in the first column')
    begin, end = lines_of(lines, begin, end, f'  {form}:', f'`  {form}:`, two columns in, below {name}')
    kept = [text for text in lines[begin:end] if not text.startswith('    recorded:')]
    return '\n'.join([*lines[:begin], *kept, line(played), *lines[end:]]) + '\n'


def lines_of(lines, begin, end, key, told):
    """What stands below a key, further to the right; comments may follow the key."""
    found = next((k for k in range(begin, end) if lines[k].split('#')[0].rstrip() == key), None)
    if found is None:
        raise Wrong(f'--record writes a line below {told}, and there is no such line in the file of expected numbers: '
                    'write it so, with its keys in lines of their own.')
    margin = ' ' * (len(key) - len(key.lstrip()) + 1)
    says_nothing = [not text.split('#')[0].strip() for text in lines]
    last = next((k for k in range(found + 1, end) if not lines[k].startswith(margin) and not says_nothing[k]), end)
    while says_nothing[last - 1]:
        last -= 1
    return found + 1, last


def require_writable(file):
    """Found before something is played."""
    try:
        with open(file, 'r+b'):
            pass
    except OSError as error:
        raise Wrong(f'--record writes into {file}: {error.strerror}. Give one of yours: --expected FILE.') from None
