# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures and measurements of runs in space: projection, nearest surfaces, free surface, report, film."""
import json
import unittest
import warnings
import weakref

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from made_up_run import RunFolderTest
from PIL import Image

import contact_files
import film
import fluid_fields
import force_network
import grain_files
import member_pictures
import pictures
import report
import run_data
import seeds
from analysis import concentration, energy, snapshots, weight_balance
from document.page import Page
from space import ball_image, camera, chains, free_surface, scene, sequence, slice_files, slices, walls

CASE = """dimension: 3
domain:
  size: [6, 5, 4]  # D
  left: wall
  front: cyclic
grains:
  adapter: standalone-nscd
  shape: sphere
  density_ratio: 2
fluid:
  enabled: false
scales:
  kind: avalanche
"""

HISTORY = ('step,time,mean_velocity_norm,mean_speed,front_x,grains,sigma_zz,pore_volume\n'
           '0,0,0,0,2.5,3,,5\n10,1,0.2,0.2,2.5,3,0.4,6\n')


def numbers(values):
    return '\n'.join(' '.join(f'{v:.17g}' for v in np.atleast_1d(row)) for row in values)


def array(name, values, width=3):
    kind = 'Int64' if np.asarray(values).dtype.kind == 'i' else 'Float64'
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="ascii">'
            f'{numbers(values)}</DataArray>')


def poly_data(points, cells, point_data='', cell_data=''):
    return (f'<VTKFile type="PolyData"><PolyData><Piece><Points>{array("position", points)}</Points>'
            f'<Verts>{cells}</Verts><PointData>{point_data}</PointData><CellData>{cell_data}</CellData>'
            '</Piece></PolyData></VTKFile>')


PLACES = np.array([[1.0, 0.5, 1.0], [2.0, 0.5, 3.0], [1.0, 1.5, 1.0]])
RADII = np.array([0.5, 0.5, 0.5])


class SpaceRun(RunFolderTest):
    """Three spheres at two times; the third stands on the first, the first on the floor."""

    def setUp(self):
        super().setUp()
        self.write('case.yaml', CASE)
        self.write('run.json', json.dumps({'case': 'spheres', 'status': 'done', 'exit_code': 0, 'D': 1, 'u_c': 1,
                                           't_c': 1, 'g': 1, 'rho': 1, 'grains': 3}))
        self.write('history.csv', HISTORY)
        weight = 2.0 * np.pi / 6.0
        for name in ('grains', 'contacts'):
            entries = ''.join(f'<DataSet timestep="{k}" part="0" file="{name}_{k:08d}.vtp"/>' for k in range(2))
            self.write(f'grains/{name}.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
        for k in range(2):
            velocities = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [3.0, 0.0, 4.0]]) * k
            self.write(f'grains/grains_{k:08d}.vtp', poly_data(
                PLACES, '', array('id', np.arange(3), 1) + array('radius', RADII, 1) + array('velocity', velocities)))
            ends = np.array([[1.0, 0.0, 1.0], PLACES[0], PLACES[0], PLACES[2]])
            forces = np.array([[0.0, 2 * weight, 0.0], [0.0, weight, 0.0]])
            self.write(f'grains/contacts_{k:08d}.vtp', poly_data(
                ends, '', '', array('id_a', np.array([-3, 0]), 1) + array('id_b', np.array([0, 2]), 1)
                + array('normal', np.array([[0, 1.0, 0], [0, 1.0, 0]])) + array('force', forces)
                + array('normal_force', forces[:, 1], 1)))
        self.run_data = run_data.load_run(self.folder)

    def grains(self, k=1):
        return grain_files.read_grains(k, self.folder / f'grains/grains_{k:08d}.vtp')


