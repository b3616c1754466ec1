# SPDX-License-Identifier: LGPL-2.1-or-later
"""faulty_grains.py FAULTS NAME RUN: discs that fall, spin and touch nothing, and one fault of the table FAULTS
(faults.txt, which says what its columns mean; NAME `none`: no fault).

The adapter is honest; its messages are changed on their way to the coupler, as bytes of docs/protocol.md."""
import struct
import sys

import numpy
import turbidite_adapter as turbidite

CONTACT = turbidite._record('a#', 'b#', 'wall#', 'feature#', 'status#', 'gap', 'length', ('point', 3), ('normal', 3),
                            ('branch', 3), ('impulse', 3), ('rolling_impulse', 3))
REPORT = turbidite._record('contacts#', 'iterations#', 'has_residual#', 'converged#', 'max_penetration', 'removed#',
                           'wall_seconds', 'has_quad#', 'has_max#', 'has_violation#', 'has_contacts#')   # without the optional values
FRAME = ('magic', 'kind', 'window', 'iteration', 'sequence', 'length')
KINDS = {'hello': (turbidite.HELLO, -1), 'start': (turbidite.STATE, -1), 'motion': (turbidite.MOTION, 3),
         'state': (turbidite.STATE, 3)}


class Falling:
    name, version, host_code = 'faulty', '1', 'Python'

    def initialise(self, settings, shapes, grains):
        self.grains, self.g = grains, settings.real('run.gravity')
        return turbidite.Motion(grains)

    def advance(self, window, responses):
        self.grains['velocity'][:, 1] -= self.g * window.step
        return turbidite.Motion(self.grains)

    def apply_kick(self, window, kicks):
        order = numpy.argsort(kicks['id'])[numpy.searchsorted(numpy.sort(kicks['id']), self.grains['id'])]
        for field in ('velocity', 'angular_velocity'):
            self.grains[field] = kicks[field][order]
        self.grains['position'] += window.step * self.grains['velocity']
        for grain in self.grains:
            grain['orientation'] = turned(grain['orientation'], window.step * grain['angular_velocity'][2])
        return turbidite.Motion(self.grains)


def turned(q, angle):
    c, s = numpy.cos(angle / 2), numpy.sin(angle / 2)
    return numpy.array((c * q[0] - s * q[3], 0, 0, c * q[3] + s * q[0]))


def changed(number, verb, value):
    return {'set': value, 'add': number + value, 'times': number * value}[verb]


def change_record(record, field, verb, value):
    """`field`: "radius", or "position.1"."""
    name, _, place = field.partition('.')
    target, at = (record[name], int(place)) if place else (record, name)
    target[at] = changed(target[at], verb, value)


class Fault:
    def __init__(self, table, wanted):
        with open(table) as lines:
            cells = [[cell.strip() for cell in line.split('|')] for line in lines if not line.startswith('#')]
        rows = {row[0]: row for row in cells if len(row) > 4}
        self.due, words = KINDS[rows[wanted][1]], rows[wanted][2].split()
        self.verb, self.field = words[0], words[1] if len(words) > 1 else ''
        self.value = float(words[-1]) if words[-1] not in ('twice', 'drop', 'leave', 'swap') else 0.0
        self.before = None                              # the grains of the last state

    def spoil(self, frame):
        head = dict(zip(FRAME, struct.unpack('<6q', frame[:48])))
        payload, kind = frame[48:], (head['kind'], head['window'])
        honest = payload
        if kind == self.due:
            print('fault:', self.verb, self.field, self.value, flush=True)
            if self.verb == 'cut':
                payload = payload[:-int(self.value)]
            elif self.verb == 'extend':
                payload += bytes(int(self.value))
            elif self.field.startswith('frame.'):
                name = self.field[6:]
                head[name] = int(changed(head[name], self.verb, self.value))
            else:
                payload = self.spoilt_hello(payload) if kind[0] == turbidite.HELLO else self.spoilt_motion(payload)
            head['length'] = len(payload)
        if kind[0] == turbidite.STATE:
            self.before = turbidite.Reader(honest).records(turbidite.GRAIN)
        return struct.pack('<6q', *(head[name] for name in FRAME)) + payload

    def spoilt_hello(self, payload):
        """Role, protocol; three texts; dimension, rank, ranks; host; pid; log; hash."""
        reader, out = turbidite.Reader(payload), []
        fields = ('role', 'protocol_major', 'protocol_minor', 'adapter', 'version', 'code', 'dimension', 'rank',
                  'ranks', 'host', 'pid', 'log', 'case_hash')
        for name in fields:
            is_text = name in ('adapter', 'version', 'code', 'host', 'log', 'case_hash')
            value = reader.text() if is_text else reader.integer()
            if self.field == 'hello.' + name:
                value = int(changed(0 if is_text else value, self.verb, self.value))
            out.append(turbidite._text(value) if is_text else turbidite._integers(value))
        return b''.join(out) + bytes(payload[reader.at:])

    def spoilt_motion(self, payload):
        grains = turbidite.Reader(payload).records(turbidite.GRAIN)
        report = numpy.frombuffer(payload[8 + grains.nbytes:], REPORT).copy()
        contacts = numpy.zeros(0, CONTACT)
        first = grains[0]
        if self.field.startswith('report.'):
            change_record(report[0], self.field[7:], self.verb, self.value)
        elif self.field.startswith('contact.') or self.verb == 'contact':
            contacts = self.false_contact(grains)
        elif self.verb == 'turn':
            first['orientation'] = turned(first['orientation'], self.value)
        elif self.verb == 'part':
            then = self.before[0]['position']
            first['position'] = then + self.value * (first['position'] - then)
        elif self.verb == 'turned':
            then, now = self.before[0]['orientation'], first['orientation']
            angle = 2 * numpy.arctan2(now[3], now[0]) - 2 * numpy.arctan2(then[3], then[0])
            first['orientation'] = turned(then, self.value * angle)
        elif self.verb in ('drop', 'leave'):
            grains = grains[1:]
            report['removed'] = self.verb == 'leave'
        elif self.verb == 'twice':
            grains = numpy.append(grains, grains[:1])
        elif self.verb == 'swap':
            grains['id'][:2] = grains['id'][1::-1]
        else:
            change_record(first, self.field, self.verb, self.value)
        report['has_contacts'] = len(contacts) > 0
        more = turbidite._integers(len(contacts)) + contacts.tobytes() if len(contacts) else b''
        return turbidite._integers(len(grains)) + grains.tobytes() + report.tobytes() + more

    def false_contact(self, grains):
        contacts = numpy.zeros(2 if self.verb == 'contact' else 1, CONTACT)
        contacts['a'], contacts['b'] = grains['id'][0], grains['id'][1]
        contacts['wall'], contacts['normal'] = -1, (1, 0, 0)
        if self.field.startswith('contact.'):
            change_record(contacts[0], self.field[8:], self.verb, self.value)
        return contacts


def play(table, wanted):
    if wanted == 'none':
        return
    fault, isend = Fault(table, wanted), turbidite.MPI.Intercomm.Isend

    class Spoiling(turbidite.MPI.Intercomm):
        def Isend(self, message, dest, tag):
            return isend(self, [fault.spoil(bytes(message[0])), turbidite.MPI.BYTE], dest, tag)

    make = turbidite._Coupler.__init__

    def with_fault(self, local, run_folder):
        make(self, local, run_folder)
        self.comm = Spoiling(self.comm)
    turbidite._Coupler.__init__ = with_fault


play(sys.argv[1], sys.argv[2])
turbidite.run_grains(Falling(), sys.argv[-1])
