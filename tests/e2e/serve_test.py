#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp serve`: what it starts with and refuses, HTTP, plans, uploads, files of plans, Ctrl-C."""
import io
import json
import os
import socket
import struct
import unittest
import zipfile

import support
import web_client


def glb_nodes(data):
    """Names of the nodes of a binary glTF."""
    magic, version, length = struct.unpack('<4sII', data[:12])
    assert (magic, version, length) == (b'glTF', 2, len(data)), data[:20]
    size, kind = struct.unpack('<I4s', data[12:20])
    assert kind == b'JSON'
    return [node.get('name') for node in json.loads(data[20:20 + size])['nodes']]


def packed_hand(hand, change=lambda text: text, leave_out=None):
    """A shipped hand's folder as a .zip, its hand.yaml changed."""
    packed = io.BytesIO()
    folder = os.path.join(support.SOURCE, 'data', 'hands', hand)
    with zipfile.ZipFile(packed, 'w', zipfile.ZIP_DEFLATED) as archive:
        for place, _, names in os.walk(folder):
            for name in names:
                if name == leave_out:
                    continue
                with open(os.path.join(place, name), encoding='utf-8') as file:
                    text = file.read()
                path = os.path.relpath(os.path.join(place, name), os.path.dirname(folder))
                archive.writestr(path, change(text) if name == 'hand.yaml' else text)
    return packed.getvalue()


class Start(support.EndToEnd):
    def test_a_port_in_use_is_one_sentence(self):
        with socket.socket() as taken:
            taken.bind(('127.0.0.1', 0))
            taken.listen()
            self.refuse(['serve', '--port', taken.getsockname()[1]], 'in use', '--port')

    def test_another_address_needs_a_token(self):
        self.refuse(['serve', '--bind', '0.0.0.0', '--port', 0], '--token', '0.0.0.0')

    def test_bad_options_are_one_sentence(self):
        for args, named in (
                (['--app', self.folder], 'index.html'),
                (['--port', 70000], '--port'),
                (['--token', 'short'], '--token'),
                (['--hand', 'nobody'], 'nobody'),
                (['--object', 'nothing'], 'nothing'),
                (['--bind', 'example', '--token', 'a' * 20], '--bind'),
                (['--max-clients', 0], '--max-clients')):
            with self.subTest(args=args):
                self.refuse(['serve', *args], named)

    def test_an_app_that_is_not_built_says_how_to_build_it(self):
        (self.folder / 'share').mkdir()
        app = self.file('app/index.html', '<html>the app</html>')
        self.file('app/assets/app.js', 'let x = 1;')
        self.file('secret.txt', 'secret')
        os.symlink(self.folder / 'secret.txt', self.folder / 'app' / 'link.txt')
        server = web_client.Server(self.folder, '--app', app.parent)
        self.addCleanup(server.end)
        self.assertEqual(server.get('/')[2], b'<html>the app</html>')
        status, headers, body = server.get('/assets/app.js')
        self.assertEqual((status, body), (200, b'let x = 1;'))
        self.assertTrue(headers['Content-Type'].startswith('text/javascript'))
        for path in ('/link.txt', '/../secret.txt', '/%2e%2e/secret.txt', '/assets/../../secret.txt',
                     '/assets/%2e%2e%2f%2e%2e%2fsecret.txt', '//etc/passwd', '/..%5csecret.txt', '/%00', '/%zz',
                     '/api/logs/../secret.txt', '/api/plans/../../secret.txt', '/api/hands/..%2f../model.glb'):
            with self.subTest(path=path):
                status, _, body = server.get(path)
                self.assertIn(status, (400, 404))
                self.assertNotIn(b'secret', body.replace(path.encode(), b''))

    def test_ctrl_c_ends_it_cleanly_with_clients_and_plans(self):
        server = web_client.Server(self.folder)
        schema = web_client.Schema()
        app = web_client.Talk(server, schema)
        idle = web_client.Talk(server, schema)
        app.send(type='plan.start', hand='human', object='glass', options={'iterations': 10000000})
        app.wait_for('plan.started')
        code, errors = server.end()
        self.assertEqual((code, errors), (0, ''))
        with self.assertRaises(web_client.Closed) as closed:
            while True:
                idle.receive()
        self.assertEqual(closed.exception.code, 1001)


