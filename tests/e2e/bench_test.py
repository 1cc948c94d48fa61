#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""`eigengrasp bench` and scripts/compare_benchmarks, the latter with programs that pretend to measure."""
import json
import subprocess
import sys
import support
from support import EndToEnd, test_data

SHORT = ('bench', '--seconds', '0.02', '--iterations', '3000')


class Bench(EndToEnd):
    def assert_measured(self, report, threads):
        self.assertEqual(report['format'], 'eigengrasp-bench')
        self.assertTrue(report['machine']['processor'])
        self.assertGreater(report['wrench_space_microseconds']['epsilon_8_contacts'], 0)
        scene, = report['scenes']
        self.assertTrue(0 < scene['legal_share'] < 1)
        self.assertTrue(0 < scene['candidates'] <= 20)
        self.assertGreater(scene['peak_memory_bytes'], 1e6)
        steps = scene['microseconds']
        self.assertEqual(sorted(steps), ['close', 'closure', 'contacts', 'epsilon'])
        self.assertTrue(all(t > 0 for t in steps.values()), steps)
        self.assertEqual([by['threads'] for by in scene['threads']], threads)
        for by in scene['threads']:
            self.assertTrue(all(value > 0 for value in by.values()), by)
        # One thread: the rate is the inverse of the steps.
        whole = 1e-6 * (steps['close'] + steps['contacts'] + steps['epsilon'])
        self.assert_near(scene['threads'][0]['candidates_per_second'] * whole, 1.0, 0.3)
        return scene

    def test_a_shipped_hand(self):
        run = self.succeed(*SHORT, '--hand', 'barrett-rubber', '--threads', '2', '--json', 'bench.json',
                           '--markdown', 'page.md', timeout=300)
        self.assertEqual(run.stderr, '')
        self.assertIn('barrett-rubber on glass', run.stdout)
        self.assertIn('2 threads: ', run.stdout)
        report = json.loads((self.folder / 'bench.json').read_text())
        self.assert_measured(report, [1, 2])
        page = (self.folder / 'page.md').read_text()
        self.assertIn(report['command'].split(' --json')[0], page)
        self.assertIn('| barrett-rubber on glass: one state, legality and energy | 0.15 ms | 400 x |', page)

    def test_graspit_models_and_json_on_stdout(self):
        models = test_data('graspit', 'models')
        run = self.succeed(*SHORT, '--graspit', models, '--hand', 'barrett', '--object', 'ashtray', '--threads', '1',
                           '--json', '-', timeout=300)
        scene = self.assert_measured(json.loads(run.stdout), [1])
        self.assertEqual(scene['object'], 'ashtray')
        self.assertIn('on ashtray', run.stderr)
        self.assertNotIn(str(models), run.stdout)

    def test_bad_input(self):
        self.refuse(['bench', '--hand', 'shadow'], 'shadow')
        self.refuse(['bench', '--object', 'teapot'], 'teapot')
        self.refuse(['bench', '--seconds', '0'], '--seconds')
        self.refuse(['bench', '--seconds', 'nan'], '--seconds')
        self.refuse(['bench', '--threads', '-2'], '--threads')
        self.refuse(['bench', '--iterations', '0'], '--iterations')
        self.refuse(['bench', '--search', 'random'], 'random')
        self.refuse(['bench', '--graspit', 'gone'], 'gone')
        self.refuse(['bench', '--graspit', '.'], 'Barrett.xml')
        self.file('regular', 'a file\n')
        self.refuse(['bench', '--json', 'regular/bench.json'], 'regular')
        self.refuse(['bench', '--markdown', '/proc/x/page.md'], '/proc/x')


PRETENDER = '''#!{python} -SE
import json, pathlib, re, sys
times = {times}
filter = [a.split('=', 1)[1] for a in sys.argv if a.startswith('--benchmark_filter=')][0]
names = [name for name in times if re.search(filter, name)]
if '--benchmark_list_tests=true' in sys.argv:
    print(*names, sep='\\n')
    sys.exit()
count = pathlib.Path(__file__).with_suffix('.count')
n = int(count.read_text()) if count.exists() else 0
count.write_text(str(n + 1))
rows = [dict(name=name, run_type='iteration', time_unit='us', real_time=1.0, cpu_time=times[name][n % len(times[name])])
        for name in names]
print(json.dumps(dict(benchmarks=rows)))
'''


class CompareBenchmarks(EndToEnd):
    def build(self, name, times):
        """A build whose program says these times of its runs [us] one after the other."""
        program = self.file(f'{name}/bench/some_bench', PRETENDER.format(python=sys.executable, times=times))
        program.chmod(0o755)
        return name

    def compare(self, *args, code):
        run = subprocess.run([str(support.SOURCE / 'scripts/compare_benchmarks'), '--repetitions', '3', *args], cwd=self.folder, text=True,
                             capture_output=True, timeout=60, check=False)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run

    def test_a_slower_benchmark_fails(self):
        run = self.compare(self.build('base', {'a/8': [100.0], 'b': [10.0], 'c': [10.0]}),
                           self.build('head', {'a/8': [112.0], 'b': [10.1], 'c': [5.0]}), code=1)
        lines = {line.split()[1]: line for line in run.stdout.splitlines() if line.startswith('some_bench')}
        self.assertIn('+12.0 %', lines['a/8'])
        self.assertTrue(lines['a/8'].endswith('SLOWER'))
        self.assertTrue(lines['b'].endswith('%'), 'within the noise')
        self.assertTrue(lines['c'].endswith('faster'))
        self.assertIn('1 became slower', run.stdout)

    def test_less_than_the_threshold_passes(self):
        builds = self.build('base', {'a': [100.0]}), self.build('head', {'a': [108.0]})
        self.assertIn('a little slower', self.compare(*builds, code=0).stdout)
        self.compare(*builds, '--threshold', '5', code=1)

    def test_what_is_not_confirmed_passes(self):
        head = self.build('head', {'a': [200.0] * 3 + [100.0] * 6})
        self.assertIn('once more', self.compare(self.build('base', {'a': [100.0]}), head, code=0).stderr)

    def test_one_disturbed_repetition_does_not_count(self):
        self.compare(self.build('base', {'a': [100.0]}), self.build('head', {'a': [900.0, 100.0, 100.0]}),
                     code=0)

    def test_stored_baselines(self):
        self.compare('--save', 'stored.json', self.build('base', {'a': [100.0]}), code=0)
        stored = json.loads((self.folder / 'stored.json').read_text())
        self.assertEqual([(r['program'], r['name'], r['ns']) for r in stored['benchmarks']], [('some_bench', 'a', 1e5)])
        head = self.build('head', {'a': [150.0]})
        self.compare('stored.json', head, code=1)
        stored['machine'] = 'another machine'
        self.file('stored.json', json.dumps(stored))
        self.assertIn('another machine', self.compare('stored.json', head, code=0).stdout)

    def test_bad_input(self):
        base = self.build('base', {'a': [100.0]})
        for args in ((base, 'gone'), (base,), (base, base, base), ('--save', 'x.json', base, base),
                     (base, base, '--repetitions', '0'), (self.file('no.json', '[]').name, base)):
            with self.subTest(args):
                run = self.compare(*args, code=2)
                self.assertEqual((run.stdout, run.stderr.count('\n')), ('', 1), run.stderr)


if __name__ == '__main__':
    support.main()
