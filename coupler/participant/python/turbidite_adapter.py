# SPDX-License-Identifier: LGPL-2.1-or-later
"""A grains adapter in Python: the participant library for programs that use mpi4py.

    import sys
    import turbidite_adapter as turbidite

    class MyCode:
        name, version, host_code = 'my-code', '1.0', 'Python'
        shapes, native_substeps, effective_inertia = ['disc'], True, False
        restores_within_window = False
        dimensions = (2,)                                     # of space: (2,), (3,) or (2, 3)
        knows = ['friction']                                  # beyond the least: of KNOWS

        def initialise(self, settings, shapes, grains): ...   # -> Motion, the grains at t = 0
        def advance(self, window, responses): ...             # -> Motion, the contacts (step 4)
        def apply_kick(self, window, kicks): ...              # -> Motion, the state at the end

        def save(self): ...                                   # -> bytes; with restore: checkpoints
        def restore(self, state): ...                         # goes on from these bytes

    turbidite.run_grains(MyCode(), sys.argv[-1])

The calls mean what docs/write-an-adapter.md says, units and fields are those of coupler/protocol/records.hpp.
`grains`, `kicks` and `responses` are numpy arrays with named fields (GRAIN, KICK, RESPONSE), the adapter's own to keep and
to change; `settings` is a Settings, `shapes` a list of Shape (kind, vertices), `window` a Window (index, time, step,
write_output). An exception ends the run for all participants with its text: exit code 4, or 6 for PhysicsRefused; one in
`save` costs this checkpoint only.

`knows` lists what the program can do beyond free grains of one material that touch without friction and restitution,
between walls at rest, on one rank: names of KNOWS. Cases that ask for more are then refused, naming the key. Without it
`initialise` has to.

Everything passes through the C interface, turbidite.h, in libturbidite.so.
"""
import atexit
import collections
import contextlib
import ctypes
import functools
import os
import sys
import traceback

import numpy


def _loaded():
    """The library: BUILD/lib or PREFIX/lib, this module being in BUILD/lib/python or PREFIX/share/turbidite/python."""
    here = os.path.dirname(os.path.abspath(__file__))
    places = [os.path.normpath(os.path.join(here, lib, 'libturbidite.so')) for lib in ('..', '../../../lib')]
    for place in places:
        if os.path.exists(place):
            return ctypes.CDLL(place)
    raise ImportError('turbidite_adapter needs libturbidite.so, which is neither ' + ' nor '.join(places)
                      + ': use the module of the build or of the installation')


_library = _loaded()


def _before_mpi_finalize():
    if not _joins and 'TURBIDITE_MEMBER' in os.environ:
        # All others wait for this program, and MPI_Finalize, which mpi4py calls next, for them.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(Exception):  # closed, absent, or its disk is full
                stream.flush()
        os._exit(1)
    _library.turbidite_before_mpi_finalize()


_joins = False                            # run_grains has been called
_library.turbidite_before_mpi_init()      # which the import of mpi4py calls
atexit.register(_before_mpi_finalize)     # the first one registered is the last one called
from mpi4py import MPI


# ---- records: eight bytes per number ------------------------------------------------------------------------------

def _record(*fields):
    """`name` or (name, count), integers with a trailing `#`."""
    columns = []
    for field in fields:
        name, count = field if isinstance(field, tuple) else (field, 1)
        kind = '<i8' if name.endswith('#') else '<f8'
        columns.append((name.rstrip('#'), kind) if count == 1 else (name, kind, (count,)))
    return numpy.dtype(columns)


GRAIN = _record('id#', 'shape#', 'material#', 'prescribed#', 'radius', 'density', ('position', 3),
                ('orientation', 4), ('velocity', 3), ('angular_velocity', 3), ('contact_impulse', 3),
                ('contact_angular_impulse', 3), ('announced_impulse', 3), ('announced_angular_impulse', 3))
