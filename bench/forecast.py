#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How good the forecast of `turbidite check` is: wall time per window and files of finished runs over the predicted.

    bench/forecast.py FOLDER... [--program turbidite] [--from N]

Takes every finished run in one part below the folders, with at least N windows (100), predicts it from the case.yaml
in it, and prints what was measured, what is predicted, the ratios, and their quantiles. What else the machine was doing
is not known to it. Reports and logs are not counted as files."""
import argparse
import json
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
QUANTILES = (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('folders', nargs='+', type=Path)
    parser.add_argument('--program', default=ROOT / 'build/release/bin/turbidite')
    parser.add_argument('--from', dest='least', type=int, default=100, metavar='N', help='windows')
    return parser.parse_args()


def bytes_on_disk(run):
    parts = ('checkpoints', 'fluid', 'grains')
    files = [file for part in parts for file in (run / part).rglob('*') if file.is_file()]
    return sum(file.stat().st_size for file in [*files, run / 'history.csv'])


def finished(folder, least):
    """(folder of the run, [milliseconds per window, megabytes]) of every run that can be compared."""
    for file in sorted(folder.rglob('run.json')):
        record = json.loads(file.read_text())
        whole = record.get('status') == 'done' and len(record.get('parts', [])) == 1
        if whole and record['windows_done'] >= least:
            yield file.parent, [1e3 * record['wall_seconds'] / record['windows_done'], 1e-6 * bytes_on_disk(file.parent)]


def predicted(run, program):
    """The same two numbers, or None if today's program refuses the case."""
    answer = subprocess.run([program, 'check', run / 'case.yaml'], capture_output=True, text=True, cwd=run)
    found = re.search(r'forecast: .*?, ([-+.e\d]+) ms per window.* ([.\d]+) ([MG])B of files', answer.stdout)
    return [float(found[1]), float(found[2]) * (1000 if found[3] == 'G' else 1)] if found else None


def compare(options):
    """Ratios of times and of files."""
    ratios = []
    for folder in options.folders:
        for run, measured in finished(folder, options.least):
            forecast = predicted(run, options.program)
            if forecast is None:
                print(f'{"refused":>9} {"":>39}  {run}')
                continue
            ratios.append([one / other for one, other in zip(measured, forecast)])
            numbers = zip(measured, forecast, ratios[-1])
            print('  '.join(f'{one:9.2f} {other:9.2f} {ratio:6.2f}' for one, other, ratio in numbers), f' {run}')
    return ratios


def main():
    options = arguments()
    print(f'{"measured":>9} {"predicted":>9} {"ratio":>6}  ' * 2 + 'run   [ms per window; MB]')
    ratios = compare(options)
    if not ratios:
        raise SystemExit('no finished run found')
    for what, values in zip(('time', 'files'), map(sorted, zip(*ratios))):
        quantiles = ', '.join(f'{q:.0%}: {values[round(q * (len(values) - 1))]:.2f}' for q in QUANTILES)
        print(f'{len(values)} runs; quantiles of measured over predicted {what}: {quantiles}')


if __name__ == '__main__':
    main()
