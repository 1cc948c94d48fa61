#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp serve` among clients that mean it ill, or are slow, silent or many: each is answered with a sentence or
dropped, and a good client beside them is served all the time."""
import json
import os
import queue
import socket
import struct
import threading
import time
import unittest

import support
import web_client


class GoodClient:
    """A client that reads all the time, as an app does."""

    def __init__(self, server, schema):
        self.talk = web_client.Talk(server, schema)
        self.talk.send(type='online.start', hand='human', object='glass')
        self.talk.wait_for('online.ready')
        self.answers = queue.Queue()
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        try:
            while True:
                message = json.loads(self.talk.receive_text())
                if message['type'] != 'view':
                    self.answers.put(message)
        except (web_client.Closed, OSError) as e:
            self.answers.put({'type': 'closed', 'why': repr(e)})

    def is_served(self, number):
        self.talk.send(type='solution.get', id=number)
        answer = self.answers.get(timeout=60)
        return answer == {'type': 'solution', 'id': number} or answer


class Hostile(support.EndToEnd):
    @classmethod
    def setUpClass(cls):
        cls.schema = web_client.Schema()
        cls.server = web_client.Server(support.SOURCE, '--slow-after', 3, '--silent-after', 3, '--hello-within', 2)
        cls.good = GoodClient(cls.server, cls.schema)

    @classmethod
    def tearDownClass(cls):
        code, errors = cls.server.end()
        assert (code, errors) == (0, ''), (code, errors)

    def tearDown(self):
        """Whatever a test did, the good client is served."""
        self.assertIs(self.good.is_served(7), True)

    def talk(self, **more):
        client = web_client.Talk(self.server, self.schema, **more)
        self.addCleanup(client.close)
        return client

    def raw(self):
        client = socket.create_connection(('127.0.0.1', self.server.port), timeout=60)
        self.addCleanup(client.close)
        return client

    def closes(self, client):
        """Waits until the server closes; returns the code."""
        with self.assertRaises((web_client.Closed, ConnectionError)) as closed:
            while True:
                client.receive_text()
        return getattr(closed.exception, 'code', None)

    def refused(self, client, text, *named, code='bad_message'):
        client.send_text(text)
        error = client.wait_for('error')
        self.assertEqual(error['code'], code, text[:200])
        for name in named:
            self.assertIn(name, error['message'])
        self.assertLess(len(error['message']), 600)

    def test_messages_that_are_not_sound_are_answered_with_a_sentence(self):
        client = self.talk()
        pose = [0, 0, 0, 1, 0, 0, 0]
        good = json.dumps({'type': 'plan.stop'})
        for message, named in (
                ('', ['JSON']), ('{', ['JSON']), ('null', ['null', 'object']), ('[]', ['array']), ('"x"', ['object']),
                ('{"type": "wrist"', ['JSON']), ('{"type":"wrist","time":1e999}', ['number']),
                ('[' * 30000 + ']' * 30000, ['deep']), ('{"a":' * 10000 + '1' + '}' * 10000, ['deep']),
                (json.dumps({}), ['type', 'missing']), (json.dumps({'type': 7}), ['7']),
                (json.dumps({'type': 'no.such'}), ['no.such', 'plan.start']),
                (json.dumps({'type': 'wrist', 'time': 1}), ['pose', 'missing']),
                (json.dumps({'type': 'wrist', 'time': '1', 'pose': pose}), ['time', '"1"', 'number']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': pose[:6]}), ['pose', '7']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': pose + [0]}), ['pose', '7']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': [0, 0, 'x', 1, 0, 0, 0]}), ['pose[2]']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': [0, 0, 1e9, 1, 0, 0, 0]}), ['pose[2]', '1000']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': [0] * 7}), ['quaternion', 'length']),
                (json.dumps({'type': 'wrist', 'time': 1, 'pose': pose, 'x': 1}), ['"x"', 'session']),
                (json.dumps({'type': 'plan.start', 'hand': 'h' * 65, 'object': 'o'}), ['hand', '64']),
                (json.dumps({'type': 'plan.start', 'hand': 'h', 'object': 'o', 'options': {'iterations': 10**9}}),
                 ['options.iterations']),
                (json.dumps({'type': 'command', 'command': 'explode'}), ['explode', 'forget']),
                (b'{"type":"\xff\xfe"}', [])):
            with self.subTest(message=str(message)[:80]):
                if isinstance(message, bytes):  # no UTF-8: the WebSocket itself refuses it
                    other = self.talk()
                    other.send_frame(1, message)
                    self.assertEqual(self.closes(other), 1007)
                    continue
                self.refused(client, message, *named)
                client.send_text(good)  # so that they are not too many in a row

    def test_many_unsound_messages_in_a_row_end_the_connection(self):
        client = self.talk()
        for _ in range(25):
            client.send_text('junk')
        self.assertEqual(self.closes(client), 1008)

    def test_giant_binary_and_broken_frames(self):
        client = self.talk()
        client.send_text('x' * 70000)
        self.assertEqual(self.closes(client), 1009)
        announced = self.talk()
        announced.socket.sendall(b'\x81\xff' + struct.pack('>Q', 1 << 62) + b'\0\0\0\0')
        self.assertEqual(self.closes(announced), 1009)
        pieces = self.talk()
        pieces.send_frame(1, b'x' * 40000, final=False)
        pieces.send_frame(0, b'x' * 40000)
        self.assertEqual(self.closes(pieces), 1009)
        binary = self.talk()
        binary.send_frame(2, os.urandom(300))
        self.assertEqual(binary.wait_for('error')['code'], 'bad_message')
        unmasked = self.talk()
        unmasked.socket.sendall(b'\x81\x02{}')
        self.assertEqual(self.closes(unmasked), 1002)
        cut = self.talk()
        cut.socket.sendall(b'\x81\xfe\x01\x00abcd{"type"')
        cut.close()

    def test_hello_comes_first_and_once(self):
        for message in ({'type': 'plan.start', 'hand': 'human', 'object': 'glass'}, {'type': 'hello'},
                        {'type': 'hello', 'protocol': 99, 'role': 'app'}):
            client = self.talk(hello=False)
            client.send(**message)
            self.assertIn(client.receive()['code'], ('not_allowed', 'bad_message'))
            self.assertEqual(self.closes(client), 1008)
        client = self.talk()
        client.send(type='hello', protocol=1, role='app')
        self.assertEqual(client.wait_for('error')['code'], 'not_allowed')

    def test_a_client_that_never_says_hello_is_dropped(self):
        self.closes(self.talk(hello=False))

    def test_a_client_that_answers_no_ping_is_dropped(self):
        silent = self.talk()
        silent.answer_pings = False
        self.closes(silent)

    def test_a_client_that_reads_nothing_is_dropped_and_harms_no_other(self):
        slow = self.talk(receive_buffer=4096)
        slow.send(type='online.start', hand='human', object='glass')
        end = time.monotonic() + 60
        while time.monotonic() < end:  # it sends, but does not read
            try:
                slow.send(type='solution.get', id=1)
            except OSError:
                break
            time.sleep(0.01)
            if not int(time.monotonic() * 10) % 5:
                self.assertIs(self.good.is_served(5), True)
        else:
            self.fail('the slow client was not dropped')

    def test_a_flood_is_answered_once_and_the_rest_dropped(self):
        client = self.talk()
        text = json.dumps({'type': 'plan.stop'})
        for _ in range(20000):
            client.send_text(text)
        client.send_text('junk')  # dropped or not: what counts is that too_fast comes once
        self.assertEqual(client.wait_for('error')['code'], 'too_fast')
        time.sleep(0.1)
        client.send(type='solution.get', id=1)
        self.assertIn(client.wait_for('error')['code'], ('no_session', 'bad_message'))

    def test_two_hundred_clients(self):
        taken, refused = [], 0
        for _ in range(200):
            try:
                taken.append(self.talk())
            except web_client.Refused as e:
                self.assertEqual(e.code, 503)
                self.schema.require(json.loads(e.body), 'ErrorReply')
                refused += 1
        self.assertGreater(len(taken), 10)
        self.assertEqual(len(taken) + refused, 200)
        self.assertGreater(refused, 100)
        for client in taken:
            client.send(type='plan.start', hand='human', object='nothing')
            self.assertEqual(client.wait_for('error')['code'], 'not_known')
            client.close()
        end = time.monotonic() + 30
        while time.monotonic() < end:  # their places are free again
            try:
                return self.talk()
            except web_client.Refused:
                time.sleep(0.05)
        self.fail('no client is let in after 200 left')

    def test_many_idle_connections_are_closed_beyond_the_limit(self):
        sockets = [self.raw() for _ in range(300)]
        sockets[-1].settimeout(10)
        self.assertEqual(sockets[-1].recv(1), b'')
        for s in sockets:
            s.close()
        end = time.monotonic() + 30
        while time.monotonic() < end:
            try:
                self.server.get_json('/api/status')
                return
            except OSError:
                time.sleep(0.05)
        self.fail('no request is served after 300 connections left')

    def test_foreign_origins_and_hosts(self):
        port = self.server.port
        for headers, code in (
                ({'Origin': 'http://evil.example'}, 403), ({'Origin': 'null'}, 403), ({'Origin': 'file://'}, 403),
                ({'Origin': 'http://localhost.evil.example'}, 403), ({'Origin': 'http://127.0.0.1.evil.example'}, 403),
                ({'Origin': f'http://user@127.0.0.1:{port}'}, 403), ({'Host': 'evil.example'}, 403),
                ({'Host': 'evil.example', 'Origin': 'http://evil.example'}, 403), ({'Host': ''}, 403),
                ({'Origin': f'http://127.0.0.1:{port}'}, 200), ({'Origin': 'http://localhost:5173'}, 200),
                ({'Origin': 'http://[::1]:80'}, 200), ({'Host': 'localhost'}, 200), ({'Host': '[::1]:1'}, 200)):
            with self.subTest(headers=headers):
                self.assertEqual(self.server.get('/api/status', headers)[0], code)
                if code == 403 and 'Host' not in headers:
                    with self.assertRaises(web_client.Refused) as refused:
                        web_client.WebSocket(port, headers=headers)
                    self.assertEqual(refused.exception.code, 403)

    def test_requests_that_are_not_http(self):
        for request, answers in ((b'\r\n\r\n', True), (b'GET\r\n\r\n', True), (b'\x16\x03\x01' + os.urandom(200), None),
                                 (b'GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ' + b'a' * 40000, True),
                                 (b'GET ../../etc/passwd HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n', True),
                                 (b'GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999999\r\n\r\n', True),
                                 (b'POST /api/objects?name=a.obj HTTP/1.1\r\nHost: 127.0.0.1\r\n'
                                  b'Content-Length: 99999999999\r\n\r\nv 0 0 0', True),
                                 (b'GET /api/status HTTP/1.1\r\nHost: 127.0.0.1\r\n'
                                  b'Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n', True),
                                 (os.urandom(5000), None)):
            with self.subTest(request=request[:60]):
                client = self.raw()
                reply = b''
                try:
                    client.sendall(request)
                    client.shutdown(socket.SHUT_WR)
                    while data := client.recv(65536):
                        reply += data
                except ConnectionError:
                    pass
                if answers:
                    self.assertRegex(reply[:12], rb'^HTTP/1\.1 4')
                else:
                    self.assertNotIn(b'200', reply[:12])

    def test_websockets_elsewhere_and_no_websocket_at_its_place(self):
        with self.assertRaises(web_client.Refused) as refused:
            web_client.WebSocket(self.server.port, path='/api/status')
        self.assertEqual(refused.exception.code, 404)
        self.assertEqual(self.server.get('/ws')[0], 426)


if __name__ == '__main__':
    support.main()
