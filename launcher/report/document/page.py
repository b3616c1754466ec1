# SPDX-License-Identifier: LGPL-2.1-or-later
"""A self-contained HTML page of figures and tables, written completely or not at all. Texts are those of typeset:
symbols are set, and Code stays as it is."""
import base64
import html
import io
import itertools
import os
import re
import sys
from contextlib import contextmanager
from urllib.parse import quote

import matplotlib.pyplot as plt
from PIL import Image

from document.alt_text import described
from document.style import STYLE
from document.typeset import typeset

RESOLUTION = 120  # dots per inch
PROGRAM = 'turbidite'  # `Software` in the pictures of a page
BEGINNING = '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">'  # of every page, by which it is known
CONTENTS = object()  # stands in the parts of a page where its contents go


class Page:
    def __init__(self, title):
        self.title = title
        self.parts = []
        self.places = []    # (name, text) of the headings
        self.pictures = {}  # name: bytes of a PNG

    def heading(self, text):
        self.parts.append(f'<h2 id="{self._place(text)}">{typeset(text)}</h2>')

    def subheading(self, text):
        """Within a part; not in the contents."""
        self.parts.append(f'<h3>{typeset(text)}</h3>')

    def contents(self):
        """Links to all headings of the page, those that follow included."""
        self.parts.append(CONTENTS)

    @contextmanager
    def folded_part(self, text):
        """A heading whose content opens on demand; nothing where no content is added."""
        before = len(self.parts)
        yield
        content = ''.join(self.parts[before:])
        del self.parts[before:]
        if content:
            self.parts.append(f'<details class="part" id="{self._place(text)}"><summary>{typeset(text)}</summary>{content}'
                              '</details>')

    def checks(self, items):
        """(text, class) of single findings: `holds`, `doubt` or `told`."""
        lines = ''.join(f'<li class="{css}">{typeset(text)}</li>' for text, css in items)
        self.parts.append(f'<ul class="checks">{lines}</ul>' if lines else '')

    def _place(self, text):
        """The name of a place to link to, noted for the contents."""
        name = re.sub(r'[^a-z0-9]+', '-', text.lower()).strip('-') or 'part'
        taken = {place for place, _ in self.places}
        place = next(one for one in itertools.chain([name], (f'{name}-{k}' for k in itertools.count(2)))
                     if one not in taken)
        self.places.append((place, text))
        return place

    def paragraph(self, text, css=''):
        attribute = f' class="{css}"' if css else ''
        self.parts.append(f'<p{attribute}>{typeset(text)}</p>')

    def figure(self, figure, name, caption):
        """Embeds a figure and closes it; `name` is also that of the PNG file."""
        self.parts.append(f'<figure>{self._image(figure, name)}'
                          f'<figcaption>{typeset(caption)}</figcaption></figure>')

    def panels(self, figures, caption, width=400):
        """Several (figure, name), or (figure, name, address of a page), with one caption: side by side where each has
        `width` pixels, below each other where not."""
        images = ''.join(self._image(*one) for one in figures)
        self.parts.append(f'<figure><div class="panels" style="--width: {width}px">{images}</div>'
                          f'<figcaption>{typeset(caption)}</figcaption></figure>')

    def legend(self, entries):
        """(name, colour, dashes of SVG, whether a band belongs to it) of the lines in all figures that follow."""
        self.parts.append('<p class="legend">' + ' '.join(
            f'<span><svg width="40" height="12" aria-hidden="true"><line x1="0" x2="40" y1="6" y2="6" stroke="{colour}" '
            f'stroke-width="2" stroke-dasharray="{dashes}"/>'
            + (f'<rect x="0" y="1" width="40" height="10" fill="{colour}" opacity="0.18"/>' if band else '')
            + f'</svg> {html.escape(name)}</span>' for name, colour, dashes, band in entries) + '</p>')

    def file_only(self, figure, name):
        """A PNG beside the page that is not part of it."""
        buffer = io.BytesIO()
        figure.savefig(buffer, format='png', dpi=RESOLUTION, pil_kwargs={'compress_level': 4},
                       metadata={'Software': PROGRAM, 'Title': name})
        plt.close(figure)
        self.pictures[name] = buffer.getvalue()

    def links(self, entries):
        """(text, address) in a row."""
        self.parts.append('<p class="links">' + ' '.join(
            f'<a href="{address_of(address)}">{html.escape(text)}</a>' for text, address in entries) + '</p>')

    def _image(self, figure, name, address=''):
        words = html.escape(described(figure))
        self.file_only(figure, name)
        data = base64.b64encode(self.pictures[name]).decode()
        image = f'<img alt="{words}" src="data:image/png;base64,{data}">'
        return f'<a href="{address_of(address)}">{image}</a>' if address else image

    def table(self, rows, header=None, css=''):
        line = lambda tag, cells: '<tr>' + ''.join(
            f'<{tag}>{typeset(cell if isinstance(cell, (str, list)) else str(cell))}</{tag}>'
            for cell in cells) + '</tr>'
        head = line('th', header) if header else ''
        body = ''.join(line('td', row) for row in rows)
        self.parts.append(f'<div class="wide"><table class="{css}">{head}{body}</table></div>')

    def bullets(self, items, css=''):
        lines = ''.join(f'<li>{typeset(item)}</li>' for item in items)
        self.parts.append(f'<ul class="{css}">{lines}</ul>')

    def folded(self, summary, text):
        self.parts.append(f'<details><summary>{html.escape(summary)}</summary>'
                          f'<pre>{html.escape(text)}</pre></details>')

    def text(self):
        title = html.escape(self.title)
        links = ' '.join(f'<a href="#{place}">{typeset(text)}</a>' for place, text in self.places)
        body = ''.join(f'<nav>{links}</nav>' if part is CONTENTS else part for part in self.parts)
        return (BEGINNING + '<meta name="viewport" content="width=device-width, initial-scale=1">'
                f'<title>{title}</title><style>{STYLE}</style></head><body><h1>{title}</h1>'
                + body + '</body></html>\n')

    def write_pictures(self, folder):
        """Writes every picture as a file, and removes those of a page that had others. Whether all could be written;
        what could not is told on stderr."""
        try:
            folder.mkdir(exist_ok=True)
        except OSError as error:
            print(f'cannot write {folder}: {error.strerror}', file=sys.stderr)
            return False
        for old in folder.glob('*.png'):
            if old.stem not in self.pictures and is_picture_of_a_page(old):
                old.unlink()
        return all([write_whole(folder / f'{name}.png', png) for name, png in self.pictures.items()])


def address_of(path):
    """Of a file beside the page, for a link."""
    return html.escape(quote(os.fsencode(path)))


def is_picture_of_a_page(path):
    """By what the file says. A copy under another name is the user's own, as is one that says nothing: versions that
    wrote no name cannot be told from a user's matplotlib."""
    try:
        with Image.open(path) as picture:
            said = picture.info
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):  # damaged, a folder, somebody's large one
        return False
    return said.get('Software') == PROGRAM and said.get('Title') == path.stem


def write_whole(path, content):
    """Writes a file atomically. An OSError is printed on stderr; returns whether the file was written."""
    part = path.with_name(path.name + '.part')
    try:
        part.write_bytes(content if isinstance(content, bytes) else content.encode())
        part.replace(path)
    except OSError as error:
        print(f'cannot write {path}: {error.strerror}', file=sys.stderr)
        _remove(part)
        return False
    return True


def _remove(part):
    try:
        part.unlink(missing_ok=True)
    except OSError:
        pass  # the original failure has already been printed
