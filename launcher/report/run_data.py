# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the case, run record and history of a run folder for the report. Grains are read by grain_files.py, the
fluid's fields by fluid_fields.py.

Everything is returned in the units of the run (see run.json: D, u_c, t_c). Missing data are None, and
`RunData.remarks` describes them.
"""
import csv
import json
import re
import shlex
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import grain_files

GRAINS = 'grains'  # in RunData.fingerprints
EXTRA = 'grains.extra_file'
BARE_FROM = 0.9  # of the width: grains that reach so far at first fill the box
SAME_FRONT = 0.01  # D
AT_SIDE = 0.02     # D
FEWEST_IN_COLUMN = 2  # free grains: one that falls by itself is none
CONTINUED = ('time.end', 'output.', 'limits.', 'fluid.ranks', 'grains.ranks')  # keys that change no window


@dataclass
class RunData:
    folder: Path
    record: dict = field(default_factory=dict)
    case: dict = field(default_factory=dict)
    history: dict = None
    remarks: list = field(default_factory=list)
    measured: dict = field(default_factory=dict)  # analysis/once.py
    fingerprints: dict = field(default_factory=dict)  # of the grains and of the files of the case, by what they hold

    def scale(self, name):
        """D, u_c or t_c; 1 if it is not in run.json (non-physical cases)."""
        return float(self.record.get(name) or 1.0)

    def given(self, key):
        """The text of a key of the case; None if it has no value, which is written as ~."""
        value = self.case.get(key)
        return None if value in ('~', '') else value

    def files(self):
        """The fingerprints of the files that the case names: walls, script, function objects, extra grains, and grains
        unless they were generated or poured, which is for the seed to say. The case has the names of copies, which are the
        same for all."""
        named = self.given('grains.file') and self.case.get('grains.generator') != 'poured'
        found = {what: fingerprint for what, fingerprint in self.fingerprints.items() if named or what != GRAINS}
        return {**found, **({EXTRA: self.record['extra_grains']} if self.record.get('extra_grains') else {})}

    def began_from(self):
        """The run whose grains it began with (--from); empty for grains poured for it."""
        return '' if self.record.get('hash_before_pouring') else self.record.get('from', '')

    def in_space(self):
        return self.case.get('dimension') == '3'

    def solid_unit(self):
        """What solid and pores are told in: areas in the plane, volumes in space."""
        return 'D^3' if self.in_space() else 'D^2'

    def size(self):
        """Width and height of the domain [D]."""
        return self._lengths()[:2]

    def depth(self):
        """Extent of the domain along z in space [D]."""
        return self._lengths()[2]

    def _lengths(self):
        return [float(v) for v in self.case['domain.size'].strip('[]').split(',')]

    def front_arrives(self):
        """Time at which the front, the edge of the foremost grain, is at the right side [t_c]; None if it never is."""
        time, front = self.column('front_x')
        arrived = [t for t, x in zip(time, front) if x >= self.size()[0] - AT_SIDE]
        return arrived[0] if arrived else None

    def front_is_free(self):
        """Whether the front of the history, of all grains, is that of those whose motion is not prescribed: in the first
        and in the last output no held grain is farther to the right."""
        return all(leads(self, grains) for grains in (grain_files.first_grains(self), grain_files.last_grains(self)))

    def has_cyclic_floor(self):
        """What leaves at the bottom comes in at the top."""
        return self.case.get('domain.bottom') == 'cyclic'

    def is_wet(self):
        return self.case.get('fluid.enabled') != 'false'

    def is_avalanche(self):
        """A column collapses: velocities are in sqrt(g D), and at first some free grains, which do not reach to 0.9 of the
        width, leave a part of the floor bare. Those in a drum or a pipe do not stand on it."""
        if self.case.get('scales.kind') != 'avalanche' or in_lying_pipe(self):
            return False
        count, front = free_at_first(self)
        bare = front is None or 'domain.size' not in self.case or front < BARE_FROM * self.size()[0]
        return bare and (count is None or count >= FEWEST_IN_COLUMN)

    def is_packed(self):
        """The grains are a packing from the start: they stand on a lattice."""
        return self.case.get('grains.generator') == 'lattice' or self.is_avalanche()

    def has_springs(self):
        """Contacts are springs in sub-steps of a window, not a problem that is solved to a residual: also those of a code of
        one's own."""
        return len(self.column('contact_iterations')[1]) > 0 and len(self.column('contact_residual')[1]) == 0

    def has_friction(self):
        """Of one material or pair at least: without any, all contacts are at the limit, which says nothing."""
        found = [float(value) for key, value in self.case.items()
                 if key.startswith('contact.') and key.split('.')[-1] == 'friction']
        return not found or max(found) > 0.0

    def command(self):
        """The command that made the run; empty for versions that did not record it."""
        if not self.record.get('case_file'):
            return ''
        words = ['turbidite', 'run', self.record['case_file']]
        words += [word for override in self.record.get('overrides', []) for word in ('--set', override)]
        words += ['--from', self.began_from()] if self.began_from() else []
        words += ['--out', self.record['out']] if self.record.get('out') else []
        return shlex.join(words)

    def changes(self):
        """What was given when the run was resumed, as sentences: its case has the last values of these keys alone."""
        given = [(part.get('from_window', 0), [one for one in part.get('overrides', []) if not one.startswith(CONTINUED)])
                 for part in self.record.get('parts', [])[1:]]
        return [f'from window {window} on with {", ".join(keys)}' for window, keys in given if keys]

    def is_cut_off(self):
        """run.json says that more windows are done than the history has rows of: the file has lost its end."""
        done, rows = self.record.get('windows_done'), self.column('step')[1]
        return self.record.get('status') == 'done' and done is not None and (not len(rows) or rows[-1] < done)

    def warnings(self, about=None):
        """Those of run.json, or those about one thing: 'solves', 'courant'."""
        return [warning for warning in self.record.get('warnings', []) if about in (None, warning['about'])]

    def column(self, name):
        """The rows of the history that contain a quantity: times [t_c] and values."""
        if self.history is None or name not in self.history:
            return np.empty(0), np.empty(0)
        given = np.isfinite(self.history[name])
        return self.history['time'][given], self.history[name][given]

    def end(self, name):
        """A quantity in the last row of the history; None where it is empty, as the means of a box without grains are."""
        value = np.nan if self.history is None or name not in self.history else self.history[name][-1]
        return float(value) if np.isfinite(value) else None


