# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which layer may include what.

Follows project includes ("coupler/...") transitively, so that a forbidden header is found however it is reached.
usage: includes_test.py PROJECT_FOLDER
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
LAMMPS = r"^(lammps/.*|granular_adapter/lammps/.*)$"
OPENFOAM = r"^([A-Za-z]*\.H|fluid_adapter/foam_.*)$"
SICONOS = (r"^(siconos/.*|(Friction|fc[23]d_|Numerics|NonSmooth|SolverOptions|SparseBlock)\w*\.h|fclib\.h|"
           r"bench/siconos/(siconos_problem|fclib_file)\.hpp)$")
PROJECT = r"^(coupler|fluid_adapter|granular_adapter|launcher|bench/(?!array_code/))/?.*$"
LAUNCHER = r"^launcher/.*$"
BENCH = r"^bench/.*$"
HUB = r"^coupler/hub/.*$"
OUTPUT = r"^coupler/output/.*$"
ENGINE = r"^granular_adapter/(nscd/(?!names/)|nscd_adapter|md|grains)/?.*$"
ADAPTERS = r"^(granular_adapter|fluid_adapter)/.*$"
GRANULAR = r"^granular_adapter/.*$"
FLUID = r"^fluid_adapter/.*$"

# (files, forbidden headers, why)
RULES = [
    ("coupler/protocol/**/*.[hc]pp", [MPI, TRANSPORT, EIGEN, YAML], "the protocol is bytes and rules only"),
    ("coupler/rigid/*.hpp", [MPI, TRANSPORT, EIGEN, YAML, r"^coupler/(?!rigid/).*$"],
     "rigid motion is below everything that moves"),
    ("coupler/participant/adapter.hpp", [MPI, TRANSPORT, EIGEN], "any host code may include it"),
    ("coupler/participant/participant.hpp", [MPI, TRANSPORT, EIGEN], "any host code may include it"),
    ("coupler/participant/**/*.[hc]pp", [YAML, PYTHON, OPENFOAM], "the participant library knows no host"),
    ("coupler/participant/*.hpp", [MPI], "an MPI of the host's choice must not leak in"),
    ("coupler/shapes/*.[hc]pp", [MPI, YAML, PYTHON, OPENFOAM], "shared by fluid and grains"),
    ("granular_adapter/nscd/**/*.[hc]pp", [MPI, TRANSPORT, YADE, PYTHON, OPENFOAM], "the contact engine knows no host"),
    ("granular_adapter/nscd_ranks/*.[hc]pp", [TRANSPORT, YADE, LAMMPS, PYTHON], "ranks exchange bytes, whatever the host"),
    ("granular_adapter/nscd_adapter/*.[hc]pp", [MPI], "the engine's adapter knows ranks, and no MPI"),
    *[(files, [SICONOS], "Siconos and FCLIB stay in tests and bench/siconos")
      for files in ("granular_adapter/**/*.[hc]pp", "coupler/**/*.[hc]pp", "launcher/**/*.[hc]pp", "fluid_adapter/**/*.[hc]pp",
                    "bench/[!s]*/*.[hc]pp")],
    ("fluid_adapter/multiplier/**/*.[hc]pp", [MPI, TRANSPORT, OPENFOAM], "the multiplier method knows no host"),
    ("fluid_adapter/box_step/**/*.[hc]pp", [MPI, TRANSPORT, EIGEN, OPENFOAM], "steps 1 to 3 on rows know no host"),
    ("fluid_adapter/coupled_step/*.[hc]pp", [MPI, TRANSPORT, OPENFOAM], "corrections with rigid grains know no host"),
    ("fluid_adapter/fluid_window/*.[hc]pp", [TRANSPORT, OPENFOAM], "a window knows no host: its store does"),
    ("fluid_adapter/box_app/*.[hc]pp", [TRANSPORT, OPENFOAM], "a fluid in plain arrays needs no host"),
    ("fluid_adapter/domain/*.[hc]pp", [MPI, TRANSPORT, EIGEN, OPENFOAM], "the box of a fluid is that of any program"),
    ("fluid_adapter/linear_solvers/*.[hc]pp", [MPI, TRANSPORT, EIGEN, OPENFOAM], "separable solves know no host"),
    ("coupler/participant/**/*.[hc]pp", [HUB, LAUNCHER], "participants know messages, not schemes"),
    ("coupler/output/**/*.[hc]pp", [HUB, TRANSPORT, MPI, LAUNCHER], "output does not depend on who computed it"),
    ("coupler/checkpoint/*.[hc]pp", [MPI, TRANSPORT, HUB, OUTPUT, YAML, LAUNCHER], "a checkpoint is a folder of files"),
    ("coupler/hub/**/*.[hc]pp", [MPI, YAML, PYTHON, OPENFOAM, LAUNCHER], "the hub sees channels, and no host"),
    # Dependencies between the top folders: launcher -> adapters -> coupler, never the reverse.
    ("coupler/**/*.[hc]pp", [LAUNCHER, BENCH, ADAPTERS, PYTHON, YADE], "the coupler depends neither on adapters nor on the launcher"),
    ("coupler/keys/*.[hc]pp", [MPI, TRANSPORT, EIGEN, YAML], "keys are described and checked without a file format"),
    ("granular_adapter/**/*.[hc]pp", [LAUNCHER, BENCH, FLUID, HUB, OUTPUT], "adapters depend neither on the launcher nor on the fluid"),
    ("fluid_adapter/**/*.[hc]pp", [LAUNCHER, BENCH, GRANULAR, HUB, OUTPUT], "adapters depend neither on the launcher nor on the grains"),
    ("granular_adapter/contact_keys/*.[hc]pp", [ENGINE, EIGEN, MPI], "names and rules of contact keys need no numerics"),
    ("granular_adapter/grains/*.[hc]pp", [YADE, PYTHON], "the grains of a case are for any host"),
    ("granular_adapter/nscd_adapter/*.[hc]pp", [YADE, PYTHON], "the engine's adapter is for any host"),
    ("granular_adapter/md/*.[hc]pp", [YADE, LAMMPS, PYTHON, MPI], "molecular dynamics is for any host"),
    ("granular_adapter/soft/*.[hc]pp", [YADE, LAMMPS, PYTHON, MPI], "soft grains need no other code"),
    ("granular_adapter/yade/**/*.[hc]pp", [LAMMPS], "hosts do not know each other"),
    ("granular_adapter/lammps/*.[hc]pp", [YADE, PYTHON], "hosts do not know each other"),
    ("coupler/**/*.[hc]pp", [LAMMPS], "the coupler knows no host"),
    ("launcher/**/*.[hc]pp", [LAMMPS], "LAMMPS stays in its own program"),
    ("launcher/case/**/*.[hc]pp", [ENGINE, FLUID, MPI, PYTHON, BENCH], "the case knows names of laws, solvers and schemes, and no program"),
    ("launcher/case/files/*.[hc]pp", [r"^launcher/case/(?!files/).*$"], "texts and tables are read without knowing what they mean"),
    ("launcher/case/grains/**/*.[hc]pp", [r"^launcher/case/(keys|forecast)/.*$"], "grains are placed by settings, not by the table of keys"),
    ("launcher/commands/*.[hc]pp", [BENCH, ENGINE, HUB, TRANSPORT], "commands start programs and include none of their code"),
    ("launcher/job/**/*.[hc]pp", [BENCH, ENGINE, HUB, TRANSPORT], "a job is prepared, started and watched from outside"),
    ("launcher/doctor/*.[hc]pp", [BENCH, ENGINE, HUB, TRANSPORT, MPI], "programs and libraries are looked at from outside"),
    ("bench/array_code/*.[hc]pp", [PROJECT, MPI, EIGEN, OPENFOAM], "the reference for timings uses nothing of the project"),
    ("fluid_adapter/ranks/*.[hc]pp", [TRANSPORT, OPENFOAM], "the ranks share numbers, whatever the host"),
    ("fluid_adapter/foam_solver/*.[hc]pp", [EIGEN, r"^(coupler|granular_adapter)/.*$"], "any OpenFOAM application may load it"),
]
# In the contact engine, plane/ holds what is of contacts in the plane and space/ what is of contacts of spheres;
# everything else is for any kind of contact. The doors at which a kind is chosen, the only other files that include or
# name anything of plane/, and of space/:
ENGINE_ROOM = "granular_adapter/nscd/"
PLANE_DOORS = {
    "problem/mobilities.hpp": "lists the kinds of mobility that a problem may have",
    "problem/mobilities.cpp": "makes the mobilities of dry bodies",
    "problem/residual.cpp": "measures a problem with the operator of its kind",
    "problem/problem_file.cpp": "writes a problem with the assembled operator of its kind",
    "solvers/nlgs.cpp": "solves a problem with the rows of its kind",
    "detection/narrow_phase.hpp": "holds the shapes that have corners",
    "detection/narrow_phase.cpp": "lists the detectors of all pairs of shapes, and what walls may do",
}
SPACE_DOORS = {name: PLANE_DOORS[name] for name in (
    "problem/mobilities.hpp", "problem/mobilities.cpp", "problem/problem_file.cpp", "problem/residual.cpp", "solvers/nlgs.cpp",
    "detection/narrow_phase.cpp")}
