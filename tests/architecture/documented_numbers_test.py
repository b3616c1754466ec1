# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measured numbers in the documentation say what gives them.

A section of a page with measurements has to name a command, a case, a study, a part of one, a test, or the section that
does; and all that pages name of these has to exist.
usage: documented_numbers_test.py PROJECT_FOLDER [--list]   (--list: all sections with numbers and what they name)
"""
import re
import sys
import unittest
from pathlib import Path

# Pages with measurements; sections of the others define, explain or list.
PAGES = ("validation", "splittings", "paper", "waiting-times", "beyond-paper", "dry-avalanche", "performance", "md",
         "contact-solvers", "fft-solver", "schemes", "spheres-in-liquid", "spheres", "box-program", "bulk-cases",
         "function-objects", "cluster")
CELL_NUMBER = re.compile(r"\d\.\d|\de-?\d|^[-+−–(]?\d")
PROSE_NUMBER = re.compile(r"\d\.\d+|\d+e-\d+|\d(?:\.\d+)? (?:%|ms|s|t_c|u_c|D|times)\b")
COMMAND = re.compile(r"\./turbidite \S+|bench/[\w./-]+|turbidite-bench[\w-]*|--figure|\w+_test\b|[Pp]arts?\s+`|"
                     r"configs/[\w./-]+|`[\w-]+\.yaml|--gtest_filter|`[A-Z]\w+\.[A-Z*]\w*`|figure `\w+`|"
                     r"\]\([\w./-]*#[\w-]+\)")  # or the section that tells
FEWEST = 3  # numbers in a section that make it one of measurements


def sections(text):
    """(heading, body) of a page; what stands before the first heading of the second level belongs to the page."""
    found = re.split(r"^#{2,3} (.*)$", text, flags=re.M)
    return list(zip(["", *found[1::2]], [found[0], *found[2::2]]))


def is_row(line):
    return line.startswith("|") and not set(line) <= set("|-: ")


def numbers_in(body):
    """Of the cells of tables, and of the prose outside code."""
    lines = re.sub(r"^```.*?^```", "", body, flags=re.M | re.S).splitlines()
    cells = [cell for line in lines if is_row(line) for cell in line.strip("|").split("|")[1:]]
    prose = re.sub(r"`[^`]*`", "", "\n".join(line for line in lines if not is_row(line) and not line.startswith("    ")))
    return sum(bool(CELL_NUMBER.search(cell.strip())) for cell in cells) + len(PROSE_NUMBER.findall(prose))


def without_command(text):
    """Headings of the sections with measured numbers that name nothing that gives them."""
    return [heading or "(before the first heading)" for heading, body in sections(text)
            if numbers_in(body) >= FEWEST and not COMMAND.search(body)]


# --- what pages name ----------------------------------------------------------------------------------

def parts_named(text):
    """`a` and `b` of: part `a`, parts `a` and `b`, part `a` of …"""
    return [name for group in re.findall(r"[Pp]arts?\s+((?:`[\w.-]+`(?:,\s+|\s+and\s+)?)+)", text)
            for name in re.findall(r"`([\w.-]+)`", group)]


def parts_there(folder):
    """Names of the parts of all studies."""
    found = set()
    for study in (folder / "configs").glob("*.yaml"):
        text = study.read_text()
        if "\nparts:" in text:
            found |= set(re.findall(r"^  ([\w.-]+):", text.split("\nparts:", 1)[1], flags=re.M))
    return found


def files_named(text):
    return re.findall(r"\b((?:configs|bench)/[\w./-]*\.(?:yaml|csv|py|hpp|cpp))\b", text)


def figures_named(text):
    return [name for name in re.findall(r"--figure\s+([a-z]\w+)", text)]


class Documentation(unittest.TestCase):
    folder = Path(".")

    def pages(self):
        return {path.stem: path.read_text() for path in sorted((self.folder / "docs").glob("*.md"))}

    def test_measured_numbers_name_what_gives_them(self):
        pages = self.pages()
        bare = [f"docs/{page}.md, {heading}" for page in PAGES for heading in without_command(pages[page])]
        self.assertEqual(bare, [], "sections with measured numbers and no command, case, part or test")

    def test_parts_exist(self):
        there, pages = parts_there(self.folder), self.pages()
        named = {(page, part) for page, text in pages.items() for part in parts_named(text)}
        self.assertGreater(len(named), 10)
        self.assertEqual([f"docs/{page}.md: part {part}" for page, part in sorted(named) if part not in there], [])

    def test_files_exist(self):
        named = {(page, name) for page, text in self.pages().items() for name in files_named(text)}
        self.assertGreater(len(named), 30)
        self.assertEqual([f"docs/{page}.md: {name}" for page, name in sorted(named)
                          if not (self.folder / name).exists()], [])

    def test_figures_exist(self):
        sources = "".join(path.read_text() for path in (self.folder / "bench").rglob("*.cpp"))
        named = {(page, name) for page, text in self.pages().items() for name in figures_named(text)}
        self.assertGreater(len(named), 3)
        self.assertEqual([f"docs/{page}.md: {name}" for page, name in sorted(named) if f'"{name}"' not in sources], [])


class Itself(unittest.TestCase):
    page = "# Page\n\n## One\n\n| a | b |\n|---|---|\n| x | 1.5 |\n| y | 2.5, 3 |\n| z | 3.5 |\n"

    def test_finds_a_table_without_a_command(self):
        self.assertEqual(without_command(self.page), ["One"])

    def test_a_command_of_another_section_does_not_help(self):
        self.assertEqual(without_command(self.page + "\n## Two\n\n    ./turbidite run a.yaml\n"), ["One"])

    def test_any_of_the_ways_to_name_one_helps(self):
        for way in ("./turbidite study x", "part `a`", "`configs/a.yaml`", "`Suite.Name`", "`bench/a.py`"):
            self.assertEqual(without_command(self.page + f"\nFrom {way}.\n"), [], way)

    def test_finds_prose(self):
        self.assertEqual(without_command("## One\n\nIt takes 3 ms, 5.5 % of it 0.2 t_c later.\n"), ["One"])

    def test_numbers_in_code_are_none(self):
        self.assertEqual(without_command("## One\n\n```\n1.5 2.5 3.5\n```\n\n`1.5` `2.5` `3.5`\n"), [])

    def test_parts(self):
        self.assertEqual(parts_named("parts `a-b` and `c`, part `d`\nof part `e`, `f`"), ["a-b", "c", "d", "e", "f"])


def listed(folder):
    for path in sorted((folder / "docs").glob("*.md")):
        for heading, body in sections(path.read_text()):
            if numbers_in(body) >= FEWEST:
                print(f"{path.name:24} {numbers_in(body):4}  {heading[:50]:50}  "
                      f"{', '.join(dict.fromkeys(COMMAND.findall(body)))[:100] or '-'}")


if __name__ == "__main__":
    Documentation.folder = Path(sys.argv[1])
    if sys.argv[2:] == ["--list"]:
        listed(Documentation.folder)
    else:
        unittest.main(argv=sys.argv[:1])
