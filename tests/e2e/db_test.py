# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp db: adding objects, looking, copying, bad input."""
import json
import sqlite3
import support
from pathlib import Path
from support import EndToEnd, box_obj


class Database(EndToEnd):
    def meshes(self):
        self.file('meshes/box.obj', box_obj((40, 80, 60)))        # mm: graspable, keeps its size
        self.file('meshes/more/wall.obj', box_obj((4000, 2000, 100)))
        self.file('meshes/bad.obj', 'v 0 0 0\nf 1 2 3\n')

    def add(self, store, code=0):
        self.meshes()
        return self.succeed('db', 'add-objects', store, 'meshes', '--units', 'mm', code=code)

    def test_help_has_examples(self):
        for command in ([], ['info'], ['list'], ['show'], ['export'], ['import'], ['add-objects']):
            with self.subTest(' '.join(command)):
                run = self.succeed('db', *command, '--help')
                self.assertRegex(run.stdout, r'Examples?:\s+eigengrasp db ' + ' '.join(command))

    def test_add_objects_rescales_measures_and_names_bad_meshes(self):
        run = self.add('text:store')
        self.assertIn('2 objects are new', run.stdout)
        self.assertEqual(run.stderr.count('\n'), 1, run.stderr)
        self.assertIn('bad.obj', run.stderr)
        lines = self.file_lines('store/models.jsonl')
        self.assertEqual([line['name'] for line in lines], ['box', 'wall'])
        box, wall = lines
        self.assertEqual(box['rescale'], 0.001)
        self.assert_near(wall['rescale'], 0.001 * 0.07 / 2.0, 1e-12)  # middle side to 70 mm
        self.assertEqual(box['scales'], [0.75, 1, 1.25, 1.5])
        half_diagonal = 0.5 * (40 ** 2 + 80 ** 2 + 60 ** 2) ** 0.5 / 1000
        self.assertTrue(0.04 < box['approximate_radius'] < 1.2 * half_diagonal, box)
        again = self.add('text:store')
        self.assertIn('0 objects are new, 2 were there', again.stdout)

    def test_thumbnails(self):
        self.meshes()
        self.succeed('db', 'add-objects', 'text:store', 'meshes', '--units', 'mm', '--thumbnails', 'pictures')
        for line in self.file_lines('store/models.jsonl'):
            self.assertEqual(line['thumbnail_path'], str((self.folder / 'pictures' / line['name']).resolve()) + '.png')
            self.assertEqual(Path(line['thumbnail_path']).read_bytes()[:8], b'\x89PNG\r\n\x1a\n')

    def file_lines(self, name):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()[1:]]

    def test_princeton_layout(self):
        self.file('psb/db/0/m7/m7.off', 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n')
        self.file('psb/classification/v1/base/train.cla', 'PSB 1\n2 2\n\naircraft 0 0\n\nairplane aircraft 2\n7\n8\n')
        run = self.succeed('db', 'add-objects', 'sqlite:g.db', 'psb', '--psb')
        self.assertIn('m8', run.stderr)
        self.assertIn('1 objects are new', run.stdout)
        listed = self.succeed('db', 'list', 'sqlite:g.db', '--tag', 'airplane').stdout
        self.assertRegex(listed, r'^psb_7 .*aircraft, airplane\n$')
        self.assertEqual(self.succeed('db', 'list', 'sqlite:g.db', '--tag', 'fish').stdout, '')

    def test_info_show_and_round_trip(self):
        self.add('sqlite:g.db')
        self.assertIn('objects     2, with scales 8', self.succeed('db', 'info', 'sqlite:g.db').stdout)
        self.assertIn('box.obj', self.succeed('db', 'show', 'sqlite:g.db', 'box').stdout)
        self.succeed('db', 'export', 'sqlite:g.db', 'text:out')
        self.succeed('db', 'import', 'sqlite:h.db', 'text:out')
        self.succeed('db', 'export', 'sqlite:h.db', 'text:out2')
        for name in ('models', 'hands', 'sources'):
            first, second = (self.folder / f / f'{name}.jsonl' for f in ('out', 'out2'))
            self.assertEqual(first.exists(), second.exists())
            if first.exists():
                self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_bad_input(self):
        self.add('sqlite:g.db')
        self.refuse(['db', 'info', 'g.db'], 'g.db', 'sqlite:FILE')
        self.refuse(['db', 'info', 'sqlite:none.db'], 'none.db', 'no such file')
        self.refuse(['db', 'info', 'text:none'], 'none')
        self.refuse(['db', 'info', 'sqlite:meshes/box.obj'], 'box.obj', 'no grasp store')
        self.refuse(['db', 'show', 'sqlite:g.db', 'cup'], 'cup')
        self.refuse(['db', 'export', 'sqlite:g.db', 'sqlite:g.db'], 'two stores')
        self.refuse(['db', 'export', 'sqlite:g.db', 'text:meshes'], 'meshes', 'other files')
        self.refuse(['db', 'info', 'postgresql://me:pass@127.0.0.1:1/x'], 'postgresql://me@127.0.0.1:1/x')
        self.refuse(['db', 'add-objects', 'sqlite:new.db', 'nowhere'], 'nowhere')
        self.refuse(['db', 'add-objects', 'sqlite:new.db', 'meshes', '--psb'], 'Princeton')
        self.refuse(['db', 'add-objects', 'sqlite:new.db', 'meshes', '--units', 'feet'], 'feet')
        self.refuse(['db', 'add-objects', 'sqlite:new.db', 'meshes', '--scales', '1,0.5'], '0.5')

    def test_a_store_of_a_newer_version(self):
        self.add('sqlite:g.db')
        with sqlite3.connect(self.folder / 'g.db') as db:
            db.execute('UPDATE eigengrasp_schema SET schema_version = 9')
        db.close()
        self.refuse(['db', 'info', 'sqlite:g.db'], 'version 9', 'newer eigengrasp')


if __name__ == '__main__':
    support.main()