KICK = _record('id#', ('velocity', 3), ('angular_velocity', 3), ('multiplier_impulse', 3),
               ('multiplier_angular_impulse', 3), ('force', 3), ('torque', 3))
RESPONSE = _record('id#', ('velocity', 3), ('angular_velocity', 3), ('inertia', 21), 'mismatch')
CONTACT = _record('a#', 'b#', 'wall#', 'feature#', 'status#', 'gap', 'length', ('point', 3), ('normal', 3),
                  ('branch', 3), ('impulse', 3), ('rolling_impulse', 3))

Shape = collections.namedtuple('Shape', 'kind vertices')
Window = collections.namedtuple('Window', 'index time step write_output')


# TURBIDITE_KNOWS_* of turbidite.h.
KNOWS = {'ranks': 3, 'open_sides': 5, 'inner_walls': 9, 'moving_walls': 17, 'given_motions': 33, 'materials': 65,
         'friction': 129, 'restitution': 257, 'laws': 513, 'contact_positions': 1025}


class PhysicsRefused(Exception):
    """An unphysical state: exit code 6."""


class Motion:
    """The answer of a call: grains (array of GRAIN) and the report of the contact side.

    contacts: their number; max_penetration [m]; removed: grains that left through a free side in this window
    (apply_kick only); iterations: sweeps, or sub-steps. residual: scaled natural map, None for codes without one, and
    likewise quad, max, contact_violation [m/s]. single_contacts: array of CONTACT, with the state of windows with
    output; None is not the same as no contacts.
    """

    def __init__(self, grains, contacts=0, iterations=0, max_penetration=0.0, removed=0, residual=None,
                 converged=True, wall_seconds=0.0, single_contacts=None, quad=None, max=None, contact_violation=None):
        self.grains = numpy.ascontiguousarray(grains, GRAIN)
        self.contacts, self.iterations, self.removed = contacts, iterations, removed
        self.max_penetration, self.wall_seconds = max_penetration, wall_seconds
        self.residual, self.converged = residual, converged
        self.quad, self.max, self.contact_violation = quad, max, contact_violation
        self.single_contacts = None if single_contacts is None else numpy.ascontiguousarray(single_contacts, CONTACT)


class Settings(dict):
    """The resolved case, key -> text, with run.* of settings.hpp; the typed look-ups name a key that is missing."""

    def text(self, key):
        """Any value, as it stands; KeyError for a key that is missing."""
        if key not in self:
            raise KeyError(f'the resolved case has no key "{key}"')
        return self[key]

    def real(self, key):
        """A number; ValueError for another text."""
        return self._as(float, key, 'a number')

    def integer(self, key):
        """A whole number; ValueError for another text."""
        return self._as(int, key, 'a whole number')

    def flag(self, key):
        """True or False; ValueError for another text."""
        value = self.text(key)
        if value not in ('true', 'false'):
            raise ValueError(f'{key} = "{value}" is neither true nor false')
        return value == 'true'

    def _as(self, kind, key, name):
        value = self.text(key)
        try:
            return kind(value)
        except ValueError:
            raise ValueError(f'{key} = "{value}" is not {name}') from None


# ---- the C interface ----------------------------------------------------------------------------------------------

def _in_c(record, *short):
    """The record of turbidite.h, whose integers named in `short` have four bytes."""
    return numpy.dtype([(name, '<i4' if name in short else record[name]) for name in record.names], align=True)


_C_GRAIN = _in_c(GRAIN, 'shape', 'material', 'prescribed')
_C_CONTACT = _in_c(CONTACT, 'wall', 'feature', 'status')

_pointer, _size, _integer, _real, _text = (ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int64, ctypes.c_double,
                                           ctypes.c_char_p)


class _Window(ctypes.Structure):
    _fields_ = [('index', _integer), ('time', _real), ('step', _real), ('write_output', ctypes.c_int32)]


class _Shape(ctypes.Structure):
    _fields_ = [('kind', _text), ('vertices', ctypes.POINTER(_real)), ('count', _size)]


