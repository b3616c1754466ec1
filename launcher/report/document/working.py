# SPDX-License-Identifier: LGPL-2.1-or-later
"""A line on the terminal that says what a script is doing; none where the output is no terminal."""
import os
import sys


class Progress:
    def __init__(self, title, stream=None):
        self.title, self.stream = title, stream or sys.stderr
        self.shown = self.stream.isatty() and os.environ.get('TERM') != 'dumb'

    def __call__(self, what):
        if self.shown:
            self.stream.write(f'\r\033[K{self.title}: {what} ...')
            self.stream.flush()

    def end(self):
        if self.shown:
            self.stream.write('\r\033[K')
            self.stream.flush()
