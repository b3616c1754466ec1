# SPDX-License-Identifier: LGPL-2.1-or-later
"""view.py on synthetic run folders. ParaView's module is a stand-in that notes what is asked of it."""
import json
import runpy
import shutil
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

from made_up_run import RunFolderTest

SOURCE = Path(__file__).resolve().parents[3]
SCRIPT = SOURCE / 'launcher/report/view.py'
# What a script gets from `from paraview.simple import *`.
OFFERED = ('ColorBy', 'ExtractBlock', 'GetActiveViewOrCreate', 'GetAnimationScene', 'GetColorTransferFunction',
           'GetScalarBar', 'Glyph', 'Hide', 'LoadPalette', 'OpenFOAMReader', 'PVDReader', 'RenameSource', 'Render',
           'ResetCamera', 'SaveScreenshot', 'Show', 'Threshold', 'Transform', 'Tube')
FLAT, DEEP = (0, 4, 0, 6, 0, 0), (0, 4, 0, 6, 0, 2)


class View(RunFolderTest):
    def setUp(self):
        super().setUp()
        shutil.copy(SCRIPT, self.folder / 'view.py')
        self.write('grains/grains.pvd', '')

    def record(self, **shapes):
        self.write('run.json', json.dumps({'D': 2.0, 'shapes': [
            {'kind': kind, 'vertices': vertices} for kind, vertices in shapes.items()]}))

    def run_script(self, bounds=FLAT, arguments=()):
        simple = types.ModuleType('paraview.simple')
        for name in OFFERED:
            setattr(simple, name, mock.MagicMock(name=name))
        simple.PVDReader.return_value.GetDataInformation().GetBounds.return_value = bounds
        simple.Show.return_value.LookupTable.RGBPoints = [-3.0, 0, 0, 0, 2.0, 1, 1, 1]
        modules = {'paraview': types.ModuleType('paraview'), 'paraview.simple': simple}
        script = str(self.folder / 'view.py')
        with mock.patch.dict(sys.modules, modules), mock.patch.object(sys, 'argv', [script, *arguments]):
            runpy.run_path(script, run_name='__main__')
        return simple

    def opened(self, simple):
        return [Path(call.kwargs['FileName']).name for reader in (simple.PVDReader, simple.OpenFOAMReader)
                for call in reader.call_args_list]

    def names(self, simple):
        return [call.args[0] for call in simple.RenameSource.call_args_list]

    def test_dry_discs_before_the_first_contacts(self):
        self.record(disc=[])
        simple = self.run_script()
        self.assertEqual(self.opened(simple), ['grains.pvd'])
        self.assertEqual(self.names(simple), ['Grains'])
        self.assertEqual(simple.Glyph.return_value.ScaleFactor, 1.0)
        simple.SaveScreenshot.assert_not_called()

    def test_polygons_beside_discs(self):
        self.record(disc=[], triangle=[0, 1, -1, -1, 1, -1])
        simple = self.run_script()
        self.assertEqual(self.names(simple), ['Polygons', 'Grains'])
        chosen = simple.Threshold.call_args.kwargs
        self.assertEqual((chosen['LowerThreshold'], chosen['UpperThreshold']), (0, 0))

    def test_forces_lie_before_discs_and_the_liquid_behind(self):
        self.record(disc=[])
        self.write('grains/contacts.pvd', '')
        self.write('fluid/fluid.foam', '')
        simple = self.run_script(arguments=['picture.png'])
        self.assertEqual(self.opened(simple), ['grains.pvd', 'contacts.pvd', 'fluid.foam'])
        self.assertEqual(self.names(simple), ['Grains', 'Force chains', 'Liquid'])
        self.assertEqual(simple.Transform.call_count, 2)
        simple.Hide.assert_not_called()
        self.assertEqual(simple.SaveScreenshot.call_args.args[0], 'picture.png')
        # Zero, the middle of the colours, is the liquid at rest.
        simple.Show.return_value.LookupTable.RescaleTransferFunction.assert_called_with(-3.0, 3.0)

    def test_spheres_hide_the_forces(self):
        self.record(sphere=[])
        self.write('grains/contacts.pvd', '')
        self.write('fluid/fluid.foam', '')
        self.write('fluid/slices/slices.pvd', '')
        simple = self.run_script(DEEP)
        self.assertEqual(self.opened(simple), ['grains.pvd', 'contacts.pvd', 'slices.pvd'])
        simple.Hide.assert_called_once()
        simple.Transform.assert_not_called()

    def test_one_sphere_is_not_flat(self):
        self.record(sphere=[])
        self.write('fluid/slices/slices.pvd', '')
        self.run_script((1, 1, 2, 2, 3, 3)).Transform.assert_not_called()

    def test_several_fluid_ranks(self):
        self.record(disc=[])
        self.write('fluid/fluid.foam', '')
        self.assertEqual(self.run_script().OpenFOAMReader.return_value.CaseType, 'Reconstructed Case')
        self.write('fluid/processor0/0/U', '')
        self.assertEqual(self.run_script().OpenFOAMReader.return_value.CaseType, 'Decomposed Case')

    def test_another_folder(self):
        with self.assertRaises(SystemExit) as end:
            self.run_script()
        self.assertIn('is not a run folder', str(end.exception.code))

    def test_arrays_are_those_of_the_series(self):
        script = SCRIPT.read_text()
        for file, arrays in (('grain_series', ('radius', 'shape', 'velocity')), ('contact_series', ('normal_force',))):
            written = (SOURCE / f'coupler/output/{file}.cpp').read_text()
            for array in arrays:
                self.assertIn(f"'{array}'", script)
                self.assertIn(f'"{array}"', written)


if __name__ == '__main__':
    unittest.main()
