# SPDX-License-Identifier: LGPL-2.1-or-later
"""How text and figures are set on a page."""
import io
import os
import re
import unittest
from unittest import mock

import matplotlib
import numpy as np
import made_up_run  # noqa: F401  (finds the modules of the report)

matplotlib.use('Agg')
import matplotlib.pyplot as plt

from document.page import Page, is_picture_of_a_page
from document.typeset import Code, typeset
from document.working import Progress


class Typeset(unittest.TestCase):
    def test_symbols(self):
        for plain, set_ in (('1 u_c at t = 2 t_c.', '1 u<sub>c</sub> at t = 2 t<sub>c</sub>.'),
                            ('4 rho_s g D^2', '4 ρ<sub>s</sub> g D<sup>2</sup>'), ('|<u>|', '|⟨u⟩|'),
                            ('<u_x>', '⟨u<sub>x</sub>⟩'), ('2.6e-05 D', '2.6·10<sup>−5</sup> D'), ('a < b', 'a &lt; b'),
                            ('closes to 1e-10.', 'closes to 1·10<sup>−10</sup>.'),
                            ('from -1e-9 to 2', 'from -1·10<sup>−9</sup> to 2')):
            self.assertEqual(typeset(plain), set_)

    def test_names_stay(self):
        for name in ('mean_velocity_x', 'u_c.txt', 'pictures/rho_s.png', 'case1e5b', 'contact.tolerance', 'penetration-1e-9',
                     'part/penetration-1e-9-friction-0.3'):
            self.assertEqual(typeset(name), name)


    def test_code_is_set_as_it_is(self):
        for text in ('turbidite run a --set contact.tolerance=1e-4', '12e45678', 'runs/x_0 D^2'):
            self.assertEqual(typeset(Code(text)), f'<code>{text}</code>')
        self.assertEqual(typeset(['Made by: ', Code('a < b'), ', 1 u_c']),
                         'Made by: <code>a &lt; b</code>, 1 u<sub>c</sub>')
        page = Page('title')
        page.table([['x_0', Code('x_0'), ['x ', Code('1e-4')], 3]])
        self.assertIn('<td>x<sub>0</sub></td><td><code>x_0</code></td><td>x <code>1e-4</code></td><td>3</td>',
                      page.text())


class Pages(unittest.TestCase):
    def test_panels_have_one_caption_and_files_are_not_embedded(self):
        page = Page('title')
        page.panels(((plt.figure(), name) for name in ('a', 'b')), 'both')
        page.file_only(plt.figure(), 'c')
        self.assertEqual(page.text().count('<img'), 2)
        self.assertEqual(page.text().count('<figcaption>both'), 1)
        self.assertEqual(list(page.pictures), ['a', 'b', 'c'])
        self.assertEqual(plt.get_fignums(), [])

    def test_legend_names_every_line(self):
        page = Page('title')
        page.legend([('<one>', '#123456', '', False), ('two', '#654321', '4 2', True)])
        self.assertIn('&lt;one&gt;', page.text())
        self.assertEqual(page.text().count('<rect'), 1)


class Pictures(made_up_run.RunFolderTest):
    """In `pictures/` beside a page."""

    def write_page(self, *names):
        page = Page('title')
        for name in names:
            page.file_only(plt.figure(), name)
        self.assertTrue(page.write_pictures(self.folder))

    def test_those_of_an_earlier_page_are_removed(self):
        self.write_page('stays', 'goes', 'höhe-β', 'β')
        self.write_page('stays')
        self.assertEqual([path.name for path in self.folder.iterdir()], ['stays.png'])

    def test_those_of_a_user_stay(self):
        self.write_page('energy')
        (self.folder / 'copy.png').write_bytes((self.folder / 'energy.png').read_bytes())
        figure = plt.figure()
        figure.savefig(self.folder / 'by-matplotlib.png')
        figure.savefig(self.folder / 'titled.png', metadata={'Title': 'titled'})
        plt.close(figure)
        self.write('damaged.png', (self.folder / 'energy.png').read_bytes()[:20])
        self.write('text.png', 'no picture')
        (self.folder / 'folder.png').mkdir()
        kept = sorted(path.name for path in self.folder.iterdir() if path.name != 'energy.png')
        self.assertEqual(len(kept), 6)
        self.write_page('front')
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), sorted([*kept, 'front.png']))

    def test_one_that_is_too_large_to_be_read_is_a_users(self):
        self.write_page('large')
        self.assertTrue(is_picture_of_a_page(self.folder / 'large.png'))
        with mock.patch('PIL.Image.MAX_IMAGE_PIXELS', 1):
            self.assertFalse(is_picture_of_a_page(self.folder / 'large.png'))


class Reading(unittest.TestCase):
    """On a telephone, in the dark, on paper, and without eyes."""

    def test_a_telephone_shows_the_page_in_its_own_width(self):
        self.assertIn('<meta name="viewport" content="width=device-width, initial-scale=1">', Page('title').text())

    def test_there_are_styles_for_the_dark_and_for_paper(self):
        text = Page('title').text()
        self.assertIn('@media (prefers-color-scheme: dark)', text)
        self.assertIn('@media print', text)
        # A colour that is written out would be the same on both.
        rules = [line for line in text[text.index('body {'):text.index('</style>')].splitlines() if '--' not in line]
        self.assertEqual([line for line in rules if re.search(r'#[0-9a-f]{3}|: (white|black)', line)], [])

    def test_the_words_for_a_curve_say_axes_lines_and_values(self):
        figure, axes = plt.subplots()
        axes.plot([0, 1, 2], [0.0, -0.25, np.nan], label=r'$\langle u_y \rangle$')
        axes.axhline(0.0)
        axes.set(title='Mean velocity', xlabel=r'$t\,/\,t_c$', ylabel=r'$\langle u \rangle\,/\,u_c$')
        page = Page('title')
        page.panels([(figure, 'mean_velocity')], 'caption')
        self.assertIn('alt="Mean velocity: ⟨u⟩ / u_c against t / t_c, from -0.25 to 0; lines: ⟨u_y⟩"', page.text())

    def test_a_figure_may_have_words_of_its_own(self):
        page = Page('title')
        page.panels([(plt.figure(label='two grains & a wall'), 'sequence-0')], 'caption')
        self.assertIn('alt="two grains &amp; a wall"', page.text())


class ProgressLine(unittest.TestCase):
    def test_no_terminal_no_line(self):
        stream = io.StringIO()
        Progress('report', stream)('pictures')
        self.assertEqual(stream.getvalue(), '')

    def test_a_terminal_without_escapes_has_none(self):
        stream = io.StringIO()
        stream.isatty = lambda: True
        with mock.patch.dict(os.environ, TERM='dumb'):
            Progress('report', stream)('pictures')
        self.assertEqual(stream.getvalue(), '')

    def test_a_terminal_has_one_line(self):
        stream = io.StringIO()
        stream.isatty = lambda: True
        with mock.patch.dict(os.environ, TERM='xterm'):
            working = Progress('report', stream)
        working('pictures')
        working.end()
        self.assertIn('report: pictures', stream.getvalue())
        self.assertNotIn('\n', stream.getvalue())


if __name__ == '__main__':
    unittest.main()
