# SPDX-License-Identifier: LGPL-2.1-or-later
"""The entries of configs/expected.yaml: what is expected of each shipped case and study, and what was recorded."""
import json
import math
import re
from dataclasses import dataclass, field

import quantities

FORMS = ('full', 'quick')
KEYS = {'entry': (*FORMS, 'small'), 'form': ('set', 'expected', 'recorded'),
        'bounds': ('is', 'within', 'above', 'below'), 'recorded': ('commit', 'date', 'processor', 'memory')}
INF = math.inf
PLAIN = re.compile(r'[\w./+](?:[\w./+ -]*[\w./+-])?')  # texts that need no quotes in YAML


class Wrong(Exception):
    """A message for the user; exit code 2."""


@dataclass
class Expectation:
    run: str         # folder below that of a study; empty for a case
    what: str        # quantities.quantity
    lowest: float
    highest: float

    def holds(self, value):
        return value is not None and self.lowest <= value <= self.highest

    def told(self):
        if self.lowest == -INF:
            return f'at most {self.highest:.4g}'
        return f'at least {self.lowest:.4g}' if self.highest == INF else f'{self.lowest:.4g} to {self.highest:.4g}'

    def name(self):
        return f'{self.run}: {self.what}' if self.run else self.what


@dataclass
class Form:
    overrides: dict = field(default_factory=dict)
    expected: list = field(default_factory=list)
    recorded: dict = None   # commit, date, processor [s], memory [MB]; None: never

    def arguments(self):
        return [word for text in self.sets() for word in ('--set', text)]

    def sets(self):
        return [f'{key}={as_yaml(value)}' for key, value in self.overrides.items()]


@dataclass
class Entry:
    name: str
    forms: dict             # full, and quick where there is a short form


def as_yaml(value):
    """Numbers as they were written, 12 and not 12.0; texts that would be read as something else in quotes."""
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    if isinstance(value, list):
        return '[' + ', '.join(as_yaml(one) for one in value) + ']'
    plain = isinstance(value, str) and PLAIN.fullmatch(value) and value.lower() != 'null'
    return value if plain else json.dumps(value, ensure_ascii=False)


def read_entries(tree, is_study):
    """{name: Entry} of the document; `is_study(name)`. Wrong names what is wrong in it."""
    return {name: Entry(name, forms_of(name, node or {}, is_study(name)))
            for name, node in map_of('the file of expected numbers', tree, '{quickstart: {full: ...}}').items()}


def forms_of(name, node, of_study):
    known_only(name, node, KEYS['entry'])
    return {form: form_of(f'{name}.{form}', node.get(form) or {}, of_study) for form in FORMS
            if form in node or form == 'full'}


def form_of(where, node, of_study):
    known_only(where, node, KEYS['form'])
    expected = map_of(f'{where}.expected', node.get('expected') or {}, '{overlap: {below: 1e-4}}')
    groups = expected if of_study else {'': expected}
    found = [expectation(f'{where}.expected', run, what, bounds) for run, group in groups.items()
             for what, bounds in map_of(f'{where}.expected.{run}', group, '{overlap: {below: 1e-4}}').items()]
    recorded = node.get('recorded')
    if recorded is not None:
        known_only(f'{where}.recorded', recorded, KEYS['recorded'])
        if not isinstance(recorded.get('commit'), str) or 'date' not in recorded:
            raise Wrong(f'{where}.recorded: it has a commit, in quotes, and a date: {{commit: "0123456789", date: 2026-01-31}}')
    return Form(map_of(f'{where}.set', node.get('set') or {}, '{time.end: 5}'), found, recorded)


def expectation(where, run, what, bounds):
    known_only(f'{where}.{what}', bounds, KEYS['bounds'])
    try:
        quantities.quantity(what)
    except quantities.Unknown as error:
        raise Wrong(f'{where}: {error}') from None
    for key, value in bounds.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise Wrong(f'{where}.{what}: {key} = {value} is no number')
    if ('is' in bounds) != ('within' in bounds) or not bounds:
        raise Wrong(f'{where}.{what}: is and within belong together: {{is: 0.5, within: 0.01}}; or above, below')
    if 'is' in bounds and ('above' in bounds or 'below' in bounds):
        raise Wrong(f'{where}.{what}: is and within are both bounds; above and below cannot be added')
    lowest, highest = bounds.get('above', -INF), bounds.get('below', INF)
    if 'is' in bounds:
        lowest, highest = bounds['is'] - bounds['within'], bounds['is'] + bounds['within']
    return Expectation(run, what, lowest, highest)


def map_of(where, node, example):
    if not isinstance(node, dict):
        raise Wrong(f'{where}: a map is needed, for example {example}')
    return node


def known_only(where, node, known):
    for key in map_of(where, node, f'{{{known[0]}: ...}}'):
        if key not in known:
            raise Wrong(f'{where}: {key} is unknown. {quantities.did_you_mean(key, known)}Known: {", ".join(known)}.')