class Liquid(SpaceRun):
    """12 x 10 x 8 cells in 6 x 5 x 4 D; cell (i, j, k) has the velocity (i, j, k)."""

    def setUp(self):
        super().setUp()
        self.write('case.yaml', CASE.replace('enabled: false', 'enabled: true\n  cells_per_diameter: 2'))
        self.k, self.j, self.i = np.mgrid[0:8, 0:10, 0:12]
        self.field(0, 0.0)
        self.field(1, 1.0)
        self.run_data = run_data.load_run(self.folder)

    def field(self, time, factor):
        values = factor * np.stack([self.i, self.j, self.k], axis=-1).reshape(-1, 3).astype('<f8')
        self.write(f'fluid/{time}/U', b'format binary;\ninternalField nonuniform List<vector> \n%d\n(' % len(values)
                   + values.tobytes() + b')\n;\n')

    def test_motion_of_the_liquid_has_a_point_per_field(self):
        """The liquid sees radii of 0.8 * 0.5 + 0.3/2 D. Two of the three spheres move, with 3 and 5 u_c."""
        self.write('case.yaml', CASE.replace('enabled: false', 'enabled: true\n  cells_per_diameter: 2\n'
                                             '  hydrodynamic_radius: 0.8\n  surface_shift: 0.3'))
        data = run_data.load_run(self.folder)
        times, values = energy.fluid_kinetic(data)
        self.assertEqual(times.tolist(), [0.0, 1.0])
        mass = 3 * np.pi / 6 * 2.0
        whole = 0.5 * 0.5**3 * (self.i**2 + self.j**2 + self.k**2).sum() / mass
        np.testing.assert_allclose(values, [0.0, whole - 0.5 * 4 / 3 * np.pi * 0.55**3 * (9 + 25) / mass])
        self.assertEqual(data.remarks, [])

    def test_fields_of_the_box_program_count_by_their_heights(self):
        edges = [np.array(along, dtype='<f4') for along in ([0, 1, 2], [0, 1, 3], [0, 1])]
        velocity = np.arange(12, dtype='<f4').reshape(1, 2, 2, 3)  # z, y, x
        self.write('fluid/fields/fields_00000002.vtr',
                   rectilinear_file({'x': edges[0], 'y': edges[1], 'z': edges[2], 'U': velocity.ravel()}))
        self.write('fluid/fields/fields.pvd', '<VTKFile><Collection><DataSet timestep="0.5" part="0" '
                   'file="fields_00000002.vtr"/></Collection></VTKFile>')
        data = run_data.load_run(self.folder)
        data.record['fluid_program'] = 'box'
        [(time, path)] = fluid_fields.field_times(data)
        self.assertEqual(time, 0.5)
        index = self.folder / 'fluid/fields/fields.pvd'
        whole = index.read_text()
        index.write_text(whole[:whole.index('</Coll')])
        self.assertEqual(fluid_fields.field_times(data), [(time, path)])
        self.assertIn('fluid/fields/fields.pvd is cut off or damaged after 1 whole entries', data.remarks[-1])
        rows = (velocity**2).sum(axis=-1).mean(axis=(0, 2))
        self.assertAlmostEqual(fluid_fields.mean_square_velocity(data, time, path), (rows[0] + 2 * rows[1]) / 3)

    def test_a_damaged_field_is_said(self):
        self.write('fluid/1/U', b'format binary;\ninternalField nonuniform List<vector> \n3\n(')
        data = run_data.load_run(self.folder)
        self.assertEqual(len(energy.fluid_kinetic(data)[0]), 1)
        self.assertEqual(data.remarks, ['Velocity of the liquid at 1: U is cut off'])

    def test_stretched_rows_count_by_their_heights(self):
        self.write('case.yaml', CASE.replace('enabled: false', 'enabled: true\n  cells_per_diameter: 2\n'
                                             '  stretch_ratio: 1.2'))
        heights = np.array([0.5] * 8 + [0.6, 0.4])
        z, y, x = np.meshgrid(np.arange(9) / 2, np.concatenate([[0], heights.cumsum()]), np.arange(13) / 2,
                              indexing='ij')
        points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
        self.write('fluid/constant/polyMesh/points',
                   b'FoamFile\n{\n format binary;\n}\n\n\n%d\n(' % len(points) + points.astype('<f8').tobytes() + b')')
        found = fluid_fields.mean_square_velocity(run_data.load_run(self.folder), 1, self.folder / 'fluid/1')
        rows = (self.i**2 + self.j**2 + self.k**2).mean(axis=(0, 2))
        self.assertAlmostEqual(found, (rows * heights).sum() / 5.0)

    def test_grains_are_coloured_and_the_caption_says_so(self):
        shown = [pictures.load(self.run_data, instant) for instant in pictures.instants(self.run_data)]
        self.assertIn('Colour: speed of the grains', report.captions.sequence(self.run_data, shown))
        self.assertNotIn('velocity of the fluid', report.captions.sequence(self.run_data, shown))
        self.assertEqual(self.run_data.remarks, [])


