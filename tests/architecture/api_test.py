# SPDX-License-Identifier: LGPL-2.1-or-later
"""The API reference describes what turbidite-dev installs, and doxygen finds no fault with its comments.

Every installed header says what it is, every type has a description, and so has every function of an adapter and every name of
the C interface. Needs doxygen; without it the exit code is 77.
usage: api_test.py PROJECT_FOLDER
"""
import importlib.util
import re
import shutil
import sys
import tempfile
import unittest
from fnmatch import fnmatch
from pathlib import Path
from xml.etree import ElementTree

HEADERS = ("*.hpp", "*.h")
SPEAKS_FOR_ITSELF = {"id", "TURBIDITE_H"}


def site_script(root):
    """launcher/site/site.py as a module; Python has one of this name."""
    spec = importlib.util.spec_from_file_location("turbidite_site", root / "launcher/site/site.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def installed(root):
    """The headers among the install rules of the component dev, relative to the coupler."""
    text = (root / "coupler/CMakeLists.txt").read_text()
    rules = re.findall(r"^install\((DIRECTORY|FILES) ([^$)]+?) DESTINATION include/turbidite", text, flags=re.M)
    hidden = re.findall(r'PATTERN "?([\w.]+)"? EXCLUDE', text)
    found = set()
    for kind, names in rules:
        for name in names.split():
            inside = (root / "coupler" / name).rglob("*") if kind == "DIRECTORY" else [root / "coupler" / name]
            found |= {file for file in inside if any(fnmatch(file.name, pattern) for pattern in HEADERS)
                      and not any(part in hidden for part in file.relative_to(root).parts)}
    return {str(file.relative_to(root / "coupler")) for file in found}


def words(element):
    """Summary and description together."""
    return " ".join("".join(element.find(part).itertext()).strip()
                    for part in ("briefdescription", "detaileddescription") if element.find(part) is not None).strip()


class Reference:
    """The pages made of a tree, and the same as XML."""

    def __init__(self, root, folder):
        self.folder = folder
        self.pages, self.warnings = site_script(root).describe(root, folder, "GENERATE_XML = YES\nXML_OUTPUT = xml")
        self.compounds = [compound for file in sorted((folder / "xml").glob("*.xml"))
                          for compound in ElementTree.parse(file).iter("compounddef")]

    def compound(self, kind, name):
        found = [each for each in self.compounds if each.get("kind") == kind and each.findtext("compoundname") == name]
        assert len(found) == 1, f"{len(found)} of {kind} {name}"
        return found[0]

    def of_kind(self, *kinds):
        return [compound for compound in self.compounds if compound.get("kind") in kinds]

    def text(self, page):
        return (self.folder / page).read_text()


def members(compound):
    """(name, definition) of what others may use."""
    return [(member.findtext("name"), member) for member in compound.iter("memberdef") if member.get("prot") == "public"]


class Api(unittest.TestCase):
    root = Path(".")

    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.reference = Reference(cls.root, Path(cls.work.name) / "api")

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def without_words(self, compound):
        return [name for name, member in members(compound) if not words(member) and name not in SPEAKS_FOR_ITSELF]

    def test_doxygen_finds_no_fault(self):
        self.assertEqual(self.reference.warnings, "")

    def test_every_installed_header_has_a_page_and_no_other(self):
        described = {str(file.relative_to(self.root / "coupler")) for file in self.reference.pages if file.suffix in (".hpp", ".h")}
        self.assertGreater(len(described), 30)
        self.assertEqual(described, installed(self.root))

    def test_every_header_says_what_it_is(self):
        files = self.reference.of_kind("file")
        self.assertEqual([file.findtext("compoundname") for file in files
                          if file.findtext("compoundname").endswith((".h", ".hpp")) and not words(file)], [])

    def test_every_type_has_a_description(self):
        types = self.reference.of_kind("class", "struct")
        self.assertGreater(len(types), 60)
        self.assertEqual([each.findtext("compoundname") for each in types if each.get("prot") == "public" and not words(each)], [])

    def test_every_function_of_an_adapter_has_a_description_on_its_page(self):
        header = (self.root / "coupler/participant/adapter.hpp").read_text()
        for name in ("GrainsAdapter", "FluidAdapter"):
            body = re.search(rf"^class {name} {{(.*?)^}};", header, flags=re.M | re.S)[1]
            virtual = set(re.findall(r"^    virtual [\w:<>]+ (\w+)\(", body, flags=re.M))
            self.assertGreaterEqual(virtual, {"describe", "initialise", "advance", "save", "restore"})
            compound = self.reference.compound("class", f"turbidite::{name}")
            described = {member: words(definition) for member, definition in members(compound) if definition.get("virt") != "non-virtual"}
            self.assertEqual({member for member in virtual if not described.get(member)}, set())
            page = self.reference.text(compound.get("id") + ".html")
            self.assertEqual([member for member in virtual if f">{member}<" not in page and f"{member}()" not in page], [])

    def test_every_name_of_the_c_interface_has_a_description(self):
        header = self.reference.compound("file", "turbidite.h")
        found = dict(members(header))
        self.assertGreaterEqual(set(found), {"turbidite_run_grains", "turbidite_run_grains_sized", "turbidite_real", "turbidite_grains",
                                             "turbidite_fail"})
        self.assertEqual(self.without_words(header), [])
        for name in re.findall(r"^\} (\w+);", (self.root / "coupler/participant/turbidite.h").read_text(), flags=re.M):
            with self.subTest(name):
                self.assertEqual(self.without_words(self.reference.compound("struct", name)), [])

    def test_functions_of_a_program_have_descriptions(self):
        found = dict(members(self.reference.compound("namespace", "turbidite")))
        for name in ("run_grains", "run_fluid", "make_session", "run_values", "motions_of", "plates_of", "space_walls_of"):
            self.assertTrue(words(found[name]), name)

    def test_the_module_for_python_has_its_page(self):
        page = self.reference.text("python/namespaceturbidite__adapter.html")
        for name in ("class MyCode", "run_grains", "Motion", "Settings", "PhysicsRefused", "CONTACT"):
            self.assertTrue(name in page, name)
        private = re.findall(r"<b>(_\w+)</b>|>(_\w+)</a>", page)
        self.assertEqual(private, [])

    def test_the_first_page_leads_to_them(self):
        page = self.reference.text("index.html")
        for target in ("classturbidite_1_1GrainsAdapter.html", "turbidite_8h.html#", "structturbidite__adapter.html",
                       "python/namespaceturbidite__adapter.html", "structturbidite_1_1GrainState.html"):
            self.assertTrue(f'href="{target}' in page, target)

    def test_nothing_is_of_this_machine_or_day(self):
        for page in self.reference.folder.rglob("*.html"):
            text = page.read_text()
            self.assertFalse(str(self.root) in text, page.name)
            self.assertIsNone(re.search(r"Generated on|\d\d:\d\d:\d\d", text), page.name)


class Itself(unittest.TestCase):
    def reference_of(self, header, old, new):
        """Of a tree whose header is changed."""
        with tempfile.TemporaryDirectory() as work:
            tree = Path(work) / "tree"
            for folder in ("coupler", "launcher/site"):
                shutil.copytree(Api.root / folder, tree / folder, ignore=shutil.ignore_patterns("*.cpp", "__pycache__"))
            text = (tree / "coupler" / header).read_text()
            self.assertIn(old, text)
            (tree / "coupler" / header).write_text(text.replace(old, new))
            return Reference(tree, Path(work) / "api")

    def test_a_reference_to_nothing_is_found(self):
        reference = self.reference_of("participant/adapter.hpp", "class GrainsAdapter {", "/// \\ref nowhere\nclass GrainsAdapter {")
        self.assertRegex(reference.warnings, r"adapter\.hpp:\d+: warning: unable to resolve reference to 'nowhere'")

    def test_a_function_without_a_description_is_found(self):
        reference = self.reference_of("participant/adapter.hpp", "    virtual Motion apply_kick(", "    int x_;\n    virtual Motion apply_kick(")
        kick = dict(members(reference.compound("class", "turbidite::GrainsAdapter")))["apply_kick"]
        self.assertEqual(words(kick), "")

    def test_installed_headers(self):
        found = installed(Api.root)
        self.assertLessEqual({"participant/turbidite.h", "transport/channel.hpp", "rigid/vec3.hpp"}, found)
        self.assertFalse({"participant/scripted.hpp", "transport/world.hpp"} & found)


if __name__ == "__main__":
    if not shutil.which("doxygen"):
        print("skipped: doxygen is not installed (apt-get install doxygen)")
        sys.exit(77)
    Api.root = Path(sys.argv.pop()).resolve()
    unittest.main()
