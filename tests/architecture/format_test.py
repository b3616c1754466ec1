# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every C++ file is as clang-format writes it, by the tree's .clang-format.

usage: format_test.py PROJECT_FOLDER
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HOUSES = ("coupler", "launcher", "fluid_adapter", "granular_adapter", "bench", "examples", "tests")
FORMATTER = "clang-format-14"  # versions differ; this is Debian 12's


def misformatted(style, files):
    """The files that clang-format would change."""
    found = subprocess.run([FORMATTER, f"--style=file:{style}", "--dry-run", *map(str, files)], check=True,
                           capture_output=True, text=True).stderr
    return sorted({line.split(":")[0] for line in found.splitlines() if "-Wclang-format-violations" in line})


class Format(unittest.TestCase):
    root = None

    def test_every_file_is_formatted(self):
        files = [file for house in HOUSES for file in sorted((self.root / house).rglob("*"))
                 if file.suffix in (".cpp", ".hpp", ".h")]
        self.assertGreater(len(files), 900)
        self.assertEqual(misformatted(self.root / ".clang-format", files), [], "run clang-format-14 -i on these")

    def test_a_file_that_is_not_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            good, bad = Path(folder) / "good.cpp", Path(folder) / "bad.cpp"
            good.write_text("int main() {\n    return 0;\n}\n")
            bad.write_text("int main(){ return 0 ; }\n")
            self.assertEqual(misformatted(self.root / ".clang-format", [good, bad]), [str(bad)])


if __name__ == "__main__":
    Format.root = Path(sys.argv.pop(1))
    unittest.main()
