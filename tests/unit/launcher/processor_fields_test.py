# SPDX-License-Identifier: LGPL-2.1-or-later
"""Merging fields written by several ranks: where each value goes, and what is refused."""
import sys
import tempfile
import types
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / 'launcher/report'))
import fluid_fields
import processor_fields

PARTS = ([4, 0, 2], [5, 1, 3])  # cells of two processors


def label_file(cells, binary):
    head = f'FoamFile\n{{\n    version 2.0;\n    format {"binary" if binary else "ascii"};\n}}\n\n'
    body = np.array(cells, '<i4').tobytes() if binary else '\n'.join(map(str, cells)).encode()
    return head.encode() + f'{len(cells)}\n('.encode() + body + b')\n'


class ProcessorFields(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.fluid = Path(scratch.name) / 'fluid'
        self.fluid.mkdir()

    def write(self, parts, binary=True):
        for n, cells in enumerate(parts):
            mesh = self.fluid / f'processor{n}/constant/polyMesh'
            mesh.mkdir(parents=True, exist_ok=True)
            (mesh / 'cellProcAddressing').write_bytes(label_file(cells, binary))
            (self.fluid / f'processor{n}/0.5').mkdir(exist_ok=True)

    def read(self, count=6):
        """The value of a cell is its number; a processor has only its own cells, by the name of the folder."""
        def part(folder, n):
            cells = PARTS[int(folder.parent.name[-1])]
            return np.array(cells, float)[:, None]
        first = processor_fields.time_parents(self.fluid)[0] / '0.5'
        return processor_fields.whole_field(first, count, part)

    def test_values_go_to_their_cells(self):
        for binary in (True, False):
            self.write(PARTS, binary)
            self.assertEqual(self.read()[:, 0].tolist(), [0, 1, 2, 3, 4, 5])

    def test_ten_processors_are_in_the_order_of_their_numbers(self):
        self.write([[n] for n in range(11)])
        names = [p.name for p in processor_fields.processor_folders(self.fluid)]
        self.assertEqual(names[1:3] + names[-1:], ['processor1', 'processor2', 'processor10'])

    def test_a_case_on_one_rank_is_read_as_it_is(self):
        (self.fluid / '0.5').mkdir()
        self.assertEqual(processor_fields.time_parents(self.fluid), [self.fluid])
        values = processor_fields.whole_field(self.fluid / '0.5', 3, lambda folder, n: np.arange(n))
        self.assertEqual(values.tolist(), [0, 1, 2])

    def test_fields_of_every_number_of_ranks_are_found(self):
        for folder in ('0', '0.1', 'until-w00000010/processor0/0', 'until-w00000010/processor0/0.2',
                       'until-w00000020/processor0/0.3', 'until-w00000020/processor1/0.3', 'processor0/0', 'processor0/0.4',
                       'constant', 'processor0/constant'):
            (self.fluid / folder).mkdir(parents=True)
            (self.fluid / folder / 'U').touch()
        run = types.SimpleNamespace(folder=self.fluid.parent, record={}, is_wet=lambda: True, remarks=[])
        self.assertEqual([(time, str(folder.relative_to(self.fluid))) for time, folder in fluid_fields.field_times(run)],
                         [(0.0, 'processor0/0'), (0.1, '0.1'), (0.2, 'until-w00000010/processor0/0.2'),
                          (0.3, 'until-w00000020/processor0/0.3'), (0.4, 'processor0/0.4')])

    def test_one_label_for_all(self):
        self.assertEqual(processor_fields.read_labels(b'format binary;\n}\n\n3{7}\n').tolist(), [7] * 3)

    def test_missing_doubled_and_strange_cells_are_refused(self):
        for parts in ([[4, 0, 2], [5, 1, 1]], [[4, 0, 2], [5, 1, 9]], [[4, 0, 2], [5, 1]]):
            self.write(parts)
            with self.assertRaises(ValueError):
                self.read()
        with self.assertRaises(ValueError):
            processor_fields.read_labels(label_file([1, 2, 3], True)[:-8])


if __name__ == '__main__':
    unittest.main()
