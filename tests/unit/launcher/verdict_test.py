# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report begins with, on runs whose numbers are known."""
import unittest
from pathlib import Path

import matplotlib
import numpy as np
import made_up_run  # noqa: F401  (finds the modules of the report)

matplotlib.use('Agg')

import captions
import run_data
from head import facts, key_numbers, verdict
from measured import MEASURED
from document.page import Page

CASE = {'time.step': '0.5', 'fluid.enabled': 'true', 'scales.kind': 'sedimentation', 'limits.grain_balance_soft': '1e-08',
        'limits.fluid_balance_soft': '1e-06', 'limits.penetration': '0.2'}
MAXIMA = {'penetration': 1e-4, 'grain_balance': 2e-14, 'fluid_balance': 3e-13, 'unconverged_windows': 0,
          'unconverged_multiplier_windows': 0, 'courant': 0.4}


def run_with(maxima=(), record=(), history=None, case=()):
    known = {'status': 'done', 'exit_code': 0, 'windows': 10, 'windows_done': 10, 'maxima': {**MAXIMA, **dict(maxima)}}
    rows = {name: np.array(values, dtype=float) for name, values in (history or {}).items()} or None
    return run_data.RunData(Path('.'), {**known, **dict(record)}, {**CASE, **dict(case)}, rows)


def said(run):
    return {check.subject: (check.css, check.text) for check in verdict.checks(run)}


