# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which layer may include what.

Follows project includes ("coupler/...") to the end, so that a forbidden header is found however it is
reached. usage: includes_test.py PROJECT_FOLDER
"""
import re
import sys
import tempfile
import unittest
from pathlib import Path

MPI = r"^(mpi\.h|mpi\.hpp)$"
TRANSPORT = r"^coupler/transport/.*$"
EIGEN = r"^(Eigen/.*|unsupported/Eigen/.*)$"
YAML = r"^yaml-cpp/.*$"
PYTHON = r"^(Python\.h|pyconfig\.h|boost/python.*|pybind11/.*)$"
YADE = r"^(yade/.*|core/.*|lib/.*|pkg/.*|granular_adapter/yade/.*)$"
OPENFOAM = r"^([A-Za-z]*\.H|fluid_adapter/foam_.*)$"
SICONOS = r"^(siconos/.*|FrictionContactProblem\.h|bench/siconos/siconos_problem\.hpp)$"
HUB = r"^coupler/hub/.*$"
LAUNCHER = r"^launcher/.*$"
PROJECT = r"^(coupler|fluid_adapter|granular_adapter)/.*$"

# (files, forbidden headers, why)
RULES = [
    ("coupler/protocol/*.[hc]pp", [MPI, TRANSPORT, EIGEN, YAML], "the protocol is bytes and rules only"),
    ("coupler/participant/adapter.hpp", [MPI, TRANSPORT, EIGEN], "any host code may include it"),
    ("coupler/participant/participant.hpp", [MPI, TRANSPORT, EIGEN], "any host code may include it"),
    ("coupler/participant/*.[hc]pp", [YAML, PYTHON, OPENFOAM], "the participant library knows no host"),
    ("coupler/participant/*.hpp", [MPI], "an MPI of the host's choice must not leak in"),
    ("coupler/participant/*.[hc]pp", [HUB, LAUNCHER], "participants know messages, not schemes"),
    ("coupler/output/*.[hc]pp", [HUB, TRANSPORT, MPI, LAUNCHER], "what is written knows nothing of who played it"),
    ("coupler/hub/**/*.[hc]pp", [MPI, YAML, PYTHON, OPENFOAM, LAUNCHER], "the hub sees channels, and no host"),
    ("coupler/shapes/*.[hc]pp", [MPI, YAML, PYTHON, OPENFOAM], "shared by fluid and grains"),
    ("granular_adapter/nscd/**/*.[hc]pp", [MPI, TRANSPORT, YADE, PYTHON, OPENFOAM], "the contact engine knows no host"),
    ("granular_adapter/*/*.[hc]pp", [SICONOS], "Siconos stays in tests and one contender"),
    ("fluid_adapter/multiplier/*.[hc]pp", [MPI, TRANSPORT, OPENFOAM], "the multiplier method knows no host"),
    ("fluid_adapter/box_step/*.[hc]pp", [MPI, TRANSPORT, EIGEN, OPENFOAM], "steps 1 to 3 on rows know no host"),
    ("fluid_adapter/linear_solvers/*.[hc]pp", [MPI, TRANSPORT, EIGEN, OPENFOAM], "separable solves know no host"),
    ("bench/array_code/*.[hc]pp", [PROJECT, MPI, EIGEN, OPENFOAM], "the yardstick stands alone"),
    ("fluid_adapter/ranks/*.[hc]pp", [TRANSPORT, OPENFOAM], "the ranks share numbers, whatever the host"),
    ("fluid_adapter/foam_solver/*.[hc]pp", [MPI, EIGEN, r"^(coupler|granular_adapter)/.*$"], "any OpenFOAM application may load it"),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


def includes_of(root, file):
    """Every (header, chain of files that leads to it) reached from a file through project includes."""
    found, pending, seen = [], [(file, (file,))], {file}
    while pending:
        current, chain = pending.pop()
        for header in INCLUDE.findall((root / current).read_text()):
            found.append((header, chain))
            inside = (root / header).is_file()
            if inside and header not in seen:
                seen.add(header)
                pending.append((header, chain + (header,)))
    return found


def violations(root, pattern, forbidden):
    files = sorted(str(path.relative_to(root)) for path in root.glob(pattern))
    return files, [
        " -> ".join(chain + (header,))
        for file in files
        for header, chain in includes_of(root, file)
        if any(re.match(rule, header) for rule in forbidden)
    ]


class Includes(unittest.TestCase):
    root = None

    def test_every_layer_keeps_its_rule(self):
        for pattern, forbidden, reason in RULES:
            with self.subTest(pattern):
                files, found = violations(self.root, pattern, forbidden)
                self.assertTrue(files, f"no file matches {pattern}: the rule guards nothing")
                self.assertEqual(found, [], f"{reason}; forbidden here:\n" + "\n".join(found))

    def test_a_forbidden_header_is_found_through_another_file(self):
        # a.hpp includes b.hpp includes mpi.h: one violation, with the chain that leads to it.
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder)
            (tree / "coupler").mkdir()
            (tree / "coupler/a.hpp").write_text('#include <vector>\n#include "coupler/b.hpp"\n')
            (tree / "coupler/b.hpp").write_text("  # include <mpi.h>\n")
            _, found = violations(tree, "coupler/a.hpp", [MPI])
            self.assertEqual(found, ["coupler/a.hpp -> coupler/b.hpp -> mpi.h"])


if __name__ == "__main__":
    Includes.root = Path(sys.argv.pop(1))
    unittest.main()