def free_at_first(run):
    """(number, front [D]) of the grains whose motion is not prescribed, in the first output; by the history, which has all
    grains, where there is no file of them. None where neither tells it."""
    grains = grain_files.first_grains(run)
    if grains is None:
        counts, front = run.column('grains')[1], run.column('front_x')[1]
        return int(counts[0]) if len(counts) else None, float(front[0]) if len(front) else None
    extent = first_extent(run)
    return len(grains.free().radii), None if extent is None else float(extent[1][0])


def leads(run, grains):
    """Whether the foremost of these grains is free, or there is none."""
    extent = extent_of(run, grains)
    if extent is None or grains.prescribed is None:
        return True
    reaches = grains.centres[:, 0] + grains.radii
    return reaches.max() / run.scale('D') <= extent[1][0] + SAME_FRONT


def first_extent(run):
    """That of the first output."""
    return extent_of(run, grain_files.first_grains(run))


def extent_of(run, grains):
    """(low, high), in D, of the box around those of these grains whose motion is not prescribed; None without any."""
    free = None if grains is None else grains.free()
    if free is None or not len(free.radii):
        return None
    places, radii = free.positions() / run.scale('D'), free.radii[:, None] / run.scale('D')
    return (places - radii).min(axis=0), (places + radii).max(axis=0)


def in_lying_pipe(run):
    """Whether a round wall whose axis is not vertical was around the grains at first."""
    walls = [wall for wall in grain_files.walls_of(run) if wall.get('kind') in ('cylinder', 'cone')]
    grains = grain_files.first_grains(run) if walls else None
    free = None if grains is None else grains.free()
    return free is not None and len(free.radii) > 0 and any(
        is_lying_around(wall, free.positions() / run.scale('D')) for wall in walls)


