# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare.py [--each] PAGE RUN RUN...: the same quantities of several runs on one page, differences
quantified. Runs of one case with several seeds are averaged unless --each is given. Beside PAGE
(compare.html) it writes the numbers as .csv and .json.
"""
import csv
import io
import json
import shlex
import sys
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path

import matplotlib

matplotlib.use('Agg')
import numpy as np

import compare_page
import findings
from analysis import peaks
import run_data
import seeds
import surface
from differences import common_span, difference
from measured import MEASURED
from document.own_files import Refusal, is_page, require_own
from document.page import write_whole
from document.working import Progress
from head import facts


@dataclass
class Quantity:
    column: str
    title: str
    unit: str        # for the axis of a plot
    plain_unit: str  # for a table
    logarithmic: bool = False
    applies: object = lambda run: True  # to a run


ITERATIONS = Quantity('contact_iterations', 'Contact solver', 'sweeps', 'sweeps')
PORES = Quantity('pore_volume', 'Pores between the grains', r'area $/\,D^2$', 'D^2')
QUANTITIES = [
    Quantity('mean_velocity_y', 'Mean vertical velocity', r'$\langle u_y \rangle\,/\,u_c$', 'u_c'),
    Quantity('mean_velocity_norm', 'Norm of the mean velocity', r'$|\langle u \rangle|\,/\,u_c$', 'u_c'),
    Quantity('mean_position_y', 'Mean vertical position', r'$\langle y \rangle\,/\,D$', 'D'),
    Quantity('front_x', 'Front', r'$\max(x+R)\,/\,D$', 'D', applies=run_data.RunData.is_avalanche),
    Quantity('kinetic_energy', 'Kinetic energy', r'energy $/\,(\Sigma m\,u_c^2)$', 'Σm u_c²'),
    Quantity('coordination', 'Coordination', 'contacts per grain', '-'),
    Quantity('fabric_anisotropy', 'Anisotropy of the contacts', 'fabric anisotropy', '-'),
    PORES,
    Quantity('max_penetration', 'Deepest overlap', r'overlap $/\,D$', 'D'),
    ITERATIONS,
    Quantity('contact_residual', 'Contact residual', 'scaled natural map', '-', logarithmic=True),
    Quantity('multiplier_iterations', 'Multiplier solver', 'iterations', 'iterations'),
    Quantity('joint_rounds', 'Joint scheme', 'rounds', 'rounds'),
    Quantity('grain_balance', 'Momentum of the grains', 'relative defect', '-', logarithmic=True),
    Quantity('fluid_balance', 'Momentum of the fluid', 'relative defect', '-', logarithmic=True),
    Quantity('wall_step', 'Wall time of a window', 'seconds', 's'),
]


def quantities_of(members):
    """Those that some member has and that apply to one, as they are called for these members."""
    called = {ITERATIONS.column: iterations_of(members), PORES.column: pores_of(members)}
    return [called.get(q.column, q) for q in QUANTITIES
            if any(len(m.data.column(q.column)[1]) and q.applies(m.data) for m in members)]


def iterations_of(members):
    """Springs have sub-steps instead of sweeps."""
    springs = [m.data.has_springs() for m in members if len(m.data.column(ITERATIONS.column)[1])]
    words = 'sub-steps' if all(springs) else 'sweeps or sub-steps' if any(springs) else 'sweeps'
    title = 'Springs' if all(springs) else 'Contact solver or springs' if any(springs) else 'Contact solver'
    return replace(ITERATIONS, title=title, unit=words, plain_unit=words)


def pores_of(members):
    """Areas in the plane, volumes in space."""
    units = {m.data.solid_unit(): r'volume $/\,D^3$' if m.data.in_space() else PORES.unit for m in members}
    return replace(PORES, unit=' or '.join(units.values()), plain_unit=' or '.join(units))


@dataclass
class Surface:
    """Free surface at the end of a member's runs, in D: mean, smallest and largest height over columns x."""

    time: float  # t_c
    x: np.ndarray
    height: np.ndarray
    low: np.ndarray
    high: np.ndarray
    runs: int


@dataclass
class Comparison:
    """The content of the page, the CSV and the JSON. Tables by the member's name; unknown values are None."""

    members: list     # seeds.Member; the first is the reference
    remark: str       # that their scales differ, or empty
    quantities: list  # that at least one member has
    parameters: list  # (key, one value per member)
    wall: list        # (seconds of the run, of a window on average) per member
    measured: dict    # {member: {column: numbers}}
    peaks: dict       # {member: peaks.MemberPeaks}
    surfaces: dict    # {member: Surface}

    @cached_property
    def pairs(self):
        """peaks.Pair of each two members; a study, which may have many, does not ask for them."""
        return peaks.pairs(self.members)


def load(folders):
    runs = [run_data.load_run(folder) for folder in folders]
    for run in runs:
        if run.history is None:
            raise Refusal(f'{run.folder} has no history to compare: ' + ' '.join(run.remarks))
    return runs


def check_spans(members):
    first = members[0].data
    for member in members[1:]:
        if common_span(first.history['time'], member.data.history['time']) is None:
            spans = [f'{r.folder} from {r.history["time"][0]:g} to {r.history["time"][-1]:g} t_c'
                     for r in (first, member.data)]
            raise Refusal('these runs have no common time span: ' + ', '.join(spans)
                          + '\n  Extend the shorter run, or compare other runs.')


# --- measuring ----------------------------------------------------------------------------------------

def measure(members):
    shown = quantities_of(members)
    scales = facts.differing_scales([run for member in members for run in member.runs])
    return Comparison(
        members, scales, shown, parameters(members), [findings.wall_seconds(member.data) for member in members],
        {m.name: {q.column: numbers(members[0], m, q.column) for q in shown} for m in members},
        {m.name: peaks.peaks(m) for m in members},
        {m.name: member_surface(m) for m in members})


