#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How good the forecast of `turbidite check` is: the wall time per window of finished runs over the predicted one.

    bench/forecast.py FOLDER... [--program turbidite] [--from N]

Takes every finished run in one part below the folders, with at least N windows (100), predicts it from the case.yaml
in it, and prints both, the ratio, and quantiles of the ratios. What else the machine was doing is not known to it."""
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


def finished(folder, least):
    """(folder of the run, seconds per window) of every run that can be compared."""
    for file in sorted(folder.rglob('run.json')):
        record = json.loads(file.read_text())
        whole = record.get('status') == 'done' and len(record.get('parts', [])) == 1
        if whole and record['windows_done'] >= least:
            yield file.parent, record['wall_seconds'] / record['windows_done']


def predicted(run, program):
    """Seconds per window, or None if today's program refuses the case."""
    answer = subprocess.run([program, 'check', run / 'case.yaml'], capture_output=True, text=True, cwd=run)
    found = re.search(r'forecast: .*?, ([-+.e\d]+) ms per window', answer.stdout)
    return float(found[1]) * 1e-3 if found else None


def compare(options):
    ratios = []
    for folder in options.folders:
        for run, measured in finished(folder, options.least):
            forecast = predicted(run, options.program)
            if forecast is None:
                print(f'{"refused":>9} {"":>9} {"":>6}  {run}')
                continue
            ratios.append(measured / forecast)
            print(f'{1e3 * measured:9.2f} {1e3 * forecast:9.2f} {ratios[-1]:6.2f}  {run}')
    return sorted(ratios)


def main():
    options = arguments()
    print(f'{"measured":>9} {"predicted":>9} {"ratio":>6}  run   [ms per window]')
    ratios = compare(options)
    if not ratios:
        raise SystemExit('no finished run found')
    values = ', '.join(f'{q:.0%}: {ratios[round(q * (len(ratios) - 1))]:.2f}' for q in QUANTILES)
    print(f'{len(ratios)} runs; quantiles of measured over predicted: {values}')


if __name__ == '__main__':
    main()
