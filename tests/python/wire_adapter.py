# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grains side of docs/protocol.md without the library: an independent reader of the protocol.

It has the names of turbidite_adapter that an adapter needs, and says what it is made to say: Coupler.send_frame is
where tests/faults/faulty_grains.py lies. No doorbell, no shapes but discs, no failure but code 4.
"""
import os
import socket
import struct
import sys
import time
import traceback
import zlib

import numpy


def note(step):
    if 'TURBIDITE_MEMBER' in os.environ:
        with open(os.environ['TURBIDITE_MEMBER'], 'a') as record:
            record.write(step + '\n')


note('MPI_Init')
from mpi4py import MPI

ROLE, PROTOCOL, MAGIC = 2, (1, 8), 0x7469646962727574
HELLO, SETTINGS, SHAPES, POPULATION, ORDER, WINDOW, CONTACT_INPUT, MOTION, KICKS, STATE = 1, 2, 3, 4, 6, 10, 12, 13, 16, 17
SAVE, SAVED, RESTORE, RESTORED, FAILURE, DISMISS, FAREWELL, RELEASE = 20, 21, 22, 23, 90, 91, 92, 93


def record(text):
    """"id# velocity*3": integers with a trailing #."""
    fields = [(word.split('*')[0], int((word + '*1').split('*')[1])) for word in text.split()]
    return numpy.dtype([(name.rstrip('#'), '<i8' if name.endswith('#') else '<f8', (count,) if count > 1 else ())
                        for name, count in fields])


GRAIN = record('id# shape# material# prescribed# radius density position*3 orientation*4 velocity*3 angular_velocity*3 '
               'contact_impulse*3 contact_angular_impulse*3 announced_impulse*3 announced_angular_impulse*3')
KICK = record('id# velocity*3 angular_velocity*3 multiplier_impulse*3 multiplier_angular_impulse*3 force*3 torque*3')
RESPONSE = record('id# velocity*3 angular_velocity*3 inertia*21 mismatch')
CONTACT = record('a# b# wall# feature# status# gap length point*3 normal*3 branch*3 impulse*3 rolling_impulse*3')


class Motion:
    def __init__(self, grains, contacts=0, iterations=0, max_penetration=0.0, removed=0, residual=None,
                 converged=True, wall_seconds=0.0, single_contacts=None, quad=None, max=None, contact_violation=None):
        self.__dict__.update((name, value) for name, value in locals().items() if name != 'self')

    def bytes(self):
        out = [listed(self.grains), integers(self.contacts, self.iterations), maybe(self.residual),
               integers(self.converged), reals(self.max_penetration), integers(self.removed), reals(self.wall_seconds)]
        out += [maybe(value) for value in (self.quad, self.max, self.contact_violation)]
        contacts = self.single_contacts
        return b''.join(out) + (integers(0) if contacts is None else integers(1) + listed(contacts))


class Settings(dict):
    text = dict.__getitem__

    def real(self, key):
        return float(self[key])

    def flag(self, key):
        return self[key] == 'true'


class Window:
    def __init__(self, reader):
        self.index, self.time, self.step, self.write_output = (reader.integer(), reader.real(), reader.real(),
                                                               reader.integer() != 0)


# ---- bytes ----------------------------------------------------------------------------------------------------------

class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        self.at += size
        return self.data[self.at - size:self.at]

    def integer(self):
        return struct.unpack('<q', self.take(8))[0]

    def real(self):
        return struct.unpack('<d', self.take(8))[0]

    def text(self):
        return bytes(self.take(self.integer())).decode()

    def list(self, read):
        return [read() for _ in range(self.integer())]

    def records(self, dtype):
        return numpy.frombuffer(self.take(self.integer() * dtype.itemsize), dtype).copy()


def integers(*values):
    return struct.pack(f'<{len(values)}q', *(int(value) for value in values))


def reals(*values):
    return struct.pack(f'<{len(values)}d', *values)


def text(text):
    data = text if isinstance(text, bytes) else str(text).encode()
    return integers(len(data)) + data


def maybe(value):
    return integers(0) if value is None else integers(1) + reals(value)


def listed(records):
    return integers(len(records)) + records.tobytes()


