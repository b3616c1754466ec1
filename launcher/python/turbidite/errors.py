# SPDX-License-Identifier: LGPL-2.1-or-later
"""What this package raises, in words."""
import difflib


class Error(Exception):
    """Of all errors of this package."""


class NoSuchRun(Error):
    """A folder that is not there, or that no run wrote."""


class NotThere(Error):
    """Data that this run does not have, such as fields of a run without a fluid."""


class UnknownName(Error, KeyError, AttributeError):
    """A name that nothing has; the message tells the nearest one."""

    def __str__(self):  # KeyError would quote it
        return str(self.args[0])


class RunFailed(Error):
    """`turbidite run` ended with an exit code other than 0.

    exit_code: of the program (docs/running.md); folder: of the run, None if nothing was started.
    """

    def __init__(self, message, exit_code, folder):
        super().__init__(f'{message}\n(exit code {exit_code})')
        self.exit_code = exit_code
        self.folder = folder


def nearest(name, known):
    """The most similar of some names, None if none is like it; `friction` finds `contact.friction`."""
    containing = [other for other in known if name and name in other]
    return min(containing, key=len) if containing else next(iter(difflib.get_close_matches(name, known, 1)), None)


def did_you_mean(name, known, shown=str):
    """'Did you mean NAME? ', or nothing; `shown` makes of the name what is shown of it."""
    found = nearest(str(name), list(known))
    return f'Did you mean {shown(found)}? ' if found else ''


def unknown(what, name, known):
    """The error of a name that is none of the `known`."""
    if not known:
        return UnknownName(f'there is no {what} "{name}", and no other')
    meant = did_you_mean(name, known, '"{}"'.format)
    return UnknownName(f'there is no {what} "{name}". {meant}There are: {", ".join(known)}')