class _Report(ctypes.Structure):
    _fields_ = [('contacts', _integer), ('iterations', _integer), ('removed', _integer), ('residual', _real),
                ('max_penetration', _real), ('wall_seconds', _real), ('converged', ctypes.c_int32), ('quad', _real),
                ('max', _real), ('contact_violation', _real)]


def _function(*arguments):
    return ctypes.CFUNCTYPE(ctypes.c_int, _pointer, *arguments)


class _Adapter(ctypes.Structure):
    _fields_ = [
        ('self', _pointer), ('name', _text), ('version', _text), ('host_code', _text),
        ('shapes', ctypes.POINTER(_text)), ('native_substeps', ctypes.c_int32), ('effective_inertia', ctypes.c_int32),
        ('initialise', _function(_pointer, _pointer, _size, _pointer)),
        ('advance', _function(ctypes.POINTER(_Window), _pointer, _size, _pointer)),
        ('apply_kick', _function(ctypes.POINTER(_Window), _pointer, _size, _pointer)),
        ('save', _function(_pointer)), ('restore', _function(_pointer, _size)),
        ('restores_within_window', _integer), ('contact_laws', ctypes.POINTER(_text)),
        ('joined', ctypes.CFUNCTYPE(None, _pointer, ctypes.c_int)), ('communicator', _pointer),
        ('dimensions', _integer), ('knows', ctypes.c_uint64)]


for _name, _result, *_arguments in (
        ('key', _text, _pointer, _size), ('text', _text, _pointer, _text), ('shape_at', _Shape, _pointer, _size),
        ('grains', _pointer, _pointer, _size), ('report_of', ctypes.POINTER(_Report), _pointer),
        ('contacts', _pointer, _pointer, _size), ('room', _pointer, _pointer, _size), ('fail', None, _text, ctypes.c_int),
        ('run_grains_sized', ctypes.c_int, ctypes.POINTER(_Adapter), _size, _pointer, _pointer, _text)):
    _call = getattr(_library, 'turbidite_' + _name)
    _call.restype, _call.argtypes = _result, _arguments


def _array(place, count, record):
    """The records at an address, without a copy."""
    if count == 0:
        return numpy.zeros(0, record)
    return numpy.frombuffer((ctypes.c_char * (count * record.itemsize)).from_address(place), record)


def _all(get, handle):
    """get(handle, 0), get(handle, 1), ... up to one that is not there."""
    index = 0
    while (entry := get(handle, index)) is not None:
        yield entry
        index += 1


def _answer(state, motion):
    count = len(motion.grains)
    _array(_library.turbidite_grains(state, count), count, _C_GRAIN)[:] = motion.grains
    report = _library.turbidite_report_of(state).contents
    for name, kind in _Report._fields_:
        value = getattr(motion, name)
        setattr(report, name, float('nan' if value is None else value) if kind is _real else int(value))
    if motion.single_contacts is not None:
        count = len(motion.single_contacts)
        _array(_library.turbidite_contacts(state, count), count, _C_CONTACT)[:] = motion.single_contacts


class _Calls:
    """The functions of the struct."""

    def __init__(self, adapter):
        self.adapter = adapter

    def joined(self, handle):
        self.adapter.comm = MPI.Intracomm(MPI.Comm.f2py(handle))

    def initialise(self, settings, grains, count, answer):
        values = Settings((key.decode(errors='replace'), _library.turbidite_text(settings, key).decode(errors='replace'))
                          for key in _all(_library.turbidite_key, settings))
        shapes = [Shape(shape.kind.decode(), shape.vertices[:shape.count])
                  for shape in _all(_shape, settings)]
        _answer(answer, self.adapter.initialise(values, shapes, _array(grains, count, _C_GRAIN).astype(GRAIN)))

    def advance(self, window, responses, count, answer):
        _answer(answer, self.adapter.advance(_window(window), _array(responses, count, RESPONSE).copy()))

    def apply_kick(self, window, kicks, count, answer):
        _answer(answer, self.adapter.apply_kick(_window(window), _array(kicks, count, KICK).copy()))

    def save(self, room):
        state = bytes(memoryview(self.adapter.save()))  # bytes(5) would be five zeros
        ctypes.memmove(_library.turbidite_room(room, len(state)), state, len(state))

    def restore(self, state, size):
        # ctypes.string_at takes no more than 2 GiB.
        self.adapter.restore(bytes((ctypes.c_char * size).from_address(state)) if size else b'')


