# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names of schemes, adapters and splittings stand where they are defined; everything else asks for properties.

What a scheme needs (rounds, inertia, repeated windows), what an adapter is (host, contacts, cost) and what a splitting
does (rigid grains, iterations) are fields of their entries, so that a new one is an entry and no search for names.
"""
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop())
HOUSES = ("coupler", "fluid_adapter", "granular_adapter", "launcher")
SUFFIXES = (".cpp", ".hpp", ".h", ".def", ".py")

SCHEMES = "coupler/hub/schemes/"
ADAPTERS = "launcher/case/grains/grains_adapter_table.def"
SPLITTINGS = "coupler/protocol/scene/splitting.hpp"
# The files that may name it: where it is defined, and the program that says it of itself. (split and dry are words of
# other things, too.)
NAMES = {
    "joint": {SCHEMES + "joint.cpp"},
    "sub-iterated": {SCHEMES + "sub_iterated.cpp"},
    "external": {"coupler/protocol/hello.hpp"},
    "yade-nscd": {ADAPTERS, "granular_adapter/yade/yade_adapter.cpp"},
    "yade-md": {ADAPTERS, "granular_adapter/yade/extension.cpp"},
    "lammps-md": {ADAPTERS, "granular_adapter/lammps/main.cpp"},
    "standalone-md": {ADAPTERS, "granular_adapter/soft/main.cpp"},
    "marchuk-yanenko": {SPLITTINGS},
    "explicit-multiplier": {SPLITTINGS},
    "implicit-multiplier": {SPLITTINGS},
}


def without_comments(text, suffix):
    return re.sub(r"#.*" if suffix == ".py" else r"//.*", "", text)


def files_naming(name):
    """Product files that have the name as a string of its own."""
    literal = re.compile(r"""["']""" + re.escape(name) + r"""["']""")
    return {
        str(path.relative_to(ROOT))
        for house in HOUSES
        for path in (ROOT / house).rglob("*")
        if path.suffix in SUFFIXES and literal.search(without_comments(path.read_text(), path.suffix))
    }


class Names(unittest.TestCase):
    def test_stand_where_they_are_defined(self):
        for name, places in NAMES.items():
            with self.subTest(name=name):
                self.assertEqual(files_naming(name), places)


if __name__ == "__main__":
    unittest.main()
