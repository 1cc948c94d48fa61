# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp evaluate`: the planner's own grasps come back as they were written, and poses of others."""
import json
import support
from support import EndToEnd

HAND = ('--hand', 'barrett-rubber', '--object', 'glass')
FAR = {'position': [0, 0, 0.5], 'orientation': [1, 0, 0, 0]}


class Evaluate(EndToEnd):
    def rate(self, states, *options):
        self.file('states.jsonl', ''.join(json.dumps(s) + '\n' for s in states))
        return self.json_lines(self.succeed('evaluate', 'states.jsonl', *HAND, *options))

    def test_round_trip_of_a_grasp_file(self):
        self.succeed('plan', 'glass', '--hand', 'barrett-rubber', '--iterations', '4000', '--no-pictures', '--out', 'out')
        grasps = json.loads((self.folder / 'out/grasps.json').read_text())['grasps']
        rated = self.json_lines(self.succeed('evaluate', 'out/grasps.json', *HAND, '--exact', '--close'))
        self.assertEqual(len(rated), len(grasps))
        for grasp, r in zip(grasps, rated):
            with self.subTest(rank=grasp['rank']):
                self.assertTrue(r['legal'], r['reason'])
                self.assert_near(r['contact_energy'], grasp['energy'], 1e-6, 'energy')
                closed = r['closed']
                self.assertFalse(closed['started_in_collision'])
                self.assert_near(closed['epsilon'], grasp['epsilon'], 1e-9, 'epsilon')
                self.assert_near(closed['volume'], grasp['volume'], 1e-6 * max(1.0, grasp['volume']), 'volume')
                self.assertEqual(closed['form_closure'], grasp['form_closure'])
                # A contact at the edge of the tolerance may come or go with the rounding of the pose.
                self.assertLessEqual(abs(len(closed['contacts']) - len(grasp['contacts'])), 2)
                self.assertLessEqual(closed['max_penetration'], 0.0005)
                for name, value in grasp['grasp']['joints'].items():
                    self.assert_near(closed['joints'][name], value, 1e-9, name)
        # The same states as lines of their own give the same answers.
        self.assertEqual(self.rate([g['pregrasp'] for g in grasps], '--exact', '--close'), rated)
        # From the distance field nearly the same.
        for exact, fast in zip(rated, self.rate([g['pregrasp'] for g in grasps])):
            self.assert_near(exact['contact_energy'], fast['contact_energy'], 0.5, 'energy of the field')

    def test_named_joints_and_dofs_agree(self):
        joints = {'finger1_flexion': 0.6, 'finger2_flexion': 0.6, 'finger3_flexion': 0.6, 'finger1_spread': 0.3,
                  'finger2_spread': 0.3, 'finger1_distal_flexion': 0.2, 'finger2_distal_flexion': 0.2,
                  'finger3_distal_flexion': 0.2}
        named, plain, few = self.rate([{'hand_pose': FAR, 'joints': joints},
                                       {'hand_pose': FAR, 'dofs': [0.3, 0.6, 0.6, 0.6]},
                                       {'hand_pose': FAR, 'joints': {'finger1_flexion': 0.1}}], '--exact')
        self.assertTrue(named['legal'] and plain['legal'] and few['legal'])
        for key in ('contact_energy', 'quality', 'deepest_penetration'):
            self.assert_near(named[key], plain[key], 1e-6, key)
        self.assertNotEqual(few['contact_energy'], named['contact_energy'])
        # The paper's Q beside it: N (1 - energy / 50) of 19 virtual contacts.
        self.assert_near(named['quality'], 19 * (1 - named['contact_energy'] / 50), 1e-6, 'Q')

    def test_illegal_states_say_why(self):
        inside = {'position': [0, 0, 0], 'orientation': [1, 0, 0, 0]}
        for options in (('--exact',), ()):
            far, pierced = self.rate([{'hand_pose': FAR, 'dofs': [0, 0, 0, 0]},
                                      {'hand_pose': inside, 'dofs': [0, 0, 0, 0]}], *options)
            self.assertTrue(far['legal'])
            self.assertEqual(far['deepest_penetration'], 0.0)
            self.assertFalse(pierced['legal'])
            self.assertIn('object', pierced['reason'])
            self.assertGreater(pierced['deepest_penetration'], 0.001)

    def test_joint_beyond_its_limit_is_illegal(self):
        for line in ({'hand_pose': FAR, 'dofs': [0, 4.0, 0, 0]}, {'hand_pose': FAR, 'joints': {'finger1_flexion': -1.0}}):
            rated, = self.rate([line], '--exact')
            self.assertFalse(rated['legal'], rated)
            self.assertIn('limit', rated['reason'])

    def test_orientation_is_normalised_and_order_is_kept(self):
        heights = [0.3, 0.9, 0.5, 0.7]
        rated = self.rate([{'hand_pose': {'position': [0, 0, z], 'orientation': [2, 0, 0, 0]}, 'dofs': [0] * 4}
                           for z in heights], '--exact')
        energies = [r['contact_energy'] for r in rated]
        self.assertEqual(sorted(range(4), key=lambda i: energies[i]), sorted(range(4), key=lambda i: heights[i]))

    def test_no_lines_give_no_lines(self):
        self.assertEqual(self.rate([]), [])

    def test_closing_in_the_air_touches_nothing(self):
        rated, = self.rate([{'hand_pose': FAR, 'dofs': [0, 0, 0, 0]}], '--exact', '--close')
        self.assertEqual((rated['closed']['contacts'], rated['closed']['epsilon']), ([], 0.0))
        self.assertFalse(rated['closed']['form_closure'])


if __name__ == '__main__':
    support.main()
