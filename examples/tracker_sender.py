#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""Moves the wrist of an interactive session from another program, by datagrams (docs/trackers.md).

Start `eigengrasp serve --udp 8081`, open the app's page Interactive, start a session, then run this. Put your device in
place of read_tracker(). Standard library only."""
import argparse
import json
import math
import socket
import time


def read_tracker(t):
    """Pose of the hand base in the object frame at time t [s]: x, y, z [m], quaternion w, x, y, z.

    Here: from 40 cm beside the object towards it and back again, once in 8 s, with a slight turn about z."""
    distance = 0.15 + 0.25 * abs((t / 4.0) % 2.0 - 1.0)
    turn = 0.2 * math.sin(t)
    return [distance, 0.0, 0.0, math.cos(turn / 2), 0.0, 0.0, math.sin(turn / 2)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--port', type=int, default=8081, help='as after serve --udp')
    parser.add_argument('--rate', type=float, default=100.0, help='poses a second')
    parser.add_argument('--seconds', type=float, default=0.0, help='how long; 0: until Ctrl-C')
    parser.add_argument('--session', help='which session it moves; default: the one that began last')
    parser.add_argument('--close', action='store_true', help='closes the hand at the end')
    args = parser.parse_args()
    session = {'session': args.session} if args.session else {}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        def send(**message):
            out.sendto(json.dumps({**message, **session}).encode() + b'\n', ('127.0.0.1', args.port))

        start = time.monotonic()
        n = 0
        while not args.seconds or n < args.seconds * args.rate:
            t = time.monotonic() - start
            send(type='wrist', time=t, pose=read_tracker(t))
            n += 1
            time.sleep(max(0.0, start + n / args.rate - time.monotonic()))
        if args.close:
            send(type='command', command='close')
    print(f'{n} poses sent')


if __name__ == '__main__':
    try:
        main()
    except KeyboardInterrupt:
        pass
