# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures and statements of the paper on made-up runs that do what it says, and on runs that do not."""
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import matplotlib
import made_up_run  # noqa: F401  (finds the modules of the report)

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

import run_data
import study
from analysis import deposit, energy, pore_pressure, snapshots
from document.page import Page
from paper import add, darcy, figures, statements, waiting
from paper.selection import COLUMNS, COMPACITIES, DENSE, LOOSE, REYNOLDS, PaperRuns, spread

ROWS = np.arange(81) * 0.25  # t_c
OPEN = {'fluid.hydrodynamic_radius': '0.8', 'fluid.splitting': 'explicit-multiplier', 'fluid.cells_per_diameter': '16'}
CLOSED = {'fluid.hydrodynamic_radius': '1', 'fluid.splitting': 'marchuk-yanenko', 'fluid.cells_per_diameter': '8'}


def made(part, values, case=None, found=None, maxima=None, status='done', **history):
    """A run of a study. Its history has the times of ROWS unless given; `found` are measurements of its files."""
    data = run_data.RunData(Path(f'/nowhere/{part}-{"-".join(values.values())}'))
    data.case = {'scales.kind': 'avalanche', 'domain.size': '[100, 60]', 'fluid.enabled': 'true', **(case or {}),
                 **values}
    data.record = {'D': 1.0, 'u_c': 1.0, 't_c': 1.0, 'g': 1.0, 'status': status, 'maxima': maxima or {}}
    data.history = {'time': ROWS, 'step': 100 * ROWS, **history}
    data.history = {name: np.asarray(column, dtype=float) for name, column in data.history.items()}
    data.measured = {'analysis.snapshots.snapshots': [], **(found or {})}
    return study.StudyRun({'part': part, 'name': '-'.join(values.values()), 'values': values, 'status': status}, data)


def slide(waits, slope, creep=0.0):
    """|<u>| that rises from `waits` on, for 8 t_c."""
    return creep * (ROWS < waits) + slope * np.clip(ROWS - waits, 0.0, 8.0)


# --- what the paper says, part by part; arguments make it something else -------------------------------

def immersed(waits=lambda re, phi: 0.0 if phi < 0.8 else 60.0 * (phi - 0.8), part='immersed', case=None, creep=0.0,
             slopes=lambda re, phi: 0.3 * (1.0 - phi) * (1.0 + 0.1 * np.log10(float(re))), pores=lambda phi: phi - 0.8,
             saturates=True, pressure=lambda phi: -3.0 if phi > 0.8 else 2.0, angle=44.0, quiescent=0.4, seeds='1'):
    """Columns by Reynolds number and compacity: waits(Re, phi), slopes(Re, phi)."""
    made_of = lambda re, phi, seed: made(
        part, {'fluid.reynolds': re, 'grains.compacity': phi, 'random.seed': seed}, case or OPEN,
        found={'analysis.shear_band.shear_band': band(angle, quiescent) if phi == DENSE else None,
               'analysis.pore_pressure.probes': probes(pressure(float(phi)))},
        mean_velocity_norm=slide(waits(re, float(phi)), slopes(re, float(phi)), creep),
        pore_volume=100.0 * (1.0 + pores(float(phi)) * (np.minimum(ROWS / 10.0, 1.0) if saturates else ROWS / 20.0)),
        mean_position_x=12.5 * (1.0 + 0.02 * ROWS))
    return [made_of(re, phi, seed) for re in REYNOLDS for phi in COMPACITIES for seed in seeds]


def band(angle, quiescent):
    return type('Band', (), {'slip_angle': angle, 'quiescent': quiescent})()


def probes(pressure):
    """Inside the column it is `pressure` until 12 t_c, later twice as large with the other sign; nothing elsewhere."""
    inside = np.where(ROWS < 12.0, pressure, -2.0 * pressure)
    return pore_pressure.Probes(['a', 'b'], np.zeros((2, 2)), ROWS, np.column_stack([0.0 * ROWS, inside]))


def settling(triangles=11, triangle_speed=0.78, seeds='12'):
    rest = lambda t: np.where(ROWS < t, 1.0, 0.0)
    played = (('discs-nscd', 1.0, 10), ('discs-md', 0.95, 10), ('triangles-nscd', 0.8, triangles),
              ('triangles-md', triangle_speed, triangles))
    return [made('sedimentation', {'variant': variant, 'random.seed': seed}, {'scales.kind': 'sedimentation'},
                 mean_velocity_y=-speed * rest(time), mean_speed=rest(time),
                 mean_position_y=40.0 - 3.0 * np.minimum(ROWS, time))
            for variant, speed, time in played for seed in seeds]