class Verdict(unittest.TestCase):
    def test_a_run_that_holds(self):
        run = run_with()
        self.assertEqual({css for css, _ in said(run).values()}, {verdict.HOLDS})
        self.assertEqual(set(said(run)), {'momentum', 'overlaps', 'solvers', 'Courant number'})
        self.assertEqual(verdict.outcome(run, verdict.checks(run)),
                         'Status: done, exit code 0. All 10 windows, t = 5 t_c. Every check holds.')

    def test_each_doubt_is_named_with_number_and_limit(self):
        for name, value, subject, words in (
                ('grain_balance', 1e-5, 'momentum', 'grains 1e-05, fluid 3e-13, beyond limits.grain_balance_soft = 1e-08.'),
                ('fluid_balance', 1e-5, 'momentum', 'beyond limits.fluid_balance_soft = 1e-06.'),
                ('penetration', 0.05, 'overlaps', 'Overlaps are large: up to 0.05 D; beyond 0.2 D a run ends.'),
                ('unconverged_windows', 3, 'solvers', '(10 windows): in 3 of them the contact solver missed'),
                ('unconverged_multiplier_windows', 4, 'solvers', 'in 4 of them the multiplier problem')):
            run = run_with({name: value})
            css, text = said(run)[subject]
            self.assertEqual(css, verdict.DOUBT, name)
            self.assertIn(words, text)
            self.assertTrue(verdict.outcome(run, verdict.checks(run)).endswith(f'Look at: {subject}.'))

    def test_the_courant_number_is_judged_by_the_run_itself(self):
        run = run_with({'courant': 4.6}, {'warnings': [{'about': 'courant', 'text': 'the Courant number was up to 4.6.'}]})
        self.assertEqual(said(run)['Courant number'], (verdict.DOUBT, 'The Courant number is too large: up to 4.6.'))

    def test_what_a_dry_run_has_no_fluid_for_is_left_out(self):
        run = run_with({'fluid_balance': 1.0}, case={'fluid.enabled': 'false'})
        self.assertNotIn('Courant number', said(run))
        self.assertEqual(said(run)['momentum'], (verdict.HOLDS, 'Momentum is balanced: largest relative defect of any '
                                                 'window grains 2e-14.'))

    def test_an_old_or_empty_folder_is_not_praised(self):
        run = run_data.RunData(Path('.'))
        self.assertEqual(verdict.checks(run), [])
        self.assertEqual(verdict.outcome(run, []), 'Status: unknown.')

    def test_a_run_that_was_cut_off_says_how_far_it_came(self):
        run = run_with(record={'status': 'interrupted', 'exit_code': 130, 'windows_done': 4})
        self.assertIn('Status: interrupted, exit code 130. 4 of 10 windows, t = 2 t_c.', verdict.outcome(run, []))

    def test_a_run_that_was_resumed_and_killed_is_judged_by_its_rows_too(self):
        """run.json has the maxima of the earlier part alone."""
        run = run_with(history={'time': [0, 1, 2], 'max_penetration': [0, 0.05, np.nan], 'grain_balance': [np.nan, 1e-15, 1e-3],
                                'unconverged': [np.nan, 3, 4]})
        self.assertEqual(said(run)['overlaps'][0], verdict.DOUBT)
        self.assertIn('up to 0.05 D', said(run)['overlaps'][1])
        self.assertIn('grains 0.001, fluid 3e-13', said(run)['momentum'][1])
        self.assertIn('in 7 of them the contact solver missed', said(run)['solvers'][1])

    def test_a_run_that_was_killed_is_judged_by_its_rows(self):
        """run.json has no maxima: those are written at the end."""
        rows = {'step': [0, 6], 'time': [0, 3], 'max_penetration': [0, 1e-5], 'grain_balance': [np.nan, 1e-15],
                'unconverged': [np.nan, 7]}
        run = run_with(record={'status': 'interrupted', 'maxima': None, 'windows_done': None}, history=rows)
        self.assertEqual(said(run)['solvers'], (verdict.DOUBT, 'Not every window is solved to its tolerance (6 windows by the '
                                                'rows): in 7 of them the contact solver missed its tolerance.'))
        self.assertIn('6 of 10 windows, t = 3 t_c. Look at: solvers.', verdict.outcome(run, verdict.checks(run)))
        self.assertEqual(said(run)['momentum'][1], 'Momentum is balanced: largest relative defect of the rows grains 1e-15.')
        self.assertEqual(said(run)['overlaps'][1], 'Overlaps are small: at most 1e-05 D in the rows; beyond 0.2 D a run ends.')
        run.history['unconverged'][1] = 0
        self.assertEqual(said(run)['solvers'], (verdict.HOLDS, 'The contacts of every window up to the last row are solved to '
                                                'their tolerance (6 windows by the rows).'))

    def test_springs_are_not_said_to_be_solved(self):
        """run.json counts 0 of their windows, and so do the rows."""
        springs = {'step': [0, 10], 'time': [0, 5], 'contact_iterations': [np.nan, 20],
                   'contact_residual': [np.nan, np.nan], 'unconverged': [np.nan, 0]}
        run = run_with({'unconverged_multiplier_windows': None}, history=springs)
        self.assertNotIn('solvers', said(run))
        self.assertNotIn('Windows in which', captions.solvers(run))
        self.assertIsNone({one.name: one for one in MEASURED}['unconverged_windows'].of(run))
        self.assertIn('solvers', said(run_with(history=springs)))  # the multipliers of a fluid are
        killed = run_with({'unconverged_multiplier_windows': 0}, {'windows_done': 5}, springs)
        self.assertNotIn('solvers', said(killed))                  # its rows tell nothing of them
        run.history['contact_residual'][1] = 1e-9
        self.assertEqual(said(run)['solvers'][0], verdict.HOLDS)

    def test_maxima_of_an_earlier_part_are_said_to_be_of_it(self):
        rows = {'step': [0, 5, 8], 'time': [0, 2, 4], 'max_penetration': [0, 1e-5, 1e-3]}
        run = run_with(record={'windows_done': 5}, history=rows)
        self.assertIn('of the earlier parts and the rows grains', said(run)['momentum'][1])
        self.assertIn('at most 0.001 D in the earlier parts and the rows', said(run)['overlaps'][1])
        self.assertIn('at most 0.4 in the earlier parts of the run.', said(run)['Courant number'][1])
        run.record['windows_done'] = 9  # one window more than the last row has
        self.assertIn('of any window grains', said(run)['momentum'][1])
        self.assertIn('Every window is', said(run)['solvers'][1])

    def test_only_what_no_fault_has_ended_is_praised(self):
        for status, words in (('done', ' Every check holds.'), ('interrupted', ' Every check holds.'),
                              ('prepared', ' Every check holds so far.'), ('failed', ''), ('handshake refused', ''),
                              ('stalled', ''), ('physics refused', '')):
            run = run_with(record={'status': status, 'exit_code': None})
            self.assertEqual(verdict.outcome(run, verdict.checks(run)), f'Status: {status}. All 10 windows, t = 5 t_c.{words}')
        refused = run_with({'penetration': 0.3}, {'status': 'physics refused'})
        self.assertIn('Look at: overlaps.', verdict.outcome(refused, verdict.checks(refused)))

    def test_praise_by_rows_alone_says_so(self):
        for status in ('interrupted', 'prepared'):
            run = run_with(record={'status': status, 'maxima': None, 'windows_done': None},
                           history={'step': [0, 6], 'time': [0, 3], 'max_penetration': [0, 1e-5]})
            self.assertTrue(verdict.outcome(run, verdict.checks(run)).endswith('Every check holds as far as the rows tell.'))

    def test_the_rows_do_not_hide_what_lies_between_them(self):
        run = run_with({'penetration': 0.04, 'unconverged_windows': 9, 'grain_balance': None, 'fluid_balance': np.nan},
                       history={'time': [0, 1], 'max_penetration': [0, 1e-5], 'grain_balance': [np.nan, 1e-15],
                                'unconverged': [np.nan, 2]})
        self.assertIn('up to 0.04 D', said(run)['overlaps'][1])
        self.assertIn('in 9 of them', said(run)['solvers'][1])
        self.assertIn('grains 1e-15.', said(run)['momentum'][1])

    def test_grains_that_rest_and_grains_that_left(self):
        run = run_with(history={'time': [0, 1, 2], 'mean_speed': [0, 1, 0.001], 'grains': [9, 9, 7]})
        self.assertTrue(said(run)['rest'][1].startswith('At rest from t = 2 t_c on'))
        self.assertEqual(said(run)['grains'], (verdict.TOLD, '2 of 9 grains left the box; means are over the remaining ones.'))


