# SPDX-License-Identifier: LGPL-2.1-or-later
"""A grains adapter in Python: the participant library for programs that use mpi4py.

    import sys
    import turbidite_adapter as turbidite

    class MyCode:
        name, version, host_code = 'my-code', '1.0', 'Python'
        shapes, native_substeps, effective_inertia = ['disc'], True, False

        def initialise(self, settings, shapes, grains): ...   # -> Motion, the grains at t = 0
        def advance(self, window, responses): ...             # -> Motion, the contacts (step 4)
        def apply_kick(self, window, kicks): ...              # -> Motion, the state at the end

        def save(self): ...                                   # -> bytes; with restore: checkpoints
        def restore(self, state): ...                         # goes on from these bytes

    turbidite.run_grains(MyCode(), sys.argv[-1])

The calls mean what docs/write-an-adapter.md says, units and fields are those of coupler/protocol/records.hpp.
`grains`, `kicks` and `responses` are numpy arrays with named fields (GRAIN, KICK, RESPONSE). An exception ends the
run for all participants with its text: exit code 4, or 6 for PhysicsRefused. docs/protocol.md describes the bytes.
"""
import atexit
import collections
import os
import select
import socket
import struct
import sys
import time
import traceback
import zlib

import numpy


def _note_start(step):
    """Notes for the coupler that this program is about to take a step of its start, or to end: docs/protocol.md."""
    if 'TURBIDITE_MEMBER' in os.environ:
        with open(os.environ['TURBIDITE_MEMBER'], 'a') as record:
            record.write(step + '\n')


_note_start('MPI_Init')                # which this import calls
atexit.register(_note_start, 'end')    # the first one registered is the last one called
from mpi4py import MPI

PROTOCOL = (1, 8)
GRAINS = 2                          # the role
FIRST_COLOUR, ANNOUNCEMENT_TAG, INTERCOMM_TAG, FRAME_TAG = 1000, 1000, 1010, 7
MAGIC = 0x7469646962727574          # "turbidit"
HELLO, SETTINGS, SHAPES, POPULATION, ORDER = 1, 2, 3, 4, 6
WINDOW, CONTACT_INPUT, MOTION, KICK_MESSAGE, STATE = 10, 12, 13, 16, 17
SAVE, SAVED, RESTORE, RESTORED = 20, 21, 22, 23
FAILURE, DISMISS, FAREWELL, RELEASE = 90, 91, 92, 93
PARTICIPANT_FAILED, STALLED, PHYSICS_REFUSED = 4, 5, 6
NAMES = {SETTINGS: 'settings', ORDER: 'order', SHAPES: 'shapes', POPULATION: 'population', WINDOW: 'window',
         CONTACT_INPUT: 'contact_input', KICK_MESSAGE: 'kick', SAVE: 'save', RESTORE: 'restore', DISMISS: 'dismiss',
         RELEASE: 'release'}            # of what the coupler sends


def _record(*fields):
    """A record of eight-byte numbers; `name` or (name, count), integers with a trailing `#`."""
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

Shape = collections.namedtuple('Shape', 'kind vertices')
Window = collections.namedtuple('Window', 'index time step write_output')


class PhysicsRefused(Exception):
    """An unphysical state: exit code 6."""


class ProtocolError(Exception):
    """A message that this library does not expect."""


class Motion:
    """The answer of a call: grains (array of GRAIN) and the report of the contact side.

    residual: scaled natural map, None for codes without one; max_penetration [m]; removed: grains that left through
    a free side in this window (apply_kick only); iterations: sweeps, or sub-steps.
    """

    def __init__(self, grains, contacts=0, iterations=0, max_penetration=0.0, removed=0, residual=None,
                 converged=True, wall_seconds=0.0):
        self.grains = numpy.ascontiguousarray(grains, GRAIN)
        self.contacts, self.iterations, self.removed = contacts, iterations, removed
        self.max_penetration, self.wall_seconds = max_penetration, wall_seconds
        self.residual, self.converged = residual, converged


class Settings(dict):
    """The resolved case, key -> text, and run.*; the typed look-ups name a key that is missing."""

    def text(self, key):
        if key not in self:
            raise KeyError(f'the resolved case has no key "{key}"')
        return self[key]

    def real(self, key):
        return float(self.text(key))

    def integer(self, key):
        return int(self.text(key))

    def flag(self, key):
        return {'true': True, 'false': False}[self.text(key)]


# ---- bytes: eight per number, little-endian; texts and lists after their length --------------------------------

