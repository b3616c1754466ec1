# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures and statements of the paper on made-up runs that do what it says, and on runs that do not."""
import tempfile
import unittest
from pathlib import Path

import matplotlib
import made_up_run  # noqa: F401  (finds the modules of the report)

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

import run_data
import study
from page import Page
from paper import add, darcy, figures, statements
from paper.selection import COMPACITIES, REYNOLDS, PaperRuns, spread

ROWS = np.arange(81) * 0.25  # t_c


def made(part, values, case=None, **history):
    """A run of a study. Its history has the times of ROWS unless given."""
    data = run_data.RunData(Path(f'/nowhere/{part}-{"-".join(values.values())}'))
    data.case = {'scales.kind': 'avalanche', 'domain.size': '[100, 60]', 'fluid.enabled': 'true', **(case or {}),
                 **values}
    data.record = {'D': 1.0, 'u_c': 1.0, 't_c': 1.0, 'g': 1.0, 'status': 'done'}
    data.history = {'time': ROWS, 'step': 100 * ROWS, **history}
    data.history = {name: np.asarray(column, dtype=float) for name, column in data.history.items()}
    data.measured['analysis.snapshots.snapshots'] = []
    return study.StudyRun({'part': part, 'name': '-'.join(values.values()), 'values': values, 'status': 'done'}, data)


def slide(waits, slope, top=10.0):
    """|<u>| that rises from `waits` on, for 8 t_c."""
    return slope * np.clip(ROWS - waits, 0.0, 8.0) * (ROWS < top + 10.0)


def immersed(waits, slopes):
    """Columns by Reynolds number and compacity: waits(Re, phi), slopes(Re, phi)."""
    return [made('immersed', {'fluid.reynolds': re, 'grains.compacity': phi},
                 mean_velocity_norm=slide(waits(re, float(phi)), slopes(re, float(phi))),
                 pore_volume=100.0 * (1.0 + (float(phi) - 0.8) * np.minimum(ROWS / 10.0, 1.0)),
                 mean_position_x=12.5 * (1.0 + 0.02 * ROWS)) for re in REYNOLDS for phi in COMPACITIES]


def as_the_paper_says():
    waits = lambda re, phi: 0.0 if phi < 0.8 else 60.0 * (phi - 0.8)
    slopes = lambda re, phi: 0.3 * (1.0 - phi) * (1.0 + 0.1 * np.log10(float(re)))
    return PaperRuns(immersed(waits, slopes))


def result(name, runs):
    measured = getattr(statements, name)(runs)
    return None if measured is None else measured[1]


