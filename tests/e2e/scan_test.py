# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp scan, clouds of points as objects, and what is said of bad ones."""
import math
import re
import support
from support import EndToEnd

PCD = ('VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\n'
       'VIEWPOINT {1} 1 0 0 0\nPOINTS {0}\nDATA ascii\n')


def seen_of_ball(radius, camera, step=0.06):
    """Points of a ball about the origin that a camera along +x sees."""
    points = []
    theta = step / 2
    while theta < math.pi / 2 - 0.1:
        count = max(1, round(2 * math.pi * math.sin(theta) / step))
        for k in range(count):
            phi = 2 * math.pi * k / count
            points.append((radius * math.cos(theta), radius * math.sin(theta) * math.cos(phi),
                           radius * math.sin(theta) * math.sin(phi)))
        theta += step
    return [p for p in points if p[0] * camera[0] > radius * radius]


class Scan(EndToEnd):
    def pcd(self, name, points, camera=(0.6, 0.0, 0.0)):
        text = PCD.format(len(points), ' '.join(map(str, camera)))
        (self.folder / name).write_text(text + ''.join(f'{x} {y} {z}\n' for x, y, z in points))
        return name

    def ball(self, name='ball.pcd', unit=1.0):
        camera = (0.6 * unit, 0.0, 0.0)
        return self.pcd(name, seen_of_ball(0.035 * unit, camera), camera)

    def test_a_view_becomes_a_closed_surface(self):
        out = self.succeed('scan', self.ball(), '-o', 'ball.obj').stdout
        self.assertIn('mirrored about the plane', out)
        info = self.succeed('object', 'info', 'ball.obj').stdout
        self.assertIn('watertight      yes', info)
        volume = float(re.search(r'volume +([0-9.]+) cm', info)[1])
        self.assertAlmostEqual(volume / (4 / 3 * math.pi * 3.5 ** 3), 1.0, delta=0.25)

    def test_units_and_unseen_space(self):
        out = self.succeed('scan', self.ball(unit=1000.0), '-o', 'a.obj', '--units', 'mm', '--unseen', 'free').stdout
        self.assertIn('unseen     free', out)
        out = self.succeed('scan', self.ball(), '-o', 'b.obj', '--unseen', 'unknown', '--camera', '0.6,0,0').stdout
        self.assertIn('counts as the object', out)

    def test_a_cloud_is_an_object_to_grasp(self):
        self.succeed('plan', self.ball(), '--hand', 'barrett-rubber', '--iterations', '5000', '--grasps', '3',
                     '--out', 'out', '--no-pictures')
        self.assertTrue((self.folder / 'out/grasps.json').exists())

    def test_range_scans_with_poses_are_one_object(self):
        for name, text in support.registered_balls(0.035).items():
            self.file(name, text)
        run = self.succeed('scan', 'ball.conf', '-o', 'ball.obj')
        self.assertIn('1 of its 3 scans are not there and were left out: side.obj', run.stderr)
        self.assertRegex(run.stdout, r'view 2     from 0.000 0.000 -1.000 m\n')
        volume = float(re.search(r'volume +([0-9.]+) cm', self.succeed('object', 'info', 'ball.obj').stdout)[1])
        self.assertAlmostEqual(volume / (4 / 3 * math.pi * 3.5 ** 3), 1.0, delta=0.05)
        self.succeed('plan', 'ball.conf', '--hand', 'barrett-rubber', '--iterations', '5000', '--grasps', '3',
                     '--out', 'out', '--no-pictures')
        self.file('none.conf', 'bmesh side.obj 0 0 0 0 0 0 1\n')
        self.refuse(['plan', 'none.conf', '--hand', 'human'], 'none.conf', 'none of which is there')

    def test_bad_clouds(self):
        plane = [(0.002 * i, 0.002 * j, 0.0) for i in range(20) for j in range(20)]
        nan = self.pcd('nan.pcd', [('nan', 'nan', 'nan')] * 60)
        for args, found in (([self.pcd('three.pcd', [(0, 0, 0), (0, 0.1, 0), (0.1, 0, 0)])], '3 points'),
                            ([self.pcd('plane.pcd', plane, (0, 0, 0.5))], 'in a plane'),
                            ([nan], 'no point with finite coordinates'),
                            ([self.ball('mm.pcd', unit=1000.0)], '--units mm'),
                            ([self.ball(), '--camera', 'here'], 'three numbers'),
                            ([self.ball(), '--unseen', 'dark'], 'mirrored, unknown or free'),
                            ([self.ball(), '--remove-table'], 'no table was found'),
                            (['absent.ply'], 'no such file')):
            run = self.run_program('scan', *args, '-o', 'x.obj')
            self.assertEqual(run.returncode, 2, args)
            self.assertIn(found, run.stderr, args)
            self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
            self.assertFalse((self.folder / 'x.obj').exists())

    def test_points_that_are_not_finite_are_left_out(self):
        points = seen_of_ball(0.035, (0.6, 0, 0)) + [('nan', 'nan', 'nan')] * 7
        run = self.succeed('scan', self.pcd('some.pcd', points), '-o', 'some.obj')
        self.assertIn('7 points are not finite', run.stderr)


if __name__ == '__main__':
    support.main()
