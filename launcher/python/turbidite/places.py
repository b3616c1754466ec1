# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the report and the program are: beside this package in a checkout and under one prefix when installed."""
import os
import shutil
from pathlib import Path

from .errors import Error

HERE = Path(__file__).resolve().parent
# From this folder, which is launcher/python/turbidite in a checkout as well as in share/turbidite of a prefix
# (cmake/install.cmake). The program of a checkout builds what it needs.
REPORT = '../../report'
PROGRAMS = ('../../../turbidite', '../../../../../bin/turbidite')


def first_there(places, is_there):
    found = [(HERE / place).resolve() for place in places if is_there(HERE / place)]
    return found[0] if found else None


def report_folder():
    """The folder with the readers of the report; Error without any."""
    found = first_there([REPORT], lambda place: (place / 'run_data.py').is_file())
    if found is None:
        raise Error(f'the readers of turbidite belong to {HERE / REPORT} and are not there\n'
                    '  Install turbidite again, or use launcher/python of a checkout.')
    return found


def program():
    """The program `turbidite`: that of TURBIDITE_PROGRAM, the one beside this package, or the first in PATH."""
    found = os.environ.get('TURBIDITE_PROGRAM') or first_there(PROGRAMS, Path.is_file) or shutil.which('turbidite')
    if not found:
        raise Error('the program turbidite is neither beside this package nor in PATH\n'
                    '  Set TURBIDITE_PROGRAM to it.')
    return str(found)
