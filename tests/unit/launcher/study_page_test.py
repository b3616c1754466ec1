# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a study draws its quantities against."""
import unittest
from types import SimpleNamespace

import made_up_run  # puts launcher/report on the path

import study


def numbers(*texts):
    members = [SimpleNamespace(name=str(i)) for i in range(len(texts))]
    return study.numbers_of('grains.region', members, {str(i): {'grains.region': text} for i, text in enumerate(texts)})


class SweptValues(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual(numbers('0.3', '1e-2'), ([0.3, 0.01], 'grains.region'))

    def test_lists_that_differ_in_one_place(self):
        self.assertEqual(numbers('[15, 7.5]', '[15, 60]'), ([7.5, 60.0], 'grains.region[1]'))

    def test_nothing_to_draw_against(self):
        for texts in (('0.3', '0.3'), ('[15, 7.5]', '[10, 60]'), ('[1, 2]', '[1, 2, 3]'), ('yade-md', 'yade-nscd')):
            self.assertIsNone(numbers(*texts)[0], texts)


if __name__ == '__main__':
    unittest.main()
