# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""The grasps that are shipped: 'shipped' as a store to read."""
import re
import shutil
import sqlite3
import support
from support import EndToEnd


class Shipped(EndToEnd):
    def data(self):
        return support.SOURCE / 'data'

    def test_its_objects_are_those_of_the_library(self):
        names = sorted(file.stem for file in (self.data() / 'objects').glob('*.obj'))
        listed = self.succeed('db', 'list', 'shipped').stdout
        self.assertEqual(sorted(line.split()[0] for line in listed.splitlines()), names)
        for name in names:
            self.assertIn(f'{name}: library:{name}\n', self.succeed('db', 'show', 'shipped', name, '--scale', '1').stdout)
        self.assertIn('72 done, 0 failed, 0 claimed, 0 waiting', self.succeed('db', 'info', 'shipped').stdout)

    def test_it_says_nothing_of_the_machine_that_made_it(self):
        file = self.data() / 'grasps/shipped.db'
        self.assertLess(file.stat().st_size, 4_000_000)
        with sqlite3.connect(f'file:{file}?mode=ro', uri=True) as db:
            self.assertEqual(db.execute('SELECT DISTINCT work_unit_worker FROM work_unit').fetchall(), [('',)])
            self.assertEqual(db.execute("SELECT count(*) FROM original_model WHERE original_model_geometry_path NOT LIKE "
                                        "'library:%' OR original_model_thumbnail_path <> ''").fetchone(), (0,))
            self.assertEqual(db.execute('PRAGMA journal_mode').fetchone(), ('delete',))
        db.close()

    def test_its_grasps_are_found_and_reproduce(self):
        show = self.succeed('db', 'show', 'shipped', 'glass', '--hand', 'human', '--scale', '1').stdout
        self.assertEqual(len(re.findall(r'^ +\d+ human +1 .* yes ', show, re.M)), 15, show)
        verify = self.succeed('db', 'verify', 'shipped', '--objects', 'glass,phone', '--every', '20').stdout
        self.assertIn(' 0 of them do not reproduce', verify)
        self.assertRegex(self.succeed('db', 'stats', 'shipped').stdout, r'6 objects, 0 of them without any grasp')

    def test_reading_leaves_the_installed_file_alone(self):
        shutil.copytree(self.data() / 'grasps', self.folder / 'data/grasps')
        shutil.copytree(self.data() / 'objects', self.folder / 'data/objects')
        shutil.copytree(self.data() / 'hands/human', self.folder / 'data/hands/human')
        file = self.folder / 'data/grasps/shipped.db'
        before, files = file.read_bytes(), self.contents()
        for folder in (file, file.parent):
            folder.chmod(folder.stat().st_mode & ~0o222)
        self.addCleanup(file.parent.chmod, 0o755)
        with support.environment(EIGENGRASP_DATA_DIR=str(self.folder / 'data')):
            self.succeed('db', 'stats', 'shipped')
            self.succeed('db', 'status', 'shipped')
            self.succeed('db', 'show', 'shipped', 'phone')
            self.assertIn(' 0 of them', self.succeed('db', 'verify', 'shipped', '--objects', 'shoe', '--hands', 'human',
                                                     '--every', '30').stdout)
        self.assertEqual((file.read_bytes(), self.contents()), (before, files))

    def test_a_copy_can_be_written_to(self):
        self.succeed('db', 'export', 'shipped', 'sqlite:mine.db')
        self.assertIn('0 units in', self.succeed('db', 'build', 'sqlite:mine.db').stdout)

    def test_bad_input(self):
        for command in (['build', 'shipped'], ['add-objects', 'shipped', '--library']):
            self.refuse(['db', *command], 'only for reading', 'db export shipped')
        self.refuse(['db', 'add-objects', 'sqlite:g.db'], 'no folder of meshes', '--library')
        self.refuse(['db', 'add-objects', 'sqlite:g.db', '.', '--library'], '--library stands beside')
        with support.environment(EIGENGRASP_DATA_DIR=str(self.folder)):
            self.refuse(['db', 'list', 'shipped'], 'shipped grasps were not found', self.folder)

    def test_objects_of_the_library_in_a_store_of_ones_own(self):
        self.succeed('db', 'add-objects', 'sqlite:g.db', '--library', '--scales', '1')
        self.assertIn('6 objects', self.succeed('db', 'stats', 'sqlite:g.db').stdout)
        with sqlite3.connect(self.folder / 'g.db') as db:
            db.execute("UPDATE original_model SET original_model_geometry_path = 'library:vase' WHERE original_model_name = 'glass'")
        db.close()
        run = self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'barrett-rubber', '--scales', '1', '--grasps', '1')
        self.assertIn('1 of them failed', run.stdout)
        self.assertIn('"vase" is no', self.succeed('db', 'status', 'sqlite:g.db').stdout)


if __name__ == '__main__':
    support.main()
