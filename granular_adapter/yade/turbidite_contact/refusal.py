# SPDX-License-Identifier: GPL-3.0-or-later
"""What the contact engine cannot treat is refused before a step, by the id of the body."""


class Refused(ValueError):
    """A scene or a setting that is not supported; the text says which body and what to do."""


def refuse(body, fault, remedy):
    raise Refused(f'turbidite_contact: body {body.id} ({shape_name(body)}) {fault}; {remedy}')


def shape_name(body):
    return type(body.shape).__name__ if body.shape is not None else 'no shape'
