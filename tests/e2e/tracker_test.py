#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""The example senders move a session: examples/tracker_sender.py and the program of examples/tracker_sender.cpp, which
EIGENGRASP_TRACKER_SENDER names."""
import os
import subprocess
import sys
import unittest

import support
import web_client


class Senders(support.EndToEnd):
    def moves_a_session(self, *command):
        server = web_client.Server(support.SOURCE, '--udp', 0)
        self.addCleanup(server.end)
        app = web_client.Talk(server, web_client.Schema())
        self.addCleanup(app.close)
        app.send(type='online.start', hand='human', object='glass')
        app.wait_for('online.ready')
        arguments = [str(server.udp_port) if part == 'PORT' else part for part in command]
        run = subprocess.run(arguments, cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual((run.returncode, run.stderr), (0, ''))
        self.assertIn('50 poses sent', run.stdout)
        while True:
            view = app.wait_for('view')
            if 'wrist' in view:
                break
        # where the senders say that the wrist is: on the x axis, 15 to 40 cm out
        self.assertTrue(0.15 <= view['wrist']['pose'][0] <= 0.4, view['wrist'])
        self.assertEqual(view['wrist']['pose'][1:3], [0, 0])
        return app

    def test_the_python_sender(self):
        app = self.moves_a_session(sys.executable, str(support.SOURCE / 'examples' / 'tracker_sender.py'),
                                   '--port', 'PORT', '--rate', '200', '--seconds', '0.25', '--close')
        if not any(m['type'] == 'closed' for m in app.seen):
            app.wait_for('closed')

    def test_the_cpp_sender(self):
        program = os.environ.get('EIGENGRASP_TRACKER_SENDER')
        if not program:
            raise unittest.SkipTest('EIGENGRASP_TRACKER_SENDER does not name the program')
        self.moves_a_session(program, 'PORT', '200', '0.25')


if __name__ == '__main__':
    support.main()
