# SPDX-License-Identifier: LGPL-2.1-or-later
"""film.py RUN: writes RUN/film.webp, the pictures of the report at every output, one after the other.

WebP because browsers, image viewers and slides play it, and the library that draws the pictures writes it.
"""
import io
import sys
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
from PIL import Image

import pictures
import run_data
from space import scene, sequence
from space.camera import OBLIQUE
from document.working import Progress

NAME = 'film.webp'
FRAME_TIME = 100   # ms
LAST_FRAME = 1500  # ms, before it begins again
RESOLUTION = 110   # dots per inch
QUALITY = 82


def frames(run, shown):
    """A function that draws one picture of the film as a figure, with scales and view that serve all of them."""
    if run.in_space():
        frame, limit = scene.frame(run, [one.grains for one in shown], OBLIQUE), pictures.speed_limit(run, shown)
        return lambda picture: sequence.panel(run, frame, picture.grains, limit)
    limit, size = pictures.shown_limit(run, shown), pictures.view(run, [one.grains for one in shown])
    return lambda picture: pictures.panel(run, picture, limit, size)


def image_of(figure):
    """An image of the figure, which is closed."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format='png', dpi=RESOLUTION)
    plt.close(figure)
    return Image.open(buffer).convert('RGB')


def write(path, images):
    """All or nothing."""
    part = path.with_name(path.name + '.part')
    times = [FRAME_TIME] * (len(images) - 1) + [LAST_FRAME]
    images[0].save(part, format='WEBP', save_all=True, append_images=images[1:], duration=times, loop=0,
                   quality=QUALITY)
    part.replace(path)


def main(arguments):
    if len(arguments) != 2 or not Path(arguments[1]).is_dir():
        print('usage: film.py RUN   (a run folder of `turbidite run`)', file=sys.stderr)
        return 2
    run = run_data.load_run(arguments[1])
    shown = [pictures.load(run, instant) for instant in pictures.all_instants(run)]
    shown = [one for one in shown if one.grains is not None]
    if not shown:
        print(f'{run.folder} has no outputs of grains to make a film of', file=sys.stderr)
        return 2
    draw, working, images = frames(run, shown), Progress('film'), []
    for k, picture in enumerate(shown):
        working(f'picture {k + 1} of {len(shown)}')
        images.append(image_of(draw(picture)))
    working('encoding')
    try:
        write(run.folder / NAME, images)
    except OSError as error:
        print(f'cannot write {run.folder / NAME}: {error.strerror or error}', file=sys.stderr)
        return 4
    working.end()
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv))
