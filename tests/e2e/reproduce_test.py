#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp reproduce table2`: its page, JSON and pictures, interruption and bad input."""
import json
import signal
import struct
import subprocess
import support
from support import EndToEnd, wait_until_catching_interrupts

QUICK = ('reproduce', 'table2', '--quick', '--object', 'glass')


class Table2(EndToEnd):
    def test_quick(self):
        run = self.succeed(*QUICK, '--out', 'trial', timeout=300)
        self.assertEqual(run.stderr, '')
        self.assertIn('trial/table2.md', run.stdout)
        self.assertEqual([name for name in self.contents() if '.' in name],
                         ['trial/table2.json', 'trial/table2.md', 'trial/table2/figure2.png',
                          'trial/table2/grasps-human.png'])
        table = json.loads((self.folder / 'trial/table2.json').read_text())
        self.assertEqual((table['format'], table['models']), ('eigengrasp-table2', 'shipped'))
        self.assertEqual(table['command'],
                         'eigengrasp reproduce table2 --hand human --object glass --seeds 1 --iterations 3000')
        self.assertTrue(table['machine']['processor'])
        self.assertEqual([(p['search'], p['friction']) for p in table['parts']],
                         [(s, f) for s in ('paper', 'staged') for f in ('materials', 'one')])
        page = (self.folder / 'trial/table2.md').read_text()
        self.assertIn(table['command'], page)
        for part in table['parts']:
            cell, = part['cells']
            self.assertEqual((cell['hand'], cell['object'], cell['paper'], cell['graspit']),
                             ('human', 'glass', 11.2, 7.3))
            only, = cell['runs']
            self.assertEqual(only['tested'], only['form_closed'] + only['not_closed'] + only['no_contact'] +
                             only['penetrating'])
            self.assertTrue(0 < only['tested'] <= 20)
            self.assertEqual(cell['form_closed_mean'], only['form_closed'])
            self.assertEqual(only['best_epsilon'] > 0, only['form_closed'] > 0)
            self.assertIn(f"**{only['form_closed']:.1f}", page)
        self.assertEqual(table['targets'], [])  # a trial is not judged
        self.assert_same_as_plan(table['parts'][0]['cells'][0]['runs'][0])
        for picture in (self.folder / 'trial/table2').iterdir():
            data = picture.read_bytes()
            self.assertEqual(data[:8], b'\x89PNG\r\n\x1a\n')
            self.assertTrue(all(side >= 230 for side in struct.unpack('>II', data[16:24])))
            self.assertLess(len(data), 400_000)

    def assert_same_as_plan(self, counted):
        """The cell of the paper's search is what `plan` finds."""
        self.run_program('plan', 'glass', '--hand', 'human', '--search', 'paper', '--iterations', '3000',
                         '--no-pictures', '--out', 'plan')
        candidates = json.loads((self.folder / 'plan/grasps.json').read_text())['statistics']['candidates']
        self.assertEqual(candidates, {k: counted[k] for k in candidates})

    def test_interrupt_writes_nothing(self):
        process = subprocess.Popen([str(support.PROGRAM), 'reproduce', 'table2', '--hand', 'human', '--out', 'stopped'],
                                   cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertTrue(wait_until_catching_interrupts(process))
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=120)
        self.assertEqual((process.returncode, stdout), (1, ''), stderr)
        self.assertIn('nothing was written', stderr)
        self.assertEqual(self.contents(), ['stopped'])

    def test_bad_input(self):
        self.refuse(['reproduce'], 'subcommand')
        self.refuse(['reproduce', 'table9'], 'table9')
        self.refuse([*QUICK, '--seeds', '0'], 'seeds', '0')
        self.refuse([*QUICK, '--seeds', 'some'], '--seeds')
        self.refuse([*QUICK, '--iterations', '0'], 'iterations')
        self.refuse([*QUICK, '--threads', '-1'], 'threads')
        self.refuse([*QUICK, '--hand', 'shadow'], 'shadow')
        self.refuse(['reproduce', 'table2', '--quick', '--object', 'teapot'], 'teapot')
        self.refuse([*QUICK, '--graspit', 'gone'], 'gone')
        (self.folder / 'empty' / 'models').mkdir(parents=True)
        self.refuse([*QUICK, '--graspit', 'empty'], 'empty/models', 'Barrett.xml')

    def test_folders_that_cannot_be_written(self):
        self.file('regular', 'a file\n')
        self.refuse([*QUICK, '--out', 'regular/out'], 'regular/out')
        self.refuse([*QUICK, '--out', '/proc/x'], '/proc/x')


if __name__ == '__main__':
    support.main()
