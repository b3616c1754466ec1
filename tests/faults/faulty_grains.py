# SPDX-License-Identifier: LGPL-2.1-or-later
"""faulty_grains.py FAULTS NAME RUN: discs that fall, spin and touch nothing, and one fault of the table FAULTS
(faults.txt, which says what its columns mean; NAME `none`: no fault).

The adapter is honest (tests/python/falling.py); its messages are changed on their way to the coupler, as bytes of
docs/protocol.md."""
import struct
import sys

import numpy
import wire_adapter as wire
from falling import Falling, turned

REPORT = wire.record('contacts# iterations# has_residual# converged# max_penetration removed# wall_seconds has_quad# '
                     'has_max# has_violation# has_contacts#')   # without the optional values
FRAME = ('magic', 'kind', 'window', 'iteration', 'sequence', 'length')
KINDS = {'hello': (wire.HELLO, -1), 'start': (wire.STATE, -1), 'motion': (wire.MOTION, 3), 'state': (wire.STATE, 3)}


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
                payload = self.spoilt_hello(payload) if kind[0] == wire.HELLO else self.spoilt_motion(payload)
            head['length'] = len(payload)
        if kind[0] == wire.STATE:
            self.before = wire.Reader(honest).records(wire.GRAIN)
        return struct.pack('<6q', *(head[name] for name in FRAME)) + payload

    def spoilt_hello(self, payload):
        """Role, protocol; three texts; dimension, rank, ranks; host; pid; log; hash."""
        reader, out = wire.Reader(payload), []
        fields = ('role', 'protocol_major', 'protocol_minor', 'adapter', 'version', 'code', 'dimension', 'rank',
                  'ranks', 'host', 'pid', 'log', 'case_hash')
        for name in fields:
            is_text = name in ('adapter', 'version', 'code', 'host', 'log', 'case_hash')
            value = reader.text() if is_text else reader.integer()
            if self.field == 'hello.' + name:
                value = int(changed(0 if is_text else value, self.verb, self.value))
            out.append(wire.text(value) if is_text else wire.integers(value))
        return b''.join(out) + bytes(payload[reader.at:])

    def spoilt_motion(self, payload):
        grains = wire.Reader(payload).records(wire.GRAIN)
        report = numpy.frombuffer(payload[8 + grains.nbytes:], REPORT).copy()
        contacts = numpy.zeros(0, wire.CONTACT)
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
        more = wire.integers(len(contacts)) + contacts.tobytes() if len(contacts) else b''
        return wire.integers(len(grains)) + grains.tobytes() + report.tobytes() + more

    def false_contact(self, grains):
        contacts = numpy.zeros(2 if self.verb == 'contact' else 1, wire.CONTACT)
        contacts['a'], contacts['b'] = grains['id'][0], grains['id'][1]
        contacts['wall'], contacts['normal'] = -1, (1, 0, 0)
        if self.field.startswith('contact.'):
            change_record(contacts[0], self.field[8:], self.verb, self.value)
        return contacts


class Faulty(wire.Coupler):
    fault = Fault(sys.argv[1], sys.argv[2]) if sys.argv[2] != 'none' else None

    def send_frame(self, frame):
        super().send_frame(self.fault.spoil(frame) if self.fault else frame)


wire.run_grains(Falling(wire), sys.argv[-1], coupler=Faulty)