EDGES = [np.arange(13) / 2, np.arange(11) / 2, np.arange(9) / 2]  # of 6 x 5 x 4 D at two cells per D


def slice_file(axis, place):
    """As the fluid program writes it: p is the number of the cell, x fastest, and U = (x, y, z) of its centre."""
    edges = [np.array([place]) if other == axis else EDGES[other] for other in range(3)]
    middles = [along if len(along) == 1 else 0.5 * (along[1:] + along[:-1]) for along in edges]
    z, y, x = np.meshgrid(*middles[::-1], indexing='ij')
    places = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    arrays = {'x': edges[0], 'y': edges[1], 'z': edges[2], 'p': np.arange(len(places)), 'U': places,
              'covered': np.zeros(len(places))}
    return rectilinear_file(arrays)


def rectilinear_file(arrays):
    """{name: numbers} as the fluid programs write them."""
    head, data = '', b''
    for name, values in arrays.items():
        head += f'<DataArray type="Float32" Name="{name}" NumberOfComponents="1" format="appended" offset="{len(data)}"/>\n'
        raw = np.asarray(values).astype('<f4').tobytes()
        data += len(raw).to_bytes(8, 'little') + raw
    return (f'<VTKFile>{head}<AppendedData encoding="raw">\n_'.encode() + data + b'\n</AppendedData>\n</VTKFile>\n')


