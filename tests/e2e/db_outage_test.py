# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""eigengrasp db build while things fail around it: the server starts again, the disk is full, another worker dies."""
import os
import signal
import socket
import sqlite3
import subprocess
from pathlib import Path
import support
from store_support import PostgresServer, StoreTest, query
from support import wait_until_catching_interrupts

SMALL = ['--hands', 'barrett-rubber', '--scales', '0.75,1,1.25', '--grasps', '4', '--states', '20000']


class Server(StoreTest):
    def test_a_server_that_starts_again_loses_and_doubles_nothing(self):
        server = PostgresServer()
        self.addCleanup(server.close)
        self.store(server.address)
        self.succeed('db', 'export', server.address, 'sqlite:whole.db')
        ended = "SELECT count(*) FROM work_unit WHERE work_unit_state IN ('done', 'failed')"
        build = self.start(server.address, *SMALL, '--jobs', '2')
        for least, mode in ((1, 'fast'), (4, 'immediate')):
            self.wait_until(f'{least} units have ended', lambda: int(query(server.address, ended) or 0) >= least
                            or build.poll() is not None)
            self.assertIsNone(build.poll(), 'the build ended too soon')
            server.control('restart', '-m', mode)
        out, err = build.communicate(timeout=120)
        self.assertEqual(build.returncode, 0, err)
        self.assertIn('9 of 9 units have ended', out)
        self.succeed('db', 'build', 'sqlite:whole.db', *SMALL, '--jobs', '1')
        self.assertEqual(self.content(server.address), self.content('sqlite:whole.db'))


class FullDisk(StoreTest):
    """A small disk that another file fills while a store on it is built."""

    def small_disk(self):
        disk = self.folder / 'disk'
        disk.mkdir()
        mount = subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=4m', 'tmpfs', disk], capture_output=True, text=True)
        if mount.returncode != 0:
            self.skipTest('a small disk needs the right to mount one')
        self.addCleanup(subprocess.run, ['umount', '-l', disk], check=True)
        return disk

    def fill(self, disk, leave):
        """Another file takes all but some bytes."""
        stat = os.statvfs(disk)
        with open(disk / 'other', 'wb') as other:
            other.write(bytes(max(0, stat.f_bavail * stat.f_frsize - leave)))

    def check(self, address):
        self.store(address)
        self.succeed('db', 'export', address, 'sqlite:whole.db')
        first = ['--hands', 'barrett-rubber', '--scales', '1', '--grasps', '1', '--states', '20000']
        work = ['--hands', 'barrett-rubber', '--scales', '0.75,1,1.25', '--grasps', '15', '--states', '20000', '--jobs', '1']
        for store in ('sqlite:whole.db', address):
            self.succeed('db', 'build', store, *first)
        self.succeed('db', 'build', 'sqlite:whole.db', *work)
        whole = self.content('sqlite:whole.db')
        self.fill(self.folder / 'disk', 200_000)
        run = self.succeed('db', 'build', address, *work, code=2)
        sentences = [line for line in run.stderr.splitlines() if line.startswith('eigengrasp: ')]
        self.assertEqual(len(sentences), 1, run.stderr)
        self.assertRegex(sentences[0], 'disk is full|No space left')
        (self.folder / 'disk/other').unlink()
        ended = 0
        for file, lines in self.content(address).items():  # every unit is whole or waits
            if file.startswith('grasps/') and lines[0]['unit']['state'] == 'done':
                self.assertEqual(lines, whole[file])
                ended += 1
            elif file.startswith('grasps/'):
                self.assertEqual(len(lines), 1, lines[0])
        self.assertTrue(3 <= ended < 9, ended)
        self.assertIn('9 of 9 units have ended', self.succeed('db', 'build', address, *work).stdout)
        self.assertEqual(self.content(address), whole)

    def test_sqlite(self):
        self.small_disk()
        self.check('sqlite:disk/g.db')
        with sqlite3.connect(self.folder / 'disk/g.db') as db:
            self.assertEqual(db.execute('PRAGMA integrity_check').fetchone(), ('ok',))
        db.close()

    def test_text(self):
        self.small_disk()
        self.check('text:disk/g')


class DeadWorker(StoreTest):
    def test_what_it_held_is_taken_while_another_build_waits(self):
        self.store(boxes=((40, 80, 60),))
        self.succeed('db', 'build', 'sqlite:g.db', *SMALL[:2], '--scales', '1', '--grasps', '1')
        other = subprocess.Popen(['sleep', '600'])
        self.addCleanup(self.end, other)
        began = Path(f'/proc/{other.pid}/stat').read_text().rsplit(')', 1)[1].split()[19]
        host = os.environ.get('SLURMD_NODENAME') or socket.gethostname()
        with sqlite3.connect(self.folder / 'g.db') as db:
            db.execute("DELETE FROM grasp")
            db.execute("UPDATE work_unit SET work_unit_state = 'claimed', work_unit_lease = 1e12, work_unit_worker = ?",
                       (f'{host}:{other.pid}.{began}/0',))
        db.close()
        build = self.start('sqlite:g.db', *SMALL[:2], '--scales', '1', '--grasps', '1')
        self.assertTrue(wait_until_catching_interrupts(build))
        with self.assertRaises(subprocess.TimeoutExpired):  # the other one lives, and its lease lasts
            build.communicate(timeout=5)
        other.send_signal(signal.SIGKILL)
        other.wait()
        out, err = build.communicate(timeout=60)
        self.assertEqual(build.returncode, 0, err)
        self.assertIn('1 units in', out)


if __name__ == '__main__':
    support.main()
