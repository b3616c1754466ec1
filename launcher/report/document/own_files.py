# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results replace those of before, and nothing that somebody else keeps under their names."""
from document.page import BEGINNING


class Refusal(Exception):
    """An error message for the user; exit code 2."""


def require_own(files, remedy):
    """Of {file: whether it is such a result, if it is there}."""
    for file, own in files.items():
        if file.is_file() and not own:
            raise Refusal(f'{file} would be overwritten. {remedy}')


def is_page(file, title):
    """Whose title begins so."""
    head = beginning(file)
    return head.startswith(BEGINNING) and f'<title>{title}' in head


def beginning(file):
    """Of a text; empty where there is none that can be read."""
    try:
        with open(file, encoding='utf-8', errors='replace') as text:
            return text.read(1000)
    except OSError:
        return ''
