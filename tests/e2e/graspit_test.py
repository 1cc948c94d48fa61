# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""GraspIt! robots and worlds and scanned objects: needs the test data, and is skipped loudly without it."""
import json
import support
from support import EndToEnd, test_data


class GraspIt(EndToEnd):
    def plan(self, *args, closed=True, timeout=120):
        run = self.run_program('plan', *args, '--no-pictures', '--out', 'out', timeout=timeout)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        file = json.loads((self.folder / 'out/grasps.json').read_text())
        self.assertTrue(file['grasps'], run.stdout)
        for grasp in file['grasps']:
            self.assertLessEqual(grasp['max_penetration'], 0.0005)
        if closed:
            self.assertTrue(any(g['form_closure'] for g in file['grasps']), run.stdout)
        return file, run

    def test_barrett_in_a_world(self):
        robots = test_data('graspit', 'models', 'robots')
        world = test_data('graspit', 'worlds', 'plannerMug.xml')
        file, _ = self.plan('--world', world, '--hand', robots / 'Barrett' / 'Barrett.xml', '--iterations', '6000',
                            closed=False)
        self.assertEqual(len(file['hand']['dofs']), 4)
        self.assertEqual(file['object']['units'], 'mm')
        self.assertLess(file['object']['max_radius'], 0.2)

    def test_hand_of_the_world(self):
        file, _ = self.plan('--world', test_data('graspit', 'worlds', 'plannerMug.xml'), '--iterations', '2000',
                            '--grasps', '4', closed=False)
        self.assertEqual(len(file['hand']['dofs']), 4)

    def test_dlr_with_contact_files(self):
        robot = test_data('graspit', 'models', 'robots', 'DLR')
        contacts = ','.join(str(robot / 'virtual' / f'{n}.xml')
                            for n in ('palm', 'phlx_prox', 'phlx_middle', 'phlx_distal'))
        flask = test_data('graspit', 'models', 'objects', 'flask.xml')
        file, _ = self.plan(flask, '--hand', robot / 'DLR.xml', '--contacts', contacts, '--eigengrasp-file',
                            robot / 'eigen' / 'DLR_eigen.xml', '--iterations', '6000', closed=False)
        self.assertEqual(len(file['hand']['dofs']), 12)
        self.assertIn('13 virtual contacts', self.succeed('hand', 'show', robot / 'DLR.xml', '--contact-files',
                                                          contacts).stdout)

    def test_dlr_without_contact_files_says_what_to_give(self):
        robot = test_data('graspit', 'models', 'robots', 'DLR', 'DLR.xml')
        run = self.run_program('plan', 'glass', '--hand', robot, '--iterations', '100', '--no-pictures', '--out', 'out')
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertEqual(run.stdout, '')
        self.assertRegex(run.stderr, 'virtual contacts.*contact file')
        self.assertEqual(self.contents(), [])

    def test_robonaut_13_dof(self):
        robot = test_data('graspit', 'models', 'robots', 'Robonaut')
        contacts = ','.join(str(robot / 'virtual' / f'{n}.xml')
                            for n in ('palm', 'proximal_phlx', 'middle_phlx', 'distal_phlx'))
        file, _ = self.plan('glass', '--hand', robot / 'Robonaut_13DOF.xml', '--contacts', contacts,
                            '--eigengrasp-file', robot / 'eigen' / 'robonaut_13DOF.xml', '--iterations', '6000',
                            closed=False)
        self.assertEqual(len(file['hand']['dofs']), 13)

    def test_contact_file_that_is_none(self):
        robot = test_data('graspit', 'models', 'robots', 'DLR', 'DLR.xml')
        self.file('none.xml', '<contacts')
        self.refuse(['plan', 'glass', '--hand', robot, '--contacts', 'none.xml', '--out', 'out'], 'none.xml')
        self.refuse(['plan', 'glass', '--hand', robot, '--contacts', 'gone.xml', '--out', 'out'], 'gone.xml')

    def test_human_hand_on_a_scanned_mug(self):
        mug = test_data('ycb', '025_mug.obj')
        file, _ = self.plan(mug, '--hand', 'human', '--iterations', '20000', timeout=200)
        self.assertEqual(file['object']['name'], '025_mug')


if __name__ == '__main__':
    support.main()
