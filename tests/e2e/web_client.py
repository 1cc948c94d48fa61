# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""A server to talk to, and a WebSocket client (RFC 6455) that can also misbehave. Standard library only; what comes in
is held against the schema where python3-jsonschema is there."""
import base64
import http.client
import json
import os
import re
import select
import signal
import socket
import struct
import subprocess
import time

import support

try:
    import jsonschema
except ImportError:
    jsonschema = None


class Schema:
    """Holds JSON values against entries of schema/wire.schema.json, by an implementation that is not ours."""

    def __init__(self):
        self.schema = json.loads((support.SOURCE / 'schema' / 'wire.schema.json').read_text())
        self.validators = {}

    def errors(self, value, definition):
        if jsonschema is None:
            return []
        if definition not in self.validators:
            part = {'$ref': f'#/$defs/{definition}', '$defs': self.schema['$defs']}
            self.validators[definition] = jsonschema.Draft202012Validator(part)
        return list(self.validators[definition].iter_errors(value))

    def require(self, value, definition):
        errors = self.errors(value, definition)
        if errors:
            raise AssertionError(f'not in the schema ({definition}): {errors[0].message[:500]}; {str(value)[:300]}')


class Server:
    """The program with `serve` on free ports; ended by Ctrl-C."""

    def __init__(self, folder, *args, environment=None):
        self.process = subprocess.Popen(
            [str(support.PROGRAM), 'serve', '--port', '0', *map(str, args)], cwd=folder, text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env={**os.environ, **(environment or {})})
        self.said = []
        while True:
            line = self.process.stdout.readline()
            if not line:
                raise AssertionError(f'the server ended: {self.process.stderr.read()[:2000]}')
            self.said.append(line)
            if 'Ctrl-C' in line:
                break
        text = ''.join(self.said)
        self.host, port = re.search(r'http://([^/:]+):(\d+)/', text).groups()
        self.port = int(port)
        udp = re.search(r'UDP port (\d+)', text)
        self.udp_port = int(udp.group(1)) if udp else 0

    def end(self, how=signal.SIGINT, seconds=60):
        """Ends the server; returns its exit code and what it said on stderr."""
        if self.process.poll() is None:
            self.process.send_signal(how)
        try:
            _, errors = self.process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.communicate()
            raise AssertionError('the server did not end')
        return self.process.returncode, errors

    def request(self, method, path, body=None, headers=None):
        """(status, headers, bytes) of one request; the path is sent as it stands."""
        connection = http.client.HTTPConnection('127.0.0.1', self.port, timeout=120)
        try:
            connection.putrequest(method, path, skip_host='Host' in (headers or {}))
            for key, value in (headers or {}).items():
                connection.putheader(key, value)
            if body is not None:
                connection.putheader('Content-Length', str(len(body)))
            connection.endheaders(body)
            reply = connection.getresponse()
            return reply.status, dict(reply.getheaders()), reply.read()
        finally:
            connection.close()

    def get(self, path, headers=None):
        return self.request('GET', path, headers=headers)

    def get_json(self, path, headers=None):
        status, _, body = self.get(path, headers)
        assert status == 200, (path, status, body[:300])
        return json.loads(body)


class Refused(Exception):
    """The server did not take a WebSocket in; code is the HTTP status."""

    def __init__(self, code, body):
        super().__init__(f'{code}: {body[:300]}')
        self.code, self.body = code, body


class Closed(Exception):
    """The server closed the WebSocket; code is of RFC 6455, None where the connection just broke."""

    def __init__(self, code, reason=''):
        super().__init__(f'closed: {code} {reason}')
        self.code, self.reason = code, reason


class WebSocket:
    """One WebSocket to a server."""

    def __init__(self, port, path='/ws', headers=None, host='127.0.0.1', receive_buffer=None):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(60)
        self.socket.connect((host, port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.buffer = b''
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f'GET {path} HTTP/1.1', f'Host: {host}:{port}', 'Upgrade: websocket', 'Connection: Upgrade',
                 f'Sec-WebSocket-Key: {key}', 'Sec-WebSocket-Version: 13',
                 *(f'{k}: {v}' for k, v in (headers or {}).items())]
        self.socket.sendall(('\r\n'.join(lines) + '\r\n\r\n').encode())
        head = self.until(b'\r\n\r\n').decode('latin-1')
        status = int(head.split()[1])
        if status != 101:
            length = re.search(r'(?i)content-length: (\d+)', head)
            raise Refused(status, self.exactly(int(length.group(1)) if length else 0).decode(errors='replace'))
        self.answer_pings = True

    def more(self):
        data = self.socket.recv(65536)
        if not data:
            raise Closed(None)
        self.buffer += data

    def until(self, mark):
        while mark not in self.buffer:
            self.more()
        end = self.buffer.index(mark) + len(mark)
        head, self.buffer = self.buffer[:end], self.buffer[end:]
        return head

    def exactly(self, n):
        while len(self.buffer) < n:
            self.more()
        data, self.buffer = self.buffer[:n], self.buffer[n:]
        return data

    def send_frame(self, opcode, payload, final=True):
        mask = os.urandom(4)
        n = len(payload)
        head = bytes([(0x80 if final else 0) | opcode])
        head += bytes([0x80 | n]) if n < 126 else bytes([0xFE]) + struct.pack('>H', n) if n < 65536 else \
            bytes([0xFF]) + struct.pack('>Q', n)
        repeated = (mask * (n // 4 + 1))[:n]
        masked = (int.from_bytes(payload, 'big') ^ int.from_bytes(repeated, 'big')).to_bytes(n, 'big') if n else b''
        self.socket.sendall(head + mask + masked)

    def send_text(self, text):
        self.send_frame(1, text if isinstance(text, bytes) else text.encode())

    def send(self, **message):
        self.send_text(json.dumps(message))

    def receive_text(self):
        """The next text message; pings are answered on the way."""
        parts = b''
        while True:
            first, second = self.exactly(2)
            length = second & 0x7F
            if length == 126:
                length, = struct.unpack('>H', self.exactly(2))
            elif length == 127:
                length, = struct.unpack('>Q', self.exactly(8))
            payload = self.exactly(length)
            opcode = first & 0x0F
            if opcode == 8:
                code = struct.unpack('>H', payload[:2])[0] if len(payload) >= 2 else None
                raise Closed(code, payload[2:].decode(errors='replace'))
            if opcode == 9 and self.answer_pings:
                self.send_frame(10, payload)
            if opcode in (0, 1):
                parts += payload
                if first & 0x80:
                    return parts.decode()

    def close(self):
        self.socket.close()


class Talk(WebSocket):
    """A client that speaks the protocol. Every message that comes in is held against the schema."""

    def __init__(self, server, schema, role='app', hello=None, **more):
        super().__init__(server.port, **more)
        self.schema = schema
        self.seen = []
        if hello is not False:
            self.send(**{'type': 'hello', 'protocol': 1, 'role': role, **(hello or {})})
            self.welcome = self.wait_for('welcome')

    def receive(self):
        message = json.loads(self.receive_text())
        self.schema.require(message, 'ServerMessage')
        self.seen.append(message)
        return message

    def wait_for(self, *types, seconds=120):
        """The next message of one of these types; others are passed over. An error that is not waited for fails."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            message = self.receive()
            if message['type'] in types:
                return message
            if message['type'] == 'error':
                raise AssertionError(f'while waiting for {types}: {message}')
        raise AssertionError(f'no {types} within {seconds} s')

    def is_silent(self, seconds):
        """Whether nothing comes for a while."""
        return not self.buffer and not select.select([self.socket], [], [], seconds)[0]
