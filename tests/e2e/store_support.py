# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""What the tests of grasp stores share: boxes as objects, builds beside the test, content of a store, a PostgreSQL server."""
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
import support
from support import EndToEnd, box_obj


class StoreTest(EndToEnd):
    def store(self, address='sqlite:g.db', boxes=((40, 80, 60), (30, 30, 120), (25, 70, 70))):
        for i, size in enumerate(boxes):
            self.file(f'meshes/box{i}.obj', box_obj(size))
        self.succeed('db', 'add-objects', address, 'meshes', '--units', 'mm')

    def start(self, address, *args):
        """A build that runs beside the test; killed at its end where it still runs."""
        build = subprocess.Popen([str(support.PROGRAM), 'db', 'build', address, *args], cwd=self.folder,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, build)
        return build

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
            process.communicate()

    def wait_until(self, what, condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, f'waited {seconds} s until {what}')
            time.sleep(0.05)

    def content(self, address):
        """All that a store holds, but for who made it, how long it took, and the order of the units."""
        shutil.rmtree(self.folder / 'content', ignore_errors=True)
        self.succeed('db', 'export', address, 'text:content')
        content = {}
        for file in sorted((self.folder / 'content').rglob('*.jsonl')):
            lines = file.read_text().splitlines()
            head = json.loads(lines[0])
            head.pop('file', None)
            for name in ('number', 'worker', 'seconds', 'lease_until'):
                head.get('unit', {}).pop(name, None)
            content[str(file.relative_to(self.folder / 'content'))] = [head, *lines[1:]]
        return content


def postgres_programs():
    """The folder of initdb and pg_ctl, of version 15 or newer; skips the test where there is none."""
    for version in range(30, 14, -1):
        folder = Path(f'/usr/lib/postgresql/{version}/bin')
        if (folder / 'initdb').exists():
            return folder
    raise unittest.SkipTest('PostgreSQL is not installed (apt-get install postgresql): initdb was not found')


def free_ports(count):
    """The first of so many neighbouring ports of the loopback that are free."""
    for port in range(20000 + os.getpid() % 10000, 60000, count):
        try:
            for i in range(count):
                with socket.socket() as s:
                    s.bind(('127.0.0.1', port + i))
            return port
        except OSError:
            continue
    raise unittest.SkipTest('no free ports on the loopback')


def query(address, sql):
    """The first value that a statement answers; none while the server is away."""
    run = subprocess.run([postgres_programs() / 'psql', '-qAt', address, '-c', sql], text=True, capture_output=True,
                         stdin=subprocess.DEVNULL, timeout=60)
    return run.stdout.strip() if run.returncode == 0 else None


class PostgresServer:
    """A server of its own, in a scratch folder; as the user postgres where the test is root."""

    def __init__(self):
        self.programs = postgres_programs()
        self.scratch = tempfile.TemporaryDirectory(prefix='eigengrasp-pg-')
        self.folder = Path(self.scratch.name)
        self.port = free_ports(1)
        if os.geteuid() == 0:
            shutil.chown(self.folder, 'postgres')
        self.run('initdb', '-D', self.folder / 'data', '-U', 'grasp', '-A', 'trust', '-E', 'UTF8', '--locale=C', '--no-sync')
        self.control('start')
        self.address = f'postgresql://grasp@127.0.0.1:{self.port}/postgres'

    def run(self, program, *args):
        as_user = ['runuser', '-u', 'postgres', '--'] if os.geteuid() == 0 else []
        # The server keeps what it is given as output, so that is a file.
        with open(self.folder / 'commands', 'a') as log:
            subprocess.run([*as_user, str(self.programs / program), *map(str, args)], cwd='/', check=True, timeout=120,
                           stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def control(self, command, *args):
        self.run('pg_ctl', '-D', self.folder / 'data', '-l', self.folder / 'log', '-w', '-o',
                 f'-p {self.port} -k {self.folder} -c listen_addresses=127.0.0.1 -c fsync=off', *args, command)

    def close(self):
        try:
            self.control('stop', '-m', 'immediate')
        finally:
            self.scratch.cleanup()
