# SPDX-License-Identifier: LGPL-2.1-or-later
"""The report on synthetic run folders: complete, partly empty, damaged."""
import json
import re
import unittest

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from made_up_run import CASE, COLUMNS, ROWS, VTP, RunFolderTest, foam_file

import captions
import curves
import findings
import fluid_fields
import grain_drawing
import grain_files
import pictures
from analysis import pore_pressure, relaxation
import report
import run_data
import surface
from document.typeset import typeset
from head import facts

FIGURES = ['concentration.png', 'concentration_profiles.png', 'motion-max_penetration.png', 'motion-mean_speed.png',
           'sequence-0.png', 'sequence-1.png', 'sequence.png', 'settling-mean_position_y.png', 'settling-mean_velocity_y.png',
           'solvers-contact_residual.png', 'wall_time.png']


class Report(RunFolderTest):
    def pictures(self):
        return sorted(path.name for path in (self.folder / 'pictures').iterdir())

    def make(self):
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        return (self.folder / 'report.html').read_text()

    def test_whole_run(self):
        self.write_all()
        page = self.make()
        self.assertIn('made-up', page)
        self.assertEqual(page.count('src="data:image/png;base64,'), len(FIGURES) - 1)  # sequence.png is a file only
        self.assertIn('Status: done, exit code 0', page)
        for words in re.findall('alt="([^"]*)"', page):
            self.assertNotIn(f'{words}.png', FIGURES)
            self.assertGreater(len(words.split()), 3)
        self.assertIn('alt="2 grains at t = 1 t_c, up to x = 2.9 D and y = 3.5 D, over the vertical velocity of the fluid, '
                      'from 0 to 0.11 u_c"', page)
        parts = ('Status: done', 'Overlaps are small', 'Units: D is', '<nav>', 'id="case"', '<img',
                 'id="concentration-over-height"', 'id="solver-diagnostics"', 'Resolved case')
        order = [page.index(part) for part in parts]
        self.assertEqual(order, sorted(order))
        self.assertNotIn('Remarks', page)
        self.assertNotIn('src="http', page)
        self.assertEqual(self.pictures(), FIGURES)

    def test_field_order_in_both_formats(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        for time, folder in fluid_fields.field_times(run):
            field = fluid_fields.velocity_at(run, time, folder)
            self.assertEqual(field.vertical.shape, (ROWS, COLUMNS))
            # Row 3, column 5 is the cell with i = 5, j = 3.
            self.assertEqual(field.horizontal[3, 5], 5.0)
            self.assertEqual(field.vertical[3, 5], 0.03)

    def test_stretched_rows_are_shown_at_their_heights(self):
        """4 x 12 D at 2 cells per D: rows of 0.5 D up to 4 D, then four of 1 and two of 2 D; 14 instead of 24."""
        self.write_all()
        case = self.folder / 'case.yaml'
        case.write_text(case.read_text().replace('size: [4, 6]', 'size: [4, 12]').replace(
            'cells_per_diameter: 2', 'cells_per_diameter: 2\n  stretch_ratio: 1.2'))
        edges = np.concatenate([[0], np.cumsum([0.5] * 8 + [1] * 4 + [2] * 2)])
        z, y, x = np.meshgrid([0, 1], edges, np.arange(COLUMNS + 1) / 2, indexing='ij')
        points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
        self.write('fluid/constant/polyMesh/points',
                   b'FoamFile\n{\n format binary;\n}\n\n\n%d\n(' % len(points) + points.astype('<f8').tobytes() + b')')
        j, i = np.mgrid[0:14, 0:COLUMNS]
        values = np.stack([i, j, 0 * i], axis=-1).reshape(-1, 3)
        self.write('fluid/0/U', b'format binary;\ninternalField nonuniform List<vector> \n%d\n(' % len(values) +
                   values.astype('<f8').tobytes() + b')\n;\n')
        field = fluid_fields.velocity_at(run_data.load_run(self.folder), 0, self.folder / 'fluid/0')
        self.assertEqual(field.vertical[:, 3].tolist(),
                         list(range(8)) + [8, 8, 9, 9, 10, 10, 11, 11] + [12] * 4 + [13] * 4)
        self.assertTrue((field.horizontal == np.arange(COLUMNS)).all())

    def test_uniform_field(self):
        data = b'format ascii;\ninternalField   uniform (0 1.5 0);\n'
        self.assertTrue((fluid_fields.read_vectors(data, 6) == [0, 1.5, 0]).all())

    def test_pictures_pair_grains_and_fields(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        for time, grains, field in pictures.instants(run):
            self.assertEqual(grains.name, f'grains_{int(time):08d}.vtp')
            self.assertEqual(field.name, str(int(time)))
        grains = grain_files.read_grains(*grain_files.grain_series(run)[1])
        self.assertEqual(grains.centres.tolist(), [[1, 3], [2.5, 3]])
        self.assertEqual(grains.radii.tolist(), [0.5, 0.4])

    def test_colours_are_symmetric(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        field = fluid_fields.velocity_at(run, 0, self.folder / 'fluid/0')
        shown = [pictures.Picture(0, None, field), pictures.Picture(1, None, None)]
        # Largest vertical speed: row 11, 0.11 u_c, an eighth of the cells.
        self.assertAlmostEqual(pictures.colour_limit(run, shown), 0.11)
        figure = pictures.figure(run, shown)
        self.assertEqual(figure.axes[0].images[0].get_clim(), (-0.11, 0.11))

    def test_missing_history_and_fields_are_said(self):
        self.write_all()
        (self.folder / 'history.csv').unlink()
        for k in range(2):
            (self.folder / f'fluid/{k}/U').unlink()
        page = self.make()
        self.assertIn('history.csv is missing', page)
        self.assertIn('holds no velocity field', page)
        self.assertEqual(self.pictures(), ['concentration.png', 'concentration_profiles.png', 'sequence-0.png',
                                           'sequence-1.png', 'sequence.png'])  # of grains only

    def test_texts_of_a_case_are_what_their_quotes_enclose(self):
        for written, text in ((r'"\"my code\" --say \"a\""  # a command', '"my code" --say "a"'), (r'"C:\\"', 'C:\\'),
                              ('"a  # b"', 'a  # b'), ('plain  # D', 'plain'), ('""', '')):
            self.write('case.yaml', f'grains:\n  command: {written}\n  ranks: 2\n')
            self.assertEqual(run_data.read_resolved_case(self.folder / 'case.yaml'),
                             {'grains.command': text, 'grains.ranks': '2'})

    def test_empty_folder(self):
        page = self.make()
        for name in ('run.json', 'case.yaml', 'history.csv'):
            self.assertIn(f'{name} is missing', page)
        self.assertIn('nothing to draw', page)

    def test_broken_field_is_said(self):
        self.write_all()
        self.write('fluid/1/U', foam_file(True)[:200])
        self.write('fluid/0/U', foam_file(True)[:400])
        self.assertIn('U is cut off', self.make())

    def test_a_row_that_was_cut_off_is_left_out(self):
        """What is left of its last number looks like a number."""
        self.write_all()
        history = self.folder / 'history.csv'
        whole = history.read_text()
        for end in ('20,2,-0.3,0.0', '20,2', '20,2,-0.3,0.0123,2.5,0,1e-4,0.1,0.06,0.0'):
            history.write_text(whole + end)
            self.assertEqual(run_data.load_run(self.folder).history['time'].tolist(), [0.0, 1.0], end)
        history.write_text('step,ti')
        self.assertIn('history.csv cannot be read: it has no column "time"', self.make())

    def test_probes_that_were_cut_off_have_their_whole_rows(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('grains:', 'output:\n  probes: [1, 2]  # D\ngrains:\n  density_ratio: 1.5'))
        for end in ('1.5,-', '1.5,2,0.', '1.5'):
            self.write('probes.csv', 'time,pressure_1,velocity_x_1,velocity_y_1\n0.5,1,0,0\n1,3,0,0\n' + end)
            found = pore_pressure.probes(run_data.load_run(self.folder))
            self.assertEqual((found.time.tolist(), found.values.tolist()), ([0.5, 1.0], [[2.0], [6.0]]), end)
            page = self.make()
            self.assertIn('Pore pressure', page)
            self.assertNotIn('cannot be measured', page)
        self.write('probes.csv', 'time,pressure_1,velocity_x_1,velocity_y_1\n0.5,1')
        self.assertNotIn('Pore pressure', self.make())

    def test_a_series_that_was_cut_off_has_its_whole_outputs(self):
        self.write_all()
        index = self.folder / 'grains/grains.pvd'
        whole = index.read_text()
        for end, times in (('</Collection', [0.0, 1.0]), ('001.vtp', [0.0]), ('vtp"/><DataSet', [])):
            index.write_text(whole[:whole.index(end)])
            run = run_data.load_run(self.folder)
            self.assertEqual([time for time, _ in grain_files.grain_series(run)], times)
            self.assertEqual([time for time, _ in grain_files.grain_series(run)], times)
            [remark] = run.remarks
            self.assertIn(f'grains/grains.pvd is cut off or damaged after {len(times)} whole entries', remark)
            self.assertIn(f'after {len(times)} whole entries', self.make())
        self.write('grains/contacts.pvd', '<VTKFile><Collection>')
        self.assertIn('grains/contacts.pvd is cut off or damaged after 0 whole entries', self.make())

    def test_failed_run_shows_its_error(self):
        self.write_all()
        self.write('run.json', json.dumps({'status': 'physics refused', 'exit_code': 6,
                                           'error': 'grain 3 < wall'}))
        page = self.make()
        self.assertIn('physics refused, exit code 6: grain 3 &lt; wall', page)

    def test_captions_tell_the_numbers(self):
        self.write_all()
        page = self.make()
        self.assertIn(typeset('Fastest mean fall: 0.2 u_c at t = 1 t_c. Mean position from 3 D to 2.9 D.'), page)
        self.assertIn(typeset('Not at rest at the end, t = 1 t_c: the mean speed is 100 % of its maximum'), page)
        # 10 windows of 0.1 s, 0.06 s of them fluid, 0.01 s grains; 0.03 s are left.
        self.assertIn('10 windows took 1 s, 100 ms each: fluid 0.6 s (60 ms per window); grains 0.1 s '
                      '(10 ms per window); rest 0.3 s', page)

    def test_a_courant_number_beyond_the_limit_is_said_where_grains_rest(self):
        self.write_all()
        history = self.folder / 'history.csv'
        history.write_text(history.read_text().replace(
            '\n10,1,-0.2,0.2,2.9', '\n5,0.5,-0.2,0.2,2.95,,,,,\n10,1,0,0,2.9'))
        rests = typeset('At rest from t = 1 t_c on')
        page = self.make()
        self.assertIn(rests, page)
        self.assertNotIn('depends on the time step', page)
        record = self.folder / 'run.json'
        record.write_text(json.dumps(dict(json.loads(record.read_text()), warnings=[
            {'about': 'courant', 'text': 'the Courant number was up to 4.6. Use time.step = 0.1.'}])))
        page = self.make()
        self.assertIn('Warning: the Courant number was up to 4.6.', page)
        said = page[page.index(rests):]
        self.assertIn('This depends on the time step: the Courant number was up to 4.6.', said[:300])

    def test_one_output_only(self):
        self.write_all()
        self.write('history.csv', 'step,time,mean_velocity_y,mean_speed\n0,0,0,0\n')
        self.write('grains/grains.pvd', '<VTKFile><Collection><DataSet timestep="0" part="0" '
                   'file="grains_00000000.vtp"/></Collection></VTKFile>')
        self.assertIn('Status: done', self.make())
        # Fields of other times have no grains to be shown with.
        self.assertEqual(self.pictures(), ['motion-mean_speed.png', 'sequence-0.png', 'sequence.png',
                                           'settling-mean_velocity_y.png'])

    def test_dry_run(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('enabled: true', 'enabled: false'))
        self.write('history.csv', 'step,time,mean_velocity_y,wall_step,wall_fluid,wall_grains\n'
                   '0,0,0,,,\n10,1,-1,0.1,,0.05\n')
        page = self.make()
        self.assertNotIn('fluid velocity', page)
        self.assertNotIn('fluid 0', page)
        self.assertIn('grains 0.5 s', page)

    def test_columns_of_the_joint_scheme_are_shown(self):
        self.write_all()
        self.write('history.csv', 'step,time,joint_rounds,joint_mismatch\n0,0,,\n10,1,3,1e-9\n')
        self.assertIn('Joint rounds: 3 on average, 3 at most', self.make())

    def test_a_code_without_a_residual_has_springs(self):
        data = run_data.RunData(self.folder, case={'grains.adapter': 'external'})
        for residual, springs, words in (([np.nan, np.nan], True, 'Sub-steps: 20'), ([np.nan, 1e-4], False, 'Contact sweeps: 20')):
            data.history = {'time': np.arange(2.0), 'contact_iterations': np.array([np.nan, 20.0]),
                            'contact_residual': np.array(residual)}
            self.assertEqual(data.has_springs(), springs)
            self.assertIn(words, captions.solvers(data))

    def test_a_dry_run_has_no_momentum_of_a_fluid(self):
        data = run_data.RunData(self.folder, {'maxima': {'grain_balance': 1e-9, 'fluid_balance': 0.0}})
        for wet, told in (('true', 'grains 1e-09, fluid 0.'), ('false', 'grains 1e-09.')):
            data.case['fluid.enabled'] = wet
            self.assertIn(told, captions.solvers(data))

    def test_dry_grains_are_coloured_by_their_speed(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('enabled: true', 'enabled: false'))
        velocity = ('<DataArray type="Float64" Name="velocity" NumberOfComponents="3" format="ascii">'
                    '0.3 0.4 0 0 -2 0</DataArray></PointData>')
        for k in range(2):
            self.write(f'grains/grains_{k:08d}.vtp', VTP.format(y=4 - k).replace('</PointData>', velocity))
        run = run_data.load_run(self.folder)
        shown = [pictures.load(run, instant) for instant in pictures.instants(run)]
        self.assertEqual(shown[0].grains.speeds().tolist(), [0.5, 2.0])
        self.assertAlmostEqual(pictures.speed_limit(run, shown), 2.0, places=2)
        # Grains reach x = 2.9 and y = 4.5: rounded up with a margin of one D, within the box of 4 x 6.
        self.assertEqual(pictures.view(run, [picture.grains for picture in shown]), (4, 6))
        page = self.make()
        self.assertIn('Colour: speed of the grains', page)
        self.assertIn(typeset('Fastest here: 2 u_c'), page)
        self.assertEqual(self.pictures(), FIGURES)

    def test_pictures_are_cropped_where_the_box_is_mostly_empty(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        grains = [grain_files.read_grains(*one) for one in grain_files.grain_series(run)]  # up to 2.9 and 4.5 D
        self.assertEqual(pictures.view(run, grains), (4, 6))
        run.case['domain.size'] = '[40, 30]'  # with a fluid 3 D are left beyond the grains, without 1 D
        self.assertEqual(pictures.view(run, grains), (6, 8))
        self.assertEqual(captions.shown_part(run, (6, 8)), ' Shown are 6 x 8 D of the box, 40 x 30 D.')
        run.case['domain.size'] = '[8, 8]'
        self.assertEqual(pictures.view(run, grains), (8, 8))  # 6 x 8 D are more than half of it
        self.assertEqual(captions.shown_part(run, (8, 8)), '')
        run.case['fluid.enabled'] = 'false'
        self.assertEqual(pictures.view(run, grains), (4, 6))

    def test_the_largest_of_any_window_is_in_the_curve_that_tells_it(self):
        self.write_all()
        run = run_data.load_run(self.folder)
        run.record['maxima'] = {'penetration': 0.03}
        (figure, _), = [shown for shown in curves.panels(run, curves.MOTION, 'motion') if 'penetration' in shown[1]]
        line = figure.axes[0].lines[1]
        self.assertEqual((list(line.get_ydata()), line.get_linestyle()), ([0.03, 0.03], ':'))
        self.assertGreater(figure.axes[0].get_ylim()[1], 0.03)
        self.assertEqual([text.get_text() for text in figure.axes[0].get_legend().get_texts()], [curves.LARGEST])
        self.assertIn('Largest overlap of any window: 0.03 D (dotted)', captions.motion(run))
        run.record['windows_done'] = 5  # of an earlier part: the last row is that of window 10
        (figure, _), = [shown for shown in curves.panels(run, curves.MOTION, 'motion') if 'penetration' in shown[1]]
        self.assertEqual(len(figure.axes[0].lines), 1)
        self.assertEqual(captions.motion(run), 'Largest overlap of the earlier parts and the rows: 0.03 D.')
        plt.close('all')

    def test_captions_of_a_collapse(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('enabled: true', 'enabled: false').replace('sedimentation', 'avalanche')
                   .replace('[4, 6]', '[40, 6]'))
        self.write('history.csv', 'step,time,mean_velocity_norm,front_x,grains\n0,0,0,25,9\n'
                   '10,1,0.5,26,9\n20,2,0.25,29,7\n')
        page = self.make()
        self.assertIn(typeset('Largest |<u>|: 0.5 u_c at t = 1 t_c. Front from 25 D to 29 D. 2 grains left the box'), page)

    def test_a_front_at_a_wall_is_told_with_its_time(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace('[4, 6]', '[40, 6]')
                   .replace('  left: wall', '  left: wall\n  right: wall'))
        self.write('history.csv', 'step,time,mean_velocity_norm,front_x,grains\n0,0,0,25,9\n'
                   '10,1,0.5,39.999,9\n20,2,0.25,39.5,9\n')
        self.assertIn(typeset('Front from 25 D to the right wall, where it is at t = 1 t_c.'), self.make())
        # The edge of the foremost grain, half a diameter from the wall, is not there.
        self.write('history.csv', 'step,time,mean_velocity_norm,front_x,grains\n0,0,0,25,9\n10,1,0.5,39.6,9\n')
        self.assertIn(typeset('Front from 25 D to 39.6 D.'), self.make())

    def test_polygons_are_drawn_as_polygons(self):
        # The grains have ids 4 and 9; 4, at (1, 3), is a square that stands on a corner.
        self.write('grains_7.vtp', VTP.format(y=3))
        array = '<DataArray type="Float64" Name="{}" format="ascii">{}</DataArray>'
        self.write('outlines_7.vtp', '<VTKFile><PolyData><Piece><Points>'
                   + array.format('position', '1 3.5 0 0.5 3 0 1 2.5 0 1.5 3 0') + '</Points><Polys>'
                   + array.format('connectivity', '0 1 2 3') + array.format('offsets', '4')
                   + '</Polys><CellData>' + array.format('id', '4') + '</CellData></Piece></PolyData>'
                   '</VTKFile>')
        grains = grain_files.read_grains(0.0, self.folder / 'grains_7.vtp')
        self.assertEqual(list(grains.outlines), [0])
        np.testing.assert_array_equal(grains.outlines[0], [[1, 3.5], [0.5, 3], [1, 2.5], [1.5, 3]])
        figure, axes = plt.subplots()
        grain_drawing.draw(axes, grains, 1.0)
        kinds = [type(collection).__name__ for collection in axes.collections]
        self.assertEqual(kinds, ['EllipseCollection', 'PolyCollection'])
        plt.close(figure)
        # Column [1, 2] has its left half's highest corner, (1, 3.5); [0, 1] meets it at the same point.
        self.assertAlmostEqual(surface.top_of_polygon(grains.outlines[0], 0), 3.5)
        self.assertAlmostEqual(surface.top_of_polygon(grains.outlines[0], 1), 3.5)
        self.assertEqual(surface.top_of_polygon(grains.outlines[0], 2), 0.0)
        self.assertAlmostEqual(surface.top_of_polygon(grains.outlines[0] + [0.25, 0], 1), 3.5)
        self.assertAlmostEqual(surface.top_of_polygon(grains.outlines[0] + [0.25, 0], 0), 3.25)

    def test_what_reaches_through_a_cyclic_side_is_part_of_the_surface(self):
        """A square that stands on a corner at x = 0.2 D, and a disc at 3.9 D of 4 D."""
        square = np.array([[0.2, 3.5], [-0.3, 3.0], [0.2, 2.5], [0.7, 3.0]])
        grains = grain_files.Grains(0.0, np.array([[0.2, 3.0], [3.9, 1.0]]), np.array([0.5, 0.5]), outlines={0: square})
        reaching = 1.0 + np.sqrt(0.25 - 0.01)
        for side, first, last in (('wall', 3.5, 1.5), ('cyclic', 3.5, 3.3)):
            data = run_data.RunData(self.folder, case={'domain.size': '[4, 6]', 'domain.left': side})
            np.testing.assert_allclose(surface.surface(data, grains)[1], [first, 0.0, 0.0, last])
        grains = grain_files.Grains(0.0, np.array([[3.9, 1.0]]), np.array([0.5]))
        np.testing.assert_allclose(surface.surface(data, grains)[1], [reaching, 0.0, 0.0, 1.5])

    def test_parts_of_an_instant_are_one(self):
        self.write('grains/grains.pvd', '<VTKFile><Collection>'
                   '<DataSet timestep="2" part="0" file="grains_7.vtp"/>'
                   '<DataSet timestep="2" part="1" file="outlines_7.vtp"/></Collection></VTKFile>')
        (time, path), = grain_files.grain_series(run_data.load_run(self.folder))
        self.assertEqual((time, path.name), (2.0, 'grains_7.vtp'))

    def test_the_packing_is_shown_when_contacts_are_told(self):
        self.write_all()
        self.write('history.csv', 'step,time,pore_volume,coordination,sliding_share\n0,0,2,,\n'
                   '10,1,2.5,3.2,0.25\n')
        self.assertNotIn('Pores from', self.make())  # a suspension has no pores to speak of
        self.write('case.yaml', CASE.replace('  adapter:', '  generator: lattice\n  adapter:'))
        page = self.make()
        self.assertIn(typeset('Pores from 2 D^2 to 2.5 D^2 (+25 %). Sliding contacts at the end: 25 %.'), page)
        self.assertIn('packing-coordination.png', self.pictures())
        self.write('case.yaml', (self.folder / 'case.yaml').read_text() + 'contact:\n  friction: 0\n')
        self.assertNotIn('Sliding contacts', self.make())  # there is no limit to be at

    def test_rest_is_when_the_speed_stays_small(self):
        self.write('history.csv', 'step,time,mean_speed\n0,0,0\n1,1,1\n2,2,0.005\n3,3,0.02\n'
                   '4,4,0.009\n5,5,0.001\n')
        run = run_data.load_run(self.folder)
        self.assertEqual(findings.rest_time(run), 4)
        self.write('history.csv', 'step,time,mean_speed\n0,0,0\n1,1,1\n2,2,0.5\n')
        self.assertIsNone(findings.rest_time(run_data.load_run(self.folder)))

    def test_the_relaxation_time_is_where_the_acceleration_meets_the_axis(self):
        # Creeps at 0.02, from t = 4 on rises by 0.1 per t_c, from t = 7 on by less.
        times = [0.25 * n for n in range(41)]
        velocity = [0.02 + 0.1 * (min(t, 7) - 4 if t > 4 else 0) + 0.01 * max(0, t - 7) for t in times]
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        self.write('history.csv', 'step,time,mean_velocity_norm\n'
                   + ''.join(f'{n},{t},{u}\n' for n, (t, u) in enumerate(zip(times, velocity))))
        found = relaxation.relaxation(run_data.load_run(self.folder))
        self.assertAlmostEqual(found.time, 3.8, places=6)
        self.assertAlmostEqual(found.slope, 0.1, places=6)
        self.assertAlmostEqual(found.spread, 0.0, places=6)
        self.assertIn(typeset('Relaxation time 3.80 t_c'), self.make())
        self.assertIn('collapse-mean_velocity_norm.png', self.pictures())

    def test_a_run_that_ends_while_it_accelerates_bounds_the_relaxation_time(self):
        """The same onset to its end, and cut off where it becomes steeper: t_relax of what is left is too short."""
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        def cut_at(end, row=0.25):
            times = np.append(np.arange(0.0, end - 1e-6, row), end)
            velocity = 0.06 + 0.065 * (np.logaddexp(0.0, times - 20.0) - np.logaddexp(0.0, times - 24.0))
            self.write('history.csv', 'step,time,mean_velocity_norm\n'
                       + ''.join(f'{n},{t},{u}\n' for n, (t, u) in enumerate(zip(times, velocity))))
            return run_data.load_run(self.folder)
        whole, cut = cut_at(30.0), cut_at(20.5)
        self.assertIsNone(relaxation.relaxation_bound(whole))
        self.assertIsNone(relaxation.relaxation_time(cut))
        self.assertLess(relaxation.relaxation_bound(cut), relaxation.relaxation_time(whole) - 0.5)
        bound = np.floor(100.0 * relaxation.relaxation_bound(cut)) / 100.0
        self.assertIn(typeset(f'Relaxation time > {bound:.2f} t_c'), self.make())
        uneven = cut_at(20.0, row=0.26)  # its last row comes sooner than the others
        self.assertIsNone(relaxation.relaxation_time(uneven))
        self.assertIsNotNone(relaxation.relaxation_bound(uneven))

    def test_the_case_tells_the_densities_that_grains_have(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('  adapter', '  density_ratio: 1.5\n  adapter'))
        path = self.folder / 'grains/grains_00000000.vtp'
        text = path.read_text()
        told = lambda: facts.density_of(run_data.load_run(self.folder))
        self.assertEqual(told(), 'density ratio 1.5')
        for own, words in (('2 2.5', 'ratios 2 to 2.5'), ('7.8 7.8', 'ratio 7.8')):
            path.write_text(text.replace('</PointData>', '<DataArray type="Float64" Name="density" format="ascii">'
                                         f'{own}</DataArray></PointData>'))
            self.assertEqual(told(), f'density {words}')

    def test_the_case_tells_the_shapes_that_grains_have(self):
        """A file of grains names others than grains.shape."""
        self.write_all()
        self.write('case.yaml', CASE.replace('  adapter', '  shape: disc\n  adapter'))
        told = lambda: facts.kinds_of(run_data.load_run(self.folder))
        self.assertEqual(told(), '2 discs')
        record = json.loads((self.folder / 'run.json').read_text())
        shapes = [{'kind': kind, 'vertices': []} for kind in ('disc', 'triangle', 'triangle')]
        self.write('run.json', json.dumps({**record, 'shapes': shapes}))
        self.assertEqual(told(), '2 discs')  # this output has no shapes
        path = self.folder / 'grains/grains_00000000.vtp'
        text = path.read_text()
        for own, words in (('1 2', '2 triangles'), ('1 0', '1 triangle, 1 disc')):
            path.write_text(text.replace('</PointData>', '<DataArray type="Int64" Name="shape" format="ascii">'
                                         f'{own}</DataArray></PointData>'))
            self.assertEqual(told(), words)
        path.write_text(text[:300])
        self.assertEqual(told(), '2 discs')

    def test_rows_need_not_be_equally_far_apart(self):
        """As after `resume --set output.interval`, or an output on request."""
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        fine, coarse = np.arange(0.0, 2.0, 0.1), np.arange(0.0, 13.0)
        for times in (coarse, np.append(fine, np.arange(2.0, 13.0)), np.insert(coarse, 1, 0.3)):
            velocity = 0.1 * np.clip(times - 6.0, 0.0, 4.0)
            self.write('history.csv', 'step,time,mean_velocity_norm\n'
                       + ''.join(f'{n},{t},{u}\n' for n, (t, u) in enumerate(zip(times, velocity))))
            found = relaxation.relaxation(run_data.load_run(self.folder))
            self.assertAlmostEqual(found.time, 6.0, places=6)
            self.assertFalse(found.bound)
            self.assertGreaterEqual(((times >= found.begin) & (times <= found.end)).sum(), 3)

    def test_fits_over_the_same_rows_bound_nothing(self):
        """Rows 1 t_c apart: all fits are over three of them, 2 t_c. Rows 0.26 t_c apart: three to eight of them."""
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        for row, words in ((1.0, 'the rows are too far apart for fits of other lengths, which would bound it.'),
                           (0.26, 't_c with fits over 0.52 to 1.8 t_c.')):
            times = np.arange(0.0, 13.0, row)
            velocity = 0.4 / (1.0 + np.exp(6.0 - times))
            self.write('history.csv', 'step,time,mean_velocity_norm\n'
                       + ''.join(f'{n},{t},{u}\n' for n, (t, u) in enumerate(zip(times, velocity))))
            run = run_data.load_run(self.folder)
            self.assertIn(words, relaxation.caption(run))
            self.assertEqual(relaxation.relaxation(run).spread is None, row == 1.0)

    def test_rows_need_not_divide_the_length_of_the_fit(self):
        time = 0.26 * np.arange(60)
        found = relaxation.steepest(time, 0.1 * np.maximum(time - 3.0, 0.0), 1.0)
        self.assertAlmostEqual(found.time, 3.0)
        self.assertAlmostEqual(found.slope, 0.1)
        self.assertIsNone(relaxation.steepest(time[:3], time[:3], 1.0))  # shorter than the fit

    def test_nothing_is_told_of_the_end_where_the_last_row_is_empty(self):
        """All grains have left: contacts, front and means are those of no row but the last."""
        self.write_all()
        self.write('history.csv', 'step,time,mean_speed,mean_position_y,front_x,grains,coordination,sliding_share,pore_volume\n'
                   '0,0,2,3,2,2,,,5\n10,1,1,2,3,1,0.5,1,4\n20,2,0.01,1,4,1,0.5,1,4\n30,3,,,,0,,,\n')
        run = run_data.load_run(self.folder)
        told = ' '.join((captions.packing(run), captions.contact_statistics(run), captions.settling(run),
                         captions.front_caption(run), captions.rest(run)))
        for words in ('Sliding', 'Coordination', 'Mean position', 'Front', 'est at the end', 'Pores'):
            self.assertNotIn(words, told)
        self.assertIsNone(findings.rest_time(run))
        run.history = {name: values[:3] for name, values in run.history.items()}
        told = captions.packing(run) + captions.contact_statistics(run) + captions.front_caption(run)
        for words in ('Sliding contacts at the end: 100 %', 'Coordination at the end: 0.5', 'to 4 D'):
            self.assertIn(words, told)
        self.assertEqual(findings.rest_time(run), 2.0)

    def test_a_run_that_ended_after_one_row_has_a_report(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        self.write('history.csv', 'step,time,mean_velocity_norm,mean_speed,front_x\n1,0.1,0.5,0.5,2\n')
        self.write('grains/grains.pvd', '<VTKFile><Collection><DataSet timestep="0" part="0" '
                   'file="grains_00000000.vtp"/></Collection></VTKFile>')
        self.assertIsNone(relaxation.relaxation(run_data.load_run(self.folder)))
        self.assertNotIn('cannot be', self.make())

    def test_there_is_no_relaxation_time_without_a_slide(self):
        self.write_all()
        creep = 'step,time,mean_velocity_norm\n' + ''.join(f'{n},{n},{0.009 * n}\n' for n in range(11))
        self.write('history.csv', creep)
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche'))
        self.assertIsNone(relaxation.relaxation(run_data.load_run(self.folder)))
        self.write('history.csv', creep.replace('0.09', '0.9'))
        self.assertIsNotNone(relaxation.relaxation(run_data.load_run(self.folder)))
        self.write('case.yaml', CASE)
        self.assertIsNone(relaxation.relaxation(run_data.load_run(self.folder)))

    def test_pictures_end_when_the_grains_rest(self):
        times = [0, 2, 4, 6, 8, 10, 12]
        self.assertEqual(pictures._chosen(times, rest=4.0, time_scale=2.0), [0, 1, 2, 3, 4])
        self.assertEqual(pictures._chosen(times, rest=None, time_scale=2.0), [0, 1, 2, 4, 5, 6])


if __name__ == '__main__':
    unittest.main()
