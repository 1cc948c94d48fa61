# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp db build --slurm on a real cluster of one machine (scripts/local-slurm), parts of which fail in the middle."""
import os
import shutil
import subprocess
import support
from store_support import StoreTest, free_ports, postgres_programs, query

WORK = ['--hands', 'barrett-rubber', '--grasps', '20', '--states', '20000', '--time-limit', '20s']
SCALES = ['--scales', '0.75,1,1.25']
BOXES = ((40, 80, 60), (30, 30, 120), (25, 70, 70), (35, 50, 90), (45, 45, 45), (20, 60, 110), (50, 60, 70), (30, 40, 50))


class Slurm(StoreTest):
    def setUp(self):
        super().setUp()
        if os.geteuid() != 0:
            self.skipTest('a cluster of one machine needs root, whose jobs Slurm runs without asking')
        for program in ('sbatch', 'slurmctld', 'slurmd', 'munged'):
            if shutil.which(program, path=os.environ.get('PATH', '') + ':/usr/sbin') is None:
                self.skipTest(f'Slurm is not installed (apt-get install slurm-wlm munge): {program} was not found')
        postgres_programs()
        self.folder.chmod(0o711)  # PostgreSQL runs as another user
        self.cluster = self.folder / 'cluster'

    def local_slurm(self, command, *args):
        """Its daemons keep what it is given as output, so that is a file."""
        with open(self.folder / 'local-slurm.log', 'a') as log:
            run = subprocess.run([support.SOURCE / 'scripts/local-slurm', command, self.cluster, *map(str, args)],
                                 stdin=subprocess.DEVNULL, stdout=log, stderr=log, timeout=120)
        self.assertEqual(run.returncode, 0, f'local-slurm {command}\n' + (self.folder / 'local-slurm.log').read_text()[-2000:])

    def down(self):
        if (self.cluster / 'settings').exists():
            self.local_slurm('down')
        left = [p for p in os.listdir('/proc') if p.isdigit() and self.belongs_to_cluster(p)]
        self.assertEqual(left, [], 'processes of the cluster are left')

    def belongs_to_cluster(self, process):
        try:
            with open(f'/proc/{process}/cmdline', 'rb') as line, open(f'/proc/{process}/environ', 'rb') as environment:
                name = bytes(self.cluster)
                return name in line.read() or b'SLURM_CONF=' + name in environment.read()
        except OSError:
            return False

    def units(self, condition):
        return int(query(self.address, f'SELECT count(*) FROM work_unit WHERE {condition}') or 0)

    def test_a_build_on_two_nodes_parts_of_which_fail(self):
        self.addCleanup(self.down)
        port = free_ports(4)
        self.local_slurm('up', '--nodes', 2, '--port', port)
        self.address = f'postgresql://grasp@127.0.0.1:{port + 3}/grasps'
        self.store(self.address, BOXES)
        self.succeed('db', 'export', self.address, 'sqlite:whole.db')
        environment = {**os.environ, 'SLURM_CONF': str(self.cluster / 'slurm.conf')}
        run = subprocess.run([str(support.PROGRAM), 'db', 'build', self.address, *WORK, *SCALES, '--lease', '15s', '--slurm'],
                             cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                             timeout=60)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn('Submitted batch job', run.stdout)
        held = "work_unit_state = 'claimed' AND work_unit_worker LIKE 'n{}:%'"
        self.wait_until('both nodes work', lambda: self.units(held.format(1)) > 0 and self.units(held.format(2)) > 0)
        self.local_slurm('kill-node', 2)
        self.assertGreater(self.units("work_unit_state <> 'done'"), 0, 'the build ended too soon')
        self.local_slurm('restart', 'controller')
        self.local_slurm('restart', 'store')
        self.wait_until('all units have ended', lambda: self.units("work_unit_state IN ('done', 'failed')") == 24,
                        seconds=100)
        self.succeed('db', 'build', 'sqlite:whole.db', *WORK, *SCALES, '--jobs', '1')
        self.assertEqual(self.content(self.address), self.content('sqlite:whole.db'))
        self.assertIn('host        n1: ', self.succeed('db', 'status', self.address).stdout)


if __name__ == '__main__':
    support.main()