def dry(at=lambda phi: 9.0, height=lambda phi: 1.0, rest=0.0, seeds=(0.0, 0.25), part='dry'):
    """The seeds peak a quarter of a t_c apart; from `rest` on nothing slows down."""
    def column(phi, late):
        peaked = height(phi) * np.maximum(rest, 1.0 - np.abs(ROWS - at(phi) - late) / 8.0)
        return made(part, {'grains.compacity': str(phi), 'random.seed': str(late)}, {'fluid.enabled': 'false'},
                    mean_velocity_norm=peaked)
    return [column(float(phi), late) for phi in COMPACITIES for late in seeds]


def heap(foot, first=25.0, right=100):
    x = np.arange(right) + 0.5
    return deposit.Deposit(20.0, x, np.where(x < foot, 10.0, 0.0), first, foot, 10.0, None, None)


def packing(time, columns, velocities):
    """Grains of 4 D2 above the floor: so many in each column of 4 D, from the bottom up."""
    centres = [(4.0 * i + 2.0, 1.0 + k) for i, count in enumerate(columns) for k in range(count)]
    n = len(centres)
    return snapshots.Snapshot(time, np.arange(n), np.array(centres), np.full(n, 0.5), np.array(velocities, dtype=float),
                              np.full(n, 4.0), None, None)


def collapse(crest=True, flat=True, heaps=True):
    """Eight grains: the upper two fall, the lowest two are ejected; half of them flow over the others; all flow on."""
    at_30 = (0.866, -0.5)
    return [packing(0.0, [8], np.zeros((8, 2))),
            packing(1.0, [8], [(1, 0), (1, 0), (0, -.5), (0, -.5), (0, -.5), (0, -.5), (0, -1), (0, -1)]),
            packing(2.0, [5, 3], 4 * [(0, 0) if heaps else at_30] + 4 * [at_30]),
            packing(3.0, [4, 1, 3] if crest else [4, 3, 1], 8 * [(1, 0) if flat else at_30])]


def run_out(loose=75.0, dense=37.5, speed=0.01, slower=0.5, wave=True, dense_wave=False, right=100, **how):
    """The feet of both heaps at the end, from 25 D on, which is at rest unless `speed` is above 0.01 of the largest."""
    row = lambda phi, foot, peak, there: made(
        'run-out', {'grains.compacity': phi}, OPEN,
        found={'analysis.deposit.deposit': heap(foot, right=right), 'analysis.snapshots.snapshots': there},
        mean_velocity_norm=peak * np.where(ROWS < 10.0, 1.0, 0.5 * speed),
        mean_speed=np.where(ROWS < 10.0, 1.0, 0.5 * speed))
    return [row(LOOSE, loose, 1.0, collapse(wave, **how)), row(DENSE, dense, slower, collapse(dense_wave))]


def closed(back=-0.1, front=2.0):
    return [made('closed', {}, {'domain.size': '[50, 60]', **OPEN}, front_x=np.minimum(25.0 + front * ROWS, 50.0),
                 mean_velocity_x=np.where(ROWS > 15.0, back, 0.5))]


def balanced(energy_left=1e-5, grains=1e-12, fluid=1e-9):
    none = np.zeros(2)
    return [made('other', {}, found={'analysis.energy.budget': energy.Budget(
        none, np.array([0.0, 1.0 + energy_left]), np.array([0.0, -1.0]), none, none, none, np.ones(2, bool))},
        maxima={'grain_balance': grains, 'fluid_balance': fluid})]


