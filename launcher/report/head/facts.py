# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was played: the case and the programs, with units."""
from collections import Counter

import numpy as np

import grain_files
import solid
from analysis.once import or_remark
from document.typeset import Code

SIDES = {False: ('left', 'right', 'bottom', 'top'), True: ('left', 'right', 'bottom', 'top', 'front', 'back')}


def coupling(case):
    """The scheme, and coupling.positions unless it is the default."""
    scheme, positions = case.get('coupling.scheme'), case.get('coupling.positions')
    return scheme if positions == 'corrected' else f'{scheme}, positions {positions}'


def version_of(record):
    """['0.1.0'], with the commit where it was recorded; as parts of a text."""
    versions = record.get('versions') or {}
    commit = [' (commit ', Code(versions['commit']), ')'] if versions.get('commit') else []
    return [versions.get('turbidite', 'of unknown version'), *commit]


def by_box(record):
    return ', by the box program' if record.get('fluid_program') == 'box' else ''


def facts(run):
    """(name, value) pairs of the case, with units; a value may be a list of parts."""
    record, case = run.record, run.case
    rows = [
        ('made by', ['turbidite ', *version_of(record), date_of(record)]),
        *([('command', Code(run.command()))] if run.command() else []),
        ('domain', f'{case.get("domain.size", "unknown")} D; ' + ', '.join(
            f'{side} {case[f"domain.{side}"]}' for side in SIDES[run.in_space()] if f'domain.{side}' in case)),
        ('grains', f'{kinds_of(run)}, {density_of(run)}, {friction_of(case)}, by {case.get("grains.adapter")}'),
        ('fluid', f'Re = {record.get("reynolds", 0):.4g}, {case.get("fluid.cells_per_diameter")} '
                  f'cells per D{by_box(record)}' if run.is_wet() else 'none'),
        ('scales', f'{case.get("scales.kind")}: D = {run.scale("D"):.4g}, u_c = '
                   f'{run.scale("u_c"):.4g}, t_c = {run.scale("t_c"):.4g}, g = '
                   f'{record.get("g", float("nan")):.4g} ({units(case)})'),
        ('time', f'{record.get("windows", "?")} windows of {case.get("time.step")} t_c'),
        ('coupling', coupling(case)),
        ('seed', str(record.get('seed', '?'))),
    ]
    programs = [f'{r.get("role")} {r.get("rank")}: {r.get("adapter")} ({r.get("host_code")}) on '
                f'{r.get("host")}' for r in record.get('ranks', [])]
    return rows + [('programs', '; '.join(programs))] if programs else rows


def kinds_of(run):
    """'200 triangles, 100 discs': those of the first output, since files of grains may have other shapes than the case;
    without one, of the case."""
    first = grain_files.quiet_series(run)[:1]
    counted = or_remark(run, 'The first output', lambda: count_kinds(run, first[0][1])) if first else None
    if not counted:
        return f'{run.record.get("grains", "?")} {run.case.get("grains.shape")}s'
    return ', '.join(f'{number} {kind}{"" if number == 1 else "s"}' for kind, number in counted.most_common())


def count_kinds(run, path):
    """How many grains of each kind are in a file; none where neither file nor run.json has them."""
    shapes = run.record.get('shapes') or []
    numbers = grain_files.read_arrays(path).get('shape', ()) if shapes else ()
    return Counter(shapes[int(number)]['kind'] for number in numbers)


def density_of(run):
    """Over the fluid's: of the grains in the first output, which may have their own; without one, of the case."""
    grains = grain_files.first_grains(run)
    if grains is None or grains.densities is None or not len(grains.densities):
        return f'density ratio {run.case.get("grains.density_ratio")}'
    found = solid.densities(run, grains)
    if np.ptp(found) < 1e-6 * found.max():
        return f'density ratio {found[0]:.4g}'
    return f'density ratios {found.min():.4g} to {found.max():.4g}'


def friction_of(case):
    """Of contacts of no named material, and which materials there are."""
    names = list(dict.fromkeys(key.split('.')[2] for key in case if key.startswith('contact.materials.')))
    return f'friction {case.get("contact.friction")}' + (f' (others: {", ".join(names)})' if names else '')


def date_of(record):
    """', 2026-01-31 12:00 +0000', or empty."""
    prepared = record.get('prepared', '')
    return f', {prepared[:10]} {prepared[11:16]} {prepared[19:]}' if len(prepared) >= 16 else ''


def units(case):
    return 'SI' if case.get('scales.kind') == 'physical' else 'in units D = u_c = rho_f = 1'


def differing_scales(runs):
    """What is told of runs whose scales are of another kind, or have other values: each is in its own. Empty if all have the
    same. Where they are no SI units, D and u_c are 1, and g tells of which size u_c is."""
    scales = [(run.case.get('scales.kind'), *(run.record.get(name) for name in ('D', 'u_c', 't_c', 'g'))) for run in runs]
    if len(set(scales)) < 2:
        return ''
    each = '; '.join(f'{run.folder.name}: {told_scales(*known)}' for run, known in zip(runs, scales) if None not in known)
    return ('The scales of these runs differ, and each is shown in its own: differences are not those of one unit.'
            + (f' {each}.' if each else ''))


def told_scales(kind, diameter, velocity, time, gravity):
    if kind == 'physical':
        return f'D = {diameter:g} m, u_c = {velocity:g} m/s, t_c = {time:g} s, g = {gravity:g} m/s²'
    return f'{kind}, u_c = {velocity / np.sqrt(gravity * diameter):.4g} √(g D)'


def units_in_words(run):
    """What the units of all numbers and curves are."""
    settling = 'that of settling (Topin 2011, Eq. 21)'
    velocity = {'avalanche': '√(g D)', 'sedimentation': settling,
                'physical': 'scales.velocity' if run.given('scales.velocity') else settling}.get(run.case.get('scales.kind'))
    return ('Units: D is the diameter of the grains, u_c the characteristic velocity' + (f', {velocity}' if velocity else '')
            + ', and t_c = D/u_c the time to move by D with it; ρ_s and ρ_f are the densities of grains and fluid, m is the '
            'mass of a grain, g gravity.')
