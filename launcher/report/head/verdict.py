# SPDX-License-Identifier: LGPL-2.1-or-later
"""The verdict on a run: what happened, and whether it held. Each check is a sentence with its number, and the limit where
it is beyond one; a number that the run does not tell is left out."""
from dataclasses import dataclass

import captions
import findings

SMALL_OVERLAP = 0.01  # D; contacts that hold stay far below (docs/validation.md)
SCOPE = {'done': '', 'interrupted': '', 'prepared': ' so far'}  # of the checks, by the status of run.json; of no other
HOLDS, DOUBT, TOLD = 'holds', 'doubt', 'told'  # classes of the page's style


@dataclass
class Check:
    subject: str
    text: str
    css: str


def checks(run):
    """In the order of the page; without those that the run has no number for."""
    found = [whole(run), momentum(run), overlap(run), solves(run), courant(run), grains_there(run), rest(run)]
    return [check for check in found if check is not None]


def outcome(run, found):
    """The first sentences of a report: status, how far it came, and what the checks say together."""
    record = run.record
    status, code, error = record.get('status', 'unknown'), record.get('exit_code'), record.get('error')
    text = f'Status: {status}' + (f', exit code {code}' if code is not None else '') + (f': {error}' if error else '')
    return ' '.join([text.rstrip('.') + '.', *progress(run), *together(run, found)])


def progress(run):
    done, planned = findings.windows_done(run), run.record.get('windows')
    if done is None or planned is None:
        return []
    step = float(run.case.get('time.step') or 0.0)
    until = f', t = {done * step:.4g} t_c' if step else ''
    return [f'All {planned} windows{until}.' if done == planned else f'{done} of {planned} windows{until}.']


def together(run, found):
    """What the checks say of the run as a whole: no praise for one that a check or a fault has ended, whatever the others say."""
    doubts = [check.subject for check in found if check.css == DOUBT]
    if doubts:
        return ['Look at: ' + ', '.join(doubts) + '.']
    scope = SCOPE.get(run.record.get('status'))
    if scope is None or not any(check.css == HOLDS for check in found):
        return []
    return [f'Every check holds{scope if findings.covers_all(run) else " as far as the rows tell"}.']


def whole(run):
    if run.history is None or not run.is_cut_off():
        return None
    return Check('the history', f'history.csv has lost its end: its last row is at t = {run.history["time"][-1]:.4g} t_c, and '
                 f'all {run.record["windows_done"]} windows are done.', DOUBT)


def momentum(run):
    defects = [(name, column, findings.largest(run, column, column))
               for name, column in (('grains', 'grain_balance'), ('fluid', 'fluid_balance'))
               if name == 'grains' or run.is_wet()]
    defects = [(name, f'limits.{column}_soft', defect) for name, column, defect in defects if defect is not None]
    if not defects:
        return None
    beyond = [f'{key} = {run.case[key]}' for _, key, defect in defects if key in run.case and defect > float(run.case[key])]
    told = ', '.join(f'{name} {defect:.2g}' for name, _, defect in defects)
    largest = f'largest relative defect of {findings.extent(run)} {told}'
    if beyond:
        return Check('momentum', f'Momentum is not balanced: {largest}, beyond {", ".join(beyond)}.', DOUBT)
    return Check('momentum', f'Momentum is balanced: {largest}.', HOLDS)


def overlap(run):
    deepest = findings.largest(run, 'max_penetration', 'penetration')
    if deepest is None:
        return None
    told = f'{deepest:.3g} D' + ('' if findings.covers_all(run) else f' in {findings.extent(run)}')
    allowed = f'; beyond {run.case["limits.penetration"]} D a run ends' if 'limits.penetration' in run.case else ''
    if deepest > SMALL_OVERLAP:
        return Check('overlaps', f'Overlaps are large: up to {told}{allowed}.', DOUBT)
    return Check('overlaps', f'Overlaps are small: at most {told}{allowed}.', HOLDS)


def solves(run):
    """Of all solvers of the run; one that stopped early leaves its error in the result. The rows tell of the contact solver
    alone, in all windows up to the last row."""
    counts = findings.unconverged(run)
    if not counts:
        return None
    missed = [f'in {count} of them {what}' for what, count in counts if count]
    if missed:
        return Check('solvers', f'Not every window is solved to its tolerance ({told_windows(run)}): '
                     + ', '.join(missed) + '.', DOUBT)
    if findings.covers_all(run):
        return Check('solvers', 'Every window is solved to its tolerance.', HOLDS)
    if run.has_springs():
        return None
    return Check('solvers', f'The contacts of every window up to the last row are solved to their tolerance ({told_windows(run)}).',
                 HOLDS)


def told_windows(run):
    done = findings.windows_done(run)
    return f'{"?" if done is None else done} windows' + ('' if findings.covers_all(run) else ' by the rows')


def courant(run):
    """Only where the run itself warned of it: the limit is the coupler's."""
    largest = (run.record.get('maxima') or {}).get('courant')
    if largest is None or not run.is_wet():
        return None
    warned = bool(run.warnings('courant'))
    where = '' if findings.covers_all(run) else ' in the earlier parts of the run'
    return Check('Courant number', f'The Courant number is {"too large: up to" if warned else "at most"} {largest:.3g}{where}.',
                 DOUBT if warned else HOLDS)


def grains_there(run):
    _, grains = run.column('grains')
    lost = captions.grains_lost(run)
    if not len(grains) or not lost:
        return None
    return Check('grains', f'{lost} of {grains[0]:.0f} grains left the box; means are over the remaining ones.', TOLD)


def rest(run):
    """No check: many runs are not meant to come to rest."""
    text = captions.rest(run)
    return Check('rest', text, TOLD) if text else None