class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        if self.at + size > len(self.data):
            raise ProtocolError(f'payload ends after {len(self.data)} bytes, {self.at + size} needed')
        self.at += size
        return self.data[self.at - size:self.at]

    def integer(self):
        return struct.unpack('<q', self.take(8))[0]

    def real(self):
        return struct.unpack('<d', self.take(8))[0]

    def text(self):
        return bytes(self.take(self.integer())).decode(errors='replace')

    def list(self, read):
        return [read() for _ in range(self.integer())]

    def records(self, dtype):
        count = self.integer()
        return numpy.frombuffer(self.take(count * dtype.itemsize), dtype).copy()


def _integers(*values):
    return struct.pack(f'<{len(values)}q', *(int(value) for value in values))


def _text(text):
    data = str(text).encode(errors='replace')          # surrogates, as in names of files that are not UTF-8
    return _integers(len(data)) + data


def _texts(texts):
    return _integers(len(texts)) + b''.join(_text(text) for text in texts)


def _maybe(value):
    return _integers(0) if value is None else _integers(1) + struct.pack('<d', value)


def _encode_motion(motion):
    return b''.join((
        _integers(len(motion.grains)), motion.grains.tobytes(),
        _integers(motion.contacts, motion.iterations), _maybe(motion.residual),
        _integers(motion.converged), struct.pack('<d', motion.max_penetration),
        _integers(motion.removed), struct.pack('<d', motion.wall_seconds),
        _maybe(None), _maybe(None), _maybe(None),       # quad, max, contact violation
        _integers(0)))                                  # single contacts: not sent


def _saves_state(adapter):
    return hasattr(adapter, 'save') and hasattr(adapter, 'restore')


