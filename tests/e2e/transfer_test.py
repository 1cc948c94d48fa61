# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp db describe, transfer and reproduce figure12 on a small store of boxes."""
import json
import shutil
import signal
import sqlite3
import subprocess
import support
from support import EndToEnd, box_obj, wait_until_catching_interrupts

BOXES = {'cube': (60, 60, 60), 'brick': (40, 80, 60), 'bar': (30, 30, 120), 'plate': (20, 90, 90)}
HANDS = 'barrett-rubber,human'


class Transfer(EndToEnd):
    _store = None  # made once

    @classmethod
    def setUpClass(cls):
        cls._temporary = support.tempfile.TemporaryDirectory(prefix='eigengrasp-e2e-store-')
        folder = support.Path(cls._temporary.name)
        (folder / 'meshes').mkdir()
        for name, size in BOXES.items():
            (folder / 'meshes' / f'{name}.obj').write_text(box_obj(size))
        for args in (['db', 'add-objects', 'sqlite:g.db', 'meshes', '--units', 'mm'],
                     ['db', 'build', 'sqlite:g.db', '--hands', HANDS, '--scales', '0.75,1', '--grasps', '4',
                      '--states', '20000']):
            run = support.run_in(folder, *args, timeout=400)
            if run.returncode != 0:
                raise AssertionError(f'{args}: {run.stderr}')
        cls._store = folder / 'g.db'

    @classmethod
    def tearDownClass(cls):
        cls._temporary.cleanup()

    def store(self, described=True):
        shutil.copy(self._store, self.folder / 'g.db')
        if described:
            self.succeed('db', 'describe', 'sqlite:g.db', '--neighbors', '2')

    def transfer(self, *args, code=0):
        return self.succeed('transfer', *args, '--store', 'sqlite:g.db', '--out', 'out', code=code)

    def grasps(self):
        return json.loads((self.folder / 'out/grasps.json').read_text())

    def test_describes_a_store_of_every_kind_once(self):
        self.store(described=False)
        first = self.succeed('db', 'describe', 'sqlite:g.db', '--neighbors', '2').stdout
        self.assertIn('4 objects described, 0 were; views of 4 objects, 8 neighbours and 16 alignments are new', first)
        again = self.succeed('db', 'describe', 'sqlite:g.db', '--neighbors', '2').stdout
        self.assertIn('0 objects described, 4 were; views of 0 objects, 0 neighbours and 0 alignments are new', again)
        info = self.succeed('db', 'info', 'sqlite:g.db').stdout
        self.assertRegex(info, r'descriptors 8\nneighbours  8\nalignments  16\n')
        self.succeed('db', 'export', 'sqlite:g.db', 'text:t')
        self.succeed('db', 'describe', 'text:t', '--neighbors', '3', '--jobs', '1')
        self.assertIn('neighbours  12', self.succeed('db', 'info', 'text:t').stdout)
        out = self.transfer('brick', '--hand', 'human', '--leave-out').stdout
        self.transfer('brick', '--hand', 'human', '--leave-out')
        text = self.succeed('transfer', 'brick', '--hand', 'human', '--leave-out', '--store', 'text:t', '--out', 'out').stdout
        self.assertEqual(text.splitlines()[:4], out.splitlines()[:4])

    def test_a_mesh_that_is_gone_is_named_and_left_out(self):
        self.store(described=False)
        with sqlite3.connect(self.folder / 'g.db') as db:
            db.execute("UPDATE original_model SET original_model_geometry_path = '/nowhere/bar.obj' "
                       "WHERE original_model_name = 'bar'")
        db.close()
        run = self.succeed('db', 'describe', 'sqlite:g.db')
        self.assertIn('/nowhere/bar.obj', run.stderr)
        self.assertIn('left out', run.stderr)
        self.assertIn('3 objects described', run.stdout)

    def test_describe_goes_on_after_a_stop(self):
        self.store(described=False)
        process = subprocess.Popen([str(support.PROGRAM), 'db', 'describe', 'sqlite:g.db'], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if wait_until_catching_interrupts(process):
            process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertIn(process.returncode, (0, 1, -signal.SIGINT))
        self.succeed('db', 'describe', 'sqlite:g.db')
        self.assertIn('descriptors 8\nneighbours  12\nalignments  24',
                      self.succeed('db', 'info', 'sqlite:g.db').stdout)

    def test_grasps_a_new_object_and_writes_what_plan_writes(self):
        self.store()
        self.file('new.obj', box_obj((42, 84, 60), center=(100, 50, -20)))
        run = self.transfer('new.obj', '--units', 'mm', '--hand', 'human', '--neighbors', '2')
        self.assertRegex(run.stdout, r'1\. brick +distance')
        for name in ('grasps.json', 'grasps.csv', 'grasps.png', 'grasps.glb', 'transfer.json', 'pairs.png'):
            self.assertTrue((self.folder / 'out' / name).is_file(), name)
        file = self.grasps()
        self.assertEqual(file['status'], 'found')
        self.assertEqual(file['options']['search'], 'transfer')
        self.assertTrue(all(g['form_closure'] for g in file['grasps']))
        epsilons = [g['epsilon'] for g in file['grasps']]
        self.assertEqual(epsilons, sorted(epsilons, reverse=True))
        transfer = json.loads((self.folder / 'out/transfer.json').read_text())
        self.assertEqual(transfer['neighbors'][0]['object'], 'brick')
        self.assertEqual(len(transfer['grasps']), len(file['grasps']))
        # Into a store, and simulated again.
        self.succeed('db', 'import', 'sqlite:check.db', 'out/grasps.json')
        self.assertIn(' 0 of them do not reproduce', self.succeed('db', 'verify', 'sqlite:check.db').stdout)

    def test_threads_do_not_change_the_result(self):
        self.store()
        files = []
        for threads in ('1', '3'):
            self.transfer('cube', '--hand', 'barrett-rubber', '--leave-out', '--candidates', '0', '--threads', threads,
                          '--no-pictures')
            file = self.grasps()
            file.pop('run')
            files.append(file)
        self.assertEqual(files[0], files[1])

    def test_options(self):
        self.store()
        both = self.transfer('cube', '--hand', 'human', '--no-pictures').stdout
        self.assertRegex(both, r'1\. cube')
        out = self.transfer('cube', '--hand', 'human', '--leave-out', '--no-pictures').stdout
        self.assertNotIn('. cube', out)
        self.transfer('cube', '--hand', 'human', '--leave-out', '--alignment', 'pca-icp', '--no-pictures')
        self.transfer('cube', '--hand', 'human', '--leave-out', '--distance', 'random', '--seed', '3', '--no-pictures')
        self.transfer('cube', '--hand', 'barrett-rubber', '--from-hand', 'human', '--no-pictures')
        strict = self.transfer('cube', '--hand', 'human', '--min-epsilon', '0.9', '--no-pictures', code=1).stdout
        self.assertIn('no grasp whose epsilon is above 0.9', strict)
        table = self.transfer('cube', '--hand', 'human', '--table', 'auto', '--no-pictures').stdout
        self.assertIn('form-closed', table)

    def test_an_object_50_times_larger_gets_a_clear_answer(self):
        self.store()
        self.file('huge.obj', box_obj((3.0, 4.0, 3.5)))
        run = self.transfer('huge.obj', '--hand', 'human', '--no-pictures', code=1)
        self.assertIn('are the units right?', run.stdout)

    def test_bad_input(self):
        self.store(described=False)
        to = ['--store', 'sqlite:g.db', '--hand', 'human']
        self.refuse(['transfer', 'cube', *to], 'no shape descriptors', 'eigengrasp db describe')
        self.refuse(['transfer', 'cube', '--store', 'sqlite:none.db', '--hand', 'human'], 'none.db', 'no such file')
        self.refuse(['db', 'describe', 'sqlite:none.db'], 'none.db', 'no such file')
        self.refuse(['db', 'describe', 'sqlite:g.db', '--neighbors', '-1'], 'neighbors is -1')
        self.succeed('db', 'describe', 'sqlite:g.db', '--no-align')
        self.refuse(['transfer', 'cube', '--store', 'sqlite:g.db', '--hand', 'dlr'], "no grasps with the hand 'dlr'",
                    'barrett-rubber, human')
        self.refuse(['transfer', 'nothing', *to], 'nothing')
        self.refuse(['transfer', 'cube', *to, '--distance', 'like'], "'like'", 'zernike, views, class or random')
        self.refuse(['transfer', 'cube', *to, '--distance', 'class'], 'has no class', 'tags')
        self.refuse(['transfer', 'cube', *to, '--neighbors', '0'], 'neighbors is 0')
        self.refuse(['transfer', 'cube', *to, '--alignment', 'icp'], "'icp'", 'pca-icp')
        self.refuse(['transfer', 'cube', *to, '--min-epsilon', '-1'], 'min epsilon')
        self.file('flat.obj', 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n')
        self.refuse(['transfer', 'flat.obj', *to], 'flat.obj')
        (self.folder / 'r').mkdir()
        self.file('none/one.obj', box_obj((1, 1, 1)))
        self.succeed('db', 'add-objects', 'sqlite:bare.db', 'none')
        self.refuse(['transfer', 'one', '--store', 'sqlite:bare.db', '--hand', 'human'], 'holds no grasps', 'db build')
        self.refuse(['reproduce', 'figure12', '--store', 'sqlite:bare.db', '--out', 'r'], 'db build')

    def test_partial_scans(self):
        self.store()
        for name, text in support.registered_balls(0.035).items():
            self.file(f'scans/ball/{name}', text)
        self.succeed('scan', 'scans/ball/ball.conf', '-o', 'scans/ball/whole.obj')
        self.file('scans/half/view.obj', support.registered_balls(0.035)['front.obj'] + 'f 1 2 3\n')  # with a face
        self.file('complete/brick.obj', box_obj((0.04, 0.08, 0.06)))
        self.succeed('reproduce', 'partial', '--store', 'sqlite:g.db', '--complete', 'complete', '--views', '1',
                     '--scans', 'scans', '--hands', 'barrett-rubber', '--neighbors', '2', '--out', 'results')
        trials = json.loads((self.folder / 'results/partial.json').read_text())['trials']
        half = trials.pop()
        self.assertEqual((half['object'], half['view'], half.get('complete')), ('half', 'view', None))
        self.assertEqual(half['grasps'][1]['found'], 20)
        self.assertEqual([(t['object'], t['view']) for t in trials],
                         [('brick', '1'), ('ball', 'front'), ('ball', 'back'), ('ball', 'all')])
        self.assertEqual([t['complete'] for t in trials], ['brick', 'whole', 'whole', 'whole'])
        self.assertGreater(trials[3]['agreement'], 0.95)
        for trial in trials:
            self.assertGreater(trial['agreement'], 0.6, trial)
            self.assertEqual([g['by'] for g in trial['grasps']], ['transfer', 'planner'])
            self.assertEqual(trial['grasps'][1]['found'], 20)
        for found in [g for t in trials for g in t['grasps']]:
            self.assertGreaterEqual(found['closed'], 0.5 * found['tried'])
        page = (self.folder / 'results/partial.md').read_text()
        self.assertIn('| ball | all | ', page)
        self.assertTrue((self.folder / 'results/partial/ball-all-barrett-rubber.png').is_file())

    def test_figure12(self):
        self.store()
        args = ['reproduce', 'figure12', '--store', 'sqlite:g.db', '--neighbors', '2', '--out', 'results']
        self.succeed(*args)
        for name in ('figure12.md', 'figure12.json', 'figure12/human.svg', 'figure12/human.png',
                     'figure12/barrett-rubber.svg', 'figure12/barrett-rubber.png'):
            self.assertTrue((self.folder / 'results' / name).is_file(), name)
        self.assertFalse((self.folder / 'results/figure12-progress.jsonl').exists())
        first = json.loads((self.folder / 'results/figure12.json').read_text())
        self.assertEqual(first['models'], 4)
        for hand in first['hands']:
            self.assertEqual([c['method'] for c in hand['curves']], ['class', 'zernike', 'random', 'planner'])
            for curve in hand['curves']:
                self.assertEqual(curve['epsilon'], sorted(curve['epsilon'], reverse=True))
                self.assertGreater(curve['epsilon'][0], 0.0)
        self.succeed(*args, '--threads', '1')
        second = json.loads((self.folder / 'results/figure12.json').read_text())
        curves = [[c['epsilon'] for h in f['hands'] for c in h['curves']] for f in (first, second)]
        self.assertEqual(*curves)
        thin = self.succeed(*args, '--every', '2', '--models', '1')
        self.assertIn('1 models', thin.stdout)


if __name__ == '__main__':
    support.main()
