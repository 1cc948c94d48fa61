#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""From a wrist pose to the hand on the wire: how long after a client sends a pose the first view that shows it arrives,
and how much of that the server itself took. Prints percentiles; --json for one line of JSON.

usage: serve_latency.py PROGRAM SOURCE_FOLDER [--seconds 10] [--rate 100] [--hand human] [--object flask] [--json]"""
import argparse
import json
import math
import sys
import threading
import time
from pathlib import Path


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, math.ceil(share * len(ordered)) - 1)]


def moved(pose, t):
    """The pose, drawn near and away along the line to the object, with a little tremor."""
    share = 1.0 - 0.4 * (0.5 - 0.5 * math.cos(t))
    tremor = [0.001 * math.sin(40 * t + i) for i in range(3)]
    return [share * x + d for x, d in zip(pose[:3], tremor)] + pose[3:]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('program', type=Path)
    parser.add_argument('source', type=Path)
    parser.add_argument('--seconds', type=float, default=10.0)
    parser.add_argument('--rate', type=float, default=100.0)
    parser.add_argument('--hand', default='human')
    parser.add_argument('--object', default='flask')
    parser.add_argument('--json', action='store_true')
    args = parser.parse_args()
    sys.path.insert(0, str(args.source / 'tests' / 'e2e'))
    import support
    support.PROGRAM, support.SOURCE = args.program.resolve(), args.source.resolve()
    import serve_online_test
    import web_client

    class NoSchema:
        def require(self, value, definition):
            pass

    server = web_client.Server(args.source)
    hand = [h for h in server.get_json('/api/status')['hands'] if h['name'] == args.hand][0]
    app = web_client.Talk(server, NoSchema())
    app.send(type='online.start', hand=args.hand, object=args.object)
    app.wait_for('online.ready')
    pose = serve_online_test.approach_pose(hand, 0.3)
    sent = int(args.seconds * args.rate)
    start = time.monotonic()

    def send_all():
        for i in range(sent):
            time.sleep(max(0.0, start + i / args.rate - time.monotonic()))
            now = time.monotonic() - start
            app.send(type='wrist', time=now, pose=moved(pose, now))

    sender = threading.Thread(target=send_all)
    sender.start()
    whole, inside, shown, views, last = [], [], -1.0, 0, None
    while sender.is_alive() or not whole:
        message = json.loads(app.receive_text())
        now = time.monotonic() - start
        if message['type'] != 'view' or 'wrist' not in message:
            continue
        views, last = views + 1, message
        if message['wrist']['time'] > shown:
            shown = message['wrist']['time']
            whole.append(1e3 * (now - shown))
            if 'server_ms' in message:
                inside.append(message['server_ms'])
    sender.join()
    app.close()
    server.end()
    result = {'hand': args.hand, 'object': args.object, 'poses_sent': sent, 'poses_shown': len(whole), 'views': views,
              'wire_ms': {str(p): round(percentile(whole, p / 100), 3) for p in (50, 90, 99, 100)},
              'server_ms': {str(p): round(percentile(inside, p / 100), 3) for p in (50, 90, 99, 100)},
              'rates': last['rates']}
    if args.json:
        print(json.dumps(result))
        return
    print(f"{args.hand} on {args.object}: {sent} poses sent, {len(whole)} shown, {views} views")
    for name in ('wire_ms', 'server_ms'):
        print(f"{name:10s}" + ''.join(f'  p{p} {v:.2f}' for p, v in result[name].items()))
    print(f"postures/s {last['rates']['postures_per_second']:.0f}, candidates/s "
          f"{last['rates']['candidates_per_second']:.0f}")


if __name__ == '__main__':
    main()
