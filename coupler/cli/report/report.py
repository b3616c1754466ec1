# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.py RUN: writes RUN/report.html, one file with everything in it.

Reads run.json, case.yaml, history.csv, the grain series and the fluid's velocity fields. What is missing or
broken is said in the page; the rest is shown.
"""
import base64
import html
import io
import sys
from pathlib import Path

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

import curves
import pictures
import run_data

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em;
       color: #222; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
table { border-collapse: collapse; } td { padding: .15em 1em .15em 0; vertical-align: top; }
td:first-child { color: #666; } img { max-width: 100%; }
.bad { color: #a40000; } .remark { color: #7a5c00; }
details pre { background: #f6f6f4; padding: 1em; overflow-x: auto; font-size: 12px; }
"""


def embedded(figure, alt):
    """The figure as an image inside the page."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format='png', dpi=110)
    plt.close(figure)
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<img alt="{html.escape(alt)}" src="data:image/png;base64,{data}">'


def facts(run):
    """(name, value) pairs of the case, with units."""
    record, case = run.record, run.case
    size = case.get('domain.size', 'unknown')
    wet = case.get('fluid.enabled') != 'false'
    rows = [
        ('domain', f'{size} D; left {case.get("domain.left")}, right {case.get("domain.right")}, '
                   f'bottom {case.get("domain.bottom")}, top {case.get("domain.top")}'),
        ('grains', f'{record.get("grains", "?")} {case.get("grains.shape")}s, density ratio '
                   f'{case.get("grains.density_ratio")}, friction {case.get("contact.friction")}, '
                   f'by {case.get("grains.adapter")}'),
        ('fluid', f'Re = {record.get("reynolds", 0):.4g}, {case.get("fluid.cells_per_diameter")} '
                  f'cells per D' if wet else 'none'),
        ('scales', f'{case.get("scales.kind")}: D = {run.scale("D"):.4g}, u_c = '
                   f'{run.scale("u_c"):.4g}, t_c = {run.scale("t_c"):.4g}, g = '
                   f'{record.get("g", float("nan")):.4g} ({units(case)})'),
        ('time', f'{record.get("windows_done", 0)} of {record.get("windows", "?")} windows of '
                 f'{case.get("time.step")} t_c'),
        ('coupling', f'{case.get("coupling.scheme")}, positions {case.get("coupling.positions")}'),
        ('seed', str(record.get('seed', '?'))),
    ]
    if 'wall_seconds' in record:
        rows.append(('wall time', f'{record["wall_seconds"]:.1f} s'))
    programs = [f'{r.get("role")} {r.get("rank")}: {r.get("adapter")} ({r.get("host_code")}) on '
                f'{r.get("host")}' for r in record.get('ranks', [])]
    return rows + [('programs', '; '.join(programs))] if programs else rows


def units(case):
    return 'SI' if case.get('scales.kind') == 'physical' else 'in units D = u_c = rho_f = 1'


def status_line(run):
    status = run.record.get('status', 'unknown')
    error = run.record.get('error') or ''
    css = '' if status == 'done' else ' class="bad"'
    code = run.record.get('exit_code')
    return f'<p{css}>Status: {html.escape(status)}' + (
        f', exit code {code}' if code is not None else '') + (
        f': {html.escape(error)}' if error else '') + '</p>'


def fact_table(run):
    rows = ''.join(f'<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>'
                   for name, value in facts(run))
    return f'<table>{rows}</table>'


def picture_section(run):
    chosen = pictures.instants(run)
    if not chosen or 'domain.size' not in run.case:
        return '<p class="remark">There is nothing to draw yet.</p>'
    loaded = [(instant[0],) + pictures.load(run, instant) for instant in chosen]
    limit = pictures.colour_limit(run, [velocity for _, _, velocity in loaded])
    width, height = run.size()
    columns = len(loaded) if height > width else min(3, len(loaded))
    rows = -(-len(loaded) // columns)
    cell = 11.0 / columns
    figure, axes = plt.subplots(rows, columns, squeeze=False, layout='constrained',
                                figsize=(11.5, rows * (cell * min(height / width, 3.0) + 0.5)))
    images = [pictures.draw(run, *one, limit, place) for one, place in zip(loaded, axes.flat)]
    for unused in list(axes.flat)[len(loaded):]:
        unused.set_axis_off()
    shown = [image for image in images if image is not None]
    if shown:
        figure.colorbar(shown[-1], ax=axes, shrink=0.7, label='vertical fluid velocity / u_c')
    return embedded(figure, 'fluid velocity and grains') + (
        '<p>Lengths in D. Red: fluid rises; blue: it sinks; grains as discs.</p>')


def curve_section(run):
    if run.history is None:
        return '<p class="remark">There is no history, so there are no curves.</p>'
    plots = [plot for plot in curves.PLOTS if curves.available(plot, run.history)]
    rows = -(-len(plots) // 2)
    if not plots:
        return '<p class="remark">The history holds no known quantity.</p>'
    height = run.size()[1] if 'domain.size' in run.case else 1.0
    figure, axes = plt.subplots(rows, 2, squeeze=False, layout='constrained',
                                figsize=(11.5, 3.2 * rows))
    for plot, place in zip(plots, axes.flat):
        curves.draw(plot, run.history, height, place)
    for unused in list(axes.flat)[len(plots):]:
        unused.set_axis_off()
    return embedded(figure, 'curves of the history')


def appendix(run):
    path = run.folder / 'case.yaml'
    text = path.read_text() if path.exists() else 'case.yaml is missing'
    return f'<details><summary>Resolved case</summary><pre>{html.escape(text)}</pre></details>'


def page(run):
    name = html.escape(str(run.record.get('case') or run.folder.name))
    sections = [('Grains and fluid', picture_section(run)), ('Curves', curve_section(run))]
    body = ''.join(f'<h2>{title}</h2>{content}' for title, content in sections)
    remarks = ''.join(f'<li>{html.escape(text)}</li>'
                      for text in run.remarks + list(run.record.get('notes', [])))
    notes = f'<h2>Remarks</h2><ul class="remark">{remarks}</ul>' if remarks else ''
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
            f'<style>{STYLE}</style></head><body><h1>{name}</h1>{status_line(run)}{fact_table(run)}'
            f'{body}{notes}{appendix(run)}</body></html>\n')


def main(arguments):
    if len(arguments) != 2 or not Path(arguments[1]).is_dir():
        print('usage: report.py RUN   (a run folder of `turbidite run`)', file=sys.stderr)
        return 2
    run = run_data.load_run(arguments[1])
    part = run.folder / 'report.html.part'
    text = page(run)
    try:
        part.write_text(text, encoding='utf-8')
        part.replace(run.folder / 'report.html')
    except OSError as error:
        part.unlink(missing_ok=True)
        print(f'cannot write {run.folder / "report.html"}: {error.strerror}', file=sys.stderr)
        return 4
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv))
