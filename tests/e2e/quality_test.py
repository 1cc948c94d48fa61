# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp quality` against closed forms."""
import json
import math
import random
import support
from support import EndToEnd


def unit(i, sign=1.0, n=6):
    return [sign if k == i else 0.0 for k in range(n)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def ball_contacts(n, mu, radius=1.0):
    """n antipodal pairs spread over a ball (Fibonacci)."""
    contacts = []
    for i in range(n):
        z = (i + 0.5) / n
        r, t = math.sqrt(1 - z * z), i * math.pi * (3 - math.sqrt(5))
        d = [r * math.cos(t), r * math.sin(t), z]
        contacts += [{'position': [s * radius * x for x in d], 'normal': [-s * x for x in d], 'mu': mu}
                     for s in (1, -1)]
    return contacts


def support_of(contacts, force, torque, scale):
    """Support function of the L1 wrench space of true cones, from its definition."""
    best = 0.0
    for c in contacts:
        n, p = c['normal'], [x / scale for x in c['position']]
        direction = [f + t for f, t in zip(force, cross(torque, p))]  # f.F + (p x f).T = f.(F + T x p)
        along = dot(n, direction)
        across = math.sqrt(max(0.0, dot(direction, direction) - along * along))
        best = max(best, along + c['mu'] * across)
    return best


class Quality(EndToEnd):
    def rate(self, lines, *options):
        self.file('contacts.jsonl', ''.join(json.dumps(line) + '\n' for line in lines))
        return self.json_lines(self.succeed('quality', 'contacts.jsonl', *options))

    def test_cross_polytope(self):
        wrenches = [unit(i, s) for i in range(6) for s in (1, -1)]
        doubled = [[2 * x for x in w] for w in wrenches]
        one, two, half = self.rate([{'wrenches': wrenches}, {'wrenches': doubled}, {'wrenches': wrenches[:-1]}])
        self.assert_near(one['epsilon'], 1 / math.sqrt(6), 1e-9)
        self.assert_near(one['volume'], 2 ** 6 / math.factorial(6), 1e-6)
        self.assert_near(two['epsilon'], 2 / math.sqrt(6), 1e-9)
        self.assertTrue(one['form_closure'] and two['form_closure'])
        self.assertEqual((half['epsilon'], half['form_closure'], half['volume']), (0.0, False, 0.0))

    def test_simplex(self):
        """The regular simplex of 7 unit wrenches has the inradius 1/6."""
        # Centred unit vectors of 7 dimensions in an orthonormal basis (Helmert) of their hyperplane.
        basis = [[1 / math.sqrt(k * (k + 1))] * k + [-k / math.sqrt(k * (k + 1))] + [0.0] * (6 - k) for k in range(1, 7)]
        wrenches = [[math.sqrt(7 / 6) * row[v] for row in basis] for v in range(7)]
        rated, = self.rate([{'wrenches': wrenches}])
        self.assert_near(rated['epsilon'], 1 / 6, 1e-9)

    def test_ball_with_contacts_all_over(self):
        """Many contacts all over a ball of the torque scale's radius: epsilon tends to mu (pure torques)."""
        for mu in (0.3, 0.8):
            contacts = ball_contacts(20, mu, 0.05)
            rated, = self.rate([{'contacts': contacts}], '--true-cone', '--torque-scale', '0.05')
            self.assertLessEqual(rated['epsilon'], mu + 1e-6)
            self.assertGreater(rated['epsilon'], 0.85 * mu)
            self.assertEqual(rated['torque_scale'], 0.05)

    def test_epsilon_is_the_smallest_support(self):
        """No direction has less support than epsilon, and a local search comes down to it."""
        contacts = ball_contacts(3, 0.5)
        rated, = self.rate([{'contacts': contacts}], '--true-cone')
        generator = random.Random(7)

        def value(d):
            length = math.sqrt(dot(d, d))
            d = [x / length for x in d]
            return support_of(contacts, d[:3], d[3:], 1.0), d
        tries = sorted(value([generator.gauss(0, 1) for _ in range(6)]) for _ in range(4000))
        self.assertGreaterEqual(tries[0][0], rated['epsilon'] - 1e-6)
        lowest = math.inf
        for best in tries[:5]:
            step = 0.3
            while step > 1e-6:
                moved = min(value([x + generator.gauss(0, step) for x in best[1]]) for _ in range(30))
                best, step = (moved, step) if moved < best else (best, step * 0.7)
            lowest = min(lowest, best[0])
        self.assertGreaterEqual(lowest, rated['epsilon'] - 1e-6)
        self.assert_near(lowest, rated['epsilon'], 2e-3)

    def test_two_soft_fingers(self):
        """Two soft fingers that oppose each other resist a twist about their line by mu times the torsion length."""
        contacts = [{'position': [s, 0, 0], 'normal': [-s, 0, 0], 'mu': 0.5, 'torsion_length': 0.1} for s in (1, -1)]
        soft, = self.rate([{'contacts': contacts}], '--true-cone')
        self.assert_near(soft['epsilon'], 0.05, 1e-6)
        self.assertTrue(soft['form_closure'])
        hard, = self.rate([{'contacts': [{**c, 'torsion_length': 0} for c in contacts]}], '--true-cone')
        self.assertEqual((hard['epsilon'], hard['form_closure']), (0.0, False))

    def test_norms_and_cones(self):
        lines = [{'contacts': ball_contacts(2, 0.6)}]
        edges8, = self.rate(lines, '--edges', '8')
        edges32, = self.rate(lines, '--edges', '32')
        true_cone, = self.rate(lines, '--true-cone')
        # The Minkowski sum holds the hull, and lies in as many times the hull as there are contacts.
        angles = [2 * math.pi * k / 3 for k in range(3)]
        three = [{'contacts': [{'position': [math.cos(a), math.sin(a), 0], 'normal': [-math.cos(a), -math.sin(a), 0],
                                'mu': 0.6} for a in angles]}]
        l1, = self.rate(three, '--edges', '5')
        linf, = self.rate(three, '--norm', 'linf', '--edges', '5')
        self.assertGreater(l1['epsilon'], 0.0)
        self.assertGreaterEqual(linf['epsilon'], l1['epsilon'])
        self.assertLessEqual(linf['epsilon'], 3 * l1['epsilon'] + 1e-9)
        self.assertGreaterEqual(linf['volume'], l1['volume'])

    def test_torque_scale(self):
        contacts = ball_contacts(4, 0.6, 0.04)
        default, given, inline, moved = (self.rate([line], *options)[0] for line, options in (
            ({'contacts': contacts}, ()),
            ({'contacts': contacts}, ('--torque-scale', '0.08')),
            ({'contacts': contacts, 'torque_scale': 0.08}, ()),
            ({'contacts': contacts}, ('--torque-origin', '0.5', '0', '0'))))
        self.assert_near(default['torque_scale'], 0.04, 1e-12, 'the largest distance of a contact')
        self.assertEqual((given['torque_scale'], inline['torque_scale']), (0.08, 0.08))
        self.assertEqual(given, inline)
        self.assertLess(given['epsilon'], default['epsilon'])
        self.assertGreater(moved['torque_scale'], 0.5)
        # A ball of twice the size with twice the scale is the same.
        twice, = self.rate([{'contacts': ball_contacts(4, 0.6, 0.08)}], '--torque-scale', '0.08')
        self.assert_near(twice['epsilon'], default['epsilon'], 1e-9)
        self.assert_near(twice['volume'], default['volume'], 1e-6)

    def test_epsilon_min_decides_closure(self):
        lines = [{'wrenches': [unit(i, s) for i in range(6) for s in (1, -1)]}]
        self.assertTrue(self.rate(lines, '--epsilon-min', '0.40')[0]['form_closure'])
        self.assertFalse(self.rate(lines, '--epsilon-min', '0.41')[0]['form_closure'])

    def test_degenerate_contacts(self):
        one = {'position': [1, 0, 0], 'normal': [-1, 0, 0], 'mu': 0.5}
        for rated in self.rate([{'contacts': []}, {'contacts': [one]}, {'contacts': [one] * 5}, {'wrenches': []}]):
            self.assertEqual((rated['epsilon'], rated['form_closure'], rated['volume']), (0.0, False, 0.0))

    def test_norm_of_plain_wrenches_is_refused(self):
        self.file('contacts.jsonl', json.dumps({'wrenches': [unit(0)]}) + '\n')
        self.refuse(['quality', 'contacts.jsonl', '--norm', 'linf'], 'contacts.jsonl:1', 'linf')


if __name__ == '__main__':
    support.main()
