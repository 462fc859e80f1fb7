# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade makes heights of normal maps, and squeezes depth into reliefs."""

import math
import os
import unittest

from Reliefshade import Case, Picture

SIZE = 64


def bump(x, y):
    """A hill over the picture, in samples; y is up."""
    return 9.0 * math.exp(-(x * x + y * y) / 200.0) + 0.1 * x


class NormalMaps(Case):
    def normals(self, name="normals.ppm", green=1.0):
        rows = []
        for j in range(SIZE):
            row = []
            for i in range(SIZE):
                x, y, step = i - SIZE / 2, SIZE / 2 - j, 1e-3
                gx = (bump(x + step, y) - bump(x - step, y)) / (2 * step)
                gy = (bump(x, y + step) - bump(x, y - step)) / (2 * step)
                size = math.sqrt(gx * gx + gy * gy + 1)
                normal = (-gx / size, -gy / size * green, 1 / size)
                row.append(tuple(round(127.5 + 127.5 * n) for n in normal))
            rows.append(row)
        return self.ppm(rows, name)

    def relief(self):
        """The same heights, as they are."""
        return self.grid([[bump(i - SIZE / 2, SIZE / 2 - j) for i in range(SIZE)] for j in range(SIZE)])

    def difference(self, one, other):
        pairs = [(one[x, y][0], other[x, y][0]) for y in range(2, SIZE - 2) for x in range(2, SIZE - 2)]
        return sum(abs(a - b) for a, b in pairs) / len(pairs)

    def test_the_light_is_that_of_the_heights(self):
        words = ("--sun", "300,30")
        wanted = self.shade(self.relief(), "--spacing", "1", *words)
        for method in ("least-squares", "cliffs"):
            made = self.shade(self.normals(), "--normal-map", "auto", "--normal-method", method, *words)
            self.assertLess(self.difference(made, wanted), 4.0, method)

    def test_green_up_or_down(self):
        words = ("--sun", "350,30")
        up = self.shade(self.normals(), "--normal-map", "up", *words)
        down = self.normals("down.ppm", -1.0)
        # But for how codes are rounded.
        self.assertLess(self.difference(self.shade(down, "--normal-map", "down", *words), up), 1.0)
        self.assertEqual(self.shade(down, "--normal-map", "auto", *words),
                         self.shade(down, "--normal-map", "down", *words))
        self.assertEqual(self.shade("normals.ppm", "--normal-map", "auto", *words), up)
        self.assertGreater(self.difference(self.shade(down, "--normal-map", "up", *words), up), 5.0)

    def test_sums_of_paths_differ(self):
        squares = self.shade(self.normals(), "--normal-map", "up")
        sums = self.shade("normals.ppm", "--normal-map", "up", "--normal-method", "path-sums")
        self.assertNotEqual(sums, squares)

    def test_a_mask_keeps_what_is_hidden_out_of_the_heights(self):
        # Outside of a disc there is nonsense, which would bend the surface inside.
        inside = lambda i, j: math.hypot(i - 31.5, j - 31.5) < 20
        self.normals()
        with open(self.path("normals.ppm"), "rb") as stream:
            pixels = stream.read()[-3 * SIZE * SIZE:]
        rows = [[tuple(pixels[3 * (SIZE * j + i):][:3]) if inside(i, j) else ((i * 97 + j * 61) % 256, (i * 41) % 256, 140)
                 for i in range(SIZE)] for j in range(SIZE)]
        self.ppm(rows, "noise.ppm")
        self.png([[65535 * inside(i, j) for i in range(SIZE)] for j in range(SIZE)], "mask.png")
        words = ("--normal-map", "up", "--sun", "300,30", "--mask", "mask.png")
        clean, masked = self.shade("normals.ppm", *words), self.shade("noise.ppm", *words)
        pairs = [(clean[i, j], masked[i, j]) for j in range(SIZE) for i in range(SIZE) if inside(i, j)]
        self.assertEqual({b[3] for _, b in pairs}, {255})
        self.assertLess(sum(abs(a[0] - b[0]) for a, b in pairs) / len(pairs), 1.0)

    def test_spacing_is_the_unit(self):
        # Normals say how steep a surface is, whatever the distance of its samples.
        words = ("--normal-map", "up", "--sun", "300,30")
        self.assertLess(self.difference(self.shade(self.normals(), *words),
                                        self.shade("normals.ppm", *words, "--spacing", "4")), 0.1)

    def test_what_is_not_known_is_told(self):
        # A plane is one with green up or down.
        rows = [[(150, 140, 230)] * SIZE for _ in range(SIZE)]
        result = self.run_(self.ppm(rows, "plane.ppm"), "out.png", "--normal-map", "auto")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("which way green points cannot be told", result.stderr)

    def test_options_of_rasters(self):
        self.normals()
        for words in (("--band", "2"), ("--encoding", "terrarium"), ("--nodata", "3"), ("--degrees",),
                      ("--channel", "R"), ("--part", "1")):
            self.bad(2, [words[0], "normal map"], "normals.ppm", "out.png", "--normal-map", "auto", *words)

    def test_refusals(self):
        self.bad(2, ["--normal-map", "sideways"], self.normals(), "out.png", "--normal-map", "sideways")
        self.bad(2, ["--normal-method", "--normal-map"], "normals.ppm", "out.png", "--normal-method", "cliffs")
        self.bad(1, ["hills.asc"], self.hills(), "out.png", "--normal-map", "up")
        self.assertFalse(os.path.exists(self.path("out.png")))


