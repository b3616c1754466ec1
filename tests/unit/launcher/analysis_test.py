# SPDX-License-Identifier: LGPL-2.1-or-later
"""The analysis on made-up grains, contacts and histories whose answers are known in closed form."""
import unittest
import warnings
from pathlib import Path

import numpy as np
from made_up_run import CASE, RunFolderTest

import run_data
from analysis import (coarse_grid, concentration, deposit, dilatancy, energy, packing_triangles, panels, phases,
                      pore_pressure, pores, rheology, shear_band, snapshots, waves, weight_balance)
from document.page import Page
from grain_files import Grains
from measured import MEASURED

DISC = np.pi / 4.0


def snapshot(centres, velocities=None, contacts=None, force=None, time=1.0):
    centres = np.array(centres, dtype=float)
    n = len(centres)
    return snapshots.Snapshot(time, np.arange(n), centres, np.full(n, 0.5),
                              np.zeros((n, 2)) if velocities is None else np.array(velocities, dtype=float),
                              np.full(n, DISC), force, contacts, density=1.5)


def lattice(columns, rows, spacing=1.0):
    """Triangular lattice of neighbours at this distance, from (0.5, 0.5) on."""
    return np.array([[0.5 + spacing * (i + 0.5 * (j % 2)), 0.5 + spacing * j * np.sqrt(0.75)]
                     for j in range(rows) for i in range(columns)])


def run(case=None, record=None, **history):
    data = run_data.RunData(Path('nowhere'))
    data.case = {'scales.kind': 'avalanche', 'domain.size': '[40, 30]', 'grains.density_ratio': '1.5',
                 'fluid.enabled': 'true', 'domain.right': 'free', **(case or {})}
    data.record = {'D': 1.0, 'u_c': 1.0, 't_c': 1.0, 'g': 1.0, **(record or {})}
    data.history = {name: np.array(values, dtype=float) for name, values in history.items()} or None
    return data


def with_snapshots(data, *those):
    data.measured['analysis.snapshots.snapshots'] = list(those)
    return data


class Triangles(unittest.TestCase):
    def test_pores_of_the_dense_lattice(self):
        # A triangle of three touching discs: sqrt(3)/4 - pi/8 of pores.
        mesh = packing_triangles.triangles(snapshot(lattice(8, 6)))
        inner = np.isclose(mesh.areas, np.sqrt(3) / 4)
        self.assertGreater(inner.sum(), 60)
        np.testing.assert_allclose(mesh.pores()[inner], np.sqrt(3) / 4 - np.pi / 8, atol=1e-12)

    def test_far_grains_are_not_joined(self):
        self.assertEqual(len(packing_triangles.triangles(snapshot([[0, 0], [1, 0], [0, 9], [5, 5]])).areas), 0)

    def test_lines_and_pairs_have_none(self):
        self.assertIsNone(packing_triangles.triangles(snapshot([[0, 0], [1, 0], [2, 0]])))
        self.assertIsNone(packing_triangles.triangles(snapshot([[0, 0], [1, 1]])))
        self.assertIsNone(packing_triangles.triangles(snapshot([[1, 5], [2, 6], [3, 7]])))

    def test_a_linear_field_has_its_gradient_everywhere(self):
        # u = (0.3 y, -0.1 x + 0.2 y): growth 0.2, shear hypot(-0.2, 0.2).
        places = lattice(6, 6)
        mesh = packing_triangles.triangles(snapshot(places, places @ np.array([[0.0, -0.1], [0.3, 0.2]])))
        np.testing.assert_allclose(mesh.gradients, np.tile([[0.0, 0.3], [-0.1, 0.2]], (len(mesh.areas), 1, 1)),
                                   atol=1e-12)
        np.testing.assert_allclose(mesh.dilatancy(), 0.2, atol=1e-12)
        np.testing.assert_allclose(mesh.shear_rate(), np.hypot(0.2, 0.2), atol=1e-12)


class Grids(unittest.TestCase):
    def test_sums_go_to_their_cells_and_no_others(self):
        grid = coarse_grid.Grid(3, 2, 2.0)
        sums = grid.sums(np.array([[1.0, 1.0], [1.9, 0.1], [5.0, 3.0], [6.1, 1.0], [1.0, -0.1]]), [1, 2, 4, 8, 16])
        self.assertEqual(sums.tolist(), [[3, 0, 0], [0, 0, 4]])

    def test_empty_cells_have_no_mean(self):
        means = coarse_grid.Grid(2, 1, 1.0).means(np.array([[0.5, 0.5]] * 2), np.array([1.0, 4.0]), np.array([2.0, 1.0]))
        self.assertEqual(means[0, 0], 2.0)
        self.assertTrue(np.isnan(means[0, 1]))


class Heaps(unittest.TestCase):
    x = np.arange(40) + 0.5

    def test_slope_and_extent_of_a_straight_heap(self):
        height = np.maximum(0.0, 12.0 - 0.5 * self.x)  # meets the floor at 24
        self.assertEqual(deposit.covered(height), 24)
        level, rise = deposit.fitted_line(self.x, height)
        self.assertAlmostEqual(level, 12.0)
        self.assertAlmostEqual(rise, -0.5)

    def test_single_grains_beyond_the_foot_do_not_count(self):
        height = np.maximum(0.0, 12.0 - 0.5 * self.x)
        height[35] = 1.0
        self.assertEqual(deposit.covered(height), 24)

    def test_run_out_is_over_the_first_width(self):
        found = deposit.Deposit(1.0, self.x, self.x, 10.0, 25.0, 1.0, None, None)
        self.assertEqual(found.run_out, 1.5)

    def test_a_column_that_still_stands_has_no_slope(self):
        self.assertIsNone(deposit.fitted_line(self.x, np.where(self.x < 20, 9.9 + 0.1 * np.cos(self.x), 0.0)))

    def test_a_cliff_has_no_slope(self):
        self.assertIsNone(deposit.fitted_line(self.x, np.where(self.x < 10, 9.0, 0.0)))


GRAIN = """<?xml version="1.0"?>
<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="{count}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{places}</DataArray></Points>
<PointData><DataArray type="Float64" Name="radius" format="ascii">{radii}</DataArray></PointData>
</Piece></PolyData></VTKFile>
"""