def case_hash(run_folder):
    value = 0xcbf29ce484222325
    with open(os.path.join(run_folder, 'case.yaml'), 'rb') as file:
        for byte in file.read():
            value = (value ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return f'{value:016x}'


# ---- the conversation -----------------------------------------------------------------------------------------------

class Dismissed(Exception):
    pass


class Coupler:
    def __init__(self, local):
        if local.rank == 0:
            MPI.COMM_WORLD.Send(numpy.array([ROLE, local.size], 'i'), 0, 1000)
        self.comm = local.Create_intercomm(0, MPI.COMM_WORLD, 0, 1010 + ROLE)
        self.window, self.iteration, self.sent, self.received = -1, 0, 0, 0

    def send(self, kind, payload=b''):
        self.send_frame(integers(MAGIC, kind, self.window, self.iteration, self.sent, len(payload)) + payload)
        self.sent += 1

    def send_frame(self, frame):
        self.comm.Send([frame, MPI.BYTE], 0, 7)

    def receive(self, *kinds):
        """(kind, Reader) of the next message, which must be one of these; any that is none of the end, without."""
        status = MPI.Status()
        while not self.comm.Iprobe(0, 7, status):
            time.sleep(1e-4)
        frame = bytearray(status.Get_count(MPI.BYTE))
        self.comm.Recv([frame, MPI.BYTE], 0, 7)
        reader = Reader(memoryview(frame))
        magic, kind, self.window, self.iteration, sequence, length = (reader.integer() for _ in range(6))
        assert (magic, sequence, length) == (MAGIC, self.received, len(frame) - 48), (kind, sequence, self.received)
        self.received += 1
        if kind == DISMISS and DISMISS not in kinds:
            raise Dismissed(reader.integer(), reader.text())
        assert not kinds or kind in kinds, (kind, kinds)
        return kind, reader


class Run:
    def __init__(self, adapter, coupler, local, run_folder):
        self.adapter, self.coupler, self.local, self.run_folder = adapter, coupler, local, run_folder

    def hello(self):
        adapter, local = self.adapter, self.local
        log = f'grains.rank{local.rank}.log' if local.size > 1 else 'grains.log'
        saves = hasattr(adapter, 'save')
        flags = [getattr(adapter, flag, False)
                 for flag in ('restores_within_window', 'native_substeps', 'effective_inertia')]
        return b''.join((
            integers(ROLE, *PROTOCOL), text(adapter.name), text(adapter.version), text(adapter.host_code),
            integers(2, local.rank, local.size), text(socket.gethostname()), integers(os.getpid()),
            text(os.path.join(self.run_folder, 'logs', log)), text(case_hash(self.run_folder)),
            integers(saves, flags[0], saves, *flags[1:]), integers(1), text('disc'), integers(0)))

    def start(self):
        coupler = self.coupler
        coupler.send(HELLO, self.hello())
        reader = coupler.receive(SETTINGS)[1]
        settings = Settings(reader.list(lambda: (reader.text(), reader.text())))
        reader = coupler.receive(ORDER)[1]
        order = [kind for kind, _, _ in reader.list(lambda: [reader.integer() for _ in range(3)])]
        self.motion_follows = (WINDOW, MOTION) in zip(order, order[1:])
        reader = coupler.receive(SHAPES)[1]
        shapes = reader.list(lambda: (reader.text(), reader.list(reader.real)))
        grains = coupler.receive(POPULATION)[1].records(GRAIN)
        coupler.send(STATE, self.adapter.initialise(settings, shapes, grains).bytes())

    def solve(self, responses):
        self.solved = True
        return self.adapter.advance(self.now, responses)

    def take(self):
        kind, reader = self.coupler.receive(WINDOW, CONTACT_INPUT, KICKS, SAVE, RESTORE)
        send = self.coupler.send
        if kind == SAVE:
            send(SAVED, self.saved(reader.text()))
        elif kind == RESTORE:
            self.adapter.restore(self.stored(reader))
            send(RESTORED)
        elif kind == WINDOW:
            self.now, self.solved = Window(reader), False
            if self.motion_follows:
                send(MOTION, self.solve(numpy.zeros(0, RESPONSE)).bytes())
        elif kind == CONTACT_INPUT:
            send(MOTION, self.solve(reader.records(RESPONSE)).bytes())
        else:
            if not self.solved:                         # without a fluid
                self.solve(numpy.zeros(0, RESPONSE))
            send(STATE, self.adapter.apply_kick(self.now, reader.records(KICK)).bytes())

    def saved(self, folder):
        state, name = self.adapter.save(), f'grains.rank{self.local.rank}'
        with open(os.path.join(self.run_folder, folder, name), 'wb') as file:
            file.write(state)
            file.flush()
            os.fsync(file.fileno())
        return text(name) + integers(len(state), self.checksum(state)) + text('')

    def checksum(self, state):
        return zlib.crc32(state)

    def stored(self, reader):
        folder, _ = reader.text(), reader.integer()
        parts = reader.list(lambda: (reader.text(), reader.integer(), reader.integer()))
        name, size, checksum = parts[self.local.rank]
        with open(os.path.join(self.run_folder, folder, name), 'rb') as file:
            state = file.read()
        assert (len(state), zlib.crc32(state)) == (size, checksum), name
        return state

    def reason(self, error):
        return f'{type(error).__name__}: {error}'

    def play(self):
        """Until the coupler ends the run; returns exit code and reason."""
        try:
            self.start()
            while True:
                self.take()
        except Dismissed as end:
            return end.args
        except Exception as error:
            traceback.print_exc()
            self.coupler.send(FAILURE, integers(4) + text(self.reason(error)))
        while True:                                     # frames still on their way are dropped
            kind, reader = self.coupler.receive(DISMISS, *range(100))
            if kind == DISMISS:
                return reader.integer(), reader.text()


def run_grains(adapter, run_folder, run=Run, coupler=Coupler):
    note('split')
    local = adapter.comm = MPI.COMM_WORLD.Split(1000 + ROLE, 0)
    note('announcement')
    joined = coupler(local)
    code, reason = run(adapter, joined, local, run_folder).play()
    print(f'the run ended with code {code}: {reason}', flush=True)
    joined.send(FAREWELL)
    joined.receive(RELEASE)
    note('end')
    sys.exit(code)
