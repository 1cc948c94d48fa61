# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp plan`: its files, determinism, budgets, interruption, tables and obstacles, sizes and pictures."""
import csv
import json
import math
import os
import pty
import signal
import struct
import subprocess
import time
import support
from support import EndToEnd, UrdfHand, box_obj, obj_vertices, wait_until_catching_interrupts

RUBBER = ('--hand', 'barrett-rubber')
SMALL = (*RUBBER, '--iterations', '4000', '--no-pictures')
HAND_JOINTS = ['finger1_spread', 'finger1_flexion', 'finger1_distal_flexion', 'finger2_spread', 'finger2_flexion',
               'finger2_distal_flexion', 'finger3_flexion', 'finger3_distal_flexion']


class Plan(EndToEnd):
    def load(self, folder='out'):
        return json.loads((self.folder / folder / 'grasps.json').read_text())

    def plan(self, *args):
        """A sound run, with or without form-closed grasps."""
        run = self.run_program('plan', *args)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        return run

    def assert_files(self, folder, names):
        self.assertEqual(sorted(p.name for p in (self.folder / folder).iterdir()), sorted(names))

    def assert_pose(self, pose):
        self.assertEqual(sorted(pose), ['orientation', 'position'])
        self.assertEqual(len(pose['position']), 3)
        self.assert_near(math.hypot(*pose['orientation']), 1.0, 1e-9, 'a unit quaternion')
        self.assertGreaterEqual(pose['orientation'][0], 0.0)

    def assert_posture(self, state, file):
        self.assert_pose(state['hand_pose'])
        self.assertEqual(sorted(state['joints']), sorted(file['hand']['joints']))
        self.assertEqual(len(state['dofs']), len(file['hand']['dofs']))
        self.assertTrue(all(math.isfinite(v) for v in [*state['joints'].values(), *state['dofs']]))

    def assert_grasp(self, grasp, rank, file):
        self.assertEqual(grasp['rank'], rank)
        self.assertLessEqual(grasp['max_penetration'], 0.0005)
        self.assertGreaterEqual(grasp['epsilon'], 0.0)
        self.assertEqual(grasp['form_closure'], grasp['epsilon'] >= file['options']['epsilon_min'])
        self.assert_posture(grasp['pregrasp'], file)
        self.assert_posture(grasp['grasp'], file)
        self.assertEqual(len(grasp['pregrasp']['amplitudes']), file['options']['amplitudes'])
        self.assertTrue(grasp['contacts'] or not grasp['form_closure'])
        for c in grasp['contacts']:
            self.assertEqual(sorted(c), ['link', 'mu', 'normal', 'patch', 'position', 'torsion_length'])
            self.assert_near(math.hypot(*c['normal']), 1.0, 1e-9, 'a unit normal')
            self.assertEqual(c['mu'], 1.0)
            center = file['object']['center_of_mass']
            self.assertLessEqual(math.dist(c['position'], center), file['object']['max_radius'] + 0.0003)
        self.assertEqual(sorted(grasp['provenance']), ['options_digest', 'planner', 'seed', 'version'])

    def test_files_follow_the_schema(self):
        run = self.succeed('plan', 'glass', *SMALL, '--out', 'out')
        self.assertEqual(run.stderr, '')
        self.assert_files('out', ['grasps.csv', 'grasps.json'])
        file = self.load()
        self.assertEqual(list(file), ['format', 'version', 'program_version', 'conventions', 'hand', 'object',
                                      'obstacles', 'options', 'status', 'stopped_early', 'explanation', 'grasps',
                                      'statistics', 'milestones', 'run'])
        self.assertEqual((file['format'], file['version']), ('eigengrasp-grasps', 1))
        self.assertEqual(file['hand']['name'], 'barrett-rubber')
        self.assertEqual(file['hand']['joints'], HAND_JOINTS)
        self.assertEqual(len(file['hand']['dofs']), 4)
        for source in (file['hand']['source'], file['object']['source']):
            self.assertRegex(source['digest'], '^fnv1a64:[0-9a-f]{16}$')
        thing = file['object']
        self.assertEqual((thing['name'], thing['units'], thing['scale'], thing['watertight']), ('glass', 'm', 1, True))
        self.assertEqual((file['options']['iterations'], file['options']['seed'], file['options']['energy']),
                         (4000, 1, 'contact'))
        self.assertEqual((file['status'], file['stopped_early']), ('found', False))
        self.assertEqual(len(file['grasps']), 20)
        for rank, grasp in enumerate(file['grasps'], 1):
            self.assert_grasp(grasp, rank, file)
        closed = [g['epsilon'] for g in file['grasps'] if g['form_closure']]
        rest = [g['energy'] for g in file['grasps'] if not g['form_closure']]
        self.assertTrue(closed)
        self.assertEqual(closed, sorted(closed, reverse=True))
        self.assertEqual(rest, sorted(rest))
        self.assertTrue(all(g['form_closure'] for g in file['grasps'][:len(closed)]))
        states = file['statistics']['states']
        self.assertEqual(states['evaluated'], 4000)
        self.assertEqual(states['evaluated'], sum(states[k] for k in ('legal', 'hit_object', 'hit_itself',
                                                                      'hit_obstacle')))
        self.assertEqual(file['statistics']['candidates']['form_closed'], len(closed))
        energies = [m['energy'] for m in file['milestones']]
        self.assertEqual(energies, sorted(energies, reverse=True))
        self.assertEqual(sorted(file['run']['timings']), ['close', 'prepare', 'search', 'total'])
        with (self.folder / 'out' / 'grasps.csv').open(newline='') as text:
            rows = list(csv.DictReader(text))
        self.assertEqual(len(rows), 20)
        self.assertEqual([float(r['epsilon']) for r in rows], [g['epsilon'] for g in file['grasps']])
        table = [line.split() for line in run.stdout.splitlines()]
        self.assertEqual(sum(1 for line in table if line and line[0].isdigit() and line[-1] in ('yes', 'no')), 20)

    def test_closed_fingers_touch_the_object(self):
        """The joints and the pose of the file, put into the URDF, bring the hand to the contacts."""
        self.plan('glass', *SMALL, '--grasps', '4', '--out', 'out')
        urdf = next((support.SOURCE / 'data/hands/barrett-metal').glob('*.urdf'))
        hand = UrdfHand(urdf)
        for grasp in self.load()['grasps']:
            heights = list(hand.heights(grasp['grasp']))
            for c in grasp['contacts']:
                self.assertTrue(min(heights) - 0.001 <= c['position'][2] <= max(heights) + 0.001)

    def test_threads_do_not_change_the_result_but_the_seed_does(self):
        for name, more in (('one', ('--threads', '1')), ('two', ('--threads', '2')), ('other', ('--seed', '2'))):
            self.plan('glass', *SMALL, '--grasps', '6', *more, '--out', name)
        table = {n: (self.folder / n / 'grasps.csv').read_bytes() for n in ('one', 'two', 'other')}
        self.assertEqual(table['one'], table['two'])
        self.assertNotEqual(table['one'], table['other'])
        text = {n: (self.folder / n / 'grasps.json').read_text() for n in ('one', 'two', 'other')}
        same = [text[n][:text[n].index('"run":')] for n in ('one', 'two')]
        self.assertEqual(same[0], same[1])
        one, other = json.loads(text['one']), json.loads(text['other'])
        self.assertEqual(other['options']['seed'], 2)
        self.assertNotEqual(one['grasps'], other['grasps'])

    def test_interrupt_writes_what_was_found(self):
        command = [str(support.PROGRAM), 'plan', 'glass', *RUBBER, '--iterations', '1000000000', '--no-pictures', '--out', 'out']
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
            self.addCleanup(run.kill)
            self.assertTrue(wait_until_catching_interrupts(run), 'no handler of SIGINT')
            time.sleep(1.0)
            run.send_signal(signal.SIGINT)
            start = time.monotonic()
            stdout, stderr = run.communicate(timeout=60)
        self.assertLess(time.monotonic() - start, 20.0)
        self.assertIn(run.returncode, (0, 1), stderr)
        self.assertIn('stopped early', stdout)
        self.assertEqual(stderr, '')
        self.assert_files('out', ['grasps.csv', 'grasps.json'])
        file = self.load()
        self.assertTrue(file['stopped_early'])
        self.assertLess(file['statistics']['states']['evaluated'], 1000000000)

    def test_time_limit(self):
        self.plan('glass', *RUBBER, '--time', '1s', '--grasps', '5', '--no-pictures', '--out', 'out')
        file = self.load()
        self.assertEqual(file['options']['time_limit'], 1.0)
        self.assertGreaterEqual(file['run']['timings']['search'], 0.9)
        self.assertLess(file['run']['timings']['search'], 6.0)
        self.plan('glass', *SMALL, '--grasps', '5', '--time', '10min', '--out', 'both')
        self.assertEqual(self.load('both')['statistics']['states']['evaluated'], 4000)

    def test_progress_only_on_a_terminal(self):
        command = ['plan', 'glass', *RUBBER, '--iterations', '30000', '--grasps', '2', '--no-pictures', '--out', 'out']
        piped = self.plan(*command[1:])
        self.assertEqual(piped.stderr, '')
        self.assertNotIn('\x1b', piped.stdout)
        self.assertNotIn('\r', piped.stdout)
        command[command.index('30000')] = '1000000'  # long enough for a bar
        control, terminal = pty.openpty()
        self.addCleanup(os.close, control)
        with subprocess.Popen([str(support.PROGRAM), *command], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=terminal) as run:
            os.close(terminal)
            run.communicate(timeout=60)
        try:
            drawn = os.read(control, 65536)
        except OSError:
            drawn = b''
        self.assertIn(b'states', drawn)
        self.assertTrue(drawn.endswith(b'\r\x1b[K'), drawn[-40:])

    def test_default_folder(self):
        self.plan('phone', *RUBBER, '--iterations', '1000', '--grasps', '2', '--no-pictures')
        self.assert_files('out/phone-barrett-rubber', ['grasps.csv', 'grasps.json'])

    def test_table_and_obstacle(self):
        """No vertex of the hand lies below the table, and with a block above the glass all pre-grasps are legal."""
        lowest = min(v[2] for v in obj_vertices(support.SOURCE / 'data/objects/glass.obj'))
        highest = max(v[2] for v in obj_vertices(support.SOURCE / 'data/objects/glass.obj'))
        self.file('block.obj', box_obj((0.05, 0.05, 0.1), (0, 0, highest + 0.09)))
        run = self.run_program('plan', 'glass', *RUBBER, '--iterations', '16000', '--no-pictures', '--table', 'auto',
                               '--obstacle', 'block.obj', '--out', 'out')
        self.assertIn(run.returncode, (0, 1), run.stderr)
        file = self.load()
        self.assertEqual(len(file['obstacles']), 2)
        self.assertGreater(file['statistics']['states']['hit_obstacle'], 0)
        self.assertTrue(file['grasps'])
        hand = UrdfHand(next((support.SOURCE / 'data/hands/barrett-metal').glob('*.urdf')))
        for grasp in file['grasps']:
            for state in (grasp['pregrasp'], grasp['grasp']):
                self.assertGreater(min(hand.heights(state)), lowest - 0.0005, f"grasp {grasp['rank']}")
            for c in grasp['contacts']:
                self.assertGreater(c['position'][2], lowest - 0.0005)
        states = [json.dumps(g['pregrasp']) for g in file['grasps']]
        self.file('states.jsonl', '\n'.join(states) + '\n')
        rated = self.json_lines(self.succeed('evaluate', 'states.jsonl', '--object', 'glass', *RUBBER, '--exact',
                                             '--table', 'auto', '--obstacle', 'block.obj'))
        self.assertTrue(all(r['legal'] for r in rated), rated)
        # A hand pushed into the block is refused, with the reason.
        state = {'hand_pose': {'position': [0.0, 0.0, highest + 0.09], 'orientation': [1, 0, 0, 0]}, 'dofs': [0] * 4}
        self.file('inside.jsonl', json.dumps(state))
        rated = self.json_lines(self.succeed('evaluate', 'inside.jsonl', '--object', 'glass', *RUBBER, '--exact',
                                             '--obstacle', 'block.obj'))
        self.assertFalse(rated[0]['legal'])
        self.assertIn('obstacle', rated[0]['reason'])

    def test_too_small(self):
        run = self.succeed('plan', 'glass', *RUBBER, '--iterations', '2000', '--grasps', '4', '--no-pictures',
                           '--scale', '0.001', '--out', 'out', code=1)
        said = run.stdout + run.stderr
        self.assertRegex(said, 'small')
        self.assertIn('units', said)
        self.assertEqual(self.load()['status'] in ('none_closed', 'nothing_legal'), True)

    def test_too_large(self):
        run = self.succeed('plan', 'glass', *RUBBER, '--iterations', '2000', '--grasps', '4', '--no-pictures',
                           '--scale', '100', '--out', 'out', code=1, timeout=60)
        self.assertIn('--units', run.stderr)
        self.assertIn('large', run.stdout + run.stderr)

    def test_wrong_units_are_suspected(self):
        run = self.run_program('plan', 'glass', *RUBBER, '--iterations', '500', '--grasps', '1', '--no-pictures',
                               '--units', 'mm', '--out', 'out')
        self.assertIn(run.returncode, (0, 1), run.stderr)
        self.assertRegex(run.stderr, 'warning: .*(--units|units)')
        self.assertEqual(self.load()['object']['units'], 'mm')

    def test_pictures(self):
        self.plan('glass', *RUBBER, '--iterations', '2000', '--grasps', '2', '--out', 'out')
        self.assert_files('out', ['grasps.csv', 'grasps.glb', 'grasps.json', 'grasps.png'])
        png = (self.folder / 'out/grasps.png').read_bytes()
        self.assertEqual(png[:8], b'\x89PNG\r\n\x1a\n')
        width, height = struct.unpack('>II', png[16:24])
        self.assertTrue(100 < width < 10000 and 100 < height < 10000)
        glb = (self.folder / 'out/grasps.glb').read_bytes()
        magic, version, length = struct.unpack('<4sII', glb[:12])
        self.assertEqual((magic, version, length), (b'glTF', 2, len(glb)))
        size, kind = struct.unpack('<I4s', glb[12:20])
        self.assertEqual(kind, b'JSON')
        self.assertTrue(json.loads(glb[20:20 + size])['meshes'])

    def test_options_reach_the_file(self):
        self.run_program('plan', 'glass', '--hand', 'dlr', '--iterations', '1500', '--grasps', '3', '--no-pictures',
                         '--eigengrasps', 'all', '--energy', 'wrench', '--norm', 'linf', '--true-cone', '--chains', '2',
                         '--alpha', '0.04', '--torque-scale', '0.1', '--epsilon-min', '0.001', '--friction', '0.8',
                         '--out', 'out')
        file = self.load()
        o = file['options']
        self.assertEqual((o['amplitudes'], o['energy'], o['norm'], o['cone'], o['chains']), (12, 'wrench', 'linf', 'exact', 2))
        self.assertEqual((o['alpha'], o['torque_scale'], o['epsilon_min']), (0.04, 0.1, 0.001))
        self.assertTrue(all(c['mu'] == 0.8 for g in file['grasps'] for c in g['contacts']))


if __name__ == '__main__':
    support.main()
