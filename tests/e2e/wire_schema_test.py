#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""The schema is a sound one, and the program judges messages as python3-jsonschema does: every example of
tests/fuzz/corpus/wire, and damaged ones. usage: wire_schema_test.py WIRE_CHECK SOURCE_FOLDER"""
import copy
import json
import random
import subprocess
import unittest

import support

try:
    import jsonschema
except ImportError:
    jsonschema = None

JUNK = [None, True, -1, 0, 1.5, 10**13, 1e300, '', 'x' * 5000, [], {}, [0] * 300, {'type': 'hello'}, 'close', 3.0]


def places(value, path=()):
    """Paths to all values in a JSON value."""
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in items:
        yield from places(part, (*path, key))


def damaged(value, draw):
    """The value with one place replaced, removed, doubled or added to."""
    value = copy.deepcopy(value)
    path = draw.choice([p for p in places(value) if p])
    parent = value
    for key in path[:-1]:
        parent = parent[key]
    way = draw.randrange(4)
    if way == 0:
        del parent[path[-1]]
    elif way == 1 and isinstance(parent, dict):
        parent['unheard_of'] = draw.choice(JUNK)
    elif way == 2 and isinstance(parent, list):
        parent.append(copy.deepcopy(parent[path[-1]]))
    else:
        parent[path[-1]] = copy.deepcopy(draw.choice(JUNK))
    return value


class WireSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if jsonschema is None:
            raise unittest.SkipTest('needs python3-jsonschema: apt-get install python3-jsonschema')
        cls.schema = json.loads((support.SOURCE / 'schema' / 'wire.schema.json').read_text())
        files = sorted((support.SOURCE / 'tests' / 'fuzz' / 'corpus' / 'wire').glob('ok_*.json'))
        cls.examples = [(f.name, json.loads(f.read_text())) for f in files]

    def validator(self, definition):
        return jsonschema.Draft202012Validator({'$ref': f'#/$defs/{definition}', '$defs': self.schema['$defs']})

    def ours(self, definition, values):
        """Verdicts of the program: a line each, 'ok' or the sentence."""
        run = subprocess.run([str(support.PROGRAM), definition], text=True, capture_output=True, timeout=120,
                             input=''.join(json.dumps(v) + '\n' for v in values))
        self.assertEqual((run.returncode, run.stderr), (0, ''))
        lines = run.stdout.splitlines()
        self.assertEqual(len(lines), len(values))
        return lines

    def test_the_schema_is_sound_and_closed(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)
        for name, definition in self.schema['$defs'].items():
            if definition.get('type') == 'object':
                self.assertIs(definition.get('additionalProperties'), False, name)
            if definition.get('type') == 'array':
                self.assertIn('maxItems', definition, name)
            if definition.get('type') == 'string':
                self.assertIn('maxLength', definition, name)

    def test_every_message_has_an_example_that_both_take(self):
        for definition in ('ClientMessage', 'ServerMessage'):
            variants = {self.schema['$defs'][v['$ref'].split('/')[-1]]['properties']['type']['const']
                        for v in self.schema['$defs'][definition]['oneOf']}
            chosen = [(n, v) for n, v in self.examples if v['type'] in variants]
            self.assertEqual({v['type'] for _, v in chosen}, variants)
            for name, value in chosen:
                self.assertEqual(list(self.validator(definition).iter_errors(value)), [], name)
            self.assertEqual(self.ours(definition, [v for _, v in chosen]), ['ok'] * len(chosen))

    def test_damaged_messages_are_judged_alike(self):
        draw = random.Random(11)
        for definition in ('ClientMessage', 'ServerMessage'):
            validator = self.validator(definition)
            values = [damaged(draw.choice(self.examples)[1], draw) for _ in range(1500)]
            refused = 0
            for value, verdict in zip(values, self.ours(definition, values)):
                sound = validator.is_valid(value)
                self.assertEqual(verdict == 'ok', sound, f'{verdict}: {json.dumps(value)[:1500]}')
                refused += not sound
            self.assertTrue(100 < refused < 1500, refused)


if __name__ == '__main__':
    support.main()