def _window(pointer):
    window = pointer.contents
    return Window(window.index, window.time, window.step, window.write_output != 0)


def _shape(settings, index):
    shape = _library.turbidite_shape_at(settings, index)
    return shape if shape.kind is not None else None


def _text_of(error):
    try:
        return f'{type(error).__name__}: {error}'
    except Exception:  # of its own __str__
        return type(error).__name__


def _guarded(call):
    """What a call raises ends the run, sys.exit as well: it would wait in MPI_Finalize for the others."""
    def guarded(_, *arguments):
        try:
            call(*arguments)
            return 0
        except BaseException as error:
            # First: stderr may be closed, or its disk full.
            text = _text_of(error).replace('\0', '\ufffd')
            _library.turbidite_fail(text.encode(errors='replace'), isinstance(error, PhysicsRefused))
            with contextlib.suppress(Exception):
                traceback.print_exc()
            return 1
    return guarded


def _texts(texts):
    """Ends with a null pointer."""
    return (_text * (len(texts) + 1))(*(text.encode() for text in texts))


def _dimensions(dimensions):
    """Of turbidite.h."""
    known = {(2,): 2, (3,): 3, (2, 3): 23}
    given = tuple(dimensions) if isinstance(dimensions, (list, tuple)) else dimensions
    if given not in known:
        raise ValueError(f'dimensions = {dimensions}; allowed are (2,), (3,) and (2, 3)')
    return known[given]


def _knows(names):
    """Of turbidite.h; 0 where the adapter says nothing."""
    if names is None:
        return 0
    for name in names:
        if name not in KNOWS:
            raise ValueError(f'knows has "{name}"; allowed are {", ".join(KNOWS)}')
    return functools.reduce(lambda bits, name: bits | KNOWS[name], names, 1)


def _describe(adapter, struct):
    for text in ('name', 'version', 'host_code'):
        setattr(struct, text, str(getattr(adapter, text)).encode(errors='replace'))
    for flag in ('native_substeps', 'effective_inertia', 'restores_within_window'):
        setattr(struct, flag, bool(getattr(adapter, flag, False)))
    struct.shapes = _texts(getattr(adapter, 'shapes', ['disc']))
    struct.contact_laws = _texts(getattr(adapter, 'contact_laws', []))
    struct.dimensions = _dimensions(getattr(adapter, 'dimensions', (2,)))
    struct.knows = _knows(getattr(adapter, 'knows', None))


def _struct(adapter):
    struct, calls, types = _Adapter(), _Calls(adapter), dict(_Adapter._fields_)
    _guarded(lambda: _describe(adapter, struct))(None)
    saves = hasattr(adapter, 'save') and hasattr(adapter, 'restore')
    for name in ('joined', 'initialise', 'advance', 'apply_kick') + (('save', 'restore') if saves else ()):
        setattr(struct, name, types[name](_guarded(getattr(calls, name))))
    return struct


def run_grains(adapter, run_folder):
    """The whole life of a participant; exits with the exit code of the run.

    All processes of the job make exactly one split of the world, here: after it nothing collective may be done on
    MPI.COMM_WORLD. The adapter's own ranks, if there are several, communicate over `adapter.comm`.
    """
    global _joins
    struct, folder = _struct(adapter), os.fsencode(run_folder)
    _joins = True
    sys.exit(_library.turbidite_run_grains_sized(struct, ctypes.sizeof(struct), None, None, folder))
