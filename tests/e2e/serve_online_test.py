#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp serve` online: an approach from the first wrist pose to a closed grasp, trackers by WebSocket and UDP,
sessions side by side, logs."""
import json
import math
import socket
import time
import unittest

import support
import web_client


def approach_pose(hand, distance, lean=0.0):
    """Hand base such that the approach point stands `distance` beside the object's origin, the hand looking at it:
    the turn that takes the hand's approach direction to -x (about z, leant by an angle)."""
    d = hand['approach_direction']
    goal = (-math.cos(lean), -math.sin(lean), 0.0)
    dot = sum(a * b for a, b in zip(d, goal))
    axis = (d[1] * goal[2] - d[2] * goal[1], d[2] * goal[0] - d[0] * goal[2], d[0] * goal[1] - d[1] * goal[0])
    w = 1.0 + dot
    if w < 1e-9:
        q = (0.0, 0.0, 0.0, 1.0) if abs(d[2]) < 0.9 else (0.0, 1.0, 0.0, 0.0)
    else:
        n = math.sqrt(w * w + sum(a * a for a in axis))
        q = (w / n, *(a / n for a in axis))
    p = turned(q, hand['approach_point'])
    return [-goal[0] * distance - p[0], -goal[1] * distance - p[1], -p[2], *q]


def turned(q, v):
    w, x, y, z = q
    t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


