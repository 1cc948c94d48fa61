# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""hand, object and render; --help and --version."""
import json
import re
import shutil
import struct
import support
from support import EndToEnd, box_obj

HANDS = {'barrett-metal': 4, 'barrett-rubber': 4, 'dlr': 12, 'human': 20, 'robonaut': 14}
OBJECTS = ['ashtray', 'flask', 'glass', 'phone', 'plane', 'shoe']


class Commands(EndToEnd):
    def assert_png(self, name):
        data = (self.folder / name).read_bytes()
        self.assertEqual(data[:8], b'\x89PNG\r\n\x1a\n')
        self.assertEqual(data[-8:-4], b'IEND')
        return struct.unpack('>II', data[16:24])

    def test_help_of_every_command_has_an_example(self):
        for command in ([], ['plan'], ['evaluate'], ['quality'], ['render'], ['hand'], ['hand', 'list'],
                        ['hand', 'show'], ['hand', 'check'], ['hand', 'pca'], ['object'], ['object', 'list'],
                        ['object', 'info']):
            with self.subTest(' '.join(command)):
                run = self.succeed(*command, '--help')
                self.assertEqual(run.stderr, '')
                self.assertRegex(run.stdout, r'Examples?:\s+eigengrasp ' + ' '.join(command))

    def test_examples_name_options_that_exist(self):
        for command in ('plan', 'evaluate', 'quality', 'render'):
            text = self.succeed(command, '--help').stdout
            start = text.index('Example')
            for option in re.findall(r'--[a-z-]+', text[start:]):
                self.assertIn(option, text[:start], command)

    def test_version(self):
        run = self.succeed('--version')
        self.assertRegex(run.stdout, r'^(eigengrasp )?\d+\.\d+\.\d+\S*\n$')

    def test_hand_list(self):
        lines = [line.split() for line in self.succeed('hand', 'list').stdout.splitlines()]
        self.assertEqual({line[0]: int(line[1]) for line in lines}, HANDS)

    def test_hand_show(self):
        for hand, dofs in HANDS.items():
            text = self.succeed('hand', 'show', hand).stdout
            self.assertIn(f'{dofs} degrees of freedom', text)
            self.assertIn('e2', text)
        self.succeed('hand', 'show', 'barrett-rubber', '--png', 'hand.png', '--tile', '120')
        self.succeed('hand', 'show', 'barrett-rubber', '--contacts', '--png', 'contacts.png', '--tile', '120')
        self.succeed('hand', 'show', 'barrett-rubber', '--eigengrasps', '--png', 'eigengrasps.png', '--tile', '120')
        hand, table = self.assert_png('hand.png'), self.assert_png('eigengrasps.png')
        self.assert_png('contacts.png')
        self.assertGreaterEqual(hand[0], 120)
        self.assertGreater(table[0] * table[1], hand[0] * hand[1])  # two eigengrasps at two ends

    def test_hand_check(self):
        for hand in HANDS:
            self.assertNotIn('error', self.succeed('hand', 'check', hand).stdout.lower())
        folder = self.folder / 'bare'
        shutil.copytree(support.SOURCE / 'data/hands/barrett-metal', folder)
        text = (folder / 'hand.yaml').read_text()
        cut = re.sub(r'(?ms)^virtual_contacts:.*?(?=^\w|\Z)', '', text)
        self.assertNotEqual(cut, text)
        (folder / 'hand.yaml').write_text(cut)
        self.assertRegex(self.succeed('hand', 'check', 'bare', code=1).stdout, r'error: .*contact')

    def test_hand_pca(self):
        rows = [(a, 2 * a + 0.001 * ((7 * i) % 5), 0.01 * ((3 * i) % 7)) for i, a in enumerate([0.1 * k for k in range(30)])]
        self.file('r.csv', 'subject,index,middle,thumb,valid\n'
                  + ''.join(f's1,{a:.4f},{b:.4f},{c:.4f},1\n' for a, b, c in rows) + 's1,99,99,99,0\n')
        text = self.succeed('hand', 'pca', 'r.csv', '--components', '1').stdout
        share = re.search(r'components: ([\d.]+) %', text)
        self.assertTrue(share, text)
        self.assertGreater(float(share.group(1)), 99.0)
        origin = float(re.search(r'index: ([-\d.]+)', text).group(1))
        self.assert_near(origin, sum(r[0] for r in rows) / len(rows), 1e-4, 'rows that are not valid are left out')

    def test_hand_pca_of_recordings(self):
        """Published: 40.5 % of the variance in one component, 60.5 % in two, 84.2 % in six."""
        recordings = support.test_data('hand_postures', 'contactpose_shadow20.csv')
        text = self.succeed('hand', 'pca', recordings, '--components', '2').stdout
        shares = [float(s) for s in re.findall(r'([\d.]+) %', text)]
        for component, published in ((1, 40.5), (2, 60.5), (6, 84.2)):
            self.assert_near(shares[component - 1], published, 0.1, f'{component} components')

    def test_object_list_and_info(self):
        lines = self.succeed('object', 'list').stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], OBJECTS)
        for name in OBJECTS:
            self.assertRegex(self.succeed('object', 'info', name).stdout, r'watertight +yes')

    def test_object_info_of_a_box(self):
        self.file('box.obj', box_obj((40, 60, 80), (5, 0, 0)))
        text = self.succeed('object', 'info', 'box.obj', '--units', 'mm').stdout
        self.assertRegex(text, r'size +40\.0 x 60\.0 x 80\.0 mm')
        self.assertRegex(text, r'volume +192\.00 cm\^3')
        self.assertRegex(text, r'centre of mass +5\.00 -?0\.00 -?0\.00 mm')
        self.assertRegex(self.succeed('object', 'info', 'box.obj').stdout, r'warning: .*--units mm')
        text = box_obj((40, 60, 80))
        self.file('open.obj', '\n'.join(text.splitlines()[:-1]) + '\n')
        text = self.succeed('object', 'info', 'open.obj', '--units', 'mm').stdout
        self.assertRegex(text, r'watertight +no')

    def test_render(self):
        run = self.run_program('plan', support.SOURCE / 'data/objects/glass.obj', '--hand', 'barrett-rubber',
                               '--iterations', '2000', '--grasps', '3', '--no-pictures', '--table', 'auto', '--out', 'out')
        self.assertIn(run.returncode, (0, 1), run.stderr)
        count = len(json.loads((self.folder / 'out/grasps.json').read_text())['grasps'])
        run = self.succeed('render', 'out/grasps.json', '--rank', '1', '--tile', '150', '--png', 'one.png', '--glb',
                           'one.glb', '--isaac', 'all.yaml', '--cones')
        self.assertEqual(run.stderr, '')
        self.assert_png('one.png')
        glb = (self.folder / 'one.glb').read_bytes()
        self.assertEqual((glb[:4], struct.unpack('<I', glb[8:12])[0]), (b'glTF', len(glb)))
        isaac = (self.folder / 'all.yaml').read_text()
        self.assertRegex(isaac, r'format: +"?isaac_grasp')
        self.assertEqual(len(re.findall(r'(?m)^  "?grasp_\d+"?:', isaac)), count)
        self.succeed('render', 'out/grasps.json', '--tile', '100')
        self.assert_png('out/grasps.png')
        self.refuse(['render', 'out/grasps.json', '--rank', str(count + 1)], '--rank')
        self.refuse(['render', 'out/grasps.json', '--rank', '-1'], '--rank')
        self.refuse(['render', 'out/grasps.json', '--tile', '1'], '--tile')
        self.refuse(['render', 'out/grasps.json', '--hand', 'claw'], 'claw')


if __name__ == '__main__':
    support.main()