class Slices(SpaceRun):
    """Planes z = 1.25 and x = 2 at t = 1."""

    def setUp(self):
        super().setUp()
        self.write('case.yaml', CASE.replace('enabled: false', 'enabled: true\n  cells_per_diameter: 2'))
        self.write('fluid/slices/z1.25_00000010.vtr', slice_file(2, 1.25))
        self.write('fluid/slices/x2_00000010.vtr', slice_file(0, 2.0))
        entries = ''.join(f'<DataSet timestep="1" part="{k}" file="{name}_00000010.vtr"/>'
                          for k, name in enumerate(('z1.25', 'x2')))
        self.write('fluid/slices/slices.pvd', f'<VTKFile><Collection>{entries}</Collection></VTKFile>')
        self.run_data = run_data.load_run(self.folder)
        self.z, self.x = (slice_files.read(*plane[0]) for plane in slice_files.series(self.run_data))

    def test_rows_are_upwards_whatever_the_axis(self):
        self.assertEqual((self.z.axis, self.z.place, self.z.pressure.shape), (2, 1.25, (10, 12)))
        self.assertEqual((self.x.axis, self.x.place, self.x.pressure.shape), (0, 2.0, (10, 8)))
        self.assertEqual(self.z.pressure[3, 5], 3 * 12 + 5)
        self.assertEqual(self.x.pressure[3, 5], 3 + 10 * 5)  # y runs fastest in the file
        np.testing.assert_allclose(self.z.velocity[3, 5], [2.75, 1.75, 1.25])
        np.testing.assert_allclose(self.x.velocity[3, 5], [2.0, 1.75, 2.75])

    def test_panels_show_the_vertical_velocity_with_rows_upwards(self):
        figure = slices.velocity_panel(self.run_data, self.z, self.grains(), 5.0)
        image = figure.axes[0].images[0]
        self.assertEqual((image.origin, float(image.get_array()[3, 5])), ('lower', 1.75))
        self.z.covered[0] = 1.0
        free = self.z.pressure[1:].mean()
        self.assertAlmostEqual(float(slices.level_free(self.z)[3, 5]), 41 - free)
        plt.close('all')

    def test_cells_count_by_their_area(self):
        """Ten rows, the uppermost as high as the nine below it together: half of the plane."""
        rows = np.append(np.linspace(0.0, 2.5, 10), 5.0)
        self.z.edges = [self.z.edges[0], rows]
        self.z.covered[:] = 0.0
        self.z.pressure[:] = np.repeat([0.0, 4.0], [9, 1])[:, None]
        np.testing.assert_allclose(slices.level_free(self.z)[[0, -1], 0], [-2.0, 2.0])
        self.z.velocity[..., 1] = np.repeat([0.0, 1.0], [9, 1])[:, None]
        self.assertEqual(slices.quantile(self.z.velocity[..., 1], slices.areas(self.z), 0.6), 1.0)
        values = np.random.default_rng(1).normal(size=(3, 5))
        self.assertAlmostEqual(slices.quantile(values, np.full((3, 5), 0.2), 0.9), np.quantile(values, 0.9))
        self.assertEqual(slices.quantile(np.array([3.0]), np.array([0.1]), 0.9), 3.0)

    def test_side_views_have_the_floor_below(self):
        frame = scene.frame(self.run_data, [self.grains()], camera.SIDE)
        figure = sequence.panel(self.run_data, frame, self.grains(), 5.0)
        image = figure.axes[0].images[0]
        self.assertEqual(image.origin, 'lower')
        plt.close('all')

    def test_spheres_are_cut(self):
        cut = slices.cut_grains(self.run_data, self.z, self.grains())
        np.testing.assert_allclose(cut.centres, [[1.0, 0.5], [1.0, 1.5]])
        np.testing.assert_allclose(cut.radii, [np.sqrt(0.25 - 0.0625)] * 2)
        self.x.place = 2.3
        np.testing.assert_allclose(slices.cut_grains(self.run_data, self.x, self.grains()).centres, [[3.0, 0.5]])
        self.z.place = 3.9  # a cyclic side lies between this plane and a sphere at z = 0.1
        grains = self.grains()
        grains.z = np.array([0.1, 2.0, 2.0])
        np.testing.assert_allclose(slices.cut_grains(self.run_data, self.z, grains).radii, [np.sqrt(0.25 - 0.04)])

    def test_a_sphere_through_a_cyclic_side_is_cut_at_both(self):
        grains = self.grains()
        grains.z = np.array([0.1, 2.0, 3.9])
        self.x.place = 1.0  # z, which is cyclic, is in this plane
        cut = slices.cut_grains(self.run_data, self.x, grains)
        across = [0, 1][(self.x.across, self.x.up).index(2)]
        places = sorted(cut.centres[:, across])
        np.testing.assert_allclose(places, [-0.1, 0.1, 3.9, 4.1])
        self.assertEqual(len(cut.radii), 4)

    def test_the_report_has_a_picture_of_each_plane(self):
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        names = [path.name for path in sorted((self.folder / 'pictures').glob('slice*'))]
        self.assertEqual(names, ['slice-0.png', 'slice-1.png', 'slice-pressure-0.png'])
        self.assertIn('Planes x = 2 D, z = 1.25 D', (self.folder / 'report.html').read_text())

    def test_walls_inside_are_what_spheres_do_not_cover(self):
        self.z.covered[:, 2:4] = 1.0   # 1 D < x < 2 D, where two of the spheres' right halves are
        self.assertIsNone(slices.walls_share(self.run_data, self.z, self.grains()))
        self.run_data.case['domain.walls_file'] = '~'
        self.assertIsNone(slices.walls_share(self.run_data, self.z, self.grains()))
        self.assertNotIn('walls', slices.caption(self.run_data, [(self.z, None)]))
        self.run_data.case['domain.walls_file'] = 'walls.csv'
        self.assertIn('walls (grey)', slices.caption(self.run_data, [(self.z, None)]))
        np.testing.assert_allclose(slices.walls_share(self.run_data, self.z, None), self.z.covered)
        share = slices.walls_share(self.run_data, self.z, self.grains())
        self.assertEqual(share[1, 2], 0.0)    # (1.25, 0.75) D, beside a sphere's centre at (1, 0.5) D
        self.assertEqual(share[8, 2], 1.0)
        self.assertEqual(share[8, 5], 0.0)

    def test_a_damaged_one_is_said(self):
        whole = slice_file(2, 1.25)
        self.write('fluid/slices/z1.25_00000010.vtr', whole[:-400])
        report.make_page(self.run_data)
        self.assertIn('Slice at 1: z1.25_00000010.vtr is cut off', self.run_data.remarks)


