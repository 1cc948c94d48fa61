# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""shape describe, neighbors and align; reproduce psb-retrieval on a small benchmark that is made here."""
import json
import math
import re
import support
from support import EndToEnd, box_obj


def lines(text):
    return [json.loads(line) for line in text.splitlines()]


class Shape(EndToEnd):
    def box(self, name, size):
        (self.folder / name).write_text(box_obj(size))
        return name

    def test_help_has_examples_whose_options_exist(self):
        for command in ([], ['describe'], ['neighbors'], ['align']):
            text = self.succeed('shape', *command, '--help').stdout
            self.assertRegex(text, r'Examples?:\s+eigengrasp shape')
            start = text.index('Example')
            for option in re.findall(r'--[a-z-]+', text[start:]):
                self.assertIn(option, text[:start], command)

    def test_describe(self):
        self.assertIn('flask', self.succeed('shape', 'describe', 'flask').stdout)
        surface, = lines(self.succeed('shape', 'describe', 'flask', '--json').stdout)
        self.assertEqual((surface['name'], surface['function'], surface['route']), ('flask', 'surface', 'voxels'))
        self.assertEqual(len(surface['invariants']), 121)
        solid, = lines(self.succeed('shape', 'describe', self.box('cube.obj', (2, 2, 2)), '--json',
                                    '--function', 'solid').stdout)
        self.assertEqual(solid['route'], 'moments')
        self.assertAlmostEqual(solid['invariants'][0], 8 / (4 / 3 * math.pi * (3 ** 0.5 / 0.9) ** 3), 6)

    def test_neighbors(self):
        near, = lines(self.succeed('shape', 'neighbors', 'flask', '--count', '3', '--json').stdout)
        self.assertEqual([n['name'] for n in near['neighbors']][0], 'flask')
        self.assertEqual(len(near['neighbors']), 3)
        self.assertLess(near['neighbors'][0]['distance'], 1e-3)

    def test_descriptors_can_be_kept_in_a_file(self):
        meshes = self.folder / 'meshes'
        meshes.mkdir()
        for i in range(1, 5):
            self.box(f'meshes/{i}.obj', (1, 1, i))
        text = self.succeed('shape', 'describe', 'meshes', '--json').stdout
        (self.folder / 'kept.jsonl').write_text(text)
        query = self.box('query.obj', (2, 2, 6.1))
        for among in ('meshes', 'kept.jsonl'):
            near, = lines(self.succeed('shape', 'neighbors', query, '--among', among, '--json').stdout)
            self.assertEqual(near['neighbors'][0]['name'], '3')

    def test_align(self):
        near, = lines(self.succeed('shape', 'align', 'glass', 'glass', '--json').stdout)
        self.assertLess(near['distance'], 1e-3)
        self.assertAlmostEqual(near['scale'], 1.0, 6)
        self.assertEqual(near['method'], 'pca-icp')
        self.assertIn('method pca,', self.succeed('shape', 'align', 'glass', 'flask', '--method', 'pca').stdout)

    def test_bad_input_is_one_sentence(self):
        (self.folder / 'empty.obj').write_text('# nothing\n')
        (self.folder / 'nan.obj').write_text('v 0 0 nan\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n')
        (self.folder / 'flat.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        (self.folder / 'line.obj').write_text('v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n')
        (self.folder / 'cut.jsonl').write_text('{"name": "a", "function": "surface"}\n')
        (self.folder / 'none').mkdir()
        for command in (['describe', 'empty.obj'], ['describe', 'nan.obj'], ['describe', 'flat.obj'],
                        ['describe', 'line.obj'], ['describe', 'cut.jsonl'], ['describe', 'none'],
                        ['describe', 'absent.stl'], ['describe', 'flask', '--function', 'skin'],
                        ['describe', 'flat.obj', '--function', 'solid'], ['neighbors', 'flask', '--count', '0'],
                        ['align', 'glass', 'line.obj'], ['align', 'glass', 'flask', '--method', 'magic']):
            with self.subTest(' '.join(command)):
                run = support.run_in(self.folder, 'shape', *command)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        run = support.run_in(self.folder, 'reproduce', 'psb-retrieval', '--psb', 'none')
        self.assertEqual(run.returncode, 2)

    def test_reproduce_psb_retrieval(self):
        db = self.folder / 'psb' / 'db'
        classes = self.folder / 'psb' / 'classification' / 'v1' / 'base'
        classes.mkdir(parents=True)
        number = 0
        for half in ('train', 'test'):
            text = ['PSB 1', '2 6', '']
            for name, size in (('rod', (1, 1, 8)), ('plate', (8, 8, 1))):
                text.append(f'{name} 0 3')
                for i in range(3):
                    folder = db / '0' / f'm{number}'
                    folder.mkdir(parents=True)
                    self.off(folder / f'm{number}.off', [s * (1 + 0.1 * i * (k + 1)) for k, s in enumerate(size)])
                    text.append(str(number))
                    number += 1
                text.append('')
            (classes / f'{half}.cla').write_text('\n'.join(text))
        self.succeed('reproduce', 'psb-retrieval', '--psb', 'psb', '--out', 'out', '--index', '500')
        result = json.loads((self.folder / 'out' / 'psb-retrieval.json').read_text())
        first = result['rows'][0]
        self.assertEqual((first['half'], first['queries'], first['nearest_neighbor']), ('test', 6, 1.0))
        self.assertEqual(first['first_tier'], 1.0)
        self.assertGreater(result['index']['widths'][-1]['recall'], 0.9)
        page = (self.folder / 'out' / 'psb-retrieval.md').read_text()
        self.assertIn('spherical harmonics', page)
        self.assertIn('<svg', (self.folder / 'out' / 'psb-retrieval' / 'precision-recall.svg').read_text())
        self.assertTrue((self.folder / 'out' / 'psb-retrieval' / 'precision-recall.png').exists())

    @staticmethod
    def off(path, size):
        corners = [[size[k] * (i >> k & 1) for k in range(3)] for i in range(8)]
        faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        path.write_text('OFF\n8 6 0\n' + ''.join('{} {} {}\n'.format(*c) for c in corners) +
                        ''.join('4 {} {} {} {}\n'.format(*f) for f in faces))


if __name__ == '__main__':
    support.main()
