#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much code the product has: lines of C++ without blanks and comments, by top folder, and the share of comments:
lines of their own, and lines that hold one, such as the formula behind a statement. The licence line does not count.

    bench/product_lines.py [--rooms] [FOLDER of another checkout, to compare with]
"""
import argparse
import re
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HOUSES = ("coupler", "fluid_adapter", "granular_adapter", "launcher")
SOURCES = (".cpp", ".hpp", ".h", ".def")
# A string is read as a whole, so that no comment begins inside it.
TOKEN = re.compile(r'R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*.*?\*/', re.DOTALL)


def is_comment(token):
    return token.group(0).startswith(("//", "/*"))


def blank(token):
    """A comment becomes its line ends; everything else stays."""
    text = token.group(0)
    return "\n" * text.count("\n") if is_comment(token) else text


def filled(text):
    return sum(bool(line.strip()) for line in text.split("\n"))


def commented_lines(text):
    """Numbers of the lines that hold a comment."""
    numbers = set()
    for token in TOKEN.finditer(text):
        if is_comment(token):
            first = text.count("\n", 0, token.start())
            numbers.update(range(first, first + token.group(0).count("\n") + 1))
    return numbers


def count(root):
    """Lines of code by folder (a Counter); in sources (.cpp): lines that are a comment, that hold one, and all."""
    code, alone, holding, lines = Counter(), 0, 0, 0
    for house in HOUSES:
        for path in sorted((root / house).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            text = path.read_text(encoding="utf-8")
            own = filled(TOKEN.sub(blank, text))
            code[str(path.parent.relative_to(root))] += own
            if path.suffix == ".cpp":
                lines += filled(text)
                alone += filled(text) - own - 1
                holding += len(commented_lines(text)) - 1
    return code, alone, holding, lines


def by_house(code):
    return {house: sum(n for folder, n in code.items() if folder.split("/")[0] == house) for house in HOUSES}


def show(name, now, before):
    print(f"{name:45} {now:6}" + (f" {before:6} {now - before:+6}" if before is not None else ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", nargs="?", type=Path, help="folder of another checkout")
    parser.add_argument("--rooms", action="store_true", help="every folder")
    options = parser.parse_args()
    code, alone, holding, lines = count(ROOT)
    other = count(options.before)[0] if options.before else None
    rows, others = (code, other) if options.rooms else (by_house(code), by_house(other) if other else None)
    for name in sorted(set(rows) | set(others or ())):
        show(name, rows.get(name, 0), others.get(name, 0) if others is not None else None)
    show("together", sum(code.values()), sum(other.values()) if other is not None else None)
    print(f"sources (.cpp): {100 * alone / lines:.1f} % of lines are a comment, {100 * holding / lines:.1f} % hold one")


if __name__ == "__main__":
    main()