def is_lying_around(wall, places):
    """Around all of them [D]."""
    place, axis = (np.array([float(wall.get(name) or 0.0) for name in names])
                   for names in (('x', 'y', 'z'), ('ax', 'ay', 'az')))
    if abs(axis[1]) > 0.7 * np.linalg.norm(axis):
        return False
    along = axis / np.linalg.norm(axis)
    arms = places - place
    reach = arms @ along
    radius = max(float(wall.get(name) or 0.0) for name in ('r1', 'r2'))
    off_axis = np.linalg.norm(arms - reach[:, None] * along, axis=1)
    return bool(((reach >= 0.0) & (reach <= np.linalg.norm(axis)) & (off_axis < radius)).all())


def load_run(folder):
    run = RunData(Path(folder))
    run.record = _optional(run, 'run.json', _read_json) or {}
    run.case = _optional(run, 'case.yaml', read_resolved_case) or {}
    run.fingerprints = read_fingerprints(run.folder / 'case.yaml') if run.case else {}
    run.history = _optional(run, 'history.csv', read_history)
    run.remarks += [f'The run was resumed {change}.' for change in run.changes()]
    if run.history is not None and run.is_cut_off():
        last = run.column('step')[1]
        run.remarks.append(f'history.csv is not whole: it ends with window {last[-1] if len(last) else 0:.0f}, and run.json '
                           f'says that {run.record["windows_done"]} are done.')
    if run.history is not None and len(run.history['time']) == 0:
        run.history = None
        run.remarks.append('history.csv has no row yet: no curves.')
    return run


def _optional(run, name, read):
    path = run.folder / name
    if not path.exists():
        run.remarks.append(f'{name} is missing.')
        return None
    try:
        return read(path)
    except (ValueError, KeyError, OSError, ElementTree.ParseError) as error:
        run.remarks.append(f'{name} cannot be read: {error}')
        return None


def _read_json(path):
    return json.loads(path.read_text())


def read_resolved_case(path):
    """The flat keys of a resolved case, which consists of two levels of plain `key: value` lines."""
    case, group = {}, ''
    for line in path.read_text().splitlines():
        if not line.strip() or line.lstrip().startswith('#'):
            continue
        key, _, text = line.strip().partition(':')
        if not line.startswith(' ') and not text:
            group = key + '.'
        else:
            case[(group if line.startswith(' ') else '') + key] = plain_value(text.strip())
    return case


def plain_value(text):
    """Without the comment after it; of a text in quotes what they enclose, without the backslash before each " and
    backslash of it."""
    quoted = re.match(r'"((?:[^"\\]|\\.)*)"', text)
    return re.sub(r'\\(["\\])', r'\1', quoted.group(1)) if quoted else text.split('  #')[0].rstrip()


def read_fingerprints(path):
    """{what: fingerprint} from the head of a resolved case, of the grains without their number."""
    found = re.findall(r'^# (?:\d+ )?(.*), fingerprint ([0-9a-f]+)$', path.read_text(), re.MULTILINE)
    return dict(found)


def read_units(path):
    """Units of the keys that have one, from the comments of a resolved case."""
    units, group = {}, ''
    for line in path.read_text().splitlines():
        text, _, unit = line.partition('  # ')
        key, _, value = text.strip().partition(':')
        if text and not text.startswith((' ', '#')) and not value.strip():
            group = key + '.'
        elif unit:
            units[(group if line.startswith(' ') else '') + key] = unit.strip()
    return units


def read_history(path):
    """Columns by name; empty cells become nan. A last row without its end of line is left out: a kill or a full disk cut it
    off, and its last number may be half of one."""
    with open(path, newline='') as file:
        table = csv.DictReader(line for line in file if line.endswith('\n'))
        names, rows = table.fieldnames or [], list(table)
    if 'time' not in names:
        raise ValueError('it has no column "time"')
    number = lambda text: float(text) if text not in (None, '') else np.nan
    return {name: np.array([number(row[name]) for row in rows]) for name in names}