class Commands(unittest.TestCase):
    def test_are_whole(self):
        run = run_with(record={'case_file': '/a/my case.yaml', 'overrides': ['domain.size=[4, 6]', 'time.end=2'],
                               'from': 'runs/x@3', 'out': '/runs/y'})
        self.assertEqual(run.command(), "turbidite run '/a/my case.yaml' --set 'domain.size=[4, 6]' --set time.end=2 "
                         '--from runs/x@3 --out /runs/y')

    def test_can_be_copied(self):
        record = {'case_file': 'a', 'overrides': ['contact.tolerance=1e-4'],
                  'versions': {'turbidite': '0.1.0', 'commit': '12e45'}}
        page = Page('title')
        page.table(facts.facts(run_with(record=record, case={'domain.size': '[4, 6]'})))
        self.assertIn('<code>turbidite run a --set contact.tolerance=1e-4</code>', page.text())
        self.assertIn('turbidite 0.1.0 (commit <code>12e45</code>)', page.text())

    def test_name_no_run_that_grains_were_poured_in(self):
        """It was played by the command itself."""
        run = run_with(record={'case_file': 'heap', 'from': 'runs/poured', 'hash_before_pouring': 'a1b2'})
        self.assertEqual(run.command(), 'turbidite run heap')


class KeyNumbers(unittest.TestCase):
    def test_have_units(self):
        run = run_with(history={'step': [0, 10], 'time': [0, 1], 'mean_velocity_norm': [0, 0.5], 'front_x': [3, 4]})
        self.assertEqual(key_numbers.rows(run), [('Peak of the mean velocity', '0.5 u_c so far'), ('Time of the peak', '1 t_c so far')])

    def test_the_front_is_told_of_a_collapse(self):
        run = run_with(history={'step': [0, 10], 'time': [0, 1], 'mean_velocity_norm': [0, 0], 'front_x': [3, 4]},
                       case={'scales.kind': 'avalanche', 'domain.size': '[20, 6]'})
        self.assertIn(('Front at the end', '4 D'), key_numbers.rows(run))

    def test_units_are_said_in_words(self):
        self.assertIn('u_c the characteristic velocity, √(g D), and t_c = D/u_c',
                      facts.units_in_words(run_with(case={'scales.kind': 'avalanche'})))

    def test_a_velocity_that_is_not_given_is_that_of_settling(self):
        given = {'scales.kind': 'physical', 'scales.velocity': '0.1'}
        self.assertIn('scales.velocity', facts.units_in_words(run_with(case=given)))
        self.assertIn('settling', facts.units_in_words(run_with(case={**given, 'scales.velocity': '~'})))

    def test_runs_with_other_scales_are_told_apart(self):
        one, other = [run_with(record={'D': 1e-3, 'u_c': u, 't_c': 1e-3 / u, 'g': 9.81}, case={'scales.kind': 'physical'})
                      for u in (0.07, 0.05)]
        self.assertEqual(facts.differing_scales([one, one]), '')
        self.assertIn('D = 0.001 m, u_c = 0.05 m/s, t_c = 0.02 s, g = 9.81 m/s²', facts.differing_scales([one, other]))

    def test_velocities_of_one_may_be_of_another_size(self):
        """u_c is 1 in all of them: √(g D), half of it, and a quarter of it."""
        avalanche, light, lighter = [run_with(record={'D': 1, 'u_c': 1, 't_c': 1, 'g': g}, case={'scales.kind': kind})
                                     for kind, g in (('avalanche', 1), ('sedimentation', 4), ('sedimentation', 16))]
        for runs, told in (([avalanche, light], 'avalanche, u_c = 1 √(g D); : sedimentation, u_c = 0.5 √(g D)'),
                           ([light, lighter], 'u_c = 0.25 √(g D)')):
            text = facts.differing_scales(runs)
            self.assertIn(told, text)
            self.assertNotIn('m/s', text)
        self.assertEqual(facts.differing_scales([light, light]), '')


class Contents(unittest.TestCase):
    def test_link_to_every_heading_also_later_and_folded_ones(self):
        page = Page('title')
        page.contents()
        page.heading('Heap')
        page.heading('Heap')
        with page.folded_part('Solver diagnostics'):
            page.subheading('Residuals')
        text = page.text()
        for place in ('heap', 'heap-2', 'solver-diagnostics'):
            self.assertIn(f'<a href="#{place}">', text)
            self.assertEqual(text.count(f'id="{place}"'), 1)
        self.assertLess(text.index('<nav>'), text.index('id="heap"'))
        self.assertIn('<details class="part" id="solver-diagnostics"><summary>Solver diagnostics</summary><h3>', text)

    def test_an_empty_part_is_not_there(self):
        page = Page('title')
        page.contents()
        with page.folded_part('Solver diagnostics'):
            pass
        self.assertNotIn('Solver diagnostics', page.text())


if __name__ == '__main__':
    unittest.main()
