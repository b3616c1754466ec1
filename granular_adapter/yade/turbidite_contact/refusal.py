# SPDX-License-Identifier: GPL-3.0-or-later
"""Refusal of what the contact engine does not support, before a step, naming the body by its id."""


class Refused(ValueError):
    """A scene or a setting that is not supported; the text names the body and the remedy."""


def refuse(body, fault, remedy):
    raise Refused(f'turbidite_contact: body {body.id} ({shape_name(body)}) {fault}; {remedy}')


def shape_name(body):
    return type(body.shape).__name__ if body.shape is not None else 'no shape'
