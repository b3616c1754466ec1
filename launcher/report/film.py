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
import numpy as np
from PIL import Image

import grain_drawing
import grain_files
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


class Shown:
    """The pictures of all outputs with grains. They are read whenever one goes through them: a long run has more than fit
    into the memory."""

    def __init__(self, run):
        self.run = run
        self.instants = [instant for instant in pictures.all_instants(run) if instant[1] is not None]

    def __len__(self):
        return len(self.instants)

    def __iter__(self):
        for instant in self.instants:
            picture = pictures.load(self.run, instant)
            if picture.grains is not None:
                yield picture


def outermost(run, grains):
    """One grain that reaches as far to the right, upwards and in depth as any of these are seen to."""
    if not len(grains.radii):
        return grains
    far, radius = (grains.positions() + grains.radii[:, None]).max(axis=0), 0.0
    if not run.in_space() and grain_drawing.periods(run):
        far[:2] = grain_drawing.reach(run, grains) * run.scale('D')
        radius = grains.radii.min()  # its centre is inside the box: what is at a cyclic side is at the other one, too
    return grain_files.Grains(grains.time, far[None, :2] - radius, np.array([radius]), z=far[2:])


def frames(run, shown, working):
    """(number of pictures, function that draws one of them as a figure, with scales and view that serve all of them);
    the function is None without pictures."""
    limits, ends = [], []
    for k, picture in enumerate(shown):
        working(f'reading {k + 1} of {len(shown)}')
        limits.append(pictures.shown_limit(run, [picture]))
        ends.append(outermost(run, picture.grains))
    if not limits:
        return 0, None
    limit = max(limits)
    if run.in_space():
        frame = scene.frame(run, ends, OBLIQUE)
        return len(limits), lambda picture: sequence.panel(run, frame, picture.grains, limit)
    size = pictures.view(run, ends)
    return len(limits), lambda picture: pictures.panel(run, picture, limit, size)


def drawn(shown, draw, working):
    """The images, one after the other."""
    for k, picture in enumerate(shown):
        working(f'picture {k + 1} of {len(shown)}')
        yield image_of(draw(picture))


def image_of(figure):
    """An image of the figure, which is closed."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format='png', dpi=RESOLUTION)
    plt.close(figure)
    return Image.open(buffer).convert('RGB')


class Reel:
    """So many images one after the other as one image of many frames, as the encoder takes them. Each is drawn when the
    encoder comes to it and let go with the next: all of them together may not fit into the memory."""

    def __init__(self, images, count):
        self.n_frames = count
        self._images, self._image, self._drawn = images, None, 0

    def seek(self, frame):
        """Forwards. An output that can no longer be read is shown as the one before it."""
        while self._drawn <= frame:
            self._image, self._drawn = next(self._images, self._image), self._drawn + 1

    def __getattr__(self, name):
        return getattr(self._image, name)


def write(path, images, count):
    """All or nothing; `images` is an iterator over so many."""
    part = path.with_name(path.name + '.part')
    times = [FRAME_TIME] * (count - 1) + [LAST_FRAME]
    next(images).save(part, format='WEBP', save_all=True, append_images=[Reel(images, count - 1)], duration=times,
                      loop=0, quality=QUALITY)
    part.replace(path)


def main(arguments):
    if len(arguments) != 2 or not Path(arguments[1]).is_dir():
        print('usage: film.py RUN   (a run folder of `turbidite run`)', file=sys.stderr)
        return 2
    run = run_data.load_run(arguments[1])
    shown, working = Shown(run), Progress('film')
    count, draw = frames(run, shown, working)
    if draw is None:
        print(f'{run.folder} has no outputs of grains to make a film of', file=sys.stderr)
        return 2
    try:
        write(run.folder / NAME, drawn(shown, draw, working), count)
    except OSError as error:
        print(f'cannot write {run.folder / NAME}: {error.strerror or error}', file=sys.stderr)
        return 4
    working.end()
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv))