def _case_hash(run_folder):
    """FNV-1a, 64 bits, of the resolved case."""
    value = 0xcbf29ce484222325
    with open(os.path.join(run_folder, 'case.yaml'), 'rb') as file:
        for byte in file.read():
            value = (value ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return f'{value:016x}'


# ---- the conversation with the coupler --------------------------------------------------------------------------

def _name(kind):
    return NAMES.get(kind, f'kind {kind}')


class _Dismissed(Exception):
    def __init__(self, code, reason):
        super().__init__(reason)
        self.code, self.reason = code, reason


class _Doorbell:
    """Lets a process of the same host end our sleep, and us the coupler's (docs/protocol.md)."""

    MOST_HEARD = 1024                                   # rings per sleep: more than a socket queues

    def __init__(self):
        self.name = '\0turbidite/' + os.environ.get('PMIX_NAMESPACE', '') + '/'
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.setblocking(False)
        try:
            self.socket.bind(self.name + str(MPI.COMM_WORLD.rank))
        except OSError:                                 # nobody can ring
            print(f'turbidite: warning: another process has the doorbell {self.name[1:]}{MPI.COMM_WORLD.rank} of this '
                  'one; this one looks for messages by itself, which takes longer', file=sys.stderr, flush=True)

    def ring_coupler(self):
        try:
            self.socket.sendto(b'.', self.name + '0')
        except OSError:                                 # on another host, or it has rings to hear
            pass

    def sleep(self, seconds):
        if not select.select([self.socket], [], [], seconds)[0]:
            return
        try:
            for _ in range(self.MOST_HEARD):
                self.socket.recv(1)                     # several rings are one
        except BlockingIOError:
            pass


class _Coupler:
    """Frames to and from the coupler, rank 0 of the other side of the intercommunicator."""

    def __init__(self, local, run_folder):
        self.local, self.run_folder = local, run_folder
        self.bell = _Doorbell()                         # before the intercommunicator, whose other end may ring at once
        if local.rank == 0:
            MPI.COMM_WORLD.Send(numpy.array([GRAINS, local.size], 'i'), 0, ANNOUNCEMENT_TAG)
        self.comm = local.Create_intercomm(0, MPI.COMM_WORLD, 0, INTERCOMM_TAG + GRAINS)
        self.window, self.iteration, self.sent, self.received = -1, 0, 0, 0
        self.limit = 600.0                              # [s]
        self.pending = []                               # frames that MPI still reads from

    def send(self, kind, payload=b''):
        frame = _integers(MAGIC, kind, self.window, self.iteration, self.sent, len(payload)) + payload
        self.sent += 1
        # A blocking send of a long frame would wait for a coupler that is stopped or gone.
        self.pending = [(kept, request) for kept, request in self.pending if not request.Test()]
        self.pending.append((frame, self.comm.Isend([frame, MPI.BYTE], 0, FRAME_TAG)))
        self.bell.ring_coupler()

    def next(self):
        """(kind, Reader) of the next message; sleeps while it waits, so that others can use the core."""
        status, start = MPI.Status(), time.monotonic()
        while not self.comm.Iprobe(0, FRAME_TAG, status):
            waited = time.monotonic() - start
            if waited > self.limit:
                self.give_up(f'the coupler has been silent for {self.limit:.0f} s')
            self.bell.sleep(min(max(waited / 64, 20e-6), 2e-3))
        frame = bytearray(status.Get_count(MPI.BYTE))
        self.comm.Recv([frame, MPI.BYTE], 0, FRAME_TAG)
        reader = Reader(memoryview(frame))
        magic, kind, window, iteration, sequence, _ = (reader.integer() for _ in range(6))
        if magic != MAGIC:
            raise ProtocolError('not a frame of this protocol')
        self.window, self.iteration = window, iteration     # answers belong to the same place
        self.received, expected = sequence + 1, self.received
        if kind != DISMISS and sequence != expected:
            raise ProtocolError(f'received "{_name(kind)}" of window {window} as number {sequence} of the coupler\'s '
                                f'messages, expected number {expected}: one is missing, or came twice')
        return kind, reader

    def give_up(self, reason):
        """There is nobody to report to: says so in the log and in logs/first_end, and aborts the job."""
        print(f'turbidite: grains: {reason}', file=sys.stderr, flush=True)
        try:
            with open(os.path.join(self.run_folder, 'logs', 'first_end'), 'x') as file:
                file.write(f'{STALLED}\ngrains rank {self.local.rank}\ngave up: {reason}\n')
        except OSError:
            pass                                        # another program was first
        MPI.COMM_WORLD.Abort(STALLED)

    def receive(self, *kinds):
        kind, reader = self.next()
        if kind == DISMISS:
            raise _Dismissed(reader.integer(), reader.text())
        if kind not in kinds:
            due = ' or '.join(f'"{_name(each)}"' for each in kinds)
            raise ProtocolError(f'received "{_name(kind)}" in window {self.window}, but {due} is due')
        return kind, reader

    def fail(self, code, text):
        """Reports a failure; returns the coupler's decision on the run."""
        self.send(FAILURE, _integers(code) + _text(text))
        while True:
            kind, reader = self.next()
            if kind == DISMISS:
                return reader.integer(), reader.text()

    def leave(self):
        """The last message; returns when all ranks may leave."""
        self.send(FAREWELL)
        while self.next()[0] != RELEASE:
            pass


class _Run:
    def __init__(self, adapter, coupler, local, run_folder):
        self.adapter, self.coupler, self.local, self.run_folder = adapter, coupler, local, run_folder
        self.present = None                             # the window
        self.solved = False                             # advance was called in it

    def hello(self):
        adapter, local = self.adapter, self.local
        return b''.join((
            _integers(GRAINS, *PROTOCOL), _text(adapter.name), _text(adapter.version), _text(adapter.host_code),
            _integers(2, local.rank, local.size), _text(socket.gethostname()), _integers(os.getpid()),
            _text(_log_file(self.run_folder, local)), _text(_case_hash(self.run_folder)),
            _integers(_saves_state(adapter), False, _saves_state(adapter), getattr(adapter, 'native_substeps', False),
                      getattr(adapter, 'effective_inertia', False)),
            _texts(getattr(adapter, 'shapes', ['disc'])), _texts(getattr(adapter, 'contact_laws', []))))

    def start(self):
        coupler = self.coupler
        coupler.send(HELLO, self.hello())
        _, reader = coupler.receive(SETTINGS)
        settings = Settings(reader.list(lambda: (reader.text(), reader.text())))
        coupler.limit = 1.5 * settings.real('limits.stall_hard')
        _, reader = coupler.receive(ORDER)
        order = reader.list(lambda: (reader.integer(), reader.integer() != 0, reader.integer()))
        # What this side sends after a message of the coupler.
        self.reply = {kind: after for (kind, ours, _), (after, coupler_sends, _) in zip(order, order[1:])
                      if ours and not coupler_sends}
        _, reader = coupler.receive(SHAPES)
        shapes = reader.list(lambda: Shape(reader.text(), reader.list(reader.real)))
        _, reader = coupler.receive(POPULATION)
        coupler.send(STATE, _encode_motion(self.adapter.initialise(settings, shapes, reader.records(GRAIN))))

    def solve(self, responses):
        self.solved = True
        return self.adapter.advance(self.present, responses)

    def file(self, folder, name):
        return os.path.join(self.run_folder, folder, name)

    def save(self, reader):
        """Writes the adapter's state; if it cannot, this checkpoint is given up and the run goes on."""
        folder, name = reader.text(), f'grains.rank{self.local.rank}'
        size, checksum, fault = 0, 0, ''
        try:
            state = bytes(self.adapter.save())
            with open(self.file(folder, name), 'wb') as file:
                file.write(state)
                file.flush()
                os.fsync(file.fileno())
            size, checksum = len(state), zlib.crc32(state)
        except Exception as error:
            traceback.print_exc()
            fault = f'{type(error).__name__}: {error}'
        self.coupler.send(SAVED, _text(name) + _integers(size, checksum) + _text(fault))

    def restore(self, reader):
        folder, _ = reader.text(), reader.integer()
        parts = reader.list(lambda: (reader.text(), reader.integer(), reader.integer()))
        if len(parts) != self.local.size:
            raise ValueError(f'the checkpoint was written by {len(parts)} grains ranks; go on with the same grains.ranks')
        name, size, checksum = parts[self.local.rank]
        if name in ('', '.', '..') or '/' in name:
            raise ValueError(f'{name!r} is no name of a file in {folder}')
        with open(self.file(folder, name), 'rb') as file:
            state = file.read()
        if (len(state), zlib.crc32(state)) != (size, checksum):
            raise ValueError(f'{self.file(folder, name)} is damaged')
        self.adapter.restore(state)
        self.coupler.send(RESTORED)

    def take(self):
        kind, reader = self.coupler.receive(WINDOW, CONTACT_INPUT, KICK_MESSAGE, SAVE, RESTORE)
        if kind == SAVE:
            self.save(reader)
        elif kind == RESTORE:
            self.restore(reader)
        elif kind == WINDOW:
            self.present = Window(reader.integer(), reader.real(), reader.real(), reader.integer() != 0)
            self.solved = False
            if self.reply.get(WINDOW) == MOTION:
                self.coupler.send(MOTION, _encode_motion(self.solve(numpy.zeros(0, RESPONSE))))
        elif kind == CONTACT_INPUT:
            self.coupler.send(MOTION, _encode_motion(self.solve(reader.records(RESPONSE))))
        else:
            # Without a fluid no motion is asked for: the state is the only report of the window.
            spent = 0.0 if self.solved else self.solve(numpy.zeros(0, RESPONSE)).wall_seconds
            state = self.adapter.apply_kick(self.present, reader.records(KICK))
            state.wall_seconds += spent
            self.coupler.send(STATE, _encode_motion(state))

    def play(self):
        """Until the coupler ends the run; returns exit code and reason."""
        try:
            self.start()
            while True:
                self.take()
        except _Dismissed as end:
            return end.code, end.reason
        except BaseException as error:      # sys.exit as well: it would wait in MPI_Finalize for the others
            traceback.print_exc()
            code = PHYSICS_REFUSED if isinstance(error, PhysicsRefused) else PARTICIPANT_FAILED
            return self.coupler.fail(code, f'{type(error).__name__}: {error}')


def _log_file(run_folder, local):
    number = f'.rank{local.rank}' if local.size > 1 else ''
    return os.path.join(run_folder, 'logs', f'grains{number}.log')


def _redirect_output(file):
    """Standard output and error into one file; turbidite-member has done so already."""
    if 'TURBIDITE_MEMBER' in os.environ:
        return
    os.makedirs(os.path.dirname(file), exist_ok=True)
    log = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
    for stream in (1, 2):
        os.dup2(log, stream)


def run_grains(adapter, run_folder):
    """The whole life of a participant; exits with the exit code of the run.

    All processes of the job make exactly one split of the world, here: after it nothing collective may be done on
    MPI.COMM_WORLD. The adapter's own ranks, if there are several, communicate over `adapter.comm`.
    """
    _note_start('split')
    local = MPI.COMM_WORLD.Split(FIRST_COLOUR + GRAINS, 0)
    _note_start('announcement')
    adapter.comm = local
    _redirect_output(_log_file(run_folder, local))
    coupler = _Coupler(local, run_folder)
    code, reason = _Run(adapter, coupler, local, run_folder).play()
    if code != 0:
        print(f'turbidite: the run ended with code {code}: {reason}', file=sys.stderr, flush=True)
    coupler.leave()
    sys.exit(code)