class Files(SpaceRun):
    def test_all_three_coordinates_are_read(self):
        np.testing.assert_array_equal(self.grains().positions(), PLACES)
        np.testing.assert_allclose(self.grains().speeds(), [0.0, 3.0, 5.0])

    def test_the_box_has_a_depth(self):
        self.assertEqual((self.run_data.size(), self.run_data.depth()), ([6.0, 5.0], 4.0))

    def test_forces_are_over_the_weight_of_a_cube(self):
        network = contact_files.networks(self.run_data)[-1]
        np.testing.assert_allclose(network.forces, [np.pi / 3.0, np.pi / 6.0])
        self.assertEqual(network.ends.shape, (2, 2, 3))
        self.assertIn('rho_s g D^3', report.captions.force_network(self.run_data, [network]))

    def test_the_column_that_stands_is_carried_by_the_floor(self):
        found = weight_balance.carriers(self.run_data)
        np.testing.assert_allclose(found.floor, 2.0 / 3.0)  # of three spheres; the other one floats
        np.testing.assert_allclose(snapshots.snapshots(self.run_data)[0].areas, np.pi / 6.0)

    def test_concentration_counts_volumes_of_spheres(self):
        found = concentration.concentration(self.run_data)
        np.testing.assert_allclose(found.shares[0][:3] * 6.0 * 4.0, [np.pi / 3.0, np.pi / 6.0, 0.0], atol=1e-12)
        # A third of the radius below the top: s = 2/3.
        self.assertAlmostEqual(concentration.volume_below(0.0, 1.0, 2.0 / 3.0),
                               np.pi * (2 / 3 + 2 / 3 - 8 / 81), places=12)


WALLS = """id,kind,x,y,z,ax,ay,az,bx,by,bz,r1,r2,px,py,pz,wx,wy,wz,motion
1,cylinder,3,0,2,0,4,0,,,,2,,3,0,2,0,0,0,
2,cone,3,0,2,0,-1,0,,,,2,1,3,0,2,0,0,0,
3,ring,3,1,2,0,1,0,,,,0,1,3,1,2,0,0,0,gate
4,plate,3,2,1,2,0,0,0,0,2,,,4,2,2,0,1,0,
"""
GATE = '  motions.gate.kind: table\n  motions.gate.table: [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, -4, 0]  # t_c, D, D\n'


class Walls(SpaceRun):
    def setUp(self):
        super().setUp()
        self.write('case.yaml', CASE.replace('domain:\n', 'domain:\n' + GATE))
        self.write('grains/walls.csv', WALLS)
        self.run_data = run_data.load_run(self.folder)
        self.walls = grain_files.walls_of(self.run_data)

    def test_rims_lie_on_the_surface(self):
        for wall, radii, heights in zip(self.walls, ((2, 2), (2, 1), (1,)), ((0, 4), (0, -1), (1,))):
            rims = [line for line, _ in walls.lines(wall) if len(line) > 2]
            self.assertEqual(len(rims), len(radii))
            for rim, radius, height in zip(rims, radii, heights):
                np.testing.assert_allclose(np.hypot(rim[:, 0] - 3, rim[:, 2] - 2), radius)
                np.testing.assert_allclose(rim[:, 1], height)

    def test_lines_along_a_shell_join_its_rims(self):
        along = [line for line, _ in walls.lines(self.walls[1]) if len(line) == 2]
        self.assertEqual(len(along), walls.LENGTHWISE)
        for line in along:
            np.testing.assert_allclose(np.hypot(line[:, 0] - 3, line[:, 2] - 2), [2, 1])

    def test_walls_are_drawn_where_they_are(self):
        line, outwards = walls.lines(self.walls[2])[0]
        for time, level in ((0.5, 1.0), (1.5, -1.0), (9.0, -3.0)):
            np.testing.assert_allclose(walls.placed(self.run_data, self.walls[2], time, line, outwards)[0][:, 1], level)
        corners, outwards = walls.lines(self.walls[3])[0]
        turned, _ = walls.placed(self.run_data, self.walls[3], np.pi / 2, corners, outwards)
        np.testing.assert_allclose(turned[0], [3, 2, 3], atol=1e-12)  # a quarter turn about y

    def test_a_picture_has_them_before_and_behind_the_grains(self):
        frame = scene.frame(self.run_data, [self.grains()], camera.OBLIQUE)
        self.assertEqual(frame.box[1], 5.0)  # all of the cylinder
        _, axes, _ = scene.axes_for(frame)
        walls.draw(axes, self.run_data, frame, 0.0)
        behind, before = [len(lines.get_segments()) for lines in axes.collections]
        self.assertGreater(behind, 100)
        self.assertGreater(before, 100)

    def test_a_comparison_has_the_pictures_of_space(self):
        """Walls that move as space has it, and spheres in the colours of their speed, with a fluid too."""
        for wet in ('false', 'true'):
            text = (self.folder / 'case.yaml').read_text().replace('enabled: false', f'enabled: {wet}')
            self.write('case.yaml', text)
            data = [run_data.load_run(self.folder) for _ in range(2)]
            members = [seeds.Member(name, run, [run]) for name, run in zip('ab', data)]
            page = Page('x')
            with warnings.catch_warnings():
                warnings.simplefilter('error')
                member_pictures.add(page, members)
            self.assertIn('One scale of colours for all.', page.text())
            limit = member_pictures.common_limit([(run, [member_pictures.last(run)]) for run in data])
            self.assertAlmostEqual(limit, 5.0, delta=0.01)
            [figure, name] = member_pictures.side_by_side(data[0], [pictures.Picture(1.0, self.grains(), None)], 5.0)[0]
            self.assertEqual(name, 'sequence-0')
            self.assertIn('Obliquely', figure.get_label())
            self.assertGreater(sum(len(lines.get_segments()) for lines in figure.axes[0].collections), 200, 'walls')


