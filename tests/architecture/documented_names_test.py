# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the documentation names is in the tree.

Links of all pages lead to a file and a heading; files that a page shows whole are shown as they are; pages that sources
name exist. In the README, the decisions, the theory and the pages folders, running and window every name in back-quotes
exists: files, folders, keys of a case, tests, and every word of the rest
somewhere in the sources. Folders under another licence than most are in the licences of docs/folders.md. docs/running.md lists
the keys that may change at resume.
usage: documented_names_test.py PROJECT_FOLDER
"""
import functools
import re
import sys
import unittest
from pathlib import Path

HOUSES = ("coupler", "fluid_adapter", "granular_adapter", "launcher", "bench", "tests", "configs", "examples", "cmake")
SOURCES = (".cpp", ".hpp", ".c", ".h", ".C", ".H", ".py", ".def", ".in", ".sh", ".txt", ".toml", ".yaml", ".csv", "")
FILE = re.compile(r"^[\w./-]+\.(?:cpp|hpp|h|C|H|py|def|yaml|csv|md|txt|png)$")
KEY = re.compile(r"^(?:domain|grains|fluid|contact|coupling|time|output|checkpoint|scales|limits|random)\.\w[\w.]*$")
TEST = re.compile(r"^([A-Z]\w+)\.([A-Z]\w+)$")
WORD = re.compile(r"[A-Za-z_]\w{2,}")
# Names of other people's programs that a decision mentions and the sources do not.
FOREIGN = {"madvise", "M_TRIM_THRESHOLD", "GLIBC_TUNABLES", "glibc", "malloc", "hugetlb", "haswell"}


def without_code(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


def anchors(text):
    """Of the headings of a page, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", without_code(text), flags=re.M)
    plain = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower() for heading in headings]
    return {re.sub(r"[^\w\- ]", "", heading).replace(" ", "-") for heading in plain}


def links(text):
    """(path, anchor) of the links that stay in the tree."""
    found = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", without_code(text)))
    return [tuple((link + "#").split("#")[:2]) for link in found if not re.match(r"\w+:", link)]


def dead_links(page):
    dead = []
    for path, anchor in links(page.read_text()):
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or (anchor and anchor not in anchors(target.read_text())):
            dead.append(f"{path}#{anchor}" if anchor else path)
    return dead


def shown_files(text):
    """(link, what the page shows) of files that a page shows whole: a link of its own line before the block."""
    return re.findall(r"^\[[^\]]+\]\(([^)]+)\):\n```\w*\n(.*?)^```", text, flags=re.M | re.S)


def as_shown(file):
    """Without the line about its licence."""
    return "".join(line for line in file.read_text().splitlines(keepends=True) if "SPDX-License-Identifier" not in line)


def names(text):
    """What stands in back-quotes, outside blocks of code."""
    return {" ".join(name.split()) for name in re.findall(r"`([^`]+)`", without_code(text))}


class Tree:
    """Files and words of the sources."""

    def __init__(self, folder):
        self.folder = folder
        inside = [path for house in HOUSES for path in (folder / house).rglob("*") if "__pycache__" not in path.parts]
        self.paths = ["/" + str(path.relative_to(folder)) for path in inside]
        self.sources = {str(path.relative_to(folder)): path.read_text(errors="replace") for path in inside
                        if path.is_file() and path.suffix in SOURCES and path.name != Path(__file__).name}
        top = [folder / name for name in ("turbidite", "CMakeLists.txt", "CMakePresets.json")]
        self.sources |= {path.name: path.read_text() for path in top if path.is_file()}
        self.text = "\n".join(self.sources.values())
        self.words = set(WORD.findall(self.text)) | {word for path in self.paths for word in WORD.findall(path)}
        reference = folder / "docs/case-reference.md"
        self.keys = names(reference.read_text()) if reference.is_file() else set()

    def has_path(self, name):
        name = name.removeprefix("./").rstrip("/")
        return (self.folder / name).exists() or any(path.endswith("/" + name) for path in self.paths)

    @functools.lru_cache(None)
    def has(self, name):
        if FILE.match(name):  # of the tree, or of a run folder: then some source writes it
            return self.has_path(name) or f'{name.split("/")[-1]}"' in self.text
        if KEY.match(name):
            gone = self.sources.get("coupler/keys/gone_keys.cpp", "")
            return any(key == name or key.startswith(name + ".") for key in self.keys) or f'"{name}"' in gone
        if test := TEST.match(name):
            return bool(re.search(rf"TEST\w*\(\s*{test[1]},\s*{test[2]}\b", self.text)) or name in self.text
        if "/" in name and " " not in name and not name.startswith(("/", "$", "~")) and "." not in name[-5:]:
            return self.has_path(name) or name in self.text
        return all(word in self.words or word in FOREIGN for word in WORD.findall(name))


