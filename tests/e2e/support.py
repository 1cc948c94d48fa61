# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""What the end-to-end tests share: running the program, bad input, meshes, kinematics of a URDF.

usage of a test: X_test.py PROGRAM SOURCE_FOLDER [unittest options]
"""
import contextlib
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
import xml.etree.ElementTree as ElementTree
from pathlib import Path

PROGRAM = SOURCE = None


def main():
    """Runs the tests of the calling file; a program that is missing is an error, not a skip."""
    global PROGRAM, SOURCE
    if len(sys.argv) < 3 or sys.argv[1].startswith('-'):
        sys.exit(f'usage: {sys.argv[0]} PROGRAM SOURCE_FOLDER [unittest options]')
    PROGRAM, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if not os.access(PROGRAM, os.X_OK) or PROGRAM.is_dir():
        sys.exit(f'{PROGRAM}: no program there; build the target eigengrasp')
    if not (SOURCE / 'data' / 'hands').is_dir():
        sys.exit(f'{SOURCE}: no data/hands there; name the source folder')
    # The tests are imported as modules of their own copy of this file where they are run as programs.
    module = sys.modules['support']
    module.PROGRAM, module.SOURCE = PROGRAM, SOURCE
    result = unittest.main(module='__main__', argv=[sys.argv[0], *sys.argv[3:]], exit=False).result
    if result.skipped:
        print(f'SKIPPED {len(result.skipped)} of {result.testsRun} tests', file=sys.stderr)
        for test, reason in result.skipped:
            print(f'  {test}: {reason}', file=sys.stderr)
    everything_skipped = result.testsRun > 0 and len(result.skipped) == result.testsRun
    sys.exit(1 if not result.wasSuccessful() else 77 if everything_skipped else 0)


def test_data(*parts):
    """A path in the test data that is not part of the repository; skips the test where it is absent."""
    root = Path(os.environ.get('EIGENGRASP_DATA') or Path.home() / '.cache' / 'eigengrasp-data')
    path = root.joinpath(*parts)
    if not path.exists():
        raise unittest.SkipTest(f'needs the test data (set EIGENGRASP_DATA): {path}')
    return path


@contextlib.contextmanager
def environment(**variables):
    """Variables that the program sees meanwhile."""
    with unittest.mock.patch.dict(os.environ, variables):
        yield


def run_in(folder, *args, timeout=120):
    return subprocess.run([str(PROGRAM), *map(str, args)], cwd=folder, text=True, timeout=timeout,
                          stdin=subprocess.DEVNULL, capture_output=True, errors='replace')


class EndToEnd(unittest.TestCase):
    """Each test has an empty folder, self.folder, in which the program runs."""
    longMessage = True
    maxDiff = 2000

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix='eigengrasp-e2e-')
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_program(self, *args, timeout=120):
        return run_in(self.folder, *args, timeout=timeout)

    def succeed(self, *args, code=0, timeout=120):
        """Runs the program, which shall end with this code. Returns its run."""
        run = self.run_program(*args, timeout=timeout)
        self.assertEqual(run.returncode, code, f'{args}\nstdout: {run.stdout[-2000:]}\nstderr: {run.stderr[-2000:]}')
        return run

    def file(self, name, text=''):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text)
        return path

    def json_lines(self, run):
        return [json.loads(line) for line in run.stdout.splitlines()]

    def assert_near(self, a, b, tolerance, message=None):
        self.assertLessEqual(abs(a - b), tolerance, f'{a} and {b}: {message or ""}')

    def contents(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob('*'))

    def refuse(self, args, *named, timeout=20):
        """Bad input: one sentence on stderr that names the thing, code 2, nothing on stdout, no files made.
        Returns the sentence."""
        before = self.contents()
        start = time.monotonic()
        run = self.run_program(*args, timeout=timeout)
        what = f'{args}\nstdout: {run.stdout[:500]}\nstderr: {run.stderr[:1500]}'
        self.assertEqual(run.returncode, 2, what)
        self.assertEqual(run.stdout, '', what)
        self.assertEqual(run.stderr.count('\n'), 1, what)
        self.assertTrue(run.stderr.startswith('eigengrasp: ') and run.stderr.endswith('\n'), what)
        self.assertGreater(len(run.stderr), len('eigengrasp: \n') + 10, what)
        self.assertLess(len(run.stderr), 1000, what)
        for trace in ('terminate called', 'what():', '#0', 'Aborted', 'core dumped', '.cpp:', '.hpp:', '\x1b'):
            self.assertNotIn(trace, run.stderr, what)
        for name in named:
            self.assertIn(str(name), run.stderr, what)
        self.assertEqual(self.contents(), before, what)
        self.assertLess(time.monotonic() - start, timeout, what)
        return run.stderr


def wait_until_catching_interrupts(process, seconds=60):
    """Waits until the process has a handler for SIGINT (Linux: the bit in SigCgt)."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            status = Path(f'/proc/{process.pid}/status').read_text()
        except OSError:
            return False
        caught = [line for line in status.splitlines() if line.startswith('SigCgt:')]
        if caught and int(caught[0].split()[1], 16) & (1 << (signal.SIGINT - 1)):
            return True
        time.sleep(0.02)
    return False


