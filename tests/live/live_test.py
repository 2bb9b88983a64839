"""The server of `design live` as programs and strangers meet it: live_test.py DESIGN [ROUNDS]."""

import http.client
import json
import os
import pathlib
import random
import re
import socket
import struct
import sys
import tempfile
import time
import unittest

from live import Live
from websocket import Closed, WebSocket

program = sys.argv[1]
root = pathlib.Path(__file__).parents[2]
package = pathlib.Path(program).resolve().parent / "python"
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 60
spin = {"problem": "spin", "resolution": "40"}


def asked(live, target, method="GET", **headers):
    """Status and text of a plain request."""
    way = http.client.HTTPConnection("127.0.0.1", live.port, timeout=20)
    way.putrequest(method, target, skip_host="Host" in headers)
    for name, value in headers.items():
        way.putheader(name, value)
    way.endheaders()
    answer = way.getresponse()
    text = answer.read().decode(errors="replace")
    way.close()
    return answer.status, text


def cube(side):
    """The bytes of an STL."""
    corners = [(x, y, z) for x in (0, side) for y in (0, side) for z in (0, side)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in corners[v]), 0) for t in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + body


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.live = Live(program, "ellipsoid")

    @classmethod
    def tearDownClass(cls):
        code, seconds = cls.live.stop()
        assert code == 0 and seconds < 1, (code, seconds)
        cls.live.process.stdout.close()

    def test_the_address_answers_with_the_page(self):
        self.assertRegex(self.live.url, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")
        status, text = asked(self.live, self.live.path)
        self.assertEqual(status, 200)
        self.assertIn("<title>Kreisel</title>", text)
        for name in ("main.js", "three.min.js", "style.css"):
            self.assertEqual(asked(self.live, self.live.path + name)[0], 200, name)

    def test_the_whole_page_is_small(self):
        files = [*(root / "host/live/page").iterdir(), pathlib.Path("/usr/share/javascript/three/three.min.js")]
        self.assertLess(sum(len(asked(self.live, self.live.path + f.name)[1]) for f in files), 1_500_000)

    def test_nobody_without_the_token_gets_anything(self):
        for target in ("/", "/index.html", "/main.js", "/socket", self.live.path[:-1], "/" + "0" * 32 + "/"):
            self.assertEqual(asked(self.live, target)[0], 403, target)

    def test_other_names_and_pages_get_nothing(self):
        here = f"127.0.0.1:{self.live.port}"
        self.assertEqual(asked(self.live, self.live.path, Host=here)[0], 200)
        self.assertEqual(asked(self.live, self.live.path, Host="evil.example")[0], 403)
        self.assertEqual(asked(self.live, self.live.path, Origin="http://evil.example")[0], 403)
        for headers in ({"Origin": "http://evil.example"}, {"Origin": "null"}, {"Host": "evil.example"}):
            with self.assertRaisesRegex(Closed, "403"):
                self.live.tab(**headers)
        with self.assertRaisesRegex(Closed, "403"):
            WebSocket(self.live.port, "/socket", {"Origin": f"http://{here}"})

    def test_it_reads_and_writes_no_file_that_a_request_names(self):
        for name in ("../desk.cpp", "..%2f..%2fetc/passwd", "/etc/passwd", "page/main.js", "index.html/"):
            self.assertEqual(asked(self.live, self.live.path + name)[0], 404, name)
        self.assertEqual(asked(self.live, self.live.path, method="POST")[0], 405)
        tab = self.live.tab()
        for model in ("/etc/passwd", "../../x.stl", str(pathlib.Path(__file__))):
            tab.send("open", model=model)
            self.assertIn("expected a known name", tab.until("opened")[0]["text"])
        for question in ({"keep": "/etc/passwd"}, {"model": "/etc/passwd"}, {"device": "x"}, {"solver": "ipopt"},
                         {"ipopt.output_file": "/tmp/x"}, {"resolution": "1000"}, {"fineness": "100000"}):
            tab.send("ask", question=question)
            said = tab.until("answer")[0]
            self.assertEqual(said["do"], "error", question)
            self.assertNotIn("\n", said["text"])
        tab.close()

    def test_a_question_is_answered_with_ten_coefficients_and_a_verdict(self):
        tab = self.live.tab()
        tab.send("hello")
        hello = tab.until("hello")[0]
        self.assertEqual(hello["model"], "ellipsoid")
        self.assertIn("wall", [f["name"] for f in hello["fields"]])
        documented = re.findall(r"^\| `([a-z]+)` \|", (root / "docs/live.md").read_text(), re.M)
        self.assertEqual(documented, hello["requests"])
        tab.send("open", model="ellipsoid")
        self.assertEqual(tab.until("opened")[0]["trouble"], "")
        first = tab.send("ask", question=spin)
        body, data = tab.until("surface")
        self.assertEqual((body["name"], len(data)), ("body", 12 * (body["corners"] + body["triangles"])))
        answer = tab.until("answer")[0]
        self.assertEqual(answer["id"], first)
        self.assertTrue(answer["feasible"] and answer["part"]["ok"], answer)
        self.assertEqual(len(answer["quadric"]), 10)
        self.assertLess(answer["part"]["mass_g"], answer["solid"]["mass_g"])
        then = {said["do"]: said for said, _ in (tab.until("surface", "certificate"), tab.until("surface", "certificate"))}
        self.assertEqual(then["surface"]["name"], "offset")
        self.assertLessEqual(then["certificate"]["gap"], 1e-3)
        # Another axis over the same rays; then a wall that leaves none.
        tab.send("ask", question={**spin, "axis": "0.05,0,1"}, moving=True)
        turned = tab.until("answer")[0]
        self.assertNotIn("domain", turned["made"])
        tab.send("ask", question={**spin, "wall": "500"})
        self.assertEqual(tab.until("answer")[0]["do"], "error")
        tab.close()

    def test_while_a_hand_moves_a_coarser_domain_answers(self):
        tab = self.live.tab()
        tab.send("open", model="ellipsoid")
        tab.until("opened")
        tab.send("ask", question={"problem": "spin"})
        tab.until("certificate")
        tab.send("ask", question={"problem": "spin", "wall": "2"}, moving=True)
        self.assertTrue(tab.until("answer")[0]["coarse"])
        tab.send("ask", question={"problem": "spin", "wall": "2"})
        self.assertFalse(tab.until("answer")[0]["coarse"])
        tab.close()

    def test_what_would_help_and_where_it_can_be_done(self):
        tab = self.live.tab()
        tab.send("open", model="ellipsoid")
        tab.until("opened")
        question = {**spin, "axis": "1,0.4,0.2", "wall": "4"}
        tab.send("ask", question=question)
        answer = tab.until("answer")[0]
        self.assertFalse(answer["feasible"])
        self.assertNotEqual(tab.until("unmet")[0]["text"], "")
        tab.send("help", question=question)
        remedies = tab.until("help")[0]["remedies"]
        self.assertTrue(remedies)
        for remedy in remedies:
            if remedy["fields"]:
                tab.send("ask", question={**question, **remedy["fields"]})
                self.assertTrue(tab.until("answer")[0]["feasible"], remedy)
        tab.send("map", question=question)
        found = tab.until("map")[0]
        self.assertEqual(len(found["axes"]), len(found["ok"]))
        self.assertTrue(any(found["ok"]) and not all(found["ok"]))
        tab.close()

    def test_a_copy_nests_as_far_as_something_blocks_it(self):
        tab = self.live.tab()
        tab.send("open", model="heart")
        tab.until("opened")
        tab.send("into")
        tab.until("into")
        tab.send("nest", question={"plane": "0,1,0"})
        found = tab.until("nesting")[0]
        self.assertTrue(found["valid"] and 0.1 < found["scale"] < 1, found)
        self.assertIsNotNone(found["blocked_at"])
        self.assertIn(found["half"], ("above", "below"))
        tab.send("optimise", question={**found["fields"], "free": "position", "particles": "20", "iterations": "5", "seconds": "20"})
        self.assertGreaterEqual(tab.until("optimised")[0]["scale"], found["scale"] - 1e-3)
        tab.send("nest", question={"outer": "/etc/passwd"})
        self.assertIn("outer", tab.until("nesting")[0]["text"])
        tab.close()

    def test_a_part_is_made_and_sent(self):
        tab = self.live.tab()
        tab.send("open", model="ellipsoid")
        tab.until("opened")
        tab.send("make", question=spin, part={"format": "stl"})
        name, data = tab.until("file")
        self.assertEqual(name["name"], "ellipsoid-spin.stl")
        triangles = struct.unpack("<I", data[80:84])[0]
        self.assertEqual(len(data), 84 + 50 * triangles)
        self.assertGreater(triangles, 1000)
        made = tab.until("made")[0]
        self.assertTrue(made["ok"], made["text"])
        self.assertEqual(made["report"]["files"], ["ellipsoid-spin.stl"])
        tab.send("make", question=spin, part={"format": "exe"})
        self.assertIn("exe", tab.until("made")[0]["text"])
        tab.close()

    def test_a_mesh_is_sent_and_a_hostile_one_refused(self):
        tab = self.live.tab()
        tab.send("open", cube(30), model="cube.stl", sent=True)
        self.assertEqual(tab.until("opened")[0]["triangles"], 12)
        self.assertAlmostEqual(tab.until("inspected")[0]["solid"]["volume_mm3"], 27000, places=6)
        head = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        for name, data in (("x.off", head), ("x.off", head[:-4] + b"0 1 9"), ("x.stl", b""), ("x.stl", b"solid\n" * 9), ("x.exe", head),
                           ("x.stl", bytes(80) + b"\xff" * 4 + bytes(50)), ("x.3mf", b"PK\x03\x04" + bytes(99)), ("x.ply", bytes(range(256)))):
            tab.send("open", data, model=name, sent=True)
            said = tab.until("opened")[0]
            self.assertTrue(said.get("trouble") or said.get("text"), name)
        tab.send("ask", question=spin)
        self.assertIn("expected \"open\" first", tab.until("answer")[0]["text"])
        tab.close()

    def test_it_survives_whatever_is_sent(self):
        chance = random.Random(1)
        begin = [b"GET ", b"POST ", b"\x16\x03\x01", b"", b"GET " + self.live.path.encode(), b"GET " + b"/" * 20000]
        for k in range(rounds):
            with socket.create_connection(("127.0.0.1", self.live.port), 5) as way:
                way.settimeout(0.05)
                try:
                    way.sendall(chance.choice(begin) + chance.randbytes(chance.choice([1, 100, 5000])) + b"\r\n\r\n")
                    way.recv(100)
                except OSError:
                    pass
            tab = self.live.tab()
            for _ in range(3):
                try:
                    thing = chance.choice([b"{}", b"[[[[" * 9999, b'{"do": 3}', b'{"do":"ask","question":[]}', b'{"do":"open"}', b'{"do":"ask","moving":9}',
                                           b'{"do":"open","model":"x.stl","sent":true}\n' + chance.randbytes(300), chance.randbytes(200), b"x" * 70000])
                    tab.socket.send(thing if k % 2 else thing.decode("latin-1"))
                except OSError:
                    break
            tab.close()
        self.assertEqual(asked(self.live, self.live.path)[0], 200)


class Many(unittest.TestCase):
    def test_it_begins_with_the_model_that_it_was_given(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a cube.stl"
            file.write_bytes(cube(30))
            for model in ("heart", str(file)):
                with Live(program, model) as live:
                    tab = live.tab()
                    tab.send("hello")
                    hello = tab.until("hello")[0]
                    self.assertEqual(hello["model"], pathlib.Path(model).name)
                    tab.send("open", model=hello["model"])
                    self.assertEqual(tab.until("opened")[0]["trouble"], "")
                    tab.close()

    @unittest.skipUnless(list(package.glob("kreisel/_core*")), "built without the Python library")
    def test_python_serves_the_same_page(self):
        with Live([sys.executable, "-m", "kreisel"], "heart", environment={**os.environ, "PYTHONPATH": str(package)}) as live:
            self.assertEqual(asked(live, live.path)[0], 200)
            self.assertEqual(live.stop()[0], 0)

    def test_tabs_are_counted_and_memory_returns(self):
        with Live(program, "ellipsoid") as live:
            def one_tab():
                tab = live.tab()
                tab.send("open", model="ellipsoid")
                tab.until("opened")
                tab.send("ask", question=spin)
                tab.until("certificate")
                return tab
            one_tab().close()
            time.sleep(1)
            before = live.memory()
            tabs = [live.tab() for _ in range(rounds)]
            for tab in tabs:
                tab.send("hello")
            said = [tab.until("hello")[0] for tab in tabs]
            self.assertIn("hello", {s["do"] for s in said})
            self.assertTrue(any("too many tabs" in s.get("text", "") for s in said))
            for tab in tabs:
                tab.close()
            time.sleep(1)
            one_tab().close()
            time.sleep(1)
            self.assertLess(live.memory(), before + 60e6)

    def test_a_tab_that_does_not_read_takes_no_more_than_its_share(self):
        with Live(program, "ellipsoid") as live:
            slow = WebSocket(live.port, live.path + "socket", {"Origin": f"http://127.0.0.1:{live.port}"})
            for k in range(40):
                slow.send(json.dumps({"do": "hello", "id": k}))
            other = live.tab()
            other.send("hello")
            self.assertEqual(other.until("hello")[0]["do"], "hello")
            slow.close()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