class WrittenDeposits(RunFolderTest):
    def heap(self, *columns, by=0.0, depth=None):
        """A folder with an output for each list of how many discs lie in each column of one D, moved by so much; spheres
        in the middle of so many D."""
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace('[4, 6]', '[8, 6]'))
        entries = ''
        for k, counts in enumerate(columns):
            places = [f'{i + 0.5 + by} {j + 0.5} {0.5 * depth if depth else 0}' for i, count in enumerate(counts)
                      for j in range(count)]
            self.write(f'grains/grains_{k:08d}.vtp', GRAIN.format(count=len(places), places=' '.join(places),
                                                                  radii=' '.join(len(places) * ['0.5'])))
            entries += f'<DataSet timestep="{k}" part="0" file="grains_{k:08d}.vtp"/>'
        self.write('grains/grains.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
        if depth:
            self.write('case.yaml', (self.folder / 'case.yaml').read_text().replace(
                'dimension: 2', 'dimension: 3').replace('[8, 6]', f'[8, 6, {depth}]'))
        return deposit.deposit(run_data.load_run(self.folder))

    def on_held(self, floor, *columns):
        """The same with so many columns of held discs below."""
        found = self.heap(*[[count + (i < floor) for i, count in enumerate(one + [0] * (8 - len(one)))] for one in columns])
        for path in sorted((self.folder / 'grains').glob('*.vtp')):
            text = path.read_text()
            places = text.split('format="ascii">')[1].split('<')[0].split()
            held = ' '.join('1' if y == '0.5' and float(x) < floor else '0' for x, y in zip(places[::3], places[1::3]))
            path.write_text(text.replace('</PointData>', '<DataArray type="Int64" Name="prescribed" format="ascii">'
                                         f'{held}</DataArray></PointData>'))
        del found
        return run_data.load_run(self.folder)

    def test_held_grains_are_ground_and_no_heap(self):
        free = self.heap([3, 3], [3, 2, 1])
        for floor in (0, 6, 8):
            data = self.on_held(floor, [3, 3], [3, 2, 1])
            self.assertTrue(data.is_avalanche(), floor)
            found = deposit.deposit(data)
            self.assertEqual((found.run_out, found.first_foot, found.foot), (free.run_out, 2.0, 3.0), floor)
            self.assertTrue(found.fits, floor)
        self.assertFalse(self.on_held(8, [0], [0]).is_avalanche())  # all are held
        self.assertFalse(self.on_held(8, [1], [0, 1]).is_avalanche())  # one that falls

    def test_a_sliver_in_the_next_column_is_no_column(self):
        found = self.heap([3, 3], [3, 2, 1], by=1e-4)
        np.testing.assert_allclose((found.first_foot, found.foot), (2.0001, 3.0001), rtol=0, atol=1e-12)
        found = self.heap([3, 3], [3, 2, 1, 0, 0, 1], by=-0.3)
        np.testing.assert_allclose((found.first_foot, found.foot), (1.7, 2.7), rtol=0, atol=1e-12)

    def test_lengths_are_those_of_a_column_at_the_left_side(self):
        self.assertIsNone(self.heap([0, 0, 3, 3], [0, 2, 3, 3, 2]))
        self.assertTrue(run_data.load_run(self.folder).is_avalanche())
        self.assertIsNone(self.heap([3, 3], [3, 2, 1], depth=6))  # spheres in the middle of the depth
        for side, there in (('free', False), ('cyclic', False), ('wall', True)):
            self.heap([3, 3], [3, 2, 1])
            case = (self.folder / 'case.yaml').read_text()
            self.write('case.yaml', case.replace('left: wall', f'left: {side}') if 'left: wall' in case
                       else case.replace('domain:', f'domain:\n  left: {side}'))
            self.assertEqual(deposit.deposit(run_data.load_run(self.folder)) is not None, there, side)

    def test_grains_in_a_lying_drum_are_no_column(self):
        for wall, is_column in (('cylinder,1,3,-1,0,0,9,4', False), ('cylinder,1,-1,0,0,9,0,4', True),
                                ('cylinder,7,3,-1,0,0,9,0.9', True), ('cylinder,1,1.5,-1,0,0,9,0.9', True),
                                ('plate,0,3,0,8,0,0,', True)):
            self.heap([3, 3], [3, 2, 1], depth=1)
            self.write('grains/walls.csv', f'id,kind,x,y,z,ax,ay,az,r1\n1,{wall}\n')
            self.assertEqual(run_data.load_run(self.folder).is_avalanche(), is_column, wall)

    def test_a_sphere_ends_where_it_ends(self):
        for by in (-0.3, 0.3):
            self.assertAlmostEqual(self.heap([3, 3], [3, 2, 1], by=by, depth=1).foot, 3.0 + by)

    def test_a_polygon_ends_at_its_corners(self):
        self.heap([3, 3], [3, 3])
        grains = Grains(0.0, np.array([[1.0, 0.5]]), np.array([1.0]),
                        outlines={0: np.array([[0.5, 0.0], [1.6, 0.0], [1.0, 1.0]])})
        data = run_data.load_run(self.folder)
        self.assertEqual(deposit.foot_of(data, grains, np.array([1.0, 0.5, 0.0])), 1.6)

    def test_the_side_of_the_box_ends_a_heap(self):
        found = self.heap([3, 3], [1] * 8, by=0.4)
        self.assertEqual((found.foot, found.fits), (8.0, False))
        found = self.heap([3, 3], [1] * 8, by=-0.4)
        self.assertEqual((round(found.foot, 12), found.fits), (7.6, False))

    def test_a_column_that_settles_is_no_heap(self):
        found = deposit.Deposit(1.0, np.arange(8), np.arange(8), 4.0, 4.4, 1.0, 30.0, (1.0, -0.5))
        self.assertFalse(found.is_heap)
        found.foot = 4.6
        self.assertTrue(found.is_heap)

    def test_its_feet_are_those_of_the_first_and_the_last_output(self):
        found = self.heap([3, 3], [3, 2, 1], [2, 2, 1, 1, 0, 1])
        self.assertEqual((found.first_foot, found.foot), (2.0, 4.0))
        self.assertEqual((found.run_out, found.lengthening), (1.0, 2.0))
        self.assertTrue(found.fits)

    def test_a_heap_at_the_side_of_the_box_is_told(self):
        self.assertFalse(self.heap([4, 4], [1, 1, 1, 1, 1, 1, 1, 1]).fits)

    def headings(self, *columns):
        self.heap(*columns)
        page = Page('title')
        panels.add_deposit(page, run_data.load_run(self.folder))
        return [text for _, text in page.places], ' '.join(page.parts)

    def test_a_heap_is_told_where_there_is_one(self):
        names, text = self.headings([4, 4], [4, 3, 2, 1])
        self.assertEqual(names, ['Heap'])
        self.assertIn('Heap at t', text)
        self.assertIn('slope 45°', text)
        for columns in (([4, 4], [4, 4]), ([6, 5], [6, 4, 2]), ([4, 3, 2, 1], [4, 3, 2, 1]), ([2, 2], [1, 1, 1, 1])):
            names, text = self.headings(*columns)
            self.assertEqual(names, ['Surface'], columns)
            self.assertNotIn('Heap', text)


class SlipPlanes(unittest.TestCase):
    def test_a_band_that_is_round_or_falls_to_the_wall_is_none(self):
        for angle, there in ((45.0, True), (None, False), (-30.0, False)):
            found = shear_band.ShearBand(1.0, None, None, None, None, angle, 2.0, 0.25)
            self.assertEqual(found.is_slip_plane, there)
            self.assertEqual(found.slip_angle, angle if there else None)
            self.assertEqual('falls to the right' in shear_band.caption(found), there)


class Waves(unittest.TestCase):
    def thick(self, *columns, steep=0.0):
        """So many grains of one D2 in each column of 4 D, which move to the right and, if steep, down."""
        places = [[4.0 * i + 0.5 + k % 4, 0.5 + k // 4] for i, count in enumerate(columns) for k in range(count)]
        one = snapshot(places, len(places) * [[1.0, -steep]])
        one.areas = np.ones(len(places))
        return one

    def test_height_of_the_solid(self):
        np.testing.assert_allclose(waves.thickness(run(), self.thick(8, 4, 6)), [2.0, 1.0, 1.5] + 7 * [0.0])

    def test_a_heap_has_no_crest(self):
        self.assertEqual(waves.crest(np.array([1.0, 3.0, 2.0, 2.0, 1.0, 0.0])), 0.0)

    def test_a_crest_stands_over_the_trough_behind_it(self):
        self.assertEqual(waves.crest(np.array([1.0, 5.0, 2.0, 2.5, 1.0, 3.5, 0.0])), 2.5)

    def shots(self, *those):
        for time, one in enumerate(those):
            one.time = float(time)
        return with_snapshots(run(), *those)

    def test_the_largest_of_all_times_counts(self):
        data = self.shots(self.thick(12, 4, 0), self.thick(12, 4, 8), self.thick(8, 4, 6))
        self.assertEqual(waves.largest_crest(data), 1.0)

    def test_a_trough_behind_a_block_that_slides_down_is_no_wave(self):
        data = self.shots(self.thick(12, 4, 8, steep=1.0), self.thick(8, 4, 6))
        self.assertEqual(waves.largest_crest(data), 0.5)
        self.assertIsNone(waves.largest_crest(self.shots(self.thick(12, 4, 8, steep=1.0))))
        self.assertIsNone(waves.largest_crest(with_snapshots(run())))

    def test_what_lies_at_rest_is_no_wave(self):
        data = self.shots(self.thick(12, 4, 0), self.thick(8, 4, 6), self.thick(12, 4, 8))
        for end, crest in ((0.02, 1.0), (0.005, 0.5)):
            data.history = {'time': np.arange(3.0), 'mean_speed': np.array([0.5, 1.0, end])}
            data.measured.pop('analysis.phases.phases', None)
            self.assertEqual(waves.largest_crest(data), crest)

    def test_a_trough_before_the_horizontal_phase_is_no_wave(self):
        """A block slides along the floor, its upper half flows down over the rest, then all flow on."""
        heap = self.thick(12, 4, 0)
        heap.velocities = np.array(8 * [[0.0, 0.0]] + 8 * [[1.0, -1.0]])
        data = self.shots(self.thick(12, 4, 8), heap, self.thick(8, 4, 6))
        self.assertEqual(waves.largest_crest(data), 0.5)


class PhasesOfACollapse(unittest.TestCase):
    def column(self, *velocities):
        """Eight discs on each other at 1, 2, … t_c, with these velocities from the bottom up."""
        places = [[0.5, 0.5 + k] for k in range(8)]
        return with_snapshots(run(), *[snapshot(places, there, time=float(k)) for k, there in
                                       enumerate([np.zeros((8, 2)), *velocities])])

    fall = 2 * [(1, 0)] + 4 * [(0, -1)] + 2 * [(0.1, -1)]
    heap = 4 * [(0, 0)] + 4 * [(1, -1)]
    flat = 8 * [(1, -0.1)]

    def test_one_after_the_other(self):
        found = phases.phases(self.column(self.fall, self.heap, self.flat))
        self.assertTrue(found.complete)
        self.assertEqual([one.time for one in (found.fall, found.heap, found.flat)], [1.0, 2.0, 3.0])
        self.assertAlmostEqual(found.fall.bottom, 0.0)
        self.assertAlmostEqual(found.fall.top, np.degrees(np.arctan(10.0)))
        self.assertAlmostEqual(found.heap.moving, 45.0)
        self.assertAlmostEqual(found.heap.resting, 0.5)
        self.assertAlmostEqual(found.flat.moving, np.degrees(np.arctan(0.1)))

    def test_what_creeps_in_a_heap_at_rest_is_in_no_phase(self):
        creep = 0.001 * np.array(self.fall)
        data = self.column(self.heap, self.flat, creep)
        self.assertEqual(phases.phases(data).fall.time, 3.0, 'without a history nobody knows that it rests')
        data = self.column(self.heap, self.flat, creep)
        data.history = {'time': np.arange(4.0), 'mean_speed': np.array([0.0, 1.0, 1.0, 0.001])}
        found = phases.phases(data)
        self.assertIsNone(found.fall)
        self.assertEqual((found.heap.time, found.flat.time), (1.0, 2.0))

    def test_a_heap_that_flows_on_horizontally_comes_first(self):
        later = 6 * [(0, 0)] + 2 * [(1, -1)]  # more of it rests
        found = phases.phases(self.column(self.fall, self.heap, self.flat, later))
        self.assertEqual((found.heap.time, found.flat.time), (2.0, 3.0))
        found = phases.phases(self.column(self.fall, self.heap, later))
        self.assertEqual((found.heap.time, found.flat), (3.0, None))

    def test_grains_that_have_left_have_no_direction(self):
        data = self.column(self.fall)
        last = snapshots.snapshots(data)[1]
        for name in ('ids', 'centres', 'velocities'):
            setattr(last, name, getattr(last, name)[:6])  # without the two on top
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            self.assertTrue(np.isnan(phases.moments(data)[0].top))

    def test_what_is_missing_is_told(self):
        for velocities, words in (((self.heap, self.flat), 'no free fall'), ((self.fall, self.flat), 'no heap'),
                                  ((self.fall, 8 * [(1, -1)], self.flat), 'no heap'),  # nothing rests below
                                  ((self.fall, self.heap), 'never horizontally'),
                                  ((self.fall, self.flat, self.heap), 'never horizontally')):
            found = phases.phases(self.column(*velocities))
            self.assertFalse(found.complete)
            self.assertIn(words, found.text)


class ShearBands(unittest.TestCase):
    def slide(self, angle):
        """Above a plane that falls to the right from (0, y0), grains move along it with 1; below they rest."""
        places = lattice(30, 34)
        slope = np.tan(np.radians(angle))
        above = places[:, 1] > 4.0 + slope * (30.0 - places[:, 0]) * 0.8
        along = np.array([np.cos(np.radians(angle)), -np.sin(np.radians(angle))])
        return snapshot(places, above[:, None] * along)

    def test_the_plane_of_a_sliding_block(self):
        for angle in (25.0, 45.0):
            found = shear_band.band_of(self.slide(angle), coarse_grid.Grid(27, 24, shear_band.CELL))
            # The plane of slide() falls with 0.8 tan(angle).
            self.assertAlmostEqual(found.angle, np.degrees(np.arctan(0.8 * np.tan(np.radians(angle)))), delta=2.5)
            self.assertGreater(found.elongation, 5.0)
            self.assertGreater(found.quiescent, 0.2)

    def test_it_is_looked_for_at_half_of_the_peak(self):
        """The plane is less steep there than at the peak, and at the half on the way down."""
        history = dict(time=range(6), mean_velocity_norm=[0.0, 0.2, 0.5, 1.0, 0.5, 0.2])
        at = {1: 15.0, 2: 25.0, 3: 45.0, 4: 60.0}
        shots = [self.slide(angle) for angle in at.values()]
        for shot, time in zip(shots, at):
            shot.time = float(time)
        found = shear_band.shear_band(with_snapshots(run(**history), *shots))
        self.assertEqual(found.time, 2.0)
        self.assertAlmostEqual(found.angle, np.degrees(np.arctan(0.8 * np.tan(np.radians(25.0)))), delta=2.5)
        in_space = run(case={'dimension': '3'}, **history)
        self.assertIsNone(shear_band.shear_band(with_snapshots(in_space, *shots)))

    def test_uniform_shear_has_no_band_direction(self):
        places = lattice(12, 14)
        found = shear_band.band_of(snapshot(places, places[:, ::-1] * [0.1, 0.0]), coarse_grid.Grid(9, 9, 1.5))
        self.assertIsNone(found.angle)
        np.testing.assert_allclose(found.rate[~np.isnan(found.rate)], 0.1, atol=1e-12)

    def test_rest_has_no_band(self):
        self.assertIsNone(shear_band.band_of(snapshot(lattice(6, 6)), coarse_grid.Grid(4, 4, 1.5)))

    def test_only_connected_cells_make_a_band(self):
        rate = np.array([[1.0, 0.9, 0.0, 0.95], [0.0, 0.0, 0.0, 0.0], [0.9, 0.9, 0.9, 0.0]])
        self.assertEqual(shear_band.strongest_part(rate, 0.5).tolist(),
                         [[False] * 4, [False] * 4, [True, True, True, False]])

    def test_axis_of_a_diagonal(self):
        middle, angle, ratio = shear_band.axis_of(coarse_grid.Grid(5, 5, 1.0), np.fliplr(np.eye(5)))
        self.assertAlmostEqual(angle, 45.0)  # falls to the right
        np.testing.assert_allclose(middle, [2.5, 2.5])
        self.assertGreater(ratio, 4.0)


class Pores(unittest.TestCase):
    def test_curve_of_a_column_that_dilates(self):
        data = with_snapshots(run(time=[0, 1, 2], pore_volume=[10, 11, 13], mean_position_x=[5, 5.25, 6]))
        found = pores.pore_curve(data)
        np.testing.assert_allclose(found.displacement, [0, 0.05, 0.2])
        np.testing.assert_allclose(found.change, [0, 0.1, 0.3])
        self.assertAlmostEqual(pores.change_at(data), 0.1)
        self.assertAlmostEqual(pores.change_at(data, 0.125), 0.2)

    def test_the_extreme_includes_the_end_of_the_span(self):
        data = with_snapshots(run(time=[0, 1, 2], pore_volume=[10, 10.1, 8], mean_position_x=[5, 5.1, 5.5]))
        # 0.01 at 0.02, and half-way down to -0.2 at 0.1: 0.01 - 0.21 * 0.03 / 0.08 at 0.05.
        self.assertAlmostEqual(pores.largest_change(data), 0.01 - 0.21 * 0.375)

    def test_column_that_has_not_moved_so_far(self):
        data = with_snapshots(run(time=[0, 1], pore_volume=[10, 9], mean_position_x=[5, 5.1]))
        self.assertIsNone(pores.change_at(data))
        self.assertAlmostEqual(pores.largest_change(data), -0.1)

    def test_two_regimes(self):
        moved = np.linspace(0.0, 0.4, 41)
        change = np.minimum(moved, 0.06) * 2.0 + np.maximum(moved - 0.06, 0.0) * 0.25
        found = pores.regimes(with_snapshots(run(time=range(41), pore_volume=100.0 * (1.0 + change),
                                                  mean_position_x=5.0 * (1.0 + moved))))
        self.assertAlmostEqual(found.knee, 0.06, places=6)
        self.assertAlmostEqual(found.first, 2.0, places=6)
        self.assertAlmostEqual(found.second, 0.25, places=6)

    def test_no_regimes_of_a_column_that_hardly_moves(self):
        self.assertIsNone(pores.regimes(with_snapshots(run(time=[0, 1], pore_volume=[10, 11], mean_position_x=[5, 5.1]))))

    def test_fewer_triangles_belong_to_a_packing_with_a_smaller_limit(self):
        # Two triangles of circumradius 1/sqrt(3) D, and a corner at a distance that makes a third of 0.80 D.
        corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, np.sqrt(0.75)], [1.5, np.sqrt(0.75)], [2.4, 0.2]])
        count = lambda limit: len(packing_triangles.triangles(snapshot(corners), limit).areas)
        self.assertEqual((count(0.7), count(1.0)), (2, 3))

    def test_void_ratio_of_a_stretched_lattice(self):
        # e = A/S - 1 grows from 0.1027 to 0.2158 with a spacing of 1.05.
        first, last = snapshot(lattice(20, 16)), snapshot(lattice(20, 16, 1.05))
        grid, change = pores.change_per_cell(with_snapshots(run(), first, last), last)
        e = lambda a: np.sqrt(3) / 2 * a**2 / DISC - 1.0
        self.assertAlmostEqual(change[2, 3], e(1.05) / e(1.0) - 1.0, places=9)
        self.assertTrue(np.isnan(change[-1, -1]))


