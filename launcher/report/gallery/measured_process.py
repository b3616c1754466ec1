# SPDX-License-Identifier: LGPL-2.1-or-later
"""measured_process.py DESCRIPTOR PROGRAM ARGUMENT...: starts a program, waits for it, and writes `CODE SECONDS KILOBYTES` to
the descriptor: how it ended, what all its processes took, and the memory of the largest.

To the kernel a child's memory begins with that of the process that starts it. This one is small: it imports nothing else.
"""
import os
import signal
import sys


def main(descriptor, line):
    child = os.posix_spawnp(line[0], line, os.environ, file_actions=[(os.POSIX_SPAWN_CLOSE, descriptor)])
    # It ends when the program does. A handler, unlike SIG_IGN, is not inherited.
    signal.signal(signal.SIGINT, lambda *_: None)
    signal.signal(signal.SIGTERM, lambda *_: os.kill(child, signal.SIGTERM))
    _, status, used = os.wait4(child, 0)
    told = f'{os.waitstatus_to_exitcode(status)} {used.ru_utime + used.ru_stime} {used.ru_maxrss}'
    os.write(descriptor, told.encode())


if __name__ == '__main__':
    main(int(sys.argv[1]), sys.argv[2:])
