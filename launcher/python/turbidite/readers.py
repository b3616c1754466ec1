# SPDX-License-Identifier: LGPL-2.1-or-later
"""The modules of the report, which read run folders and measure. Their names (`page`, `surface`, `analysis`) are those of
a program of its own, so they are kept apart from the modules of whoever imports this package."""
import contextlib
import importlib
import sys

from . import places

_loaded = {}  # by the name they have in the report


def reader(name):
    """A module of the report: `run_data`, `analysis.energy`."""
    if name not in _loaded:
        with _among_their_own():
            importlib.import_module(name)
    return _loaded[name]


@contextlib.contextmanager
def _among_their_own():
    """Imports find the modules of the report first, and afterwards everything is as it was."""
    folder = places.report_folder()
    own = {path.stem for path in folder.glob('*.py')} | {path.name for path in folder.iterdir() if path.is_dir()}
    of_report = lambda: {name: module for name, module in sys.modules.items() if name.split('.')[0] in own}
    others = of_report()
    for name in others:
        del sys.modules[name]
    sys.modules.update(_loaded)
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        _loaded.update(of_report())
        for name in of_report():
            del sys.modules[name]
        sys.modules.update(others)