class Statements(unittest.TestCase):
    def test_of_the_waiting_columns(self):
        runs = as_the_paper_says()
        for name in ('loose_at_once', 'dense_waits', 'waits_linearly', 'slopes_are_alike', 'peak_falls_with_compacity',
                     'peak_and_viscosity', 'only_the_loosest_contracts', 'pores_grow_with_compacity'):
            self.assertTrue(result(name, runs), name)
        self.assertTrue(result('two_regimes', runs))
        self.assertIn('from δx/x₀ = 0.20 (0.20 to 0.20) on', statements.two_regimes(runs)[0])
        slope, _, straight = figures.waiting_line(runs, '8.9')
        self.assertAlmostEqual(slope, 60.0, places=6)
        self.assertAlmostEqual(straight, 1.0)

    def test_that_do_not_hold(self):
        waits = lambda re, phi: 5.0 if phi < 0.8 else 8.0 - 60.0 * (phi - 0.8) * float(re) / 89.0
        runs = PaperRuns(immersed(waits, lambda re, phi: 0.3 * phi / (1.0 + 0.1 * float(re))))
        for name in ('loose_at_once', 'slopes_are_alike', 'peak_falls_with_compacity', 'peak_and_viscosity'):
            self.assertFalse(result(name, runs), name)

    def test_of_pores_that_grow_steadily(self):
        rows = [made('immersed', {'fluid.reynolds': '89', 'grains.compacity': phi}, pore_volume=100.0 + ROWS,
                     mean_position_x=12.5 * (1.0 + 0.02 * ROWS)) for phi in COMPACITIES]
        self.assertFalse(result('two_regimes', PaperRuns(rows)))

    def test_of_columns_that_do_not_slide(self):
        """At the smallest Re only the loosest moves by the end: Re changes more than the slope slightly."""
        waits = lambda re, phi: 0.0 if phi < 0.8 else 40.0 * (phi - 0.8)
        slopes = lambda re, phi: 0.3 if re != '0.89' or phi < 0.8 else 0.001
        runs = PaperRuns(immersed(waits, slopes))
        self.assertIn('φ = 0.85: 2 (2 to 2), 1 of 3 not by the end', statements.dense_waits(runs)[0])
        self.assertTrue(result('dense_waits', runs))
        self.assertTrue(result('waits_linearly', runs))
        self.assertIn('Re = 0.89: fewer than two have slid', statements.slopes_are_alike(runs)[0])
        self.assertIn('Re = 0.89: fewer than three have slid', statements.waits_linearly(runs)[0])
        self.assertIs(False, result('slopes_are_alike', runs))

    def test_darcy(self):
        """A layer of one grain at 0.9069: 0.1547 D of liquid at Re k (rho_r - 1) phi = 89 1.03e-3 0.5 0.9069 per t_c."""
        self.assertAlmostEqual(darcy.time_to_dilate(0.9069, 89.0, 1.5), 3.72, places=2)
        self.assertAlmostEqual(darcy.time_to_dilate(0.9069, 8.9, 1.5), 37.2, places=1)
        self.assertAlmostEqual(darcy.time_to_dilate(np.pi / 4, 89.0, 1.5), 0.0)

    def test_of_sedimentation(self):
        rest = lambda t: np.where(ROWS < t, 1.0, 0.0)
        box = {'scales.kind': 'sedimentation'}
        played = (('discs-nscd', 1.0, 10), ('discs-md', 0.95, 10), ('triangles-nscd', 0.8, 11))
        runs = lambda *variants: PaperRuns([
            made('sedimentation', {'variant': variant, 'random.seed': seed}, box, mean_velocity_y=-speed * rest(time),
                 mean_speed=rest(time)) for variant, speed, time in variants for seed in '12'])
        found = runs(*played)
        self.assertTrue(result('triangles_are_slower', found))
        self.assertIn('+10 %', statements.triangles_are_slower(found)[0])
        self.assertTrue(result('md_is_like_nscd', found))
        self.assertNotIn('triangles', statements.md_is_like_nscd(found)[0])
        alike, apart = (runs(*played, ('triangles-md', speed, 11)) for speed in (0.78, 0.3))
        self.assertTrue(result('md_is_like_nscd', alike))
        self.assertIn('triangles: ', statements.md_is_like_nscd(alike)[0])
        self.assertFalse(result('md_is_like_nscd', apart))
        self.assertIsNotNone(figures.settling(alike))
        plt.close('all')

    def test_of_the_dry_columns(self):
        peaked = lambda at, height: height * np.maximum(0.0, 1.0 - np.abs(ROWS - at) / 8.0)
        def runs(at):
            return PaperRuns([made('dry', {'grains.compacity': phi, 'random.seed': seed}, {'fluid.enabled': 'false'},
                                   mean_velocity_norm=peaked(at(float(phi)), 1.0)) for phi in COMPACITIES for seed in '12'])
        self.assertTrue(result('dry_peak', runs(lambda phi: 9.0)))
        self.assertFalse(result('dry_peak', runs(lambda phi: 4.0 + 40.0 * (phi - 0.785))))
        self.assertTrue(result('dry_does_not_depend_on_compacity', runs(lambda phi: 9.0)))

    def test_of_the_closed_box(self):
        front = np.minimum(25.0 + 2.0 * ROWS, 50.0)
        closed = lambda back: PaperRuns([made('closed', {}, {'domain.size': '[50, 60]'}, front_x=front,
                                              mean_velocity_x=np.where(ROWS > 15.0, back, 0.5))])
        self.assertTrue(result('wave_breaks', closed(-0.1)))
        self.assertFalse(result('wave_breaks', closed(0.0)))

    def test_what_is_missing_is_said(self):
        table = statements.rows(PaperRuns([]))
        self.assertEqual({row[3] for row in table}, {'not played yet'})
        self.assertEqual({row[4] for row in table}, {'-'})
        self.assertEqual(len(table), len(statements.STATEMENTS))


class Results(unittest.TestCase):
    def test_markdown_and_page(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Page('paper')
            self.assertTrue(add.add(page, Path(folder), as_the_paper_says().runs))
            text = (Path(folder) / 'paper.md').read_text()
        self.assertEqual(sorted(page.pictures), ['paper-figure-10', 'paper-figure-8', 'paper-figure-9'])
        self.assertIn('![Figure 9](pictures/paper-figure-9.png)', text)
        rows = [line for line in text.splitlines() if line.startswith('| ')]
        self.assertEqual(len(rows), 1 + len(statements.STATEMENTS))
        self.assertEqual({line.replace(r'\|', '').count('|') for line in rows}, {7})
        self.assertEqual(plt.get_fignums(), [])

    def test_spread(self):
        self.assertEqual(spread([1.0, 2.0, 3.0]), '2 (1 to 3)')
        self.assertEqual(spread([1.5]), '1.5')


if __name__ == '__main__':
    unittest.main()