class FreeSurface(SpaceRun):
    def test_is_the_top_of_the_highest_sphere_of_each_column(self):
        found = free_surface.heights(self.run_data, self.grains())
        self.assertEqual(found.shape, (6, 4))
        # The spheres at (1, 1) touch four columns each, with their centre on the common corner.
        np.testing.assert_allclose(found[:2, :2], 2.0)
        np.testing.assert_allclose(found[1:3, 2:4].ravel(), 1.0)
        self.assertEqual(found[3:].max(), 0.0)

    def test_single_spheres_are_bare_floor(self):
        x, height = free_surface.over_length(self.run_data, self.grains())
        np.testing.assert_allclose(height[:3], [1.0, 1.5, 0.5])  # means of (2, 2, 0, 0), (2, 2, 1, 1), (0, 0, 1, 1)
        beyond = self.grains()
        beyond.radii = np.array([0.4, 0.4, 0.4])
        self.assertEqual(free_surface.over_length(self.run_data, beyond)[1][2], 0.0)  # mean 0.45

    def spheres(self, *places):
        places = np.array(places, dtype=float)
        return grain_files.Grains(0.0, places[:, :2], np.full(len(places), 0.5), z=places[:, 2])

    def test_a_flat_layer_is_flat_whatever_the_depth_and_the_shift(self):
        """5.5 D high, of 3 spheres over a depth of 3.5 D, of 6 over 6.5 D: columns between them have 5.4 D."""
        for depth in (3.5, 6.5):
            self.run_data.case['domain.size'] = f'[6, 8, {depth}]'
            for shift in np.arange(0.0, depth, 0.05):
                layer = self.spheres(*((x + 0.5, 5.0, (z + shift) % depth) for x in range(6)
                                       for z in np.arange(int(depth)) * depth / int(depth)))
                np.testing.assert_allclose(free_surface.over_length(self.run_data, layer)[1], 5.5, atol=0.03)

    def test_the_last_column_counts_as_wide_as_it_is(self):
        """Spheres that fill all of 3.5 D but the last half."""
        self.run_data.case['domain.size'] = '[6, 8, 3.5]'
        self.run_data.case['domain.front'] = 'wall'
        rows = self.spheres(*((1.5, 5.0, z) for z in (0.5, 1.5, 2.5)))
        self.assertAlmostEqual(free_surface.over_length(self.run_data, rows)[1][1], 5.5 * 3.0 / 3.5)

    def test_what_reaches_through_a_cyclic_side_is_there(self):
        self.run_data.case['domain.size'] = '[6, 8, 3.5]'
        beyond = 2.0 + np.sqrt(0.25 - 0.01)  # 0.1 D from the side
        for case, cells in (({'domain.front': 'cyclic', 'domain.left': 'wall'}, [(0, 0), (0, 3)]),
                            ({'domain.front': 'wall', 'domain.left': 'cyclic'}, [(0, 0), (5, 0)]),
                            ({'domain.front': 'wall', 'domain.left': 'wall'}, [(0, 0)])):
            self.run_data.case.update(case)
            found = free_surface.heights(self.run_data, self.spheres((0.1, 2.0, 0.1)))
            self.assertEqual(sorted(zip(*(place.tolist() for place in np.nonzero(found)))), cells)
            np.testing.assert_allclose(found[found > 0.0], [2.5, beyond][:len(cells)])
        self.run_data.case.update({'domain.front': 'cyclic', 'domain.left': 'cyclic'})
        corner = free_surface.heights(self.run_data, self.spheres((0.1, 2.0, 0.1)))
        np.testing.assert_allclose(corner[[0, 5, 0, 5], [0, 0, 3, 3]], [2.5, beyond, beyond, 2.0 + np.sqrt(0.25 - 0.02)])
        far = free_surface.heights(self.run_data, self.spheres((5.9, 2.0, 3.4)))
        np.testing.assert_allclose(far[[5, 5, 0, 0], [3, 0, 3, 0]], [2.5, beyond, beyond, 2.0 + np.sqrt(0.25 - 0.02)])

    def test_a_shift_by_a_column_changes_no_mean(self):
        for k in range(4):
            one = self.spheres((1.5, 2.0, 0.1 + k))
            np.testing.assert_allclose(free_surface.over_length(self.run_data, one)[1][1], (2.5 + 2.0 + np.sqrt(0.24)) / 4.0)