# Of each statement: runs that agree, and runs, one list after the other, that do not.
HIGHER_WITH_RE = lambda re, phi: 0.3 * phi / (1.0 + 0.1 * float(re))
BENT = lambda re, phi: 0.0 if phi < 0.8 else {0.829: 2.0, 0.85: 6.0, 0.87: 2.0, 0.9069: 4.0}[phi]
WITH_RE = lambda re, phi: 0.0 if phi < 0.8 else {'89': 10.0, '8.9': 30.0, '0.89': 50.0}[re] * (phi - 0.75)
FALLING = lambda re, phi: 0.0 if phi < 0.8 else 8.0 - 60.0 * (phi - 0.8)
CASES = {
    'triangles_are_slower': (settling(), [settling(triangles=13), settling(triangles=9)]),
    'md_is_like_nscd': (settling(), [settling(triangle_speed=0.3)]),
    'dry_peak': (dry(), [dry(at=lambda phi: 4.0 + 40.0 * (phi - 0.785)), dry(at=lambda phi: 7.0)]),
    'dry_does_not_depend_on_compacity': (dry(), [dry(height=lambda phi: phi)]),
    'dry_decreases_to_zero': (dry(part='dry-rest'), [dry(rest=0.5, part='dry-rest')]),
    'loose_at_once': (immersed(), [immersed(lambda re, phi: 5.0), immersed(slopes=lambda re, phi: 0.001)]),
    'dense_waits': (immersed(), [immersed(lambda re, phi: 0.5), immersed(
        lambda re, phi: 0.5 if (re, phi) == ('8.9', 0.87) else 3.0)]),
    'stands_still': (immersed(), [immersed(creep=0.05)]),
    'waits_linearly': (immersed(), [immersed(BENT), immersed(FALLING)]),
    'slopes_are_alike': (immersed(), [immersed(WITH_RE), immersed(FALLING)]),
    'peak_falls_with_compacity': (immersed(), [immersed(slopes=lambda re, phi: 0.3 * phi)]),
    'peak_and_viscosity': (immersed(), [immersed(slopes=HIGHER_WITH_RE)]),
    'falls_in_three_phases': (run_out(), [run_out(flat=False), run_out(heaps=False)]),
    'slides_at_45': (immersed(), [immersed(angle=60.0), immersed(angle=20.0)]),
    'wedge_rests': (immersed(), [immersed(quiescent=0.1)]),
    'dense_is_slower': (run_out(), [run_out(slower=1.1)]),
    # L from 25 D: (L - L0)/L0 of 1.6 and 4, L/L0 of 2.6 and 5.
    'spreads_half': (run_out(125.0, 65.0, right=200), [run_out(37.5, 75.0), run_out(75.0, 75.0), run_out(25.0, 25.0)]),
    'no_wave_on_the_dense_one': (run_out(), [run_out(dense_wave=True), run_out(wave=False)]),
    'wave_breaks': (closed(), [closed(back=0.0), closed(front=0.1)]),
    'suction_holds_the_dense': (immersed(), [immersed(pressure=lambda phi: 1.0), immersed(
        pressure=lambda phi: 1.0 if phi == 0.85 else -1.0)]),
    'pressure_carries_the_loose': (immersed(), [immersed(pressure=lambda phi: -1.0)]),
    'only_the_loosest_contracts': (immersed(), [immersed(pores=lambda phi: phi - 0.7),
                                                immersed(pores=lambda phi: phi - 0.84)]),
    'pores_grow_with_compacity': (immersed(), [immersed(pores=lambda phi: 0.8 - phi)]),
    'two_regimes': (immersed(), [immersed(saturates=False)]),
    'energy_closes': (balanced(), [balanced(energy_left=0.01)]),
    'momentum_closes': (balanced(), [balanced(grains=1e-4)]),
    'fluid_momentum_closes': (balanced(), [balanced(fluid=1e-4)]),
}


def result(name, runs):
    measured = getattr(statements, name)(PaperRuns(runs))
    return None if measured is None else measured[1]


def text(name, runs):
    return getattr(statements, name)(PaperRuns(runs))[0]