# Meshes ---------------------------------------------------------------------------------------------------

def box_obj(size, center=(0, 0, 0)):
    """Text of a closed box with outward triangles."""
    corners = [[center[k] + (size[k] / 2 if (i >> k) & 1 else -size[k] / 2) for k in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    lines = ['v {:.9g} {:.9g} {:.9g}'.format(*c) for c in corners]
    for a, b, c, d in quads:
        lines += [f'f {a + 1} {b + 1} {c + 1}', f'f {a + 1} {c + 1} {d + 1}']
    return '\n'.join(lines) + '\n'


def registered_balls(radius, step=0.06):
    """Files of two range scans of a ball, from in front and from behind, and of the list that lays them together."""
    points = []
    theta = step / 2
    while radius * math.cos(theta) > radius * radius:  # seen from 1 m along +z
        count = max(1, round(2 * math.pi * math.sin(theta) / step))
        points += [(radius * math.sin(theta) * math.cos(2 * math.pi * k / count),
                    radius * math.sin(theta) * math.sin(2 * math.pi * k / count), radius * math.cos(theta))
                   for k in range(count)]
        theta += step
    cloud = ''.join('v {:.9g} {:.9g} {:.9g}\n'.format(*p) for p in points)
    return {'front.obj': cloud, 'back.obj': cloud,
            'ball.conf': 'bmesh front.obj 0 0 0 0 0 0 1\nbmesh back.obj 0 0 0 0 1 0 0\nbmesh side.obj 0 0 0 0 0 0 1\n'}


def obj_vertices(path):
    return [tuple(map(float, line.split()[1:4])) for line in Path(path).read_text().splitlines()
            if line.startswith('v ')]


# Kinematics -----------------------------------------------------------------------------------------------

def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def from_quaternion(q, p):
    w, x, y, z = q
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), p[0]],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), p[1]],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), p[2]],
            [0, 0, 0, 1]]


def about_axis(axis, angle):
    n = math.sqrt(sum(a * a for a in axis))
    s = math.sin(angle / 2) / n
    return from_quaternion([math.cos(angle / 2), *(s * a for a in axis)], (0, 0, 0))


def from_rpy(rpy, p):
    r = multiply(about_axis((0, 0, 1), rpy[2]), multiply(about_axis((0, 1, 0), rpy[1]), about_axis((1, 0, 0), rpy[0])))
    for i in range(3):
        r[i][3] = p[i]
    return r


def numbers(element, name, default):
    text = element.get(name) if element is not None else None
    return [float(t) for t in text.split()] if text else list(default)


class UrdfHand:
    """Forward kinematics of a URDF with revolute joints and OBJ meshes, apart from the program's own."""

    def __init__(self, urdf):
        self.urdf = Path(urdf)
        robot = ElementTree.parse(urdf).getroot()
        self.meshes = {}
        for link in robot.findall('link'):
            self.meshes[link.get('name')] = [
                (self._origin(c), obj_vertices(self.urdf.parent / c.find('geometry/mesh').get('filename')))
                for c in link.findall('collision') if c.find('geometry/mesh') is not None]
        self.joints = {j.find('child').get('link'): j for j in robot.findall('joint')}

    @staticmethod
    def _origin(element):
        o = element.find('origin')
        return from_rpy(numbers(o, 'rpy', (0, 0, 0)), numbers(o, 'xyz', (0, 0, 0)))

    def link_pose(self, link, base, values):
        if link not in self.joints:
            return base
        joint = self.joints[link]
        pose = multiply(self.link_pose(joint.find('parent').get('link'), base, values), self._origin(joint))
        if joint.get('type') in ('revolute', 'continuous'):
            pose = multiply(pose, about_axis(numbers(joint.find('axis'), 'xyz', (1, 0, 0)), values[joint.get('name')]))
        return pose

    def heights(self, state):
        """z of all mesh vertices in the object's frame, of a pregrasp or grasp of a grasps.json."""
        base = from_quaternion(state['hand_pose']['orientation'], state['hand_pose']['position'])
        for link, meshes in self.meshes.items():
            pose = self.link_pose(link, base, state['joints'])
            for origin, vertices in meshes:
                z = multiply(pose, origin)[2]
                for v in vertices:
                    yield z[0] * v[0] + z[1] * v[1] + z[2] * v[2] + z[3]