def parameters(members):
    """(key, one value per member) of the keys in which the cases differ, and of their files. With equal seeds generated
    grains are equal, too, unless grains.extra_file has others."""
    one_seed = len({member.data.case.get(seeds.SEED) for member in members}) == 1
    files = [{**(member.data.fingerprints if one_seed else {}), **member.data.files()} for member in members]
    cases = [{**member.data.case, **{f'{what}, fingerprint': text for what, text in of_member.items()},
              **({'--from': member.data.began_from()} if member.data.began_from() else {}),
              **({'resumed': '; '.join(member.data.changes())} if member.data.changes() else {})}
             for member, of_member in zip(members, files)]
    keys = dict.fromkeys(key for case in cases for key in case)
    rows = [(key, [case.get(key, '') for case in cases]) for key in keys]
    return [(key, values) for key, values in rows if len(set(values)) > 1]


def numbers(first, member, column):
    """Difference from the first member; the first one has only an end value."""
    result = dict.fromkeys(['begin', 'end', 'rms', 'max', 'rms_relative', 'max_relative'])
    result['end_value'] = member.data.end(column)
    apart = None
    if member is not first:
        apart = difference(first.data.column(column), member.data.column(column))
    if apart:
        result.update(begin=apart.begin, end=apart.end, rms=apart.rms, max=apart.largest,
                      rms_relative=apart.relative(apart.rms),
                      max_relative=apart.relative(apart.largest))
    return result


def member_surface(member):
    found = [surface.final_surface(run) for run in member.runs]
    if any(one is None for one in found) or len({len(x) for _, x, _ in found}) > 1:
        return None
    heights = np.array([height for _, _, height in found])
    return Surface(min(time for time, _, _ in found), found[0][1], heights.mean(axis=0),
                   heights.min(axis=0), heights.max(axis=0), len(found))


# --- for scripts --------------------------------------------------------------------------------------

def as_csv(measured):
    text = io.StringIO()
    fields = list(next(iter(next(iter(measured.values())).values())))
    table = csv.writer(text, lineterminator='\n')
    table.writerow(['run', 'quantity'] + fields)
    for run, quantities in measured.items():
        for column, values in quantities.items():
            table.writerow([run, column] + ['' if v is None else repr(v) for v in values.values()])
    return text.getvalue()


def overlap(run):
    return findings.largest(run, 'max_penetration', 'penetration')


def described(comparison, member, wall):
    """A member for the JSON."""
    first = comparison.wall[0]
    ratio = lambda value, of: value / of if value and of else None
    peak, top = comparison.peaks[member.name], comparison.surfaces[member.name]
    return {'name': member.name, 'folder': str(member.runs[0].folder.resolve()),
            'folders': [str(run.folder.resolve()) for run in member.runs], 'seeds': member.seeds(),
            'wall_seconds': wall[0], 'wall_ratio': ratio(wall[0], first[0]),
            'window_seconds': wall[1], 'window_ratio': ratio(wall[1], first[1]),
            'rest_time': findings.mean_rest_time(member.runs),
            'penetration': findings.of_worst(member.runs, overlap),
            'unconverged_windows': findings.of_worst(member.runs, findings.unconverged_windows),
            'peak': asdict(peak) if peak else None,
            'measured': {one.name: [one.of(run) for run in member.runs] for one in MEASURED},
            'surface': {name: getattr(top, name).tolist() for name in ('x', 'height', 'low', 'high')}
            if top else None,
            'quantities': comparison.measured[member.name]}


def as_json(comparison):
    return json.dumps({
        'first': comparison.members[0].name, 'parameters': dict(comparison.parameters),
        'remark': comparison.remark or None,
        'mean_velocity_pairs': [asdict(pair) for pair in comparison.pairs],
        'runs': [described(comparison, member, wall)
                 for member, wall in zip(comparison.members, comparison.wall)]}, indent=2) + '\n'


def check_files(page_file):
    """Tables beside a page that is not there yet are somebody else's: those of a run, say."""
    there = page_file.exists()
    require_own({page_file: is_page(page_file, compare_page.TITLE), page_file.with_suffix('.csv'): there,
                 page_file.with_suffix('.json'): there}, f'Choose another name than --out = {page_file}.')


def compare(page_file, folders, each=False):
    """True if everything was written."""
    check_files(page_file)
    members = seeds.members(load(folders), each)
    check_spans(members)
    working = Progress('compare')
    working('differences')
    comparison = measure(members)
    working('figures')
    command = ['turbidite', 'compare', *(['--each'] if each else []), *map(str, folders), '--out', str(page_file)]
    page = compare_page.make_page(comparison, page_file.parent, shlex.join(command)).text()
    working.end()
    if comparison.remark:
        print(f'turbidite compare: {comparison.remark}', file=sys.stderr)
    return all([write_whole(page_file, page),
                write_whole(page_file.with_suffix('.csv'), as_csv(comparison.measured)),
                write_whole(page_file.with_suffix('.json'), as_json(comparison))])


def main(arguments):
    each = '--each' in arguments[1:2]
    paths = arguments[2 if each else 1:]
    if len(paths) < 3:
        print('usage: compare.py [--each] PAGE RUN RUN...   (run folders of `turbidite run`)',
              file=sys.stderr)
        return 2
    try:
        return 0 if compare(Path(paths[0]), paths[1:], each) else 4
    except Refusal as refusal:
        print(f'turbidite compare: {refusal}', file=sys.stderr)
        return 2


if __name__ == '__main__':
    sys.exit(main(sys.argv))