class Statements(unittest.TestCase):
    def test_every_statement_has_runs_that_agree_and_runs_that_do_not(self):
        self.assertEqual(set(CASES), {one.measure.__name__ for one in statements.STATEMENTS})

    def test_that_hold(self):
        for name, (agree, _) in CASES.items():
            self.assertIs(result(name, agree), True, f'{name}: {text(name, agree)}')

    def test_that_do_not_hold(self):
        for name, (_, others) in CASES.items():
            for k, runs in enumerate(others):
                self.assertIs(result(name, runs), False, f'{name}, {k}: {text(name, runs)}')

    def test_without_runs(self):
        for name in CASES:
            self.assertIsNone(getattr(statements, name)(PaperRuns([])), name)

    def test_every_seed_counts(self):
        self.assertIn('φ = 0.85: 9.12 (9 to 9.25)', text('dry_peak', dry()))
        self.assertIn('φ = 0.85: 9.38 (9.25 to 9.5)', text('dry_peak', dry(seeds=(0.25, 0.5))))

    def test_triangles_that_still_fall_have_no_verdict(self):
        self.assertIsNone(result('triangles_are_slower', settling(triangles=30)))
        self.assertIn('half of the fall in 5.5 (5.5 to 5.5) against 5 (5 to 5) t_c', text('triangles_are_slower', settling()))

    def test_runs_that_are_not_done_do_not_count(self):
        half = immersed()
        half[3].entry['status'] = 'begun'
        for name in ('loose_at_once', 'dense_waits', 'waits_linearly', 'peak_falls_with_compacity', 'pores_grow_with_compacity'):
            self.assertIsNone(result(name, half), name)
        self.assertEqual(len(PaperRuns(half).of('immersed')), len(half) - 1)

    def test_columns_of_another_radius_are_other_columns(self):
        """Each row says which, and is about these alone."""
        at_once = immersed(lambda re, phi: 0.0, part='closed-pores', case=CLOSED)
        table = statements.rows(PaperRuns(immersed() + at_once))
        rows = [row for row in table if row[1] == 'From φ = 0.829 on columns wait']
        self.assertEqual([(row[4], row[6]) for row in rows], [('agrees', 'immersed'), ('does not agree', 'closed-pores')])
        self.assertEqual([row[5] for row in rows], ['D/16, pores opened to 0.8 R, explicit-multiplier',
                                                    "D/8, R_h = R, as in the paper's Eq. 10, marchuk-yanenko"])

    def test_what_has_not_come_may_come_while_grains_move(self):
        moving = run_out(speed=0.1)
        self.assertIsNone(result('no_wave_on_the_dense_one', moving))
        self.assertIsNone(result('falls_in_three_phases', run_out(speed=0.1, flat=False)))
        self.assertTrue(result('falls_in_three_phases', moving))
        self.assertIs(result('no_wave_on_the_dense_one', run_out(speed=0.1, dense_wave=True)), False)

    def test_what_still_falls_has_no_verdict(self):
        falling = dry(at=lambda phi: 14.0, part='dry-rest')
        self.assertIsNone(result('dry_decreases_to_zero', falling))
        self.assertIn('0.25', text('dry_decreases_to_zero', falling))
        self.assertIn('still falling', text('dry_decreases_to_zero', falling))

    def test_one_reynolds_number_says_nothing_of_reynolds_numbers(self):
        runs = [run for run in immersed() if run.entry['values']['fluid.reynolds'] == '89']
        for name in ('slopes_are_alike', 'peak_and_viscosity'):
            self.assertIsNone(getattr(statements, name)(PaperRuns(runs)), name)

    def test_parts_that_add_runs(self):
        runs = immersed() + [made('immersed-again', {'fluid.reynolds': '89', 'grains.compacity': LOOSE}, OPEN,
                                  mean_velocity_norm=slide(0.5, 0.1))]
        self.assertRegex(text('loose_at_once', runs), r'Re = 89: 0\.25 \(.* to 0\.5\),')

    def test_what_is_missing_is_said(self):
        table = statements.rows(PaperRuns([]))
        self.assertEqual({row[3] for row in table}, {'not played yet'})
        self.assertEqual({row[4] for row in table}, {'-'})
        twice = [one for one in statements.STATEMENTS if one.part == COLUMNS[0]]
        self.assertEqual(len(table), len(statements.STATEMENTS) + len(twice))


