#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""No class holds more than a reader can keep in mind: at most MOST data members. Records of plain data are structs, and
are not counted. Data members of classes end with an underscore."""
import re
import sys
import unittest
from pathlib import Path

MOST = 15
FOLDERS = ('coupler', 'fluid_adapter', 'granular_adapter', 'launcher')
HEAD = re.compile(r'\bclass (\w+)[^;{}()]*\{')
MEMBER = re.compile(r'\b\w*[a-z0-9]_(?=\s*(?:[,;={[]|$))')


def own_text(source, begin):
    """The text of a class that is not in inner braces or parentheses."""
    depth, own = 1, []
    for char in source[begin:]:
        if char in '{(':
            depth += 1
        elif char in '})':
            depth -= 1
            if depth == 0:
                break
        if depth == 1 and char not in '{}()':
            own.append(char)
    return ''.join(own)


def members(source):
    """{class: data members} of a source file."""
    source = re.sub(r'//[^\n]*', '', source)
    found = {}
    for head in HEAD.finditer(source):
        # What is behind "=" is a value, which may name other members.
        declarations = re.sub(r'=[^,;]*', '', own_text(source, head.end()))
        found[head[1]] = sorted(set(MEMBER.findall(declarations)))
    return found


class Classes(unittest.TestCase):
    def test_none_has_more_members_than_fit(self):
        large = {}
        for folder in FOLDERS:
            for file in sorted((ROOT / folder).rglob('*.[hc]pp')):
                for name, own in members(file.read_text()).items():
                    if len(own) > MOST:
                        large[f'{file.relative_to(ROOT)}: {name}'] = len(own)
        self.assertEqual(large, {}, 'group what belongs together')

    def test_members_are_counted(self):
        found = members('class A final : public B {\n public:\n    int f() const { return x_; }\n    void g(int a_);\n'
                        ' private:\n    struct In { int inner_; };\n    int x_ = 0, y_ = x_;  // not z_\n'
                        '    std::vector<int> list_;\n    C c_{1};\n    double d_[3];\n};\nclass D;\n')
        self.assertEqual(found, {'A': ['c_', 'd_', 'list_', 'x_', 'y_']})

    def test_all_folders_are_looked_at(self):
        count = sum(len(members(file.read_text())) for folder in FOLDERS for file in (ROOT / folder).rglob('*.[hc]pp'))
        self.assertGreater(count, 150)


if __name__ == '__main__':
    ROOT = Path(sys.argv.pop(1))
    unittest.main()
