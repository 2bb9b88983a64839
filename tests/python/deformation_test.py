"""A body whose shape may change, from Python."""

import pathlib
import tempfile
import unittest

import numpy as np

import kreisel as kr


def leaning_tower():
    """A box of 16 x 16 x 50 mm that leans so far that its centre of mass is beside its base."""
    corners = np.array([(x, y, z) for z in (0, 50) for y in (-8, 8) for x in (-8, 8)], dtype=float)
    corners[:, 0] += 0.75 * corners[:, 2]
    faces = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7),
                      (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)])
    return corners, faces


class ADeformedBody(unittest.TestCase):
    def setUp(self):
        self.session = kr.Session(kr.Body(*leaning_tower()), device="pocl")

    def test_stands_and_its_base_stays(self):
        asked = dict(target="inside", wall=1.5, cells=32)
        self.assertEqual(self.session.solve("stand", **asked).end, "infeasible")
        found = self.session.solve("stand", deform="least", **asked)
        self.assertTrue(found.feasible)
        shape = found.deformation
        self.assertEqual(shape.reached, "all")
        (before, faces), (after, same) = shape.before, shape.after
        np.testing.assert_array_equal(faces, same)
        moved = np.linalg.norm(after - before, axis=1)
        self.assertAlmostEqual(moved.max(), shape.largest_mm, places=9)
        self.assertLess(moved[before[:, 2] < 1e-9].max(), 1e-9)

    def test_becomes_a_part_that_is_written_deformed(self):
        found = self.session.solve("stand", target="inside", wall=1.5, cells=32, deform="least")
        part = self.session.part(found)
        self.assertNotIn("deformed", self.session.made)  # it was kept
        self.assertTrue(part.verdict.ok, part.verdict.text)
        with tempfile.TemporaryDirectory() as folder:
            files = part.write(pathlib.Path(folder) / "tower.stl")
            self.assertEqual(len(files), 1)

    def test_what_does_not_fit_is_refused_in_one_line(self):
        for asked in (dict(deform="0%"), dict(deform="much"), dict(keep="0,0,0,1")):
            with self.assertRaises(ValueError) as refusal:
                self.session.solve("spin", **asked)
            self.assertNotIn("\n", str(refusal.exception))


if __name__ == "__main__":
    unittest.main()