class Waiting(unittest.TestCase):
    def test_lines(self):
        line = waiting.line(PaperRuns(immersed()), '8.9', COMPACITIES)
        self.assertAlmostEqual(line.slope, 60.0, places=6)
        self.assertAlmostEqual(line.straight, 1.0)
        self.assertEqual((line.compacities, line.left_out), ([0.829, 0.85, 0.87, 0.9069], 0))

    def test_of_columns_that_do_not_slide(self):
        """At the smallest Re only the loosest moves by the end: Re changes more than the slope slightly. Nothing is
        averaged over Reynolds numbers."""
        waits = lambda re, phi: 0.0 if phi < 0.8 else 40.0 * (phi - 0.8)
        slopes = lambda re, phi: 0.3 if re != '0.89' or phi < 0.8 else 0.001
        runs = immersed(waits, slopes=slopes)
        self.assertIn('Re = 8.9: φ = 0.829: 1.16, φ = 0.85: 2, ', text('dense_waits', runs))
        self.assertIn('Re = 0.89: φ = 0.829: stands to 20, ', text('dense_waits', runs))
        self.assertTrue(result('dense_waits', runs))
        self.assertTrue(result('waits_linearly', runs))
        self.assertIn('Re = 0.89: fewer than two have a t_relax', text('slopes_are_alike', runs))
        self.assertIn('Re = 0.89: fewer than three have a t_relax', text('waits_linearly', runs))
        self.assertIs(result('slopes_are_alike', runs), False)

    def test_a_column_that_accelerates_to_the_end_has_a_bound(self):
        """Its velocity grows ever faster: the line at the end says how long it waits at least."""
        runs = immersed()
        late = next(run for run in runs if run.entry['values']['grains.compacity'] == '0.87')
        late.data.history['mean_velocity_norm'] = 0.2 * (ROWS / 20.0)**8
        found = waiting.wait(late.data)
        self.assertTrue(found.bound)
        self.assertAlmostEqual(found.time, 19.5 - 19.5 / 8.0, delta=0.02)  # the tangent in the middle of the last t_c
        self.assertIn('φ = 0.87: > 17, ', text('dense_waits', runs))
        self.assertEqual(figures.bar(waiting.Wait(2.0, (1.5, 4.0), False, True)), (0.5, 2.0))
        # Fits over the same rows have no bar.
        self.assertTrue(np.isnan(figures.bar(waiting.Wait(2.0, None, False, True))).all())
        self.assertEqual(waiting.Wait(17.96, (17, 18), True, True).text, '> 17.9')  # never rounded up
        line = waiting.line(PaperRuns(runs), '89', COMPACITIES)
        self.assertEqual((line.compacities, line.left_out), ([0.829, 0.85, 0.9069], 1))
        self.assertAlmostEqual(line.slope, 60.0, places=6)

    def test_at_once_and_waiting_exclude_each_other(self):
        for time in (0.5, 0.99, 1.0, 3.0):
            runs = PaperRuns(immersed(lambda re, phi: time))
            for one in waiting.waits(runs, '89', '0.85'):
                self.assertNotEqual(one.at_once, one.waits)

    def test_a_second_seed_that_still_stands_is_told(self):
        runs = immersed(seeds='12')
        again = [run for run in runs if run.entry['values']['random.seed'] == '2']
        for run in again:
            run.data.history['mean_velocity_norm'] = 0.001 * ROWS
        self.assertIn('Re = 89: φ = 0.829: 1.74, stands to 20, ', text('dense_waits', runs))


class SpreadingLengths(unittest.TestCase):
    def test_no_verdict_before_the_heaps_rest(self):
        """Whatever they say at the end of the run."""
        for feet in ((125.0, 65.0), (37.5, 75.0)):
            runs = run_out(*feet, speed=0.1, right=200)
            self.assertIsNone(result('spreads_half', runs))
            self.assertIn('lower bounds: not at rest by 20 t_c', text('spreads_half', runs))

    def test_no_verdict_of_heaps_that_reach_the_side(self):
        runs = run_out(100.0, 62.5, right=100)
        self.assertIsNone(result('spreads_half', runs))
        self.assertIn('reaches the side of the box', text('spreads_half', runs))

    def test_both_readings_are_told_and_have_to_agree(self):
        """(L - L0)/L0 of 1 and 2, but L/L0 of 2 and 3."""
        runs = run_out(75.0, 50.0)
        self.assertIn('ratio 0.5; L/L₀ = 2 and 3, ratio 0.67', text('spreads_half', runs))
        self.assertIsNone(result('spreads_half', runs))


class Estimate(unittest.TestCase):
    LATTICES = (np.array([0.7854, 0.9069]), np.array([1.69e-3, 1.03e-3]))

    def test_darcy(self):
        """A layer of one grain at 0.9069: 0.1547 D of liquid at Re k (rho_r - 1) phi = 89 1.03e-3 0.5 0.9069 per t_c."""
        time = lambda phi, re: darcy.time_to_dilate(phi, re, 1.5, self.LATTICES)
        self.assertAlmostEqual(time(0.9069, 89.0), 3.72, places=2)
        self.assertAlmostEqual(time(0.9069, 8.9), 37.2, places=1)
        self.assertAlmostEqual(time(np.pi / 4, 89.0), 0.0)

    def lattices(self, missing=0):
        """k = flow over 2 and Re = 0.5: 1e-3 along x and 4e-3 along y."""
        flows = ((8.0e-3, '[0, 2]', 'flow_y'), (2.0e-3, '[2, 0]', 'flow_x'))
        runs = [made('permeability', {'variant': phi, 'fluid.acceleration': push}, {'fluid.reynolds': '0.5'},
                     **{'flow_x': 0.0 * ROWS, 'flow_y': 0.0 * ROWS, name: flow * np.minimum(ROWS, 1.0)})
                for phi in COMPACITIES for flow, push, name in flows]
        for run in runs[:missing]:
            run.entry['status'] = 'missing'
        return PaperRuns(runs)

    def test_permeabilities_are_those_of_the_study(self):
        phi, k = darcy.permeabilities(self.lattices())
        np.testing.assert_allclose(phi, [float(one) for one in COMPACITIES])
        np.testing.assert_allclose(k, np.sqrt(2e-3 * 8e-3))

    def test_there_is_no_estimate_without_them(self):
        self.assertIsNone(darcy.permeabilities(PaperRuns([])))
        self.assertIsNone(darcy.permeabilities(self.lattices(missing=1)))


