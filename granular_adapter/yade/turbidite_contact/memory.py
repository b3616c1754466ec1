# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine's settings, contact impulses and law states in a YADE object, so that O.save includes them.

The object is an inactive (dead) PyRunner at the end of O.engines, whose command is a comment:

    # turbidite_contact {settings as JSON} {contact memory, base64}

A scene that YADE has loaded is a different one, even if its text equals the one last written here. To recognise
this, the holder is marked with a random number in two places that a dead engine never uses: iterLast, which YADE
saves, and execCount, which it does not.
"""
import binascii
import itertools
import json
import random

from yade.wrapper import Omega, PyRunner

from .refusal import Refused

LABEL = 'turbidite_contact_state'
MARK = '# turbidite_contact'
_marks = itertools.count(random.SystemRandom().getrandbits(60))


def holder(settings):
    """A new holder with these settings (JSON types) and no impulses."""
    runner = PyRunner(command='', dead=True, label=LABEL)
    write(runner, settings, b'')
    return runner


def succeed(earlier, runner):
    """Gives a new holder the contacts of an earlier one, and what its scene lacks."""
    settings, contacts = read(earlier)
    own = read(runner)[0]
    if 'not_in_yade' in settings:
        own['not_in_yade'] = settings['not_in_yade']
    write(runner, own, contacts)


def find():
    """The holder in the present scene."""
    for engine in Omega().engines:
        if engine.label == LABEL:
            return engine
    raise Refused('turbidite_contact: O.engines has no engine labelled '
                  f'{LABEL}; keep all that turbidite_contact.engines() returns')


def write(runner, settings, contacts):
    """Stores settings and contact memory; returns the mark."""
    text = binascii.b2a_base64(contacts, newline=False).decode('ascii')
    runner.command = f'{MARK} {json.dumps(settings)} {text}'
    runner.iterLast = runner.execCount = next(_marks)
    return runner.iterLast


def is_marked(runner, mark):
    """Whether this object itself, and not a loaded copy, was last written with this mark."""
    return runner.iterLast == mark and runner.execCount == mark


def mark(runner):
    """Marks a loaded holder as known."""
    runner.execCount = runner.iterLast
    return runner.iterLast


def read(runner):
    """(settings, contact memory)."""
    mark, text = runner.command[:len(MARK)], runner.command[len(MARK):].strip()
    try:
        if mark != MARK:
            raise ValueError('unexpected beginning')
        settings, end = json.JSONDecoder().raw_decode(text)
        return settings, binascii.a2b_base64(text[end:].strip())
    except ValueError as error:
        raise Refused(f'turbidite_contact: the command of the engine labelled {LABEL} was changed ({error}); '
                      'it holds settings and contact impulses') from error