SPACE_DOORS["detection/narrow_phase.hpp"] = "holds the rims that round walls share"
PLANE_HEADER = re.compile(r'^\s*#\s*include\s*"granular_adapter/nscd/\w+/plane/', re.MULTILINE)
PLANE_TYPE = re.compile(r"\b(Plan(?:ar|e)[A-Z]\w*|Placed?Polygons?|Polygon[A-Z]\w*|Delassus\w*)\b")
SPACE_HEADER = re.compile(r'^\s*#\s*include\s*"granular_adapter/nscd/\w+/space/', re.MULTILINE)
SPACE_TYPE = re.compile(r"\b(Space[A-Z]\w*|Sphere[A-Z]\w*|BiasedSphere\w*)\b")
MOST_FILES = 25  # directly in a folder; more go into rooms
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)


def includes_of(root, file):
    """Every (header, chain of files leading to it) reached from a file through project includes."""
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


def source_folders(root):
    """Folders that hold sources, without tests."""
    houses = ("coupler", "launcher", "fluid_adapter", "granular_adapter", "bench")
    return sorted({str(file.parent.relative_to(root)) for house in houses
                   for file in (root / house).rglob("*") if file.suffix in (".cpp", ".hpp", ".py", ".def")})


def is_described(folder, root, table):
    """True if the folder or one of its parents has a line in the table of docs/folders.md or a README of its own."""
    path = Path(folder)
    lines = [p for p in (path, *path.parents) if str(p) != "."]
    return any(f"`{p}`" in table or (root / p / "README.md").is_file() for p in lines)