class Results(unittest.TestCase):
    def test_markdown_and_page(self):
        runs = immersed() + immersed(part='closed-pores', case=CLOSED)
        with tempfile.TemporaryDirectory() as folder:
            page = Page('paper')
            self.assertTrue(add.add(page, Path(folder), runs))
            written = (Path(folder) / 'paper.md').read_text()
        self.assertEqual(sorted(page.pictures), sorted(f'paper-figure-{number}' for number in
                                                       ('8', '9', '10', '8c', '9c', '10c')))
        self.assertIn('![Figure 9](pictures/paper-figure-9.png)', written)
        self.assertIn("R_h = R, as in the paper's Eq. 10", written)
        rows = [line for line in written.splitlines() if line.startswith('| ')]
        self.assertEqual(len(rows), 1 + len(statements.rows(PaperRuns([]))))
        self.assertEqual({line.replace(r'\|', '').count('|') for line in rows}, {8})
        self.assertEqual(plt.get_fignums(), [])

    def test_the_estimate_is_drawn_for_open_pores_alone(self):
        labels = lambda runs: [label for label in figures.relaxation_times(runs).axes[0].get_legend_handles_labels()[1]]
        runs = PaperRuns(immersed() + immersed(part='closed-pores', case=CLOSED) + Estimate().lattices().runs)
        self.assertTrue(any('Darcy' in label for label in labels(runs)))
        self.assertFalse(any('Darcy' in label for label in labels(runs.with_columns('closed-pores'))))
        plt.close('all')

    def test_sedimentation_is_drawn(self):
        self.assertIsNotNone(figures.settling(PaperRuns(settling())))
        plt.close('all')

    def test_spread(self):
        self.assertEqual(spread([1.0, 2.0, 3.0]), '2 (1 to 3)')
        self.assertEqual(spread([1.5]), '1.5')


class OfSeveralRuns(unittest.TestCase):
    def test_seeds_are_means(self):
        runs = [made('immersed', {'random.seed': str(k)}, mean_velocity_norm=slide(0.0, k / 8.0)).data
                for k in (1, 3)]
        self.assertAlmostEqual(statements.mean_peak(runs).value, 2.0)
        two = immersed(seeds='12')
        found = statements.of_columns(PaperRuns(two), lambda one: 1.0 + 2.0 * (one.case['random.seed'] == '2'))
        self.assertEqual(set(found.values()), {2.0})

    def test_figures_are_of_the_runs_that_they_name(self):
        with mock.patch.object(figures, 'sequence', lambda one: one[0].case['grains.compacity'] if one else None):
            of = {number: figure for number, _, figure in figures.all_figures(PaperRuns(run_out()))
                  if isinstance(figure, str)}
        self.assertEqual(of, {5: LOOSE, 6: DENSE})
        figure = figures.velocities(PaperRuns(immersed()))
        for axes, re in zip(figure.axes[1:], ('89', '8.9', '0.89')):
            top = 8.0 * 0.3 * (1.0 - 0.7854) * (1.0 + 0.1 * np.log10(float(re)))
            self.assertAlmostEqual(axes.lines[0].get_ydata().max(), top)
        figure = figures.settling(PaperRuns(settling()))
        self.assertEqual(figure.axes[1].lines[0].get_ydata()[0], 40.0 / 60.0)
        axes = figures.relaxation_times(PaperRuns(immersed())).axes[0]
        line = next(one for one in axes.lines if len(one.get_xdata()) == 2)     # waits 60 (phi - 0.8)
        np.testing.assert_allclose(line.get_ydata(), [60 * 0.029, 60 * 0.1069], rtol=1e-6)
        plt.close('all')


if __name__ == '__main__':
    unittest.main()
