# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plain text with symbols as the code writes them (u_c, rho_s g D^2, |<u>|) as HTML with subscripts and exponents."""
import html
import re

GREEK = {'rho': 'ρ', 'phi': 'φ', 'mu': 'μ', 'nu': 'ν', 'eta': 'η', 'sigma': 'σ'}
SUBSCRIPTED = re.compile(r'(?<![\w.])(rho|ρ|u|t|m|R|F|J|x|V|σ)_(c|s|f|h|0|xx|yy|xy|relax)(?![^\W²³]|\.\w)')
POWER = re.compile(r'(?<![\w.])(D|u|u<sub>c</sub>)\^(\d)')
TENS = re.compile(r'(?<![\w.])(?<![\w.]-)(-?\d+(?:\.\d+)?)e([+-]?)0*(\d+)(?![\w.]*\w)')
MEAN = re.compile(r'&lt;(\|?u(?:_[xy])?\|?|[xy])&gt;')
MATHTEXT = {r'\langle': '⟨', r'\rangle': '⟩', r'\,': ' ', r'\times': '×', r'\degree': '°', r'\Sigma': 'Σ',
            r'\max': 'max', r'\mathrm': '', r'\phi': 'φ', r'\mu': 'μ', r'\rho': 'ρ', r'\sigma': 'σ', r'\delta': 'δ',
            '$': '', '{': '', '}': '', '^2': '²', '^3': '³'}


def plain(mathtext):
    """A label of a figure as plain text."""
    for sign, letter in MATHTEXT.items():
        mathtext = mathtext.replace(sign, letter)
    return ' '.join(mathtext.split()).replace('⟨ ', '⟨').replace(' ⟩', '⟩')


class Code(str):
    """A command, a fingerprint or a path: set as it is, to be copied."""


def typeset(text):
    """Escaped, and typeset; names of keys, columns and files have points or longer words and stay as they are. Also of
    a list of texts, parts of which may be Code."""
    if isinstance(text, list):
        return ''.join(map(typeset, text))
    if isinstance(text, Code):
        return f'<code>{html.escape(text, quote=False)}</code>' if text else ''
    text = MEAN.sub(r'⟨\1⟩', html.escape(text, quote=False))
    text = SUBSCRIPTED.sub(lambda m: f'{GREEK.get(m.group(1), m.group(1))}<sub>{m.group(2)}</sub>', text)
    text = POWER.sub(r'\1<sup>\2</sup>', text)
    text = TENS.sub(lambda m: f'{m.group(1)}·10<sup>{"−" if m.group(2) == "-" else ""}{m.group(3) or 0}</sup>', text)
    return re.sub(r'⟨u_([xy])⟩', r'⟨u<sub>\1</sub>⟩', text)
