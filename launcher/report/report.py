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
from head import facts, key_numbers, verdict
from document.page import Page, write_whole
from space import chains, sequence, slices
from document.working import Progress


def add_head(page, run):
    """Verdict, numbers, warnings, and where the rest is."""
    found = verdict.checks(run)
    doubtful = any(check.css == verdict.DOUBT for check in found)
    page.paragraph(verdict.outcome(run, found),
                   'verdict ' + ('bad' if run.record.get('status') != 'done' else 'doubt' if doubtful else 'holds'))
    page.checks([(check.text, check.css) for check in found])
    for warning in run.warnings():
        page.paragraph(f'Warning: {warning["text"]}', 'bad')
    numbers = key_numbers.rows(run)
    if numbers:
        page.table(numbers, css='key')
    page.paragraph(facts.units_in_words(run), 'note')
    page.contents()


def add_case(page, run):
    page.heading('Case')
    page.table(facts.facts(run))


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
    size = pictures.view(run, [picture.grains for picture in loaded])
    page.panels(pictures.panels(run, loaded), f'{captions.sequence(run, loaded)}{captions.shown_part(run, size)}',
                pictures.panel_width(size))


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
            ('Packing', 'packing', curves.NETWORK, captions.packing)):
        shown = curves.panels(run, plots, name)
        if shown:
            page.heading(heading)
            page.panels(shown, caption(run))


def add_diagnostics(page, run):
    """Of the solvers and of the time they take: for those who ask how, not what."""
    with page.folded_part('Solver diagnostics'):
        shown = curves.panels(run, curves.SOLVERS, 'solvers')
        if shown:
            page.subheading('Residuals and iterations')
            page.panels(shown, captions.solvers(run))
        wall = findings.wall_time(run)
        if wall is not None:
            page.subheading('Wall time')
            page.panels([(wall_shares.figure(wall), 'wall_time')], captions.wall_time(wall))


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
                    pictures.panel_width(force_network.view(run, shown)))
    told = (chains if run.in_space() else force_network).statistics(shown)
    if told:
        page.panels(told, captions.contact_statistics(run))


def add_remarks(page, run):
    remarks = run.remarks + list(run.record.get('notes', []))
    if remarks:
        page.heading('Remarks')
        page.bullets(remarks, 'remark')
    path = run.folder / 'case.yaml'
    page.folded('Resolved case', path.read_text() if path.exists() else 'case.yaml is missing')


def make_page(run):
    page = Page(str(run.record.get('case') or run.folder.name))
    working = Progress('report')
    for what, add in (('verdict', add_head), ('case', add_case), ('pictures', add_sequence), ('slices', slices.add),
                      ('force network', add_contacts), ('curves', add_curves), ('analysis', panels.add_all),
                      ('solvers', add_diagnostics), ('remarks', add_remarks)):
        working(what)
        add(page, run)
    working.end()
    return page


def main(arguments):
    if len(arguments) != 2 or not Path(arguments[1]).is_dir():
        print('usage: report.py RUN   (a run folder of `turbidite run`)', file=sys.stderr)
        return 2
    run = run_data.load_run(arguments[1])
    page = make_page(run)
    whole = write_whole(run.folder / 'report.html', page.text())
    return 0 if whole and page.write_pictures(run.folder / 'pictures') else 4


if __name__ == '__main__':
    sys.exit(main(sys.argv))