class DilatancyAngles(unittest.TestCase):
    def test_shear_with_growth(self):
        # u = (0.2 y, 0.05 y): growth 0.05, rate hypot(0.05, 0.2).
        places = lattice(8, 8)
        data = with_snapshots(run(), snapshot(places, places[:, 1:] * [0.2, 0.05]))
        angles = dilatancy.dilatancy(data).angles()
        self.assertAlmostEqual(float(angles[0]), np.degrees(np.arcsin(0.05 / np.hypot(0.05, 0.2))))

    def test_the_angle_of_the_start_is_until_half_of_the_peak(self):
        """The row is at 33.33333333 t_c, with ten digits; the series of grains tells nine of another rounding."""
        data = run(time=[0, 33.33333333, 50], mean_velocity_norm=[0, 0.5, 1])
        for time, grown in ((33.3333334, 0.1), (33.34, None)):
            data.measured['analysis.dilatancy.dilatancy'] = dilatancy.Dilatancy(
                np.array([0.0, time, 50.0]), np.array([0.1, 0.1, 0.9]), np.ones(3))
            found = dilatancy.initial_angle(data)
            self.assertEqual(found is None, grown is None)
            if grown is not None:
                self.assertAlmostEqual(found, np.degrees(np.arcsin(grown)))

    def test_rest_has_none(self):
        self.assertIsNone(dilatancy.dilatancy(with_snapshots(run(), snapshot(lattice(5, 5)))))

    def test_space_has_no_triangles(self):
        places = lattice(8, 8)
        data = with_snapshots(run({'dimension': '3'}, time=[0, 1], pore_volume=[1, 2], mean_position_x=[1, 1.2]),
                              snapshot(places, places[:, 1:] * [0.2, 0.05]))
        self.assertIsNone(dilatancy.dilatancy(data))
        curve = pores.pore_curve(data)
        self.assertEqual((curve.change.tolist(), len(curve.void_change)), ([0.0, 1.0], 0))


