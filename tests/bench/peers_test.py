# SPDX-License-Identifier: GPL-3.0-or-later
"""The models that app/bench/peers.py measures other programs against, for fields with known sums, and
pictures that follow these models.

    peers_test.py SOURCE
"""

import pathlib
import sys
import tempfile
import unittest

SOURCE = sys.argv.pop(1)
sys.path.insert(0, f"{SOURCE}/app/bench")
try:
    import numpy as np
    import peers
except ImportError as missing:
    print(missing)
    sys.exit(77)


def field_of(values, spacing=(1.0, 2.0, 3.0), vectors=None):
    vectors = vectors or " ".join(str(tuple(s if d == e else 0 for e in range(3))).replace(" ", "")
                                  for d, s in enumerate(spacing))
    head = (f"NRRD0004\ntype: float\nsizes: {' '.join(str(n) for n in values.shape[::-1])}\n"
            f"space directions: {vectors}\nspace origin: (10,20,30)\n\n")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "field.nrrd")
        path.write_bytes(head.encode() + values.astype("<f4").tobytes())
        return peers.Field(path)


class Sums(unittest.TestCase):
    def test_box_sum_is_the_length_within_a_constant_block(self):
        field = field_of(np.ones((4, 5, 6)))
        self.assertAlmostEqual(field.box_sum(field.center - [100, 0, 0], np.array([1.0, 0, 0])), 6.0)
        # From face to face across the first two axes: 6 mm and 10 mm.
        ray = np.array([6.0, 10.0, 0.0])
        self.assertAlmostEqual(field.box_sum(field.center - 20 * ray, ray), np.hypot(6, 10))

    def test_box_sum_weights_each_voxel_by_its_length(self):
        values = np.zeros((1, 1, 3))
        values[0, 0] = 1, 2, 4
        self.assertAlmostEqual(
            field_of(values, (0.5, 1, 1)).box_sum(np.array([0.0, 20.0, 30.0]), np.array([1.0, 0, 0])), 3.5)

    def test_trilinear_sum_is_exact_where_the_field_is_linear(self):
        values = np.zeros((3, 3, 11)) + np.arange(11)
        field = field_of(values, (1, 1, 1))
        # From the first sample to the last, the mean is 5.
        # A sample more or less, of at most 10 and 0.05 mm, may be at the end.
        self.assertAlmostEqual(field.trilinear_sum(field.center - [50, 0, 0], np.array([1.0, 0, 0])), 50.0, delta=0.5)

    def test_a_turned_field_is_refused(self):
        with self.assertRaises(SystemExit):
            field_of(np.ones((2, 2, 2)), vectors="(1,0.1,0) (0,1,0) (0,0,1)")

    def blob(self):
        """A field that is like none of its mirror images."""
        values = np.zeros((12, 10, 8))
        values[2:9, 3:8, 1:5] = 1
        values[3:5, 4:6, 2:4] = 3
        return field_of(values, (1, 1, 1))

    def test_a_picture_of_plastimatch_is_compared_along_its_own_rays(self):
        field, side = self.blob(), 16
        x, y, z = field.center
        # What plastimatch writes for the view from +x, 1000 mm before the body, one pixel a mm.
        turn = np.array([[0, 1, 0, -y], [0, 0, -1, z], [-1, 0, 0, x + 1000], [0, 0, 0, 1]], float)
        rows = [[7.5, 7.5], [0] * 4, [0] * 4, [0] * 4, [1000], [1000], [-1, 0, 0]]
        text = "".join(" " + " ".join(f"{n:.9e}" for n in row) + "\n" for row in rows) + "Extrinsic\n"
        text += "".join(" " + " ".join(f"{n:.9e}" for n in row) + "\n" for row in turn) + "Intrinsic\n"
        text += " 1.0 0.0 0.0 0.0\n"
        source = np.array([x + 1000, y, z])
        picture = np.array([[0.1 * field.box_sum(source, np.array([-1000, c - 7.5, 7.5 - r])) for c in range(side)]
                            for r in range(side)], "<f4")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "plastimatch_0000.txt").write_text(text)
            for shown, expected in ((picture, 0.0), (picture[::-1], 0.3), (picture[:, ::-1], 0.3)):
                pathlib.Path(folder, "plastimatch_0000.pfm").write_bytes(b"Pf\n16 16\n-1\n" + shown.tobytes())
                error = peers.Plastimatch("", field, folder, side).error()
                self.assertLess(error, 1e-6) if expected == 0 else self.assertGreater(error, expected)

    def test_a_picture_of_vtk_is_compared_up_to_a_factor(self):
        field, side = self.blob(), 16
        pixel = 8 / side
        along = np.array([0.0, 1.0, 0.0])
        picture = np.array([[7 * field.trilinear_sum(
            field.center + np.array([(c - 7.5) * pixel, -1000, (r - 7.5) * pixel]), along) for c in range(side)]
            for r in range(side)])
        with tempfile.TemporaryDirectory() as folder:
            for shown, expected in ((picture, 0.0), (picture[::-1], 0.3), (picture[:, ::-1], 0.3)):
                np.save(f"{folder}/vtk.npy", shown)
                error = peers.Vtk("", field, folder, side).error()
                self.assertLess(error, 1e-6) if expected == 0 else self.assertGreater(error, expected)


if __name__ == "__main__":
    unittest.main()
