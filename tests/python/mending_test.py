"""What may be done to a mesh to make it a solid, asked from Python."""

import pathlib
import tempfile
import unittest

import numpy as np

import kreisel as kr
from library_test import box


def both(one, other, inside_out=False):
    """The shells of two boxes as one mesh; the second's may face inward."""
    (v, f), (w, g) = one, other
    return np.concatenate((v, w)), np.concatenate((f, (g[:, ::-1] if inside_out else g) + len(v)))


def volume(vertices, faces, **mending):
    return kr.Body(vertices, faces, kr.Mending(**mending)).moments()[0]


class Meshes(unittest.TestCase):
    def test_what_overlaps_is_united_without_being_asked(self):
        mesh = both(box((4, 4, 4)), box((4, 4, 4), (2, 2, 2)))
        self.assertAlmostEqual(volume(*mesh), 2 * 64 - 8)
        self.assertIn("united what overlaps: 8 mm^3", kr.Body(*mesh).repairs[0])

    def test_what_is_inside_out_is_what_the_user_says(self):
        mesh = both(box((4, 4, 4)), box((4, 4, 4), (2, 2, 2)), inside_out=True)
        with self.assertRaisesRegex(kr.InputError, "56 mm\\^3 are enclosed inside out"):
            kr.Body(*mesh)
        self.assertAlmostEqual(volume(*mesh, inside_out="void"), 64 - 8)
        self.assertAlmostEqual(volume(*mesh, inside_out="solid"), 2 * 64 - 2 * 8)
        with self.assertRaisesRegex(kr.InputError, "inside_out 'full'; expected refused, solid or void"):
            kr.Mending(inside_out="full")

    def test_holes_are_closed_up_to_a_size(self):
        vertices, faces = box((2, 3, 5))
        with self.assertRaisesRegex(kr.InputError, "open edges: 3"):
            volume(vertices, faces[:-1], close_holes=5)
        self.assertAlmostEqual(volume(vertices, faces[:-1], close_holes=6), 30)

    def test_pieces_are_chosen_by_weight(self):
        mesh = both(box((2, 2, 2), (9, 0, 0)), box((4, 4, 4)))
        with self.assertRaisesRegex(kr.InputError, "2 pieces that do not touch"):
            kr.Body(*mesh)
        self.assertAlmostEqual(volume(*mesh, pieces=[1]), 64)
        np.testing.assert_allclose(kr.inspect(*mesh).solid.pieces, [0.064, 0.008])

    def test_files_are_mended_as_well(self):
        vertices, faces = box((20, 20, 20))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "open.off"
            rows = [" ".join(map(str, v)) for v in vertices] + [f"3 {a} {b} {c}" for a, b, c in faces[:-1]]
            path.write_text(f"OFF\n8 {len(rows) - 8} 0\n" + "\n".join(rows) + "\n")
            self.assertFalse(kr.inspect(path))
            mending = kr.Mending(close_holes=30)
            self.assertAlmostEqual(kr.inspect(path, mending=mending).solid.volume, 8000)
            self.assertAlmostEqual(kr.Body.read(path, mending=mending).moments()[0], 8000)


if __name__ == "__main__":
    unittest.main()