class Projection(unittest.TestCase):
    def test_axes_are_right_handed_and_of_length_one(self):
        axes = camera.OBLIQUE.axes()
        np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-15)
        np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-15)

    def test_from_the_side_x_is_right_and_y_up(self):
        np.testing.assert_allclose(camera.SIDE.seen([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0])

    def test_an_oblique_view_shows_the_right_end_and_the_top(self):
        x, y, z = camera.OBLIQUE.seen(np.eye(3))
        self.assertGreater(x[2], 0.0)
        self.assertGreater(y[2], 0.0)
        self.assertGreater(y[1], 0.9)


class NearestSurface(unittest.TestCase):
    EXTENT = (-2.0, 2.0, -2.0, 2.0)

    def test_a_sphere_covers_its_disc(self):
        found = ball_image.surfaces(np.array([[0.3, -0.2, 5.0]]), np.array([0.7]), self.EXTENT, 100.0)
        self.assertAlmostEqual((found.owner == 0).sum() / 1e4, np.pi * 0.49, delta=0.01)
        self.assertAlmostEqual(found.depth.max(), 5.7, delta=1e-3)
        rows, columns = np.nonzero(found.owner == 0)
        self.assertAlmostEqual(columns.mean() / 100.0 - 2.0, 0.3, delta=0.01)
        self.assertAlmostEqual(rows.mean() / 100.0 - 2.0, -0.2, delta=0.01)

    def test_the_nearer_surface_stays_whatever_the_order_and_the_sizes(self):
        # A small sphere in front of the rim of a large one whose centre is nearer.
        seen, radii = np.array([[0.0, 0.0, 0.0], [0.9, 0.0, -0.2]]), np.array([1.0, 0.7])
        for order in ([0, 1], [1, 0]):
            found = ball_image.surfaces(seen[order], radii[order], self.EXTENT, 50.0)
            owner = np.array(order)[found.owner[100]]  # the row through both centres
            self.assertEqual(owner[100 + int(0.2 * 50)], 0)
            self.assertEqual(owner[100 + int(0.95 * 50)], 1)

    def test_what_is_outside_of_the_picture_is_left_out(self):
        found = ball_image.surfaces(np.array([[5.0, 0.0, 0.0], [-2.0, 0.0, 0.0]]), np.array([0.5, 0.5]), self.EXTENT,
                                    50.0)
        self.assertNotIn(0, found.owner)
        self.assertAlmostEqual((found.owner == 1).sum() / 2500.0, np.pi / 8.0, delta=0.02)

    def test_many_spheres_are_marked_in_parts(self):
        rng = np.random.default_rng(3)
        seen, radii = rng.uniform(-2, 2, (300, 3)), np.full(300, 0.2)
        whole = ball_image.surfaces(seen, radii, self.EXTENT, 40.0)
        chunk, ball_image.CHUNK = ball_image.CHUNK, 2000
        self.addCleanup(setattr, ball_image, 'CHUNK', chunk)
        parts = ball_image.surfaces(seen, radii, self.EXTENT, 40.0)
        np.testing.assert_array_equal(whole.owner, parts.owner)

    def test_light_comes_from_above_and_the_left(self):
        found = ball_image.surfaces(np.zeros((1, 3)), np.array([1.5]), self.EXTENT, 50.0)
        image = ball_image.shaded(found, np.array([[1.0, 1.0, 1.0]]), 75.0)
        self.assertGreater(image[150, 80, 0], image[50, 120, 0])
        self.assertEqual(image[0, 0, 3], 0.0)

    def test_what_lies_deeper_than_its_surroundings_is_darker(self):
        # A sphere in the middle of a layer of spheres, one radius below them.
        places = np.array([[i, j, 0.0] for i in range(-2, 3) for j in range(-2, 3)], dtype=float)
        flat = places.copy()
        places[12, 2] = -0.5
        light = []
        for seen in (flat, places):
            found = ball_image.surfaces(seen, np.full(25, 0.5), (-2.5, 2.5, -2.5, 2.5), 30.0)
            light.append(ball_image.shaded(found, np.ones((25, 3)), 15.0)[75, 75, 0])
        self.assertLess(light[1], 0.9 * light[0])

    def test_halving_does_not_darken_edges(self):
        image = np.zeros((2, 2, 4))
        image[0, 0] = (1.0, 0.5, 0.0, 1.0)
        np.testing.assert_allclose(ball_image.halved(image)[0, 0], [1.0, 0.5, 0.0, 0.25])


class Chains(unittest.TestCase):
    def network(self, normals, forces=None):
        count = len(normals)
        forces = np.ones(count) if forces is None else forces
        return force_network.Network(1.0, None, np.zeros((count, 2, 3)), normals, forces, np.ones(count, dtype=bool))

    def test_directions_of_no_preference_are_even(self):
        normals = np.random.default_rng(1).normal(size=(20000, 3))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        _, density = chains.steepness(self.network(normals))
        np.testing.assert_allclose(density, 1.0, atol=0.15)

    def test_weak_contacts_are_left_out(self):
        forces = np.array([1.0] * 9 + [11.0])  # mean 2
        drawn = chains.lines(camera.OBLIQUE, self.network(np.tile([0.0, 1.0, 0.0], (10, 1)), forces), 11.0)
        self.assertEqual(len(drawn.get_segments()), 1)


class Report(SpaceRun):
    def test_has_pictures_from_two_sides_and_the_measurements_of_space(self):
        self.assertEqual(report.main(['report.py', str(self.folder)]), 0)
        names = {path.stem for path in (self.folder / 'pictures').iterdir()}
        self.assertLessEqual({'sequence-0', 'sequence-1', 'side-0', 'side-1', 'force_network-0', 'heap', 'weight',
                              'packing-sigma_zz'}, names)
        self.assertFalse({'shear', 'pores', 'friction_inertial'} & names)
        page = (self.folder / 'report.html').read_text()
        self.assertIn('front cyclic', page)
        self.assertNotIn('Remarks', page)

    def test_pictures_show_the_grains_in_colours_of_their_speed(self):
        frame = scene.frame(self.run_data, [self.grains()], camera.SIDE)
        image = scene.image_of(frame, self.run_data, self.grains(),
                               scene.colours_of(self.grains().speeds(), 5.0, 'viridis'))
        seen = lambda x, y: image[int((y + scene.MARGIN) * frame.pixels_per_length),
                                  int((x + scene.MARGIN) * frame.pixels_per_length)]
        fast, slow = seen(1.0, 1.5), seen(1.0, 0.5)
        self.assertGreater(fast[0], 2.0 * fast[2])  # yellow
        self.assertGreater(slow[2], slow[1])        # violet
        self.assertEqual(seen(0.2, 3.0)[3], 0.0)

    def test_a_film_has_a_picture_of_every_output(self):
        self.assertEqual(film.main(['film.py', str(self.folder)]), 0)
        with Image.open(self.folder / 'film.webp') as shown:
            self.assertEqual(shown.n_frames, 2)

    def test_a_run_without_outputs_has_no_film(self):
        (self.folder / 'grains/grains.pvd').unlink()
        self.assertEqual(film.main(['film.py', str(self.folder)]), 2)
        self.assertFalse((self.folder / 'film.webp').exists())


    def test_no_more_than_a_few_pictures_are_in_the_memory_at_once(self):
        made, alive = [], []

        def images():
            for k in range(40):
                image = Image.new('RGB', (8, 8), (6 * k, 0, 0))
                made.append(weakref.ref(image))
                alive.append(sum(one() is not None for one in made))
                yield image
        film.write(self.folder / 'many.webp', images(), 40)
        self.assertLess(max(alive), 5)
        with Image.open(self.folder / 'many.webp') as shown:
            self.assertEqual(shown.n_frames, 40)
            shown.seek(39)
            self.assertAlmostEqual(shown.convert('RGB').getpixel((4, 4))[0], 234, delta=12)
            self.assertEqual(shown.info['duration'], film.LAST_FRAME)


if __name__ == '__main__':
    unittest.main()
