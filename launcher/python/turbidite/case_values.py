# SPDX-License-Identifier: LGPL-2.1-or-later
"""The resolved case of a run as a nested dict of Python's types. `case.yaml` is written by the program: groups of plain
`key: value` lines, where a value is a word, a number, or a list or map in brackets."""
import re

WORDS = {'true': True, 'false': False, '~': None, 'null': None, '': None}
TOKEN = re.compile(r'\s*("(?:[^"\\]|\\.)*"|[\[\]{},]|:(?=\s)|[^\[\]{},":]+(?::(?=\S)[^\[\]{},":]*)*)')


def nested(flat):
    """{'time.step': '0.01'} as {'time': {'step': 0.01}}."""
    case = {}
    for key, text in flat.items():
        *groups, name = key.split('.')
        inside = case
        for group in groups:
            inside = inside.setdefault(group, {})
        inside[name] = value(text)
    return case


def value(text):
    """A bool, int, float, str, None, list or dict."""
    if not text.startswith(('[', '{')):
        return scalar(text)
    tokens = TOKEN.findall(text)
    found = taken(tokens)
    if tokens:
        raise ValueError(f'"{text}" goes on after its closing bracket')
    return found


def taken(tokens):
    """The value that begins with the first token; takes its tokens away."""
    first = tokens.pop(0)
    if first == '[':
        return items(tokens, ']', taken)
    if first == '{':
        return dict(items(tokens, '}', entry))
    return quoted(first.strip()) if first.strip().startswith('"') else scalar(first.strip())


def entry(tokens):
    first = tokens.pop(0).strip()
    key = quoted(first) if first.startswith('"') else first
    if tokens and tokens[0] == ':':
        tokens.pop(0)
    return key, taken(tokens)


def items(tokens, end, one):
    found = []
    while tokens[0] != end:
        found.append(one(tokens))
        if tokens[0] == ',':
            tokens.pop(0)
    tokens.pop(0)
    return found


def scalar(text):
    if text in WORDS:
        return WORDS[text]
    for number in (int, float):
        try:
            return number(text)
        except ValueError:
            pass
    return text


def quoted(token):
    """What its quotes enclose, without the backslash before each " and backslash of it."""
    return re.sub(r'\\(["\\])', r'\1', token[1:-1])
