"""`design live` as a process, and a tab of it that is a program."""

import json
import os
import queue
import signal
import subprocess
import threading
import time
import urllib.parse

from websocket import Closed, WebSocket


class Live:
    def __init__(self, program, *arguments, environment=None):
        """program: a path, or the words of a command."""
        command = [program] if isinstance(program, str) else program
        self.process = subprocess.Popen([*command, "live", "--no-browser", *arguments], stdout=subprocess.PIPE, text=True, env=environment)
        self.url = self.process.stdout.readline().strip()
        parts = urllib.parse.urlparse(self.url)
        self.port, self.path = parts.port, parts.path

    def tab(self, **headers):
        return Tab(self, headers)

    def memory(self):
        """In use, bytes."""
        with open(f"/proc/{self.process.pid}/statm", encoding="ascii") as pages:
            return int(pages.read().split()[1]) * os.sysconf("SC_PAGESIZE")

    def stop(self):
        """By Ctrl-C. Returns the code and the seconds that it took."""
        began = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(10), time.monotonic() - began

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class Tab:
    def __init__(self, live, headers):
        self.socket = WebSocket(live.port, live.path + "socket", {"Origin": f"http://127.0.0.1:{live.port}", **headers})
        self.messages = queue.Queue()
        self.id = 0
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        try:
            while True:
                message = self.socket.receive()
                if isinstance(message, bytes):
                    head, rest = message.split(b"\n", 1)
                    self.messages.put((json.loads(head), rest))
                else:
                    self.messages.put((json.loads(message), b""))
        except (Closed, OSError):
            self.messages.put(({"do": "closed"}, b""))

    def send(self, do, data=None, **said):
        self.id += 1
        text = json.dumps({"do": do, "id": self.id, **said})
        self.socket.send(text if data is None else text.encode() + b"\n" + data)
        return self.id

    def until(self, *kinds, seconds=120):
        """The next message of one of these kinds, or an error; (what is said, bytes)."""
        while True:
            said, data = self.messages.get(timeout=seconds)
            if said["do"] in (*kinds, "error", "closed"):
                return said, data

    def close(self):
        self.socket.close()