class Serving(support.EndToEnd):
    @classmethod
    def setUpClass(cls):
        cls.schema = web_client.Schema()
        cls.server = web_client.Server(support.SOURCE)

    @classmethod
    def tearDownClass(cls):
        code, errors = cls.server.end()
        assert (code, errors) == (0, ''), (code, errors)

    def talk(self, **more):
        client = web_client.Talk(self.server, self.schema, **more)
        self.addCleanup(client.close)
        return client

    def test_status_lists_hands_and_objects_and_their_models_have_named_nodes(self):
        status = self.server.get_json('/api/status')
        self.schema.require(status, 'Status')
        hands = {hand['name']: hand for hand in status['hands']}
        self.assertLessEqual({'human', 'barrett-rubber'}, set(hands))
        self.assertLessEqual({'glass', 'shoe'}, {o['name'] for o in status['objects']})
        human = hands['human']
        self.assertEqual((human['n_dof'], human['n_links']), (20, len(human['links'])))
        self.assertEqual(len(human['rest']), human['n_links'])
        code, headers, body = self.server.get('/api/hands/human/model.glb')
        self.assertEqual((code, headers['Content-Type']), (200, 'model/gltf-binary'))
        nodes = glb_nodes(body)
        self.assertEqual(nodes[0], 'hand')
        self.assertLessEqual(set(nodes[1:]), set(human['links']))
        self.assertGreater(len(nodes), 15)
        self.assertEqual(glb_nodes(self.server.get('/api/objects/glass/model.glb')[2]), ['scene', 'object'])
        for path in ('/api/hands/nobody/model.glb', '/api/objects/x/model.glb', '/api/nothing', '/api/logs'):
            code, _, body = self.server.get(path)
            self.assertEqual(code, 404, path)
            self.schema.require(json.loads(body), 'ErrorReply')

    def test_a_plan_from_start_to_files(self):
        app = self.talk()
        app.send(type='plan.start', hand='human', object='glass', options={'grasps': 6, 'seed': 3})
        started = app.wait_for('plan.started')
        result = app.wait_for('plan.result')
        self.assertEqual((result['status'], result['id']), ('found', started['id']))
        milestones = [m for m in app.seen if m['type'] == 'plan.milestone']
        self.assertGreater(len(milestones), 0)
        energies = [m['energy'] for m in milestones]
        self.assertEqual(energies, sorted(energies, reverse=True))
        grasps = result['grasps']
        self.assertTrue(1 <= len(grasps) <= 6)
        epsilons = [g['epsilon'] for g in grasps if g['form_closure']]
        self.assertEqual(epsilons, sorted(epsilons, reverse=True))
        self.same_as_the_command(grasps, 'glass', 'human', '--grasps', 6, '--seed', 3)
        self.files_of(started['id'], len(grasps))

    def same_as_the_command(self, grasps, *args):
        """What `eigengrasp plan` finds with the same options."""
        self.succeed('plan', *args[:1], '--hand', *args[1:], '--no-pictures', '--out', 'out')
        file = json.loads((self.folder / 'out' / 'grasps.json').read_text())
        self.assertEqual([g['epsilon'] for g in grasps], [g['epsilon'] for g in file['grasps']])
        for ours, theirs in zip(grasps, file['grasps']):
            self.assertEqual(len(ours['contacts']), len(theirs['contacts']))
            base = ours['closing'][-1][0]  # the first link is the hand base
            for a, b in zip(base[:3], theirs['grasp']['hand_pose']['position']):
                self.assert_near(a, b, 1e-6)
            for a, b in zip(base[3:], theirs['grasp']['hand_pose']['orientation']):
                self.assert_near(a, b, 2e-6)

    def files_of(self, plan, n):
        file = self.server.get_json(f'/api/plans/{plan}/grasps.json')
        self.assertEqual(len(file['grasps']), n)
        csv = self.server.get(f'/api/plans/{plan}/grasps.csv')[2].decode()
        self.assertEqual(len(csv.strip().splitlines()), n + 1)
        self.assertTrue(self.server.get(f'/api/plans/{plan}/grasps.png')[2].startswith(b'\x89PNG'))
        self.assertIn('object_frame', glb_nodes(self.server.get(f'/api/plans/{plan}/grasp-{n}.glb')[2]))
        for name in (f'grasp-{n + 1}.glb', 'grasp-0.glb', 'grasp-.glb', 'grasp--1.glb', 'x'):
            self.assertEqual(self.server.get(f'/api/plans/{plan}/{name}')[0], 404, name)

    def test_a_plan_that_is_stopped_answers_with_what_it_found(self):
        app = self.talk()
        app.send(type='plan.start', hand='human', object='glass', options={'iterations': 10000000})
        app.wait_for('plan.progress')
        app.send(type='plan.stop')
        self.assertTrue(app.wait_for('plan.result')['stopped_early'])

    def test_a_second_plan_takes_the_place_of_the_first(self):
        app = self.talk()
        app.send(type='plan.start', hand='human', object='glass', options={'iterations': 10000000})
        first = app.wait_for('plan.started')
        app.send(type='plan.start', hand='human', object='shoe', options={'iterations': 5000})
        result = app.wait_for('plan.result')
        self.assertNotEqual(result['id'], first['id'])

    def test_unknown_names_are_answered_with_those_that_are_known(self):
        app = self.talk()
        app.send(type='plan.start', hand='human', object='teapot')
        error = app.wait_for('error')
        self.assertEqual((error['code'], error['of']), ('not_known', 'plan.start'))
        self.assertIn('glass', error['message'])

    def test_an_upload_is_an_object_like_any_other(self):
        body = support.box_obj((40, 40, 60)).encode()
        code, _, reply = self.server.request('POST', '/api/objects?name=my%20box.obj&units=mm', body)
        self.assertEqual(code, 200, reply)
        reply = json.loads(reply)
        self.schema.require(reply, 'UploadReply')
        entry = [o for o in self.server.get_json('/api/status')['objects'] if o['name'] == reply['name']][0]
        for side, expected in zip(entry['size'], (0.04, 0.04, 0.06)):
            self.assert_near(side, expected, 1e-6)
        self.assertTrue(entry['uploaded'])
        app = self.talk()
        app.send(type='plan.start', hand='barrett-rubber', object=reply['name'], options={'iterations': 20000})
        self.assertEqual(app.wait_for('plan.result')['status'], 'found')
        again = json.loads(self.server.request('POST', '/api/objects?name=my%20box.obj&units=mm', body)[2])
        self.assertNotEqual(again['name'], reply['name'])

    def test_bad_uploads_are_refused_with_a_sentence_that_names_no_folder(self):
        box = support.box_obj((0.04, 0.04, 0.06)).encode()
        glb = b'glTF' + struct.pack('<II', 2, 60) + struct.pack('<I4s', 40, b'JSON') + \
            b'{"buffers":[{"uri":"../../etc/passwd"}]}'
        for path, body, named in (
                ('/api/objects?name=a.exe', box, '.exe'), ('/api/objects?name=a.gltf', box, '.gltf'),
                ('/api/objects', box, 'name'), ('/api/objects?name=a.obj', b'', 'empty'),
                ('/api/objects?name=a.obj', b'\x00\xff' * 500, ''), ('/api/objects?name=a.stl', box, ''),
                ('/api/objects?name=a.obj&units=miles', box, 'miles'), ('/api/objects?name=a.glb', glb, 'uri'),
                ('/api/objects?name=' + 'x' * 300 + '.obj', box, '200'),
                ('/api/objects?name=a.obj&units=m', support.box_obj((4000, 4000, 6000)).encode(), 'units')):
            with self.subTest(path=path[:60]):
                code, _, reply = self.server.request('POST', path, body)
                self.assertEqual(code, 400, reply)
                self.schema.require(json.loads(reply), 'ErrorReply')
                self.assertIn(named, json.loads(reply)['error'])
                self.assertNotIn('/tmp', json.loads(reply)['error'])

    def test_an_uploaded_hand_is_a_hand_like_any_other(self):
        body = packed_hand('barrett-metal', lambda text: text.replace('name: barrett-metal', 'name: three fingers'))
        code, _, reply = self.server.request('POST', '/api/hands?name=my%20hand.zip', body)
        self.assertEqual(code, 200, reply)
        reply = json.loads(reply)
        self.schema.require(reply, 'UploadReply')
        self.assertEqual(reply['name'], 'three_fingers')
        status = self.server.get_json('/api/status')
        self.schema.require(status, 'Status')
        hands = {hand['name']: hand for hand in status['hands']}
        own, shipped = hands['three_fingers'], hands['barrett-metal']
        self.assertEqual((own['uploaded'], shipped['uploaded']), (True, False))
        self.assertEqual((own['links'], own['dofs'], own['rest']), (shipped['links'], shipped['dofs'], shipped['rest']))
        self.assertEqual(glb_nodes(self.server.get('/api/hands/three_fingers/model.glb')[2]),
                         glb_nodes(self.server.get('/api/hands/barrett-metal/model.glb')[2]))
        app = self.talk()
        app.send(type='plan.start', hand='three_fingers', object='glass', options={'iterations': 20000})
        self.assertEqual(app.wait_for('plan.result')['status'], 'found')
        app.send(type='online.start', hand='three_fingers', object='glass')
        app.wait_for('online.ready')
        app.send(type='wrist', time=1, pose=[0, 0, 0.3, 0, 1, 0, 0])
        self.assertEqual(len(app.wait_for('view')['link_poses']), own['n_links'])
        again = json.loads(self.server.request('POST', '/api/hands?name=my%20hand.zip', body)[2])
        self.assertEqual(again['name'], 'three_fingers-2')

    def test_bad_hands_are_refused_with_a_sentence_that_names_no_folder(self):
        good = packed_hand('barrett-metal')
        traversal, bomb = io.BytesIO(), io.BytesIO()
        with zipfile.ZipFile(traversal, 'w') as archive:
            archive.writestr('../hand.yaml', 'format: eigengrasp-hand')
        with zipfile.ZipFile(bomb, 'w', zipfile.ZIP_DEFLATED) as archive:
            for i in range(5):
                archive.writestr(f'hand/{i}.obj', b'\0' * (60 << 20))
        before = self.server.get_json('/api/status')['hands']
        for path, body, named in (
                ('/api/hands', good, 'name'), ('/api/hands?name=a.zip', b'', 'empty'),
                ('/api/hands?name=a.rar', good, '.rar'), ('/api/hands?name=a.zip', good[:len(good) // 2], 'archive'),
                ('/api/hands?name=a.zip', os.urandom(5000), 'archive'),
                ('/api/hands?name=a.zip', traversal.getvalue(), '..'),
                ('/api/hands?name=a.zip', bomb.getvalue(), 'bytes together'),
                ('/api/hands?name=a.zip', packed_hand('barrett-metal', leave_out='hand.yaml'), 'no hand.yaml'),
                ('/api/hands?name=a.zip', packed_hand('barrett-rubber'), 'based_on'),
                ('/api/hands?name=a.zip', packed_hand('barrett-metal', lambda t: t.replace('urdf: ', 'urdf: /etc/')),
                 'outside')):
            with self.subTest(path=path, named=named):
                code, _, reply = self.server.request('POST', path, body)
                self.assertEqual(code, 400, reply)
                self.schema.require(json.loads(reply), 'ErrorReply')
                self.assertIn(named, json.loads(reply)['error'])
                self.assertNotIn('/tmp', json.loads(reply)['error'])
        self.assertEqual(self.server.get_json('/api/status')['hands'], before)

    def test_other_methods_and_head(self):
        self.assertEqual(self.server.request('DELETE', '/api/objects')[0], 405)
        self.assertEqual(self.server.request('POST', '/api/status', b'x')[0], 405)
        code, headers, body = self.server.request('HEAD', '/api/status')
        self.assertEqual((code, body), (200, b''))
        self.assertGreater(int(headers['Content-Length']), 1000)


class WithToken(support.EndToEnd):
    def test_without_the_token_there_is_nothing(self):
        token = 'correct horse battery'
        server = web_client.Server(self.folder, '--token', token, '--bind', '0.0.0.0')
        self.addCleanup(server.end)
        schema = web_client.Schema()
        status = server.get_json('/api/status')
        self.assertEqual((status['token_required'], status['hands'], status['objects']), (True, [], []))
        for headers in ({}, {'Authorization': 'Bearer wrong'}, {'Authorization': token}):
            self.assertEqual(server.get('/api/hands/human/model.glb', headers)[0], 401)
        self.assertEqual(server.request('POST', '/api/objects?name=a.obj', b'x')[0], 401)
        self.assertEqual(server.request('POST', '/api/hands?name=a.zip', b'x')[0], 401)
        good = {'Authorization': f'Bearer {token}'}
        self.assertEqual(server.get('/api/hands/human/model.glb', good)[0], 200)
        self.assertGreater(len(server.get_json('/api/status', good)['hands']), 0)
        self.assertEqual(server.get('/api/hands/human/model.glb?token=correct%20horse%20battery')[0], 200)
        for hello in ({}, {'token': 'wrong'}, {'token': token + 'x'}, {'token': ''}):
            client = web_client.Talk(server, schema, hello=False)
            client.send(type='hello', protocol=1, role='app', **hello)
            self.assertEqual(client.receive()['code'], 'not_allowed')
            with self.assertRaises(web_client.Closed) as closed:
                client.receive()
            self.assertEqual(closed.exception.code, 1008)
        web_client.Talk(server, schema, hello={'token': token}).close()


if __name__ == '__main__':
    support.main()
