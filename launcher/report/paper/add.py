# SPDX-License-Identifier: LGPL-2.1-or-later
"""Adds the paper's figures and statements to a study's page, and writes them as Markdown."""
from document.page import write_whole
from paper import figures, statements
from paper.selection import PaperRuns

TITLE = '# Topin et al. 2011, figure by figure'  # of the Markdown, by which it is known
HEADER = ['section', 'statement', 'paper', 'ours, mean (smallest to largest)', 'verdict', 'mesh and pores',
          'part of the study']


def add(page, folder, study_runs):
    """True if the Markdown was written; the figures follow with those of the page."""
    runs = PaperRuns(study_runs)
    made = figures.all_figures(runs)
    table = statements.rows(runs)
    page.heading('Statements of Topin et al. 2011')
    page.table(table, header=HEADER)
    page.heading('Figures of Topin et al. 2011')
    for number, caption, figure in made:
        page.figure(figure, name_of(number), f'Fig. {number}. {caption}')
    return write_whole(folder / 'paper.md', markdown(table, [(number, caption) for number, caption, _ in made]))


def name_of(number):
    return f'paper-figure-{number}'


def markdown(table, made):
    lines = [TITLE, '', '`turbidite study configs/paper.yaml` wrote this file.', '',
             '| ' + ' | '.join(HEADER) + ' |', '|' + '---|' * len(HEADER)]
    lines += ['| ' + ' | '.join(cell.replace('|', r'\|') for cell in row) + ' |' for row in table]
    for number, caption in made:
        lines += ['', f'![Figure {number}](pictures/{name_of(number)}.png)', '', f'*Fig. {number}. {caption}*']
    return '\n'.join(lines) + '\n'
