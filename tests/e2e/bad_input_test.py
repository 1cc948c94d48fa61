# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""Bad input ends with one sentence that names it, code 2, nothing on stdout and nothing half-written."""
import json
import shutil
import subprocess
import support
from support import EndToEnd, box_obj

HANDS = ('barrett-metal', 'barrett-rubber', 'dlr', 'human', 'robonaut')
STATE = {'hand_pose': {'position': [0, 0, 1], 'orientation': [1, 0, 0, 0]}, 'dofs': [0, 0, 0, 0]}
CONTACT = {'position': [1, 0, 0], 'normal': [-1, 0, 0], 'mu': 0.5}


def plan(obj, *more, hand='barrett-rubber', out='out'):
    return ['plan', obj, '--hand', hand, '--iterations', '500', '--no-pictures', '--out', out, *more]


class Meshes(EndToEnd):
    def refuse_mesh(self, name, text, *named):
        """The same from both commands that read an object."""
        self.file(name, text)
        self.refuse(['object', 'info', name], name, *named)
        self.refuse(plan(name), name, *named)

    def test_missing_file(self):
        self.refuse(plan('missing.obj'), 'missing.obj')
        self.refuse(['object', 'info', 'missing/folder/mesh.stl'], 'missing/folder/mesh.stl')
        self.refuse(plan('glass', '--obstacle', 'missing.obj'), 'missing.obj')
        self.refuse(['render', 'missing.json'], 'missing.json')
        self.refuse(['hand', 'pca', 'missing.csv'], 'missing.csv')

    def test_folder_in_place_of_a_file(self):
        (self.folder / 'folder.obj').mkdir()
        self.refuse(['object', 'info', 'folder.obj'], 'folder.obj')

    def test_empty_file(self):
        for name in ('empty.obj', 'empty.stl', 'empty.ply', 'empty.off', 'empty.gltf', 'empty.glb', 'empty.iv',
                     'empty.xml'):
            with self.subTest(name):
                self.file(name)
                self.refuse(['object', 'info', name], name)

    def test_mesh_without_triangles(self):
        self.refuse_mesh('points.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\n')
        self.refuse_mesh('none.off', 'OFF\n0 0 0\n')
        self.refuse_mesh('none.stl', 'solid none\nendsolid none\n')

    def test_vertices_that_are_not_numbers(self):
        self.refuse_mesh('nan.obj', box_obj((0.1, 0.1, 0.1)).replace('v 0.05', 'v nan', 1))
        self.refuse_mesh('inf.off', 'OFF\n4 4 6\n0 0 0\n1e400 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n')
        self.refuse_mesh('nan.ply', 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
                         'property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n'
                         '0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n')

    def test_triangles_without_area(self):
        self.refuse_mesh('line.obj', 'v 0 0 0\nv 0.1 0 0\nv 0.2 0 0\nv 0.3 0 0\nf 1 2 3\nf 2 3 4\n')
        self.refuse_mesh('dot.obj', 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n')

    def test_faces_beyond_the_vertices(self):
        self.refuse_mesh('beyond.obj', box_obj((0.1, 0.1, 0.1)).replace('f 1 3 4', 'f 1 3 400', 1))
        self.refuse_mesh('zero.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n')
        self.refuse_mesh('beyond.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n')
        self.refuse_mesh('beyond.ply', 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
                         'property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n'
                         '0 0 0\n1 0 0\n0 1 0\n3 0 1 99\n')

    def test_a_billion_metres(self):
        self.refuse_mesh('huge.obj', box_obj((1e9, 1e9, 1e9)))
        self.refuse(plan('glass', '--scale', '1e10'), 'glass')

    def test_bytes_that_are_no_mesh(self):
        noise = bytes((i * 7919 + i // 3) % 256 for i in range(5000))
        for name in ('noise.obj', 'noise.stl', 'noise.ply', 'noise.off', 'noise.glb', 'noise.iv', 'noise.wrl', 'noise'):
            with self.subTest(name):
                self.file(name, noise)
                self.refuse(['object', 'info', name], name)

    def test_unknown_object_names_the_known_ones(self):
        self.refuse(plan('gals'), 'gals', 'ashtray', 'flask', 'glass', 'phone', 'plane', 'shoe')

    def test_units_and_scale(self):
        self.refuse(plan('glass', '--units', 'furlong'), 'furlong')
        for scale in ('0', '-1', 'nan', 'inf', 'abc'):
            with self.subTest(scale):
                self.refuse(plan('glass', '--scale', scale), 'scale', scale)


class Hands(EndToEnd):
    def copy_of_barrett(self):
        for name in ('barrett-metal', 'barrett-rubber'):
            shutil.copytree(support.SOURCE / 'data' / 'hands' / name, self.folder / name)
        return self.folder / 'barrett-metal'

    def refuse_hand(self, hand, *named):
        """The same from all commands that read a hand."""
        self.refuse(['hand', 'show', hand], *named)
        self.refuse(['hand', 'check', hand], *named)
        self.refuse(plan('glass', hand=hand), *named)

    def test_unknown_hand_names_the_known_ones(self):
        self.refuse_hand('claw', 'claw', *HANDS)
        self.refuse(['evaluate', self.file('s.jsonl'), '--hand', 'claw', '--object', 'glass'], 'claw', *HANDS)

    def test_no_hand(self):
        self.refuse(['plan', 'glass', '--out', 'out'], '--hand')

    def test_malformed_urdf(self):
        urdf = next(self.copy_of_barrett().glob('*.urdf'))
        sound = urdf.read_text()
        damages = {
            'cut off': sound[:len(sound) // 2],
            'no XML': 'a robot\n',
            'empty': '',
            'no robot': '<?xml version="1.0"?>\n<car/>\n',
            'number': sound.replace('xyz="0.05 0 0"', 'xyz="0.05 zero 0"', 1),
            'parent': sound.replace('<parent link="palm"/>', '<parent link="nowhere"/>', 1),
            'mesh': sound.replace('filename="meshes/palm.obj"', 'filename="meshes/gone.obj"'),
            'limits': sound.replace('lower="0" upper="2.51327412287183"', 'lower="3" upper="1"', 1),
        }
        for what, text in damages.items():
            with self.subTest(what):
                self.assertNotEqual(text, sound)
                urdf.write_text(text)
                self.refuse_hand('barrett-metal', 'gone.obj' if what == 'mesh' else urdf.name)
                self.refuse(['hand', 'show', 'barrett-rubber'], 'gone.obj' if what == 'mesh' else urdf.name)

    def test_malformed_hand_yaml(self):
        yaml = self.copy_of_barrett() / 'hand.yaml'
        sound = yaml.read_text()
        damages = {
            'cut off in a list': sound[:sound.index('[') + 4],
            'tab': sound.replace('materials:', '\tmaterials: {', 1),
            'empty': '',
            'a list': '- one\n- two\n',
            'another format': sound.replace('format: eigengrasp-hand', 'format: eigengrasp-foot', 1),
            'a later version': sound.replace('version: 1', 'version: 99', 1),
            'unknown joint': sound.replace('joint: finger1_flexion', 'joint: finger9_flexion', 1),
            'no number': sound.replace('closing_speed: ', 'closing_speed: fast', 1),
        }
        for what, text in damages.items():
            with self.subTest(what):
                self.assertNotEqual(text, sound)
                yaml.write_text(text)
                self.refuse_hand('barrett-metal', 'hand.yaml')

    def test_malformed_graspit_xml(self):
        damages = {
            'cut': '<?xml version="1.0" ?>\n<robot type="Hand">\n <palm>',
            'no-xml': 'robot',
            'empty': '',
            'other': '<?xml version="1.0" ?>\n<teapot/>\n',
            'no-palm': '<?xml version="1.0" ?>\n<robot type="Hand"></robot>\n',
            'gone': '<?xml version="1.0" ?>\n<robot type="Hand"><palm>gone.xml</palm></robot>\n',
        }
        for name, text in damages.items():
            with self.subTest(name):
                self.file(f'{name}.xml', text)
                self.refuse_hand(f'{name}.xml', 'gone.xml' if name == 'gone' else f'{name}.xml')
                self.refuse(['object', 'info', f'{name}.xml'], f'{name}.xml')
                self.refuse(['plan', '--world', f'{name}.xml', '--hand', 'dlr', '--out', 'out'], f'{name}.xml')


class Options(EndToEnd):
    def test_budgets(self):
        for option, value in (('--iterations', '-5'), ('--iterations', 'many'), ('--iterations', '1e3'),
                              ('--time', '-1s'), ('--time', 'abc'), ('--time', '0'), ('--time', '2parsecs'),
                              ('--time', 'nan'), ('--grasps', '0'), ('--grasps', '-3'), ('--chains', '0'),
                              ('--threads', '-1')):
            with self.subTest(f'{option} {value}'):
                sentence = self.refuse(['plan', 'glass', '--hand', 'barrett-rubber', option, value, '--out', 'out'],
                                       option.lstrip('-'))
                self.assertIn(value, sentence)
        self.refuse(['plan', 'glass', '--hand', 'barrett-rubber', '--iterations', '0', '--out', 'out'], 'iterations')

    def test_choices(self):
        for option, value in (('--energy', 'potential'), ('--norm', 'l7'), ('--eigengrasps', '99'),
                              ('--eigengrasps', 'some'), ('--eigengrasps', '-1'), ('--table', 'high'),
                              ('--alpha', '0'), ('--alpha', 'nan'), ('--edges', '2'), ('--torque-scale', '-1'),
                              ('--epsilon-min', '-1'), ('--friction', '-0.5'), ('--friction', 'nan'),
                              ('--seed', '-1'), ('--seed', 'x')):
            with self.subTest(f'{option} {value}'):
                self.assertIn(value, self.refuse(plan('glass', option, value)))

    def test_unknown_options_and_commands(self):
        self.refuse(plan('glass', '--colour', 'red'), '--colour')
        self.refuse(['plant', 'glass'], 'plant')
        self.refuse(['hand', 'wave'], 'wave')
        self.refuse([], 'subcommand')
        self.refuse(['plan'], 'object')
        self.refuse(['quality', '--frobnicate', 'x'], '--frobnicate')
        self.refuse(plan('glass', 'flask'), 'flask')

    def test_folders_that_cannot_be_written(self):
        # Below a regular file and in /proc not even root can make a folder.
        self.file('regular', 'a file\n')
        self.refuse(plan('glass', out='regular/out'), 'regular/out')
        self.refuse(plan('glass', out='regular'), 'regular')
        self.refuse(plan('glass', out='/proc/x'), '/proc/x')

    def test_pictures_that_cannot_be_written(self):
        self.file('regular', 'a file\n')
        for target in ('regular/hand.png', '/proc/hand.png', '/dev/full/hand.png'):
            with self.subTest(target):
                run = self.run_program('hand', 'show', 'barrett-rubber', '--png', target, timeout=60)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertEqual(run.stderr.count('\n'), 1, run.stderr)
                self.assertIn(target, run.stderr)
        self.assertEqual(self.contents(), ['regular'])
        self.refuse(['hand', 'show', 'barrett-rubber', '--png', 'x.png', '--tile', '0'], '--tile')

    def test_output_that_cannot_be_written(self):
        with open('/dev/full', 'w', encoding='utf8') as full:
            run = subprocess.run([str(support.PROGRAM), 'hand', 'list'], stdout=full, stderr=subprocess.PIPE, text=True,
                                 timeout=20, check=False)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stderr.count('\n'), 1, run.stderr)

    def test_recordings(self):
        for name, text in (('empty.csv', ''), ('header.csv', 'a,b\n'), ('ragged.csv', 'a,b\n1,2\n3\n'),
                           ('words.csv', 'a,b\nx,y\nz,w\n')):
            with self.subTest(name):
                self.file(name, text)
                self.refuse(['hand', 'pca', name], name)


class JsonLines(EndToEnd):
    def refuse_line(self, command, bad, *named):
        """A bad third line after two sound ones: named with its number, and nothing is printed."""
        sound = STATE if command[0] == 'evaluate' else {'contacts': [CONTACT] * 3}
        text = bad if isinstance(bad, str) else json.dumps(bad)
        self.file('lines.jsonl', json.dumps(sound) + '\n\n' + text + '\n')
        return self.refuse([command[0], 'lines.jsonl', *command[1:]], 'lines.jsonl:3', *named)

    def test_evaluate(self):
        command = ['evaluate', '--hand', 'barrett-rubber', '--object', 'glass', '--exact']
        pose = STATE['hand_pose']
        self.refuse(['evaluate', 'gone.jsonl', *command[1:]], 'gone.jsonl')
        for what, bad, named in (
                ('no JSON', '{"hand_pose": ', 'JSON'),
                ('number', '7', 'JSON object'),
                ('array', '[1]', 'JSON object'),
                ('no pose', {'dofs': [0, 0, 0, 0]}, 'hand_pose'),
                ('no position', {'hand_pose': {'orientation': [1, 0, 0, 0]}, 'dofs': [0] * 4}, 'position'),
                ('short orientation', {'hand_pose': {'position': [0, 0, 0], 'orientation': [1, 0, 0]}, 'dofs': [0] * 4},
                 'orientation'),
                ('zero orientation', {'hand_pose': {'position': [0, 0, 0], 'orientation': [0] * 4}, 'dofs': [0] * 4},
                 'orientation'),
                ('huge number', '{"hand_pose": {"position": [0, 0, 1e999], "orientation": [1, 0, 0, 0]}, "dofs": '
                 '[0,0,0,0]}', ''),
                ('text in a pose', {'hand_pose': {'position': [0, 0, 'up'], 'orientation': [1, 0, 0, 0]},
                                    'dofs': [0] * 4}, 'position'),
                ('wrong dofs', {'hand_pose': pose, 'dofs': [0, 0]}, 'dofs'),
                ('null dofs', {'hand_pose': pose, 'dofs': [0, 0, 0, None]}, 'dofs'),
                ('neither', {'hand_pose': pose}, 'dofs'),
                ('unknown joint', {'hand_pose': pose, 'joints': {'elbow': 0.1}}, 'elbow'),
                ('joint of text', {'hand_pose': pose, 'joints': {'finger1_flexion': 'bent'}}, 'finger1_flexion')):
            with self.subTest(what):
                self.refuse_line(command, bad, named)
        deep = '{"hand_pose": ' + '[' * 200000 + ']' * 200000 + '}'
        self.refuse_line(command, deep)

    def test_evaluate_of_damaged_grasp_files(self):
        for what, value in (('format', {'format': 7, 'grasps': []}), ('grasps', {'format': 'eigengrasp-grasps',
                                                                               'grasps': 7}),
                            ('pregrasp', {'format': 'eigengrasp-grasps', 'grasps': [{'pregrasp': 1}]}),
                            ('text', {'format': 'eigengrasp-grasps', 'grasps': ['best']})):
            with self.subTest(what):
                self.file('grasps.json', json.dumps(value))
                self.refuse(['evaluate', 'grasps.json', '--hand', 'barrett-rubber', '--object', 'glass', '--exact'],
                            'grasps.json')

    def test_evaluate_options(self):
        self.file('lines.jsonl', json.dumps(STATE) + '\n')
        command = ['evaluate', 'lines.jsonl', '--hand', 'barrett-rubber', '--object', 'glass', '--exact']
        for option, value in (('--edges', '0'), ('--edges', '2000000000'), ('--norm', 'l3'), ('--alpha', '0'),
                              ('--alpha', 'nan'), ('--torque-scale', '-1'), ('--torque-scale', 'nan'),
                              ('--threads', '-2'), ('--epsilon-min', 'nan')):
            with self.subTest(f'{option} {value}'):
                self.assertIn(value, self.refuse([*command, option, value]))

    def test_quality(self):
        def contact(**changes):
            return {'contacts': [CONTACT, {**CONTACT, **changes}]}
        no_mu = {k: v for k, v in CONTACT.items() if k != 'mu'}
        self.refuse(['quality', 'gone.jsonl'], 'gone.jsonl')
        for what, bad, named in (
                ('no JSON', 'contacts: 3', 'JSON'),
                ('neither', {'points': []}, 'contacts'),
                ('zero normal', contact(normal=[0, 0, 0]), 'normal'),
                ('text normal', contact(normal='up'), 'normal'),
                ('short position', contact(position=[1, 2]), 'position'),
                ('negative mu', contact(mu=-0.1), 'mu'),
                ('text mu', contact(mu='slippery'), 'mu'),
                ('no mu', {'contacts': [no_mu]}, 'mu'),
                ('negative torsion', contact(torsion_length=-1), 'torsion_length'),
                ('contact of text', {'contacts': ['thumb']}, 'contacts'),
                ('zero scale', {**contact(), 'torque_scale': 0}, 'torque_scale'),
                ('short origin', {**contact(), 'torque_origin': [0]}, 'torque_origin'),
                ('short wrench', {'wrenches': [[1, 0, 0]]}, 'wrench'),
                ('text wrench', {'wrenches': [[1, 0, 0, 0, 0, 'x']]}, 'wrench')):
            with self.subTest(what):
                self.refuse_line(['quality'], bad, named)
        self.assertIn('contact 2', self.refuse_line(['quality'], contact(normal=[0, 0, 0])))

    def test_quality_options(self):
        self.file('lines.jsonl', json.dumps({'contacts': [CONTACT] * 2}) + '\n')
        for option, value in (('--edges', '2'), ('--edges', 'x'), ('--norm', 'l3'), ('--torque-scale', '-1'),
                              ('--torque-scale', 'nan'), ('--epsilon-min', 'nan'), ('--epsilon-min', '-1')):
            with self.subTest(f'{option} {value}'):
                self.assertIn(value, self.refuse(['quality', 'lines.jsonl', option, value]))

    def test_render_of_damaged_files(self):
        for name, text in (('empty.json', ''), ('cut.json', '{"format": "eigengrasp-grasps", '), ('list.json', '[]'),
                           ('other.json', '{"format": "other"}'),
                           ('newer.json', '{"format": "eigengrasp-grasps", "version": 99}'),
                           ('typed.json', '{"format": 1, "version": "x"}')):
            with self.subTest(name):
                self.file(name, text)
                self.refuse(['render', name], name)


if __name__ == '__main__':
    support.main()