class WrittenProbes(RunFolderTest):
    def test_are_numbered_from_one(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace(
            'grains:', 'output:\n  probes: [1, 2, 3, 0.5]  # D\ngrains:\n  density_ratio: 1.5'))
        self.write('probes.csv', 'time,pressure_1,velocity_x_1,velocity_y_1,pressure_2,velocity_x_2,velocity_y_2\n'
                   '0.5,1,0,0,-2,0,0\n1,3,0,0,4,0,0\n')
        found = pore_pressure.probes(run_data.load_run(self.folder))
        np.testing.assert_allclose(found.values, [[2, -4], [6, 8]])  # over (1.5 - 1) g D
        self.assertEqual(found.places.tolist(), [[1, 2], [3, 0.5]])

    def test_the_last_of_those_in_the_pile_is_inside(self):
        lowest = lambda: pore_pressure.extreme(run_data.load_run(self.folder), -1)
        rows = 'time,pressure_1,velocity_x_1,velocity_y_1,pressure_2,velocity_x_2,velocity_y_2\n0.5,1,0,0,-2,0,0\n'
        for places, found in (('[0.5, 0.5, 3, 0.5]', 2.0), ('[3, 0.5, 0.5, 0.5]', -4.0), ('[3, 0.5, 3, 1]', None)):
            self.write_all()
            self.write('grains/grains_00000000.vtp', GRAIN.format(count=2, places='0.5 0.5 0 0.5 1.5 0', radii='0.5 0.5'))
            self.write('grains/grains.pvd', '<VTKFile><Collection><DataSet timestep="0" part="0" '
                       'file="grains_00000000.vtp"/></Collection></VTKFile>')
            self.write('case.yaml', CASE.replace('sedimentation', 'avalanche').replace(
                'grains:', f'output:\n  probes: {places}  # D\ngrains:\n  density_ratio: 1.5'))
            self.write('probes.csv', rows)
            self.assertEqual(lowest(), found, places)

    def test_have_three_coordinates_in_space(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('dimension: 2', 'dimension: 3').replace(
            'grains:', 'output:\n  probes: [1, 2, 3, 4, 5, 6]  # D\ngrains:\n  density_ratio: 1.5'))
        self.write('probes.csv', 'time,pressure_1,velocity_x_1,velocity_y_1,velocity_z_1,pressure_2,velocity_x_2,'
                   'velocity_y_2,velocity_z_2\n0.5,1,0,0,9,-2,0,0,9\n')
        found = pore_pressure.probes(run_data.load_run(self.folder))
        np.testing.assert_allclose(found.values, [[2, -4]])
        self.assertEqual(found.places.tolist(), [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(found.names, ['(1, 2, 3) D', '(4, 5, 6) D'])

    def test_their_level_is_told_where_no_side_fixes_it(self):
        self.write_all()
        self.write('probes.csv', 'time,pressure_1,velocity_x_1,velocity_y_1\n0.5,1,0,0\n1,3,0,0\n')
        probed = CASE.replace('grains:', 'output:\n  probes: [1, 2]  # D\ngrains:\n  density_ratio: 1.5')
        for case, maps, told in ((probed, False, 'No side of the box fixes its level.'),
                                 (probed, True, 'No side of the box fixes its level; maps are relative to the upper right'),
                                 (probed.replace('left: wall', 'left: free'), True, '')):
            self.write('case.yaml', case)
            if maps:
                self.write('fluid/1/p', 'format ascii;\ninternalField uniform 2;\n')
            page = Page('title')
            panels.add_pressure(page, run_data.load_run(self.folder))
            text = ' '.join(page.parts).partition('<figcaption>')[2]
            self.assertIn(told, text)
            self.assertEqual('level' in text, bool(told))

    def test_damaged_ones_are_said(self):
        self.write_all()
        self.write('case.yaml', CASE.replace('grains:', 'output:\n  probes: [1, 2]\ngrains:\n  density_ratio: 1.5'))
        self.write('probes.csv', 'time,other\n0.5,1\n')
        data = run_data.load_run(self.folder)
        self.assertIsNone([one for one in MEASURED if one.name == 'pressure_lowest'][0].of(data))
        self.assertEqual(data.remarks, ["Lowest pressure inside the column cannot be measured: KeyError 'pressure_1'"])


class Pressures(unittest.TestCase):
    def test_bilinear_between_the_middles_of_cells(self):
        j, i = np.mgrid[0:6, 0:8]
        pressure = 2.0 * (i + 0.5) - 3.0 * (j + 0.5)  # of cells of one D
        places = np.array([[3.3, 2.7], [0.0, 5.0], [7.9, 0.1]])
        np.testing.assert_allclose(pore_pressure.at_places(pressure, places, (8, 6)),
                                   [2 * 3.3 - 3 * 2.7, 2 * 0.5 - 3 * 5.0, 2 * 7.5 - 3 * 0.5])

    def test_unit_is_the_submerged_weight_of_a_layer(self):
        self.assertAlmostEqual(pore_pressure.unit(run(record={'D': 2.0, 'g': 3.0})), 0.5 * 3.0 * 2.0)
        self.assertIsNone(pore_pressure.unit(run({'grains.density_ratio': '0.9'})))

    def test_extremes_while_a_column_starts(self):
        """Until 3 t_c, when half of the peak is reached; the last of the places is the one inside, the first row is that
        of the packing at rest."""
        data = run(time=range(7), mean_velocity_norm=[0, 0, 0, 0.5, 1, 1, 1])
        inside = np.array([99.0, -2.0, 1.0, -3.0, 50.0, -50.0, 0.0])
        data.measured['analysis.pore_pressure.probes'] = pore_pressure.Probes(
            ['a', 'b'], np.zeros((2, 2)), np.arange(7.0), np.column_stack([100.0 + inside, inside]))
        self.assertEqual(pore_pressure.while_starting(data), (-3.0, 1.0))

    def test_times_of_folders_are_those_of_rows_but_for_rounding(self):
        """The row of half of the peak is at 5 t_c, the field of it at 5.00000000008 t_c."""
        data = run(time=[0, 2.5, 5, 7.5, 10], mean_velocity_norm=[0, 0.1, 0.5, 1, 1])
        for time, highest in ((5.00000000008, 7.0), (5.0, 7.0), (4.99999999992, 7.0), (5.00001, 3.0)):
            data.measured['analysis.pore_pressure.probes'] = pore_pressure.Probes(
                ['a'], np.zeros((1, 2)), np.array([2.5, time, 7.5]), np.array([[3.0], [7.0], [9.0]]))
            self.assertEqual(pore_pressure.while_starting(data), (3.0, highest), time)

    def test_extremes_are_those_after_the_start(self):
        """Fields begin with the packing at rest, at t = 0; probes.csv does not."""
        data = run()
        for begin, lowest in ((0.0, -2.0), (0.5, -9.0)):
            data.measured['analysis.pore_pressure.probes'] = pore_pressure.Probes(
                ['a'], np.zeros((1, 2)), begin + np.arange(3.0), np.array([[-9.0], [-2.0], [3.0]]))
            self.assertEqual((pore_pressure.extreme(data, -1), pore_pressure.extreme(data, 1)), (lowest, 3.0))
        data.measured['analysis.pore_pressure.probes'] = pore_pressure.Probes(
            ['a'], np.zeros((1, 2)), np.zeros(1), np.array([[-9.0]]))
        self.assertIsNone(pore_pressure.extreme(data, 1))

    def test_a_closed_box_has_no_level(self):
        self.assertTrue(pore_pressure.has_level(run()))
        self.assertFalse(pore_pressure.has_level(run({'domain.right': 'wall'})))


def tower(lift=0.0):
    """Three discs on each other on the floor, submerged weight w each; the liquid carries `lift` of each."""
    weight = DISC * (1.0 - 1.0 / 1.5)
    ends = [[[1, 0], [1, 0.5]], [[1, 0.5], [1, 1.5]], [[1, 1.5], [1, 2.5]]]
    forces = [[0, k * weight * (1 - lift)] for k in (3, 2, 1)]
    contacts = snapshots.Contacts(np.array([-3, 0, 1]), np.array([0, 1, 2]), np.array(ends, dtype=float),
                                  np.array(forces))
    return snapshot([[1, 0.5], [1, 1.5], [1, 2.5]], contacts=contacts,
                    force=np.tile([0.0, lift * weight], (3, 1)))


class Weights(unittest.TestCase):
    def test_contacts_hand_the_weight_down(self):
        found = weight_balance.profile(run(), tower())
        np.testing.assert_allclose(found.level, [0, 1, 2])
        np.testing.assert_allclose(found.weight, [1, 2 / 3, 1 / 3])
        np.testing.assert_allclose(found.contacts, [1, 2 / 3, 1 / 3])
        np.testing.assert_allclose(found.fluid, 0, atol=1e-15)

    def test_the_liquid_takes_its_share(self):
        found = weight_balance.profile(run(), tower(0.25))
        np.testing.assert_allclose(found.contacts + found.fluid, found.weight)
        np.testing.assert_allclose(found.fluid, 0.25 * found.weight)

    def test_a_contact_listed_the_other_way_round(self):
        # b below a: the force on b is downwards, and a is the one that is held.
        one = tower()
        one.contacts.ends[1] = one.contacts.ends[1][::-1].copy()
        one.contacts.force[1] *= -1.0
        np.testing.assert_allclose(weight_balance.profile(run(), one).contacts, [1, 2 / 3, 1 / 3])

    def test_side_walls_hold_the_grains_above(self):
        # The topmost disc hangs on the left wall; the two others stand on the floor.
        weight = DISC / 3.0
        contacts = snapshots.Contacts(np.array([-3, 0, -1]), np.array([0, 1, 2]),
                                      np.array([[[1, 0], [1, 0.5]], [[1, 0.5], [1, 1.5]], [[0, 2.5], [1, 2.5]]]),
                                      np.array([[0, 2 * weight], [0, weight], [5.0, weight]]))
        one = snapshot([[1, 0.5], [1, 1.5], [1, 2.5]], contacts=contacts)
        np.testing.assert_allclose(weight_balance.profile(run(), one).contacts, [1, 2 / 3, 1 / 3])
        found = weight_balance.carriers(with_snapshots(run(), one))
        self.assertAlmostEqual(float(found.sides[0]), 1 / 3)
        self.assertAlmostEqual(float(found.rest()[0]), 0.0)

    def test_all_contacts_are_those_of_the_window(self):
        # Springs: single contacts are of the last sub-step, three times the mean force of the window.
        weight = DISC / 3.0
        contacts = snapshots.Contacts(np.array([-3]), np.array([0]), np.array([[[1, 0], [1, 0.5]]]), np.array([[0, 3 * weight]]))
        one = snapshot([[1, 0.5]], contacts=contacts)
        one.contact_force = np.array([[0.0, weight]])
        found = weight_balance.carriers(with_snapshots(run(), one))
        self.assertAlmostEqual(float(found.floor[0]), 3.0)
        self.assertAlmostEqual(float(found.contacts()[0]), 1.0)
        self.assertAlmostEqual(float(found.rest()[0]), 0.0)

    def test_walls_inside_the_box_are_no_side_walls(self):
        weight = DISC / 3.0
        for dimension, walls in (('2', (-5, -1)), ('3', (-7, -6))):
            contacts = snapshots.Contacts(np.array(walls), np.array([0, 0]), np.array(2 * [[[1, 0], [1, 0.5]]]),
                                          np.array([[0, 0.75 * weight], [0, 0.25 * weight]]))
            data = with_snapshots(run({'dimension': dimension}), snapshot([[1, 0.5]], contacts=contacts))
            found = weight_balance.carriers(data)
            self.assertAlmostEqual(float(found.inner[0]), 0.75)
            self.assertAlmostEqual(float(found.sides[0]), 0.25)
            self.assertAlmostEqual(float(found.rest()[0]), 0.0)

    def on_fixed(self, contact):
        """The tower without its lowest disc, on a fixed one that stands on the floor, beside another fixed one."""
        weight = DISC / 3.0
        first, second, ends, sign = contact
        contacts = snapshots.Contacts(np.array([-3, first, 1, -3]), np.array([0, second, 2, 3]),
                                      np.array([[[1, 0], [1, 0.5]], ends, [[1, 1.5], [1, 2.5]], [[9, 0], [9, 0.5]]]),
                                      np.array([[0, 9.0], [0, 2 * sign * weight], [0, weight], [0, 5.0]]))
        one = snapshot([[1, 0.5], [1, 1.5], [1, 2.5], [9, 0.5]], contacts=contacts,
                       force=np.array([[0, 7.0], [0, 0], [0, 0], [0, 7.0]]))
        one.prescribed = np.array([True, False, False, True])
        return one

    def test_prescribed_grains_carry_as_walls_do(self):
        for contact in ((0, 1, [[1, 0.5], [1, 1.5]], 1), (1, 0, [[1, 1.5], [1, 0.5]], -1)):
            one = self.on_fixed(contact)
            data = with_snapshots(run(time=[0, 1], mean_speed=[0, 0]), one)
            found = weight_balance.carriers(data)
            self.assertEqual((found.floor[0], found.sides[0], found.fluid[0]), (0.0, 0.0, 0.0))
            self.assertAlmostEqual(float(found.prescribed[0]), 1.0)
            self.assertAlmostEqual(weight_balance.final_defect(data), 0.0)
            self.assertAlmostEqual(weight_balance.least_on_contacts(data), 1.0)
            over_height = weight_balance.profile(data, one)
            np.testing.assert_allclose(over_height.weight, [1, 1, 0.5])
            np.testing.assert_allclose(over_height.contacts, [1, 1, 0.5])

    def test_where_all_grains_are_prescribed_nothing_weighs(self):
        one = tower()
        one.prescribed = np.ones(3, bool)
        self.assertIsNone(weight_balance.profile(run(), one))
        self.assertIsNone(weight_balance.carriers(with_snapshots(run(), one)))

    def test_grains_of_their_own_densities(self):
        one = tower()
        one.weights = DISC * np.array([1.0, 1.0, 2.0]) / 3.0
        np.testing.assert_allclose(weight_balance.profile(run(), one).weight, [1.0, 0.75, 0.5])

    def test_the_figure_is_of_the_last_output_with_grains(self):
        drawn = Page('title')
        empty = snapshot(np.empty((0, 2)), np.empty((0, 2)), time=2.0, contacts=tower().contacts)
        panels.add_weight(drawn, with_snapshots(run(), tower(), empty))
        self.assertEqual(drawn.places[0][1], 'Effective stress and weight')

    def test_the_balance_has_to_close_at_rest_only(self):
        data = with_snapshots(run(time=[0, 1], mean_speed=[0, 1e-5]), tower(0.25))
        self.assertAlmostEqual(weight_balance.final_defect(data), 0.0)
        data = with_snapshots(run(time=[0, 1], mean_speed=[0, 0.1]), tower())
        self.assertIsNone(weight_balance.final_defect(data))


class Energies(unittest.TestCase):
    def fall(self, **changed):
        """Free fall in a liquid of two thirds of the density, dt = 0.1: g' = 1/3, y moves with the new velocity."""
        gravity, step, n = 1.0 / 3.0, 0.1, np.arange(21)
        speed = gravity * step * n
        sunk = np.cumsum(speed) * step
        columns = dict(time=step * n, grains=0 * n + 7, kinetic_energy=0.5 * speed**2, potential_energy=5.0 - gravity * sunk,
                       mean_velocity_y=-speed, contact_work=np.where(n > 0, 0.0, np.nan),
                       fluid_work=np.where(n > 0, 0.0, np.nan))
        return run({'time.step': '0.1'}, **{**columns, **changed})

    def test_free_fall_closes_with_the_term_of_the_integration(self):
        found = energy.budget(self.fall())
        self.assertLess(np.abs(found.defect()).max(), 1e-12)
        # Half a step of the final speed: g' dt/2 |u|.
        self.assertAlmostEqual(found.splitting[-1], -(1 / 3) * 0.05 * (2 / 3))

    def test_unequal_grains_fall_with_their_weights(self):
        """A light grain rises by as much as a heavy one, nine times as large, sinks: the number mean of U_y is 0."""
        gravity, step, n = 1.0 / 3.0, 0.1, np.arange(21)
        speed = step * n
        def shot(k):
            one = snapshot([[0, 0], [3, 3]], [[0, -speed[k]], [0, speed[k]]], time=step * k)
            one.areas = DISC * np.array([9.0, 1.0])
            one.weights = one.areas / 3.0  # density ratio 1.5
            return one
        changed = dict(kinetic_energy=0.5 * speed**2, mean_velocity_y=0 * speed,
                       potential_energy=5.0 - 0.8 * gravity * np.cumsum(speed) * step)
        works = 0.5 * np.diff(speed**2) - 0.8 * gravity * step * 0.5 * (speed[1:] + speed[:-1])
        data = with_snapshots(self.fall(**changed, contact_work=np.append(np.nan, works)), *map(shot, (0, 10, 20)))
        self.assertLess(energy.largest_defect(data), 1e-12)
        self.assertAlmostEqual(energy.budget(data).splitting[-1], -0.8 * gravity * 0.05 * speed[-1])
        # Between snapshots their fall is not known: here it is no line.
        speed = (step * n)**2
        changed = dict(kinetic_energy=0.5 * speed**2, mean_velocity_y=0 * speed,
                       potential_energy=5.0 - 0.8 * gravity * np.cumsum(speed) * step)
        works = 0.5 * np.diff(speed**2) - 0.8 * gravity * step * 0.5 * (speed[1:] + speed[:-1])
        data = with_snapshots(self.fall(**changed, contact_work=np.append(np.nan, works)), *map(shot, (0, 10, 20)))
        self.assertLess(energy.largest_defect(data), 1e-12)
        self.assertEqual(energy.budget(data).known.nonzero()[0].tolist(), [0, 10, 20])

    def test_an_empty_box_is_no_snapshot_of_the_fall(self):
        shots = [snapshot([[0, 9]], [[0, -1]]), snapshot(np.empty((0, 2)), np.empty((0, 2)), time=2.0)]
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            self.assertLess(energy.largest_defect(with_snapshots(self.fall(), *shots)), 1e-12)

    def test_work_that_is_not_told_is_missed(self):
        work = np.append(np.nan, np.full(20, -0.01))
        self.assertGreater(energy.largest_defect(self.fall(contact_work=work)), 0.1)

    def test_only_until_a_grain_leaves(self):
        grains = np.full(21, 7.0)
        grains[12:] = 6
        self.assertEqual(len(energy.budget(self.fall(grains=grains)).time), 12)

    def test_none_before_the_second_row(self):
        grains = np.full(21, 7.0)
        grains[1:] = 6
        data = self.fall(grains=grains)
        self.assertIsNone(energy.budget(data))
        self.assertIsNone(energy.largest_defect(data))

    def test_a_cyclic_bottom_has_none(self):
        data = self.fall()
        data.case['domain.bottom'] = 'cyclic'
        self.assertIsNone(energy.budget(data))
        self.assertIsNone(energy.largest_defect(data))

    def test_driven_grains_have_none(self):
        one = snapshot([[0, 9], [3, 9]], [[0, -1], [0.5, 0]])
        for driven, found in (([False, True], False), ([False, False], True)):
            one.prescribed = np.array(driven)
            self.assertEqual(energy.budget(with_snapshots(self.fall(), one)) is not None, found)
        one.velocities[1] = 0.0
        one.prescribed = np.array([False, True])
        self.assertIsNotNone(energy.budget(with_snapshots(self.fall(), one)), 'a fixed one does no work')
        for along_z, spin in ((0.5, 0.0), (0.0, -2.0)):
            one.velocity_z, one.spins = np.array([1.0, along_z]), np.array([[0.0, 0.0, 3.0], [0.0, spin, 0.0]])
            self.assertIsNone(energy.budget(with_snapshots(self.fall(), one)))

    def test_histories_without_works_have_none(self):
        self.assertIsNone(energy.budget(run(time=[0, 1], grains=[1, 1], kinetic_energy=[0, 1])))


class Rheology(unittest.TestCase):
    def pressed(self, rate):
        """A lattice that shears, its contacts pressed so that each cell has s_yy = 2, s_xx = 1 (up to the edges)."""
        places = lattice(30, 30)
        pairs = [(i, j) for i in range(len(places)) for j in range(i + 1, min(i + 32, len(places)))
                 if abs(np.hypot(*(places[j] - places[i])) - 1.0) < 1e-9]
        branches = np.array([places[j] - places[i] for i, j in pairs])
        # sum of f (x) l over the three contacts of a grain is its area sqrt(3)/2 times the stress.
        forces = branches * np.where(np.abs(branches[:, 1:]) < 1e-9, 1.0, 0.0)
        diagonal = np.abs(branches[:, 1]) > 1e-9
        area = np.sqrt(0.75)
        forces[diagonal] = np.stack([np.zeros(diagonal.sum()), 2.0 * area / (2 * area) * np.sign(branches[diagonal, 1])], 1)
        forces[~diagonal] = np.stack([np.full((~diagonal).sum(), area), np.zeros((~diagonal).sum())], 1)
        ends = np.array([[places[i], places[j]] for i, j in pairs])
        contacts = snapshots.Contacts(np.array([i for i, _ in pairs]), np.array([j for _, j in pairs]), ends, forces)
        return snapshot(places, places[:, ::-1] * [rate, 0.0], contacts)

    def test_numbers_of_a_known_state(self):
        data = with_snapshots(run(record={'reynolds': 10.0}), self.pressed(0.3))
        found = rheology.cells(data)
        # p = 1.5, mu = 0.5/1.5, I = 0.3/sqrt(1.5), J = 0.3/(10 1.5 1.5); cells cut the contacts of their edges.
        self.assertAlmostEqual(float(np.median(found.friction)), 1 / 3, delta=0.05)
        self.assertAlmostEqual(float(np.median(found.inertial)), 0.3 / np.sqrt(1.5), delta=0.02)
        self.assertAlmostEqual(float(np.median(found.viscous)), 0.3 / 22.5, delta=0.001)
        self.assertAlmostEqual(float(np.median(found.compacity)), np.pi / (2 * np.sqrt(3)), places=6)
        self.assertAlmostEqual(rheology.friction_between(data, 0.1, 1.0), 1 / 3, delta=0.05)
        self.assertIsNone(rheology.friction_between(data, 1e-4, 1e-2))

    def test_units_follow_the_scales(self):
        # The same state told with u_c = 2 sqrt(g D): rates in u_c/D are half as large, I the same.
        there = self.pressed(0.15)
        found = rheology.cells(with_snapshots(run(record={'u_c': 2.0}), there))
        self.assertAlmostEqual(float(np.median(found.inertial)), 0.3 / np.sqrt(1.5), delta=0.02)

    def test_space_has_none(self):
        data = with_snapshots(run({'dimension': '3'}), self.pressed(0.3))
        self.assertIsNone(rheology.cells(data))
        self.assertIsNone(rheology.friction_between(data, 0.1, 1.0))


def below(height):
    """Area of a disc of one D below y = 0, its centre so high; also of one so far below the top, above that."""
    angle = np.arccos(2.0 * height)
    return 0.25 * (angle - np.sin(angle) * np.cos(angle))


class Concentrations(unittest.TestCase):
    def test_layers_cut_discs_exactly(self):
        one = snapshot([[1, 0.5], [3, 1.0]])
        np.testing.assert_allclose(concentration.in_layers(one, np.array([0.0, 1.0, 2.0])), [1.5 * DISC, 0.5 * DISC])

    def test_a_cyclic_bottom_keeps_all_solid(self):
        one = snapshot([[1, 0.1], [3, 3.0]])
        for case, solid in (({'domain.bottom': 'cyclic'}, 2 * DISC), ({}, 2 * DISC - below(0.1) - below(0.0))):
            data = with_snapshots(run({'domain.size': '[4, 3]', **case}), one)
            shares = concentration.concentration(data).shares
            self.assertAlmostEqual(float(shares.sum()) * 4, solid)
        self.assertGreater(shares[0, 2], 0.0)
        data = with_snapshots(run({'domain.size': '[4, 3]', 'domain.bottom': 'cyclic'}),
                              *(snapshot([[1, y], [3, y]]) for y in (0.2, 0.2 + 4 * 3, 0.2 - 7 * 3)))
        first, later, below_it = concentration.concentration(data).shares
        np.testing.assert_allclose([later, below_it], [first, first])

    def test_shares_of_the_box(self):
        data = with_snapshots(run({'domain.size': '[4, 3]'}), snapshot([[1, 0.5], [3, 0.5]]))
        found = concentration.concentration(data)
        np.testing.assert_allclose(found.shares, [[2 * DISC / 4, 0, 0]], atol=1e-15)
        self.assertEqual(concentration.bed(data), (1.0, found.shares[0, 0]))

    def test_a_bed_need_not_stand_on_the_floor(self):
        on_plate = snapshot([[0.5 + i, 2.5 + j] for i in range(4) for j in range(2)])
        self.assertEqual(concentration.bed(with_snapshots(run({'domain.size': '[4, 6]'}), on_plate)), (2.0, DISC))

    def test_an_empty_box_has_no_bed(self):
        data = with_snapshots(run({'domain.size': '[4, 3]', 'scales.kind': 'physical'}), snapshot([[1, 0.5]]),
                              snapshot(np.empty((0, 2)), np.empty((0, 2)), time=2.0))
        self.assertIsNone(concentration.bed(data))
        drawn = Page('title')
        panels.add_concentration(drawn, data)
        self.assertIn('At the end the box is empty.', ' '.join(drawn.parts))


class Snapshots(RunFolderTest):
    def test_damaged_outputs_are_said_and_left_out(self):
        self.write_all()
        first = self.folder / 'grains/grains_00000000.vtp'
        first.write_text(first.read_text().replace('velocity', 'other'))
        data = run_data.load_run(self.folder)
        self.assertEqual([one.time for one in snapshots.snapshots(data)], [1.0])
        self.assertEqual(data.remarks, ['grains_00000000.vtp cannot be analysed: it has no ids or no velocities'])

    def test_measured_once(self):
        self.write_all()
        data = run_data.load_run(self.folder)
        self.assertIs(snapshots.snapshots(data), snapshots.snapshots(data))
        self.assertEqual(len(snapshots.snapshots(data)), 2)

    def test_evenly_keeps_the_ends(self):
        self.assertEqual(snapshots.evenly(3), [0, 1, 2])
        chosen = snapshots.evenly(100, 5)
        self.assertEqual((chosen[0], chosen[-1], len(chosen)), (0, 99, 5))


class Table(RunFolderTest):
    def test_an_empty_box_has_no_end(self):
        data = with_snapshots(run({'scales.kind': 'physical'}, time=[0, 1, 2], mean_speed=[1, 1e-9, np.nan],
                                  front_x=[2, 3, np.nan], mean_position_y=[1, 1, np.nan], grains=[3, 3, 0]),
                              tower(), snapshot(np.empty((0, 2)), np.empty((0, 2)), time=2.0))
        told = {one.name for one in MEASURED if one.of(data) is not None}
        self.assertFalse(told & {'end_front', 'end_height', 'rest_time', 'weight_defect', 'bed_height',
                                 'bed_concentration'}, told)
        self.assertEqual(data.remarks, [])

    def test_norms_at_the_end_have_all_components_of_space(self):
        norm = {one.name: one.measure for one in MEASURED}
        flow = dict(time=[0, 1], flow_x=[np.nan, 2], flow_y=[np.nan, 3], flow_z=[np.nan, 6])
        self.assertEqual(norm['end_flow'](run(**flow)), 7.0)
        flow['flow_z'] = [np.nan, np.nan]  # in the plane
        self.assertAlmostEqual(norm['end_flow'](run(**flow)), np.sqrt(13.0))
        force = dict(time=[0, 1], fluid_force_x=[np.nan, -1], fluid_force_y=[np.nan, 4], fluid_force_z=[np.nan, 8])
        self.assertEqual(norm['end_force'](run(**force)), 9.0)
        del force['fluid_force_z']  # of versions without space
        self.assertAlmostEqual(norm['end_force'](run(**force)), np.sqrt(17.0))

    def test_every_column_is_explained(self):
        docs = Path(__file__).resolve().parents[3] / 'docs'
        text = (docs / 'studies.md').read_text() + (docs / 'analysis.md').read_text()
        for quantity in MEASURED:
            self.assertIn(f'`{quantity.name}`', text)

    def test_of_a_run_without_anything_every_cell_is_empty(self):
        data = run_data.load_run(self.folder)
        self.assertEqual({quantity.name for quantity in MEASURED if quantity.of(data) is not None}, set())

    def test_of_a_settling_run_only_what_applies(self):
        self.write_all()
        told = {quantity.name for quantity in MEASURED if quantity.of(run_data.load_run(self.folder)) is not None}
        self.assertIn('bed_height', told)
        self.assertFalse(told & {'run_out', 'slip_angle', 'pore_change', 'relaxation_time', 'friction_slow'})


if __name__ == '__main__':
    unittest.main()
