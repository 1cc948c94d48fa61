# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp db build, status, stats, verify and import of a grasps.json: what is stored does not depend on jobs,
interruptions or kills."""
import json
import random
import re
import signal
import shutil
import sqlite3
import subprocess
import time
import support
from store_support import StoreTest
from support import box_obj, wait_until_catching_interrupts

SMALL = ['--hands', 'barrett-rubber,human', '--scales', '0.75,1', '--grasps', '3', '--states', '20000']


class Build(StoreTest):
    def start(self, address, *args, work=SMALL):
        return super().start(address, *work, *args)

    def test_builds_verifies_and_has_nothing_left_to_do(self):
        self.store()
        first = self.succeed('db', 'build', 'sqlite:g.db', *SMALL)
        self.assertIn('12 of 12 units have ended', first.stdout)
        again = self.succeed('db', 'build', 'sqlite:g.db', *SMALL)
        self.assertIn('0 units in', again.stdout)
        self.assertIn(' 0 of them do not reproduce', self.succeed('db', 'verify', 'sqlite:g.db').stdout)
        stats = self.succeed('db', 'stats', 'sqlite:g.db').stdout
        self.assertRegex(stats, r'human +6 +0 +18 ')
        status = self.succeed('db', 'status', 'sqlite:g.db').stdout
        self.assertIn('12 of 12 units have ended (100.0 %), 0 of them failed; 0 are claimed, 0 wait', status)
        show = self.succeed('db', 'show', 'sqlite:g.db', 'box0', '--hand', 'human', '--scale', '0.75').stdout
        self.assertEqual(show.count(' yes '), 3, show)

    def test_status_measures_the_rate_when_asked(self):
        self.store()
        idle = self.succeed('db', 'status', 'sqlite:g.db', '--over', '50ms').stdout
        self.assertIn('rate        0.00 units/s, measured over', idle)
        status = subprocess.Popen([str(support.PROGRAM), 'db', 'status', 'sqlite:g.db', '--over', '10s'],
                                  cwd=self.folder, stdout=subprocess.PIPE, text=True)
        self.succeed('db', 'build', 'sqlite:g.db', *SMALL)
        rate = re.search(r'rate +([\d.]+) units/s, measured over 10 s', status.communicate(timeout=60)[0])
        self.assertIsNotNone(rate)
        self.assertLessEqual(float(rate[1]), 1.2)  # 12 units
        self.refuse(['db', 'status', 'sqlite:g.db', '--over', 'soon'], '--over', 'soon')

    def test_jobs_do_not_change_the_result(self):
        self.store()
        shutil.copy(self.folder / 'g.db', self.folder / 'h.db')
        self.succeed('db', 'build', 'sqlite:g.db', *SMALL, '--jobs', '1')
        self.succeed('db', 'build', 'sqlite:h.db', *SMALL, '--jobs', '3')
        self.assertEqual(self.content('sqlite:g.db'), self.content('sqlite:h.db'))

    def test_killed_and_stopped_builds_lose_nothing(self):
        self.store()
        shutil.copy(self.folder / 'g.db', self.folder / 'whole.db')
        self.succeed('db', 'build', 'sqlite:whole.db', *SMALL)
        seed = random.randrange(10 ** 6)
        draw = random.Random(seed)
        ended = 0
        for i in range(8):
            build = self.start('sqlite:g.db')
            self.assertTrue(wait_until_catching_interrupts(build))
            time.sleep(draw.uniform(0.0, 1.5))
            build.send_signal(signal.SIGKILL if i % 2 == 0 else signal.SIGINT)
            out, err = build.communicate(timeout=60)
            self.assertIn(build.returncode, (-signal.SIGKILL, 0, 1), f'seed {seed}: {out} {err}')
            with sqlite3.connect(self.folder / 'g.db') as db:
                now = db.execute("SELECT count(*) FROM work_unit WHERE work_unit_state IN ('done', 'failed')").fetchone()[0]
            db.close()
            self.assertGreaterEqual(now, ended, f'seed {seed}')
            ended = now
        last = self.succeed('db', 'build', 'sqlite:g.db', *SMALL)
        self.assertIn('12 of 12 units have ended', last.stdout)
        self.assertEqual(self.content('sqlite:g.db'), self.content('sqlite:whole.db'), f'seed {seed}')
        self.assertIn(' 0 of them do not reproduce', self.succeed('db', 'verify', 'sqlite:g.db').stdout)

    def test_two_builds_share_a_store(self):
        self.store()
        both = [self.start('sqlite:g.db', '--jobs', '1') for _ in range(2)]
        for build in both:
            self.assertEqual(build.wait(timeout=120), 0, build.stderr.read())
            build.stdout.close()
            build.stderr.close()
        with sqlite3.connect(self.folder / 'g.db') as db:
            rows = db.execute('SELECT count(*), sum(work_unit_state = \'done\') FROM work_unit').fetchone()
            most = db.execute('SELECT max(n) FROM (SELECT count(*) n FROM grasp GROUP BY scaled_model_id, hand_id)').fetchone()
        db.close()
        self.assertEqual(rows, (12, 12))
        self.assertEqual(most, (3,))

    def test_what_cannot_be_planned_fails_with_its_reason(self):
        self.store(boxes=((40, 80, 60), (30, 30, 120)))
        self.file('meshes/box0.obj', box_obj((41, 80, 60)))  # another object than was added
        (self.folder / 'meshes/box1.obj').unlink()
        run = self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1')
        self.assertIn('2 units in', run.stdout)
        self.assertIn('2 of them failed', run.stdout)
        status = self.succeed('db', 'status', 'sqlite:g.db').stdout
        self.assertRegex(status, 'failed +box0 at scale 1 with human: .*box0.obj: has changed')
        self.assertRegex(status, 'failed +box1 at scale 1 with human: .*box1.obj')
        self.assertIn('0 units in', self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1').stdout)
        self.file('meshes/box0.obj', box_obj((40, 80, 60)))
        retried = self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1', '--retry-failed')
        self.assertIn('2 units in', retried.stdout)
        self.assertIn('1 of them failed', retried.stdout)

    def test_an_object_that_no_hand_can_hold(self):
        self.file('meshes/wall.obj', box_obj((3000, 3000, 2000)))
        self.succeed('db', 'add-objects', 'sqlite:g.db', 'meshes', '--units', 'mm', '--keep-size')
        run = self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1', '--states', '20000')
        self.assertIn('1 of them failed', run.stdout)
        self.assertRegex(self.succeed('db', 'stats', 'sqlite:g.db').stdout, r'failed +1 units: no (legal|form-closed)')

    def test_verify_names_what_does_not_reproduce(self):
        self.store('text:g', boxes=((40, 80, 60),))
        self.succeed('db', 'build', 'text:g', '--hands', 'human', '--scales', '1', '--grasps', '2')
        file = self.folder / 'g/grasps/box0/human@1.jsonl'
        lines = file.read_text().splitlines()
        grasp = json.loads(lines[1])
        grasp['epsilon'] *= 0.5
        file.write_text('\n'.join([lines[0], json.dumps(grasp), *lines[2:]]) + '\n')
        run = self.succeed('db', 'verify', 'text:g', code=1)
        self.assertIn('2 grasps simulated again, 1 of them do not reproduce', run.stdout)
        self.assertRegex(run.stdout, r'of box0 at scale 1 with human: has epsilon .*, stored is ')

    def test_import_of_planned_grasps(self):
        self.succeed('plan', 'glass', '--hand', 'human', '--search', 'enhanced', '--grasps', '4', '--no-pictures', '--out', 'o')
        run = self.succeed('db', 'import', 'sqlite:g.db', 'o/grasps.json')
        self.assertIn('4 grasps of glass at scale 1 with human are new', run.stdout)
        self.assertIn('4 grasps simulated again, 0 of them', self.succeed('db', 'verify', 'sqlite:g.db').stdout)

    def test_table3(self):
        self.store(boxes=((40, 80, 60),))
        self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1', '--grasps', '2')
        self.succeed('reproduce', 'table3', 'sqlite:g.db', '--out', 'r')
        self.assertIn('| human | 1 of 1 | **2** (2.0 a unit) | 80731', (self.folder / 'r/grasp-database.md').read_text())
        self.assertEqual(json.loads((self.folder / 'r/grasp-database.json').read_text())['hands'][0]['form_closed'], 2)
        for kind in ('good', 'odd'):
            self.assertTrue((self.folder / f'r/grasp-database/{kind}-human.png').exists())

    def test_bad_input(self):
        self.store(boxes=((40, 80, 60),))
        build = ['db', 'build', 'sqlite:g.db']
        self.refuse([*build, '--hands', 'claw'], 'claw')
        self.refuse([*build, '--scales', '1,0.5'], '0.5')
        self.refuse([*build, '--scales', '-1'], '-1')
        self.refuse([*build, '--grasps', '0'], 'grasps is 0')
        self.refuse([*build, '--states', '0'], 'states is 0')
        self.refuse([*build, '--time-limit', 'soon'], '--time-limit', 'soon')
        self.refuse([*build, '--time-limit', '0s'], '0s')
        self.refuse([*build, '--jobs', '-1'], 'jobs is -1')
        self.refuse(['db', 'build', 'g.db'], 'sqlite:FILE')
        self.refuse(['db', 'status', 'sqlite:none.db'], 'none.db', 'no such file')
        self.refuse(['db', 'stats', 'sqlite:none.db'], 'none.db', 'no such file')
        self.refuse(['db', 'verify', 'sqlite:none.db'], 'none.db', 'no such file')
        self.refuse(['db', 'verify', 'sqlite:g.db', '--hands', 'claw'], 'claw')
        self.refuse(['reproduce', 'table3', 'sqlite:g.db', '--out', 'r'], 'holds no grasps')
        self.refuse(['db', 'import', 'sqlite:g.db', 'meshes/none.json'], 'none.json')

    def test_a_text_store_in_use_and_units_of_another_hand_are_refused(self):
        self.store('text:g')
        self.succeed('db', 'export', 'text:g', 'sqlite:g.db')
        build = self.start('text:g', work=['--hands', 'human', '--grasps', '300'])
        self.assertTrue(wait_until_catching_interrupts(build))
        run = self.succeed('db', 'build', 'text:g', *SMALL, code=2)
        self.assertIn('in use', run.stderr)
        build.send_signal(signal.SIGINT)
        build.communicate(timeout=60)
        self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'human', '--scales', '1', '--grasps', '1')
        with sqlite3.connect(self.folder / 'g.db') as db:
            db.execute("UPDATE work_unit SET work_unit_state = 'waiting'")
        db.close()
        run = self.succeed('db', 'build', 'sqlite:g.db', '--hands', 'barrett-rubber', code=2)
        self.assertIn("units wait for the hand 'human'", run.stderr)


if __name__ == '__main__':
    support.main()