class Names(unittest.TestCase):
    folder = Path(".")

    def pages(self):
        return [*sorted(self.folder.glob("*.md")), *sorted((self.folder / "docs").rglob("*.md")),
                *sorted((self.folder / "configs").glob("*.md"))]

    def test_links_lead_somewhere(self):
        self.assertEqual({str(page.relative_to(self.folder)): dead for page in self.pages() if (dead := dead_links(page))}, {})

    def test_files_are_shown_as_they_are(self):
        shown = [(page, link, block) for page in self.pages() for link, block in shown_files(page.read_text())]
        self.assertGreater(len(shown), 1)
        for page, link, block in shown:
            with self.subTest(f"{page.name}: {link}"):
                self.assertEqual(block, as_shown(page.parent / link))

    def test_pages_that_sources_name_exist(self):
        named = {(file, page) for file, text in Tree(self.folder).sources.items()
                 for page in re.findall(r"\bdocs/[\w/-]+\.md\b", text) if "tests/architecture" not in file}
        self.assertGreater(len(named), 10)
        self.assertEqual([entry for entry in sorted(named) if not (self.folder / entry[1]).is_file()], [])

    def test_names_are_in_the_tree(self):
        tree = Tree(self.folder)
        docs = self.folder / "docs"
        others = (self.folder / "README.md", docs / "folders.md", docs / "running.md", docs / "window.md")
        for page in (*others, *sorted((docs / "decisions").glob("*.md")), *sorted((docs / "theory").glob("*.md"))):
            with self.subTest(page.name):
                self.assertEqual([name for name in sorted(names(page.read_text())) if not tree.has(name)], [])

    def test_keys_that_may_change_at_resume_are_listed(self):
        source = (self.folder / "launcher/job/resume_run.cpp").read_text()
        allowed = re.findall(r'"([\w.]+)"', re.search(r"keys_that_may_change\(\) \{\n.*?\{(.*?)\}", source, flags=re.S)[1])
        page = (self.folder / "docs/running.md").read_text()
        section = re.search(r"^## What may change at resume\n(.*?)^## ", page, flags=re.M | re.S)[1]
        listed = [name for row in re.findall(r"^\| (`.*?`) \| ", section, flags=re.M) for name in re.findall(r"`([^`]+)`", row)]
        self.assertGreater(len(allowed), 10)
        self.assertEqual(sorted(name.rstrip("*") for name in listed), sorted(allowed))

    def test_folders_under_another_licence_are_named(self):
        licence = re.compile(r"SPDX-License-Identifier: (L?GPL-[\d.]+-or-later)")
        rows = dict(re.findall(r"^\| (L?GPL-[\d.]+-or-later) \| (.*) \|$", (self.folder / "docs/folders.md").read_text(), flags=re.M))
        for file, text in Tree(self.folder).sources.items():
            found = licence.search(text[:400])
            if found and found[1] != "LGPL-2.1-or-later":
                named = any(re.match(re.escape(name) + r"(/|$)", file) for name in names(rows[found[1]]))
                self.assertTrue(named, f"{file} is under {found[1]}, and docs/folders.md does not say so")


class Itself(unittest.TestCase):
    def test_anchors(self):
        self.assertEqual(anchors("# `a` of B\n\n## What: [the](x) c_d?\n```\n# no\n```\n"), {"a-of-b", "what-the-c_d"})

    def test_links(self):
        self.assertEqual(links("[a](b.md#c) [d](https://e) `[f](g)` [h](#i)\n```\n[j](k)\n```\n"),
                         [("b.md", "c"), ("", "i")])

    def test_shown_files(self):
        self.assertEqual(shown_files("See [a](b.sh):\n```\nno\n```\n[c](../d.sh):\n```bash\nyes\n```\n"), [("../d.sh", "yes\n")])

    def test_names_that_are_gone(self):
        tree = Tree(Names.folder)
        for gone in ("gone_for_good.cpp", "coupler/gone", "fluid.gone", "Gone.ForGood", "GoneForGood::run"):
            self.assertFalse(tree.has(gone), gone)
        for there in ("hub.cpp", "coupler/hub", "fluid.points", "history.csv", "Hub::play"):
            self.assertTrue(tree.has(there), there)


if __name__ == "__main__":
    Names.folder = Path(sys.argv.pop()).resolve()
    unittest.main()