class Includes(unittest.TestCase):
    root = None

    def test_every_layer_keeps_its_rule(self):
        for pattern, forbidden, reason in RULES:
            with self.subTest(pattern):
                files, found = violations(self.root, pattern, forbidden)
                self.assertTrue(files, f"no file matches {pattern}: the rule checks nothing")
                self.assertEqual(found, [], f"{reason}; forbidden here:\n" + "\n".join(found))

    def test_only_doors_of_the_contact_engine_know_a_kind_of_contact(self):
        for kind, doors, header, type_name in (("plane", PLANE_DOORS, PLANE_HEADER, PLANE_TYPE),
                                               ("space", SPACE_DOORS, SPACE_HEADER, SPACE_TYPE)):
            with self.subTest(kind):
                files = {str(path.relative_to(self.root / ENGINE_ROOM)): path.read_text()
                         for path in (self.root / ENGINE_ROOM).rglob("*.[hc]pp") if path.parent.name != kind}
                self.assertGreater(len(files), 50)
                including = {name for name, text in files.items() if header.search(text)}
                naming = {name for name, text in files.items() if type_name.search(re.sub("//.*", "", text))}
                self.assertEqual(including, set(doors))
                self.assertLessEqual(naming, set(doors))

    def test_every_folder_says_what_it_is_for(self):
        table = "\n".join(line for line in (self.root / "docs/folders.md").read_text().splitlines() if line.startswith("| `"))
        self.assertTrue(table)
        homeless = [folder for folder in source_folders(self.root)
                    if not is_described(folder, self.root, table)]
        self.assertEqual(homeless, [], "these folders have no line in the table of docs/folders.md and no README")
        named = re.findall(r"^\| `([^`]+)`", table, re.MULTILINE)
        self.assertEqual([folder for folder in named if not (self.root / folder).is_dir()], [],
                         "these folders of docs/folders.md do not exist")

    def test_no_folder_holds_more_files_than_one_takes_in(self):
        files = {folder: sum(file.is_file() and file.name != "CMakeLists.txt" for file in (self.root / folder).iterdir())
                 for folder in source_folders(self.root)}
        self.assertGreater(len(files), 50)
        self.assertEqual({folder: count for folder, count in files.items() if count > MOST_FILES}, {})

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