class Reliefs(Case):
    def steps(self):
        """A tower on a hill, both high, over level ground without data around it."""
        rows = [[-1.0 if math.hypot(x - 31.5, y - 31.5) > 28
                 else 40 * math.cos((x - 31.5) / 28) * math.cos((y - 31.5) / 28) + (30 if 24 < x < 40 > y > 24 else 0)
                 for x in range(64)] for y in range(64)]
        return self.grid(rows, nodata=-1)

    def test_share_of_the_depth(self):
        # Of a relief little is left of shadows, and much of what is seen.
        words = ("--spacing", "1", "--sun", "315,25", "--depth", "1")
        whole = self.shade(self.steps(), *words)
        flat = self.shade("grid.asc", *words, "--relief", "0.05")
        data = [(x, y) for y in range(64) for x in range(64) if whole[x, y][3]]
        self.assertEqual(data, [(x, y) for y in range(64) for x in range(64) if flat[x, y][3]])
        self.assertLess(min(whole[place][0] for place in data), 60)
        self.assertGreater(min(flat[place][0] for place in data), min(whole[place][0] for place in data) + 20)
        self.assertGreater(len({flat[place][0] for place in data}), 20)

    def test_of_meshes(self):
        with open(self.path("mesh.obj"), "w", encoding="ascii") as stream:
            stream.write("v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 5 4 8\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
        self.good("mesh.obj", "out.png", "--resolution", "80", "--relief", "0.1", "--bands", "rgba")
        self.assertEqual(Picture(self.path("out.png"))[40, 40][3], 255)

    def test_tints_are_of_heights_as_they_are(self):
        with open(self.path("tint.txt"), "w", encoding="ascii") as stream:
            stream.write("0 255 0 0\n9 0 0 255\n")
        self.bad(2, ["--tint", "--relief"], self.hills(), "out.png", "--tint", "tint.txt", "--relief", "0.1")

    def test_refusals(self):
        self.hills()
        for share in ("0", "1.1", "-1", "much", "nan"):
            self.bad(2, ["--relief", share], "hills.asc", "out.png", "--relief", share)
        self.bad(1, ["hills.asc", "--memory-limit"], "hills.asc", "out.png", "--relief", "0.1",
                 "--memory-limit", "0.01")


if __name__ == "__main__":
    unittest.main()