class Online(support.EndToEnd):
    @classmethod
    def setUpClass(cls):
        cls.schema = web_client.Schema()
        cls.server = web_client.Server(support.SOURCE, '--udp', 0)
        cls.hand = [h for h in cls.server.get_json('/api/status')['hands'] if h['name'] == 'human'][0]

    @classmethod
    def tearDownClass(cls):
        code, errors = cls.server.end()
        assert code == 0, (code, errors)

    def talk(self, server=None, **more):
        client = web_client.Talk(server or self.server, self.schema, **more)
        self.addCleanup(client.close)
        return client

    def begin(self, app, **more):
        app.send(type='online.start', hand='human', object='flask', **more)
        return app.wait_for('online.ready')

    def wait_for_view(self, app, what, seconds=60):
        """The first view of which `what` is true; the wrist is held meanwhile."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            view = app.wait_for('view')
            if what(view):
                return view
        self.fail(f'no such view within {seconds} s; the last: {view}')

    def test_an_approach_that_ends_in_a_grasp_that_holds(self):
        app = self.talk()
        ready = self.begin(app)
        self.assertEqual(ready['session'], app.welcome['session'])
        first = app.wait_for('view')
        self.assertEqual((first['phase'], 'wrist' in first), ('waiting', False))
        app.send(type='wrist', time=1.0, pose=approach_pose(self.hand, 0.15))
        view = self.wait_for_view(app, lambda v: 'offer' in v)
        self.assertEqual((view['phase'], view['wrist']['time']), ('approach', 1.0))
        self.assertEqual(view['solutions'][0]['id'], view['offer']['id'])
        for poses in (view['link_poses'], view['offer']['pregrasp'], view['offer']['grasp']):
            self.assertEqual(len(poses), self.hand['n_links'])
        self.assertGreater(view['rates']['postures'], 0)
        app.send(type='solution.get', id=view['offer']['id'])
        solution = app.wait_for('solution')
        if 'grasp' in solution:  # it may have aged meanwhile
            self.assertTrue(solution['grasp']['form_closure'])
        app.send(type='solution.get', id=10**12)
        self.assertNotIn('grasp', app.wait_for('solution'))
        self.move_to_the_offer(app)
        app.send(type='command', command='close')
        closed = app.wait_for('closed')
        self.assertIn('grasp', closed)
        self.assertTrue(closed['grasp']['form_closure'], closed['message'])
        self.assertGreater(len(closed['grasp']['contacts']), 1)
        self.assertEqual(self.wait_for_view(app, lambda v: v['phase'] != 'approach')['phase'], 'holding')
        app.send(type='command', command='open')
        self.wait_for_view(app, lambda v: v['phase'] == 'approach')
        app.send(type='online.stop')
        self.assertEqual(app.wait_for('online.stopped')['session'], app.welcome['session'])
        app.send(type='command', command='close')
        self.assertEqual(app.wait_for('error')['code'], 'no_session')

    def move_to_the_offer(self, app):
        """As an operator does: towards the pre-grasp that is offered at the time, in small steps."""
        offers = []
        for step in range(600):
            view = self.wait_for_view(app, lambda v: 'wrist' in v)
            if 'offer' not in view:
                continue
            if view['offer']['id'] not in offers[-1:]:
                offers.append(view['offer']['id'])
            here, there = view['wrist']['pose'], view['offer']['pregrasp'][0]
            if sum(a * b for a, b in zip(here[3:], there[3:])) < 0:
                there = there[:3] + [-x for x in there[3:]]
            distance = math.dist(here[:3], there[:3])
            share = min(1.0, 0.01 / max(distance, 1e-9))
            pose = [a + share * (b - a) for a, b in zip(here, there)]
            length = math.sqrt(sum(x * x for x in pose[3:]))
            app.send(type='wrist', time=2.0 + 0.02 * step, pose=pose[:3] + [x / length for x in pose[3:]])
            if distance < 1e-5 and view['preshape'] > 0.99 and not view['blocked']:
                return
        self.fail(f"the wrist did not get to the offered pre-grasp: {distance} m off, preshape {view['preshape']}, "
                  f"blocked {view['blocked']}, offers {offers}, {view['message']}")

    def test_trackers_move_the_session_they_name_or_the_newest(self):
        first, second = self.talk(), self.talk()
        self.begin(first)
        self.begin(second)
        pose = approach_pose(self.hand, 0.3)
        named = self.talk(role='tracker', hello={'session': first.welcome['session']})
        self.assertNotIn('session', named.welcome)
        named.send(type='wrist', time=11.0, pose=pose)
        self.wait_for_view(first, lambda v: v.get('wrist', {}).get('time') == 11.0)
        newest = self.talk(role='tracker')
        newest.send(type='wrist', time=12.0, pose=pose)
        self.wait_for_view(second, lambda v: v.get('wrist', {}).get('time') == 12.0)
        newest.send(type='wrist', time=13.0, pose=pose, session=first.welcome['session'])
        self.wait_for_view(first, lambda v: v.get('wrist', {}).get('time') == 13.0)
        newest.send(type='wrist', time=14.0, pose=pose, session='nobody')
        self.assertEqual(newest.wait_for('error')['code'], 'no_session')
        newest.send(type='plan.start', hand='human', object='glass')
        self.assertEqual(newest.wait_for('error')['of'], 'plan.start')
        second.send(type='wrist', time=15.0, pose=pose, session=first.welcome['session'])
        self.assertEqual(second.wait_for('error')['code'], 'not_allowed')
        newest.send(type='command', command='close')  # goes to the app of the session
        second.wait_for('closed')

    def test_a_tracker_may_send_datagrams(self):
        app = self.talk()
        self.begin(app)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tracker:
            for junk in (b'', b'{', b'\x00\xff' * 100, b'[' * 5000, b'x' * 60000, b'{"type":"plan.stop"}',
                         b'{"type":"wrist","time":1,"pose":[0,0,0,9,9,9,9]}'):
                tracker.sendto(junk, ('127.0.0.1', self.server.udp_port))
            message = {'type': 'wrist', 'time': 21.0, 'pose': approach_pose(self.hand, 0.3),
                       'session': app.welcome['session']}
            tracker.sendto(json.dumps(message).encode() + b'\n', ('127.0.0.1', self.server.udp_port))
            self.wait_for_view(app, lambda v: v.get('wrist', {}).get('time') == 21.0)

    def test_late_and_repeated_wrist_poses_change_nothing(self):
        app = self.talk()
        self.begin(app)
        pose = approach_pose(self.hand, 0.3)
        for stamp in (5.0, 5.2, 5.1, 5.2, 4.9):
            app.send(type='wrist', time=stamp, pose=pose)
        app.send(type='targets', targets=[])
        app.send(type='solution.get', id=10**12)
        app.wait_for('solution')  # everything before it was taken in
        self.assertEqual(app.wait_for('view')['wrist']['time'], 5.2)

    def test_targets_that_there_are_not_are_refused(self):
        app = self.talk()
        self.begin(app)
        app.send(type='targets', targets=[{'variable': 'amplitude', 'index': 0, 'value': 0.1, 'confidence': 0.5}])
        app.send(type='targets', targets=[{'variable': 'dof', 'index': 200, 'value': 0.1}])
        error = app.wait_for('error')
        self.assertEqual((error['code'], error['of']), ('bad_message', 'targets'))
        app.wait_for('view')  # and it goes on

    def test_more_sessions_than_allowed_are_told_so(self):
        server = web_client.Server(support.SOURCE, '--max-sessions', 1, '--max-plans', 1)
        self.addCleanup(server.end)
        first, second = self.talk(server), self.talk(server)
        self.begin(first)
        second.send(type='online.start', hand='human', object='flask')
        self.assertEqual(second.wait_for('error')['code'], 'busy')
        first.send(type='plan.start', hand='human', object='flask', options={'iterations': 10000000})
        first.wait_for('plan.started')
        second.send(type='plan.start', hand='human', object='flask')
        self.assertEqual(second.wait_for('error')['code'], 'busy')

    def test_a_log_holds_what_came_in_and_went_out(self):
        logs = self.folder / 'logs'
        server = web_client.Server(support.SOURCE, '--log', logs, '--token', 'a secret token')
        app = self.talk(server, hello={'token': 'a secret token'})
        self.begin(app)
        sent = [{'type': 'wrist', 'time': 1.0 + 0.1 * i, 'pose': approach_pose(self.hand, 0.3 - 0.01 * i)}
                for i in range(10)]
        for message in sent:
            app.send(**message)
        app.send(type='command', command='close')
        app.wait_for('closed')
        app.send(type='online.stop')
        app.wait_for('online.stopped')
        listed = server.get_json('/api/logs?token=a%20secret%20token')
        self.schema.require(listed, 'Logs')
        self.assertEqual(len(listed['logs']), 1)
        app.close()
        self.assertEqual(server.end()[0], 0)
        text = (logs / listed['logs'][0]['name']).read_text()
        self.assertNotIn('secret', text)
        lines = [json.loads(line) for line in text.splitlines()]
        for line in lines[:100]:
            self.schema.require(line, 'LogLine')
        self.assertEqual([line['t'] for line in lines], sorted(line['t'] for line in lines))
        came_in = [line['in'] for line in lines if 'in' in line]
        self.assertEqual([m for m in came_in if m['type'] == 'wrist'], sent)
        self.assertEqual([m['type'] for m in came_in if m['type'] != 'wrist'],
                         ['online.start', 'command', 'online.stop'])
        went_out = [line['out']['type'] for line in lines if 'out' in line]
        self.assertEqual((went_out[0], went_out[-1]), ('online.ready', 'online.stopped'))
        self.assertIn('view', went_out)
        self.replay_again(logs / listed['logs'][0]['name'])

    def replay_again(self, log):
        run = self.run_program('replay', log)
        self.assertIn(run.returncode, (0, 1), run.stderr)  # 0.2 m from the object there may be nothing to hold
        self.assertRegex(run.stdout, r'task 1: human on flask, 11 inputs in .*\n +close 1: .+; then .+\n')
        self.assertNotIn('not recorded', run.stdout)
        for wrong, sentence in ((self.file('empty.jsonl'), 'holds no interactive session'),
                                (self.folder / 'none.jsonl', 'none.jsonl')):
            run = self.run_program('replay', wrong)
            self.assertEqual(run.returncode, 2)
            self.assertIn(sentence, run.stderr)


if __name__ == '__main__':
    support.main()
