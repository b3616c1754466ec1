# SPDX-License-Identifier: LGPL-2.1-or-later
"""How text and figures are set on a page."""
import io
import unittest

import matplotlib
import made_up_run  # noqa: F401  (finds the modules of the report)

matplotlib.use('Agg')
import matplotlib.pyplot as plt

from page import Page
from typeset import typeset
from working import Progress


class Typeset(unittest.TestCase):
    def test_symbols(self):
        for plain, set_ in (('1 u_c at t = 2 t_c.', '1 u<sub>c</sub> at t = 2 t<sub>c</sub>.'),
                            ('4 rho_s g D^2', '4 ρ<sub>s</sub> g D<sup>2</sup>'), ('|<u>|', '|⟨u⟩|'),
                            ('<u_x>', '⟨u<sub>x</sub>⟩'), ('2.6e-05 D', '2.6·10<sup>−5</sup> D'), ('a < b', 'a &lt; b'),
                            ('closes to 1e-10.', 'closes to 1·10<sup>−10</sup>.')):
            self.assertEqual(typeset(plain), set_)

    def test_names_stay(self):
        for name in ('mean_velocity_x', 'u_c.txt', 'pictures/rho_s.png', 'case1e5b', 'contact.tolerance'):
            self.assertEqual(typeset(name), name)


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


class ProgressLine(unittest.TestCase):
    def test_no_terminal_no_line(self):
        stream = io.StringIO()
        Progress('report', stream)('pictures')
        self.assertEqual(stream.getvalue(), '')

    def test_a_terminal_has_one_line(self):
        stream = io.StringIO()
        stream.isatty = lambda: True
        working = Progress('report', stream)
        working('pictures')
        working.end()
        self.assertIn('report: pictures', stream.getvalue())
        self.assertNotIn('\n', stream.getvalue())


if __name__ == '__main__':
    unittest.main()
