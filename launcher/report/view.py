#!/usr/bin/env pvpython
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows the run in this folder in ParaView: grains, force chains, and the liquid.

    cd RUN; paraview --script=view.py        # in the window of ParaView
    pvpython RUN/view.py PICTURE.png         # the last output as a picture

Needs ParaView alone, not Turbidite: a copy of the folder on another computer will do. Round grains are spheres,
coloured by speed. Force chains are tubes, as thick as their normal force; in three dimensions grains cover them, so they are
hidden at first: click their eye in the pipeline. Colour of the liquid: vertical velocity, in three dimensions in a plane."""
import json
import sys
from pathlib import Path

from paraview.simple import *  # noqa: F403

# ParaView's window does not tell a script where it lies.
RUN = Path(globals().get('__file__', 'view.py')).resolve().parent
if not (RUN / 'run.json').exists():
    sys.exit(f'{RUN} is not a run folder: it has no run.json. Start ParaView in the folder of the run.')
RECORD = json.loads((RUN / 'run.json').read_text())
D = RECORD['D']
SPEED = ('Viridis (matplotlib)', 'speed')


def series(name):
    """The reader of a .pvd series of the run; None if the run wrote no such file."""
    file = RUN / name
    return PVDReader(registrationName=file.name, FileName=str(file)) if file.exists() else None


def colour(view, name, source, array, colours, legend):
    """Shows a source under a name in the pipeline; `array`: 'POINTS' or 'CELLS', name, component."""
    RenameSource(name, source)
    display = Show(source, view)
    ColorBy(display, array)
    table = GetColorTransferFunction(array[1])   # one for all sources with an array of that name
    table.ApplyPreset(colours, True)
    display.RescaleTransferFunctionToDataRange(True, True)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = legend, ''
    bar.TitleFontSize = bar.LabelFontSize = 10
    return display


def is_flat(grains):
    """In the plane z is 0; in space the box begins there."""
    grains.UpdatePipeline()
    return grains.GetDataInformation().GetBounds()[4:] == (0.0, 0.0)


def moved(source, distance):
    """The source in the plane, moved along z to lie in front of or behind the grains."""
    shifted = Transform(Input=source)
    shifted.Transform.Translate = [0.0, 0.0, distance]
    return shifted


def show_grains(view, grains):
    outlines = [bool(shape['vertices']) for shape in RECORD['shapes']]
    if any(outlines):
        polygons = ExtractBlock(Input=grains, Selectors=['/Root/Block1'])
        colour(view, 'Polygons', polygons, ('CELLS', 'velocity', 'Magnitude'), *SPEED)
        grains = ExtractBlock(Input=grains, Selectors=['/Root/Block0'])
    for shape in (k for k, outline in enumerate(outlines) if not outline):
        round_grains = Threshold(Input=grains, Scalars=['POINTS', 'shape'], LowerThreshold=shape, UpperThreshold=shape)
        spheres = Glyph(Input=round_grains, GlyphType='Sphere', GlyphMode='All Points',
                        ScaleArray=['POINTS', 'radius'], OrientationArray=['POINTS', 'No orientation array'])
        spheres.ScaleFactor = 1.0   # by itself ParaView chooses one whenever the array is set
        spheres.GlyphType.Radius = 1.0
        spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 24
        colour(view, 'Grains', spheres, ('POINTS', 'velocity', 'Magnitude'), *SPEED)


def show_forces(view, contacts, flat):
    tubes = Tube(Input=contacts, Scalars=['POINTS', 'normal_force'], VaryRadius='By Scalar',
                 Radius=0.01 * D, RadiusFactor=20.0)
    tubes = moved(tubes, D) if flat else tubes
    array = ('POINTS', 'normal_force')
    display = colour(view, 'Force chains', tubes, array, 'Inferno (matplotlib)', 'normal force')
    if not flat:
        Hide(tubes, view)
        display.SetScalarBarVisibility(view, False)


def liquid():
    """Planes of the liquid, or in the plane all of it; None for a dry run."""
    for name in ('fluid/slices/slices.pvd', 'fluid/fields/fields.pvd'):
        if (RUN / name).exists():
            return series(name)
    if not (RUN / 'fluid/fluid.foam').exists():
        return None
    foam = OpenFOAMReader(registrationName='fluid.foam', FileName=str(RUN / 'fluid/fluid.foam'))
    foam.CaseType = 'Decomposed Case' if (RUN / 'fluid/processor0').exists() else 'Reconstructed Case'
    return foam


def main():
    LoadPalette('WhiteBackground')
    view = GetActiveViewOrCreate('RenderView')
    grains, contacts, fluid = series('grains/grains.pvd'), series('grains/contacts.pvd'), liquid()
    times = GetAnimationScene()
    times.UpdateAnimationUsingDataTimeSteps()
    times.GoToLast()
    flat = is_flat(grains)
    show_grains(view, grains)
    if contacts:
        show_forces(view, contacts, flat)
    if fluid:
        fluid = moved(fluid, -2 * D) if flat else fluid
        display = colour(view, 'Liquid', fluid, ('CELLS', 'U', 'Y'), 'Cool to Warm', 'vertical velocity')
        fastest = max(abs(end) for end in display.LookupTable.RGBPoints[0::4])
        display.LookupTable.RescaleTransferFunction(-fastest, fastest)
    if flat:
        view.InteractionMode = '2D'
    else:
        view.GetActiveCamera().Azimuth(20)
        view.GetActiveCamera().Elevation(15)
    ResetCamera(view)
    if len(sys.argv) > 1:
        view.ViewSize = [1600, 1200]
        SaveScreenshot(sys.argv[1], view)
    else:
        Render(view)


main()
