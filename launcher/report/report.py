# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py RUN: writes RUN/report.html, one file with everything in it, and its figures as RUN/pictures/*.png.

Reads run.json, case.yaml, history.csv, the grain series and the fluid's velocity fields. Missing or damaged data are
noted in the page; the rest is shown.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import captions
import contact_files
import curves
import findings
import force_network
import pictures
import run_data
import wall_shares
from analysis import panels
from page import Page, write_whole
from space import chains, sequence, slices
from working import Progress


SIDES = {False: ('left', 'right', 'bottom', 'top'), True: ('left', 'right', 'bottom', 'top', 'front', 'back')}


def by_box(record):
    return ', by the box program' if record.get('fluid_program') == 'box' else ''


def coupling(case):
    """The scheme, and coupling.positions unless it is the default."""
    scheme, positions = case.get('coupling.scheme'), case.get('coupling.positions')
    return scheme if positions == 'corrected' else f'{scheme}, positions {positions}'


def facts(run):
    """(name, value) pairs of the case, with units."""
    record, case = run.record, run.case
    rows = [
        ('made by', f'turbidite {(record.get("versions") or {}).get("turbidite", "of unknown version")}'
                    f'{date_of(record)}'),
        *([('command', run.command())] if run.command() else []),
        ('domain', f'{case.get("domain.size", "unknown")} D; ' + ', '.join(
            f'{side} {case[f"domain.{side}"]}' for side in SIDES[run.in_space()] if f'domain.{side}' in case)),
        ('grains', f'{record.get("grains", "?")} {case.get("grains.shape")}s, density ratio '
                   f'{case.get("grains.density_ratio")}, friction {case.get("contact.friction")}, '
                   f'by {case.get("grains.adapter")}'),
        ('fluid', f'Re = {record.get("reynolds", 0):.4g}, {case.get("fluid.cells_per_diameter")} '
                  f'cells per D{by_box(record)}' if run.is_wet() else 'none'),
        ('scales', f'{case.get("scales.kind")}: D = {run.scale("D"):.4g}, u_c = '
                   f'{run.scale("u_c"):.4g}, t_c = {run.scale("t_c"):.4g}, g = '
                   f'{record.get("g", float("nan")):.4g} ({units(case)})'),
        ('time', f'{record.get("windows_done", 0)} of {record.get("windows", "?")} windows of '
                 f'{case.get("time.step")} t_c'),
        ('coupling', coupling(case)),
        ('seed', str(record.get('seed', '?'))),
    ]
    courant = (record.get('maxima') or {}).get('courant')
    if courant is not None:
        rows.append(('Courant number', f'at most {courant:.3g}'))
    if 'wall_seconds' in record:
        rows.append(('wall time', f'{record["wall_seconds"]:.1f} s'))
    programs = [f'{r.get("role")} {r.get("rank")}: {r.get("adapter")} ({r.get("host_code")}) on '
                f'{r.get("host")}' for r in record.get('ranks', [])]
    return rows + [('programs', '; '.join(programs))] if programs else rows


def date_of(record):
    """', 2026-01-31 12:00 +0000', or empty."""
    prepared = record.get('prepared', '')
    return f', {prepared[:10]} {prepared[11:16]} {prepared[19:]}' if len(prepared) >= 16 else ''


def units(case):
    return 'SI' if case.get('scales.kind') == 'physical' else 'in units D = u_c = rho_f = 1'


def add_status(page, run):
    status = run.record.get('status', 'unknown')
    code, error = run.record.get('exit_code'), run.record.get('error')
    text = (f'Status: {status}' + (f', exit code {code}' if code is not None else '')
            + (f': {error}' if error else ''))
    page.paragraph(text, '' if status == 'done' else 'bad')
    for warning in run.warnings():
        page.paragraph(f'Warning: {warning["text"]}', 'bad')


def add_sequence(page, run):
    page.heading('Grains and fluid' if run.is_wet() else 'Grains')
    chosen = pictures.instants(run)
    if not chosen or 'domain.size' not in run.case:
        return page.paragraph('There is nothing to draw yet.', 'remark')
    loaded = [pictures.load(run, instant) for instant in chosen]
    if run.in_space():
        return page.panels(sequence.panels(run, loaded),
                           f'{captions.sequence(run, loaded)} {sequence.caption(run, loaded)}', sequence.PANEL_WIDTH)
    page.file_only(pictures.figure(run, loaded), 'sequence')
    page.panels(pictures.panels(run, loaded), captions.sequence(run, loaded), pictures.panel_width(run, loaded))


def add_curves(page, run):
    if run.history is None:
        page.heading('Curves')
        return page.paragraph('There is no history, so there are no curves.', 'remark')
    motion = ('settling', curves.SETTLING, captions.settling)
    if run.is_avalanche():
        motion = ('collapse', curves.COLLAPSE, captions.collapse)
    for heading, name, plots, caption in (
            ('Mean motion', *motion),
            ('Speed, energy and contacts', 'motion', curves.MOTION, captions.motion),
            ('Packing', 'packing', curves.NETWORK, captions.packing),
            ('Residuals and iterations', 'solvers', curves.SOLVERS, captions.solvers)):
        shown = curves.panels(run, plots, name)
        if shown:
            page.heading(heading)
            page.panels(shown, caption(run))


def add_contacts(page, run):
    shown = contact_files.networks(run)
    if not shown:
        return
    page.heading('Force network')
    if run.in_space():
        page.panels(chains.panels(run, shown), captions.force_network(run, shown, chains.LEFT_OUT),
                    sequence.PANEL_WIDTH)
    else:
        page.file_only(force_network.figure(run, shown), 'force_network')
        page.panels(force_network.panels(run, shown), captions.force_network(run, shown),
                    pictures.panel_width(run, shown))
    told = (chains if run.in_space() else force_network).statistics(shown)
    if told:
        page.panels(told, captions.contact_statistics(run))


def add_wall_time(page, run):
    wall = findings.wall_time(run)
    if wall is not None:
        page.heading('Wall time')
        page.panels([(wall_shares.figure(wall), 'wall_time')], captions.wall_time(wall))


def add_remarks(page, run):
    remarks = run.remarks + list(run.record.get('notes', []))
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    path = run.folder / 'case.yaml'
    page.folded('Resolved case', path.read_text() if path.exists() else 'case.yaml is missing')


def make_page(run):
    page = Page(str(run.record.get('case') or run.folder.name))
    add_status(page, run)
    page.table(facts(run))
    working = Progress('report')
    for what, add in (('pictures', add_sequence), ('slices', slices.add), ('force network', add_contacts),
                      ('curves', add_curves), ('analysis', panels.add_all), ('wall time', add_wall_time),
                      ('remarks', add_remarks)):
        working(what)
        add(page, run)
    working.end()
    return page


def write_pictures(page, folder):
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        print(f'cannot write {folder}: {error.strerror}', file=sys.stderr)
        return False
    for old in folder.glob('*.png'):  # of a report that had other figures
        if old.stem not in page.pictures:
            old.unlink()
    return all(write_whole(folder / f'{name}.png', png) for name, png in page.pictures.items())


def main(arguments):
    if len(arguments) != 2 or not Path(arguments[1]).is_dir():
        print('usage: report.py RUN   (a run folder of `turbidite run`)', file=sys.stderr)
        return 2
    run = run_data.load_run(arguments[1])
    page = make_page(run)
    whole = write_whole(run.folder / 'report.html', page.text())
    return 0 if whole and write_pictures(page, run.folder / 'pictures') else 4


if __name__ == '__main__':
    sys.exit(main(sys.argv))
