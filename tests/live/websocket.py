"""A WebSocket's end (RFC 6455), as far as tests need one: no library of Python's own has it."""

import base64
import os
import socket
import struct


class Closed(Exception):
    """The other end has closed, or refused."""


class WebSocket:
    def __init__(self, port, path, headers=None, timeout=120):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout)
        self.rest = b""
        said = {"Host": f"127.0.0.1:{port}", "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), **(headers or {})}
        lines = "".join(f"{name}: {value}\r\n" for name, value in said.items() if value is not None)
        self.socket.sendall(f"GET {path} HTTP/1.1\r\n{lines}\r\n".encode())
        while b"\r\n\r\n" not in self.rest:
            self._more()
        self.head, self.rest = self.rest.split(b"\r\n\r\n", 1)
        self.status = int(self.head.split()[1])
        if self.status != 101:
            raise Closed(self.head.decode(errors="replace"))

    def _more(self):
        try:
            part = self.socket.recv(1 << 16)
        except ConnectionError as error:
            raise Closed(str(error)) from error
        if not part:
            raise Closed("the other end has closed")
        self.rest += part

    def _take(self, count):
        parts = [self.rest]
        have = len(self.rest)
        while have < count:
            self.rest = b""
            self._more()
            parts.append(self.rest)
            have += len(self.rest)
        whole = b"".join(parts)
        self.rest = whole[count:]
        return whole[:count]

    def send(self, data):
        """Text, or bytes."""
        kind, payload = (1, data.encode()) if isinstance(data, str) else (2, data)
        size = len(payload)
        length = (bytes([0x80 | size]) if size < 126 else bytes([0x80 | 126]) + struct.pack(">H", size) if size < 1 << 16
                  else bytes([0x80 | 127]) + struct.pack(">Q", size))
        mask = os.urandom(4)
        body = (int.from_bytes(payload, "big") ^ int.from_bytes((mask * (size // 4 + 1))[:size], "big")).to_bytes(size, "big") if size else b""
        self.socket.sendall(bytes([0x80 | kind]) + length + mask + body)

    def receive(self):
        """The next message, text or bytes. Raises Closed where there is none to come."""
        message, text = b"", True
        while True:
            first, second = self._take(2)
            size = second & 127
            if size > 125:
                size = struct.unpack(">H" if size == 126 else ">Q", self._take(2 if size == 126 else 8))[0]
            payload = self._take(size)
            code = first & 15
            if code == 8:
                raise Closed("the other end has said good-bye")
            if code in (9, 10):
                continue
            if code:
                text = code == 1
            message += payload
            if first & 128:
                return message.decode() if text else message

    def close(self):
        """Also where another thread waits for a message: closing alone would leave the connection to it."""
        try:
            self.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass  # the other end was first
        self.socket.close()
