"""The page of `design live` in a browser, as somebody uses it: page_test.py DESIGN [FOLDER for pictures]."""

import os
import pathlib
import shutil
import sys
import unittest

from browser import Browser
from live import Live

program = sys.argv[1]
pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None

at_rest = "kreisel.answer && !kreisel.answer.moving && !kreisel.answer.coarse"


def project(what):
    """On the window: where a mark is drawn."""
    return (f"(() => {{ const p = kreisel.{what}.position.clone().project(kreisel.scene.orbit.camera), b = kreisel.scene.canvas.getBoundingClientRect();"
            " return [b.x + b.width * (p.x + 1) / 2, b.y + b.height * (1 - p.y) / 2]; })()")


@unittest.skipUnless(shutil.which("chromium") or "KREISEL_CI" in os.environ, "chromium is not installed")
class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.live = Live(program, "ellipsoid", "--resolution", "48")

    @classmethod
    def tearDownClass(cls):
        cls.live.stop()
        cls.live.process.stdout.close()

    def picture(self, browser, name):
        if pictures:
            browser.screenshot(pictures / f"{name}.png")

    def test_start_drag_read_the_verdict_and_make_a_part(self):
        with Browser(self.live.url) as browser:
            browser.until(f"window.kreisel && {at_rest}")
            browser.until("document.getElementById('proof').textContent.includes('proved')")
            self.assertIn("✓ spins", browser.js("document.getElementById('verdict').textContent"))
            browser.until("kreisel.scene.walls.visible")
            self.picture(browser, "live-spin")
            before = browser.js("kreisel.answer.axis")
            start = browser.js(project("marks.tip"))
            browser.drag(start, [start[0] + 40, start[1] + 10])
            browser.until(f"{at_rest} && kreisel.question.axis")
            self.assertNotEqual(before, browser.js("kreisel.answer.axis"))
            self.assertTrue(browser.js("kreisel.times.some(t => t.moving)"))
            browser.click("#undo")
            browser.until(f"{at_rest} && !kreisel.question.axis && Math.abs(kreisel.answer.axis[2]) > 0.9999")
            self.assertTrue(browser.js("location.hash.length > 5"))
            browser.js("kreisel.set('wall', '2.5', false)")
            browser.until(f"{at_rest} && kreisel.answer.wall_mm > 2.4 && kreisel.scene.walls.visible")
            browser.click("#make")
            browser.until("document.querySelectorAll('#parts a').length >= 3", 240)
            self.assertIn("✓", browser.js("document.querySelector('#parts p').textContent"))
            self.assertEqual(browser.errors, [])

    def test_a_mesh_that_is_dropped_floats(self):
        with Browser(self.live.url, scheme="dark") as browser:
            browser.until(f"window.kreisel && {at_rest}")
            stl = pathlib.Path(browser.folder.name) / "tetra.off"
            stl.write_text("OFF\n4 4 0\n0 0 0\n40 0 0\n0 40 0\n0 0 40\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
            browser.choose_file("#file", stl)
            browser.until(f"{at_rest} && document.getElementById('model').value === 'tetra.off'")
            browser.until("document.getElementById('inspection').textContent.includes('4 triangles')")
            browser.click("input[value=float]")
            browser.until(f"{at_rest} && kreisel.answer.problem === 'float'")
            self.assertTrue(browser.js("kreisel.marks.water.visible"))
            self.picture(browser, "live-float")
            self.assertEqual(browser.errors, [])

    def test_one_in_another_is_dragged_and_looked_for(self):
        with Browser(self.live.url) as browser:
            browser.until(f"window.kreisel && {at_rest}")
            browser.click("input[value=nest]")
            browser.until("kreisel.nest.answer && kreisel.nest.answer.valid")
            scale = browser.js("kreisel.nest.answer.scale")
            middle = browser.js("(() => { const b = kreisel.scene.canvas.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()")
            browser.drag(middle, [middle[0] + 30, middle[1]])
            browser.until(f"kreisel.nest.answer.scale < {scale}")
            browser.click("#go")
            browser.until(f"kreisel.nest.answer.scale > {0.9 * scale}")
            browser.click("#halt")
            self.picture(browser, "live-nest")
            self.assertEqual(browser.errors, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
