# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade takes meshes: heights as seen from one side, in the units of the mesh."""

import json
import os
import struct
import unittest

from Reliefshade import Case, Picture

# A pyramid over 10 x 8, 3 high.
PYRAMID = """v 0 0 0
v 10 0 0
v 10 8 0
v 0 8 0
v 5 4 3
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
"""


class Meshes(Case):
    def mesh(self, text=PYRAMID, name="mesh.obj"):
        with open(self.path(name), "w", encoding="ascii") as stream:
            stream.write(text)
        return name

    def test_size_and_spacing(self):
        known = self.statistics(self.mesh(), "--resolution", "104")
        self.assertEqual(known["size"], "104 84")
        self.assertEqual(known["spacing"], "0.1 0.1")
        self.assertEqual(known["height-scale"], "1")
        known = self.statistics("mesh.obj")
        self.assertEqual(known["size"].split()[0], "1024")
        known = self.statistics("mesh.obj", "--spacing", "2", "--height-scale", "3")
        self.assertEqual((known["spacing"], known["height-scale"]), ("2 2", "3"))

    def test_nothing_is_told(self):
        result = self.run_(self.mesh(), "out.png")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_what_is_not_seen_is_transparent(self):
        self.good(self.mesh(), "out.png", "--resolution", "104", "--bands", "rgba")
        picture = Picture(self.path("out.png"))
        self.assertEqual(picture[0, 0][3], 0)
        self.assertEqual(picture[50, 40][3], 255)

    def test_heights(self):
        # Faces of the pyramid by how much they turn to the light.
        picture = self.shade(self.mesh(), "--resolution", "104", "--sun", "270,30", "--exposure", "-1")
        west, south, north, east = (picture[place][0] for place in ((20, 42), (52, 70), (52, 14), (84, 42)))
        self.assertGreater(west, south)
        self.assertEqual(south, north)
        self.assertGreater(south, east)

    def test_view(self):
        # Seen from the front it is a triangle 10 wide and 3 high.
        known = self.statistics(self.mesh(), "--view", "0,-1,0", "--resolution", "104")
        self.assertEqual(known["size"], "104 34")
        known = self.statistics("mesh.obj", "--view", "0,-1,0", "--view-up", "1,0,0", "--resolution", "104")
        self.assertEqual(known["size"], "34 104")
        # The tip is up.
        picture = self.shade("mesh.obj", "--view", "0,-1,0", "--resolution", "104")
        self.assertEqual([picture[52, y][3] for y in (4, 31)], [255, 255])
        self.assertEqual([picture[8, y][3] for y in (4, 31)], [0, 255])
        # Seen from below it is the inside.
        known = self.statistics("mesh.obj", "--view", "0,0,-2", "--resolution", "104")
        self.assertEqual(known["size"], "104 84")
        for view in ("0,0,0", "1,2", "1,2,x"):
            self.bad(2, ["--view"], "mesh.obj", "out.png", "--view", view)
            self.bad(2, ["--view-up"], "mesh.obj", "out.png", "--view-up", view)

    def test_resolution(self):
        for resolution in ("0", "-4", "65537", "many"):
            self.bad(2, ["--resolution"], self.mesh(), "out.png", "--resolution", resolution)
        self.bad(1, ["mesh.obj", "2^30"], "mesh.obj", "out.png", "--resolution", "65536")
        self.bad(1, ["mesh.obj", "--memory-limit"], "mesh.obj", "out.png", "--resolution", "20000",
                 "--memory-limit", "100")

    def test_options_of_the_other_kind(self):
        for words in (("--band", "1"), ("--channel", "Z"), ("--part", "1"), ("--nodata", "0"),
                      ("--encoding", "terrarium"), ("--degrees",)):
            self.bad(2, [words[0], "mesh"], self.mesh(), "out.png", *words)
        self.plane(name="plane.asc")
        self.bad(2, ["--view", "mesh"], "plane.asc", "out.png", "--view", "1,0,0")
        self.bad(2, ["--view-up", "mesh"], "plane.asc", "out.png", "--view-up", "1,0,0")
        self.bad(2, ["--resolution", "mesh"], "plane.asc", "out.png", "--resolution", "9")

    def test_mask_and_tint(self):
        self.good(self.mesh(), "out.png", "--resolution", "104")
        with open(self.path("tint.txt"), "w", encoding="ascii") as stream:
            stream.write("0 255 0 0\n3 255 0 0\n")
        self.good("mesh.obj", "tinted.png", "--resolution", "104", "--tint", "tint.txt", "--bands", "rgb")
        red, green, blue = Picture(self.path("tinted.png"))[50, 30]
        self.assertGreater(red, 50)
        self.assertEqual((green, blue), (0, 0))

    def test_what_is_left_out_is_told(self):
        result = self.run_(self.mesh(PYRAMID + "l 1 2\nf 1 1 2\n"), "out.png", "--resolution", "64")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("1 vertices and lines, 1 triangles without area", result.stderr)

    def test_numbers_in_a_file_beside(self):
        """glTF names the file of its numbers, which is found beside it and not written over."""
        with open(self.path("a b.bin"), "wb") as stream:
            stream.write(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 1) + struct.pack("<4H", 0, 1, 2, 0))
        views = [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                 {"buffer": 0, "byteOffset": 36, "byteLength": 6}]
        accessors = [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                      "min": [0, 0, 0], "max": [1, 1, 1]},
                     {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]
        self.mesh(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": 44, "uri": "a%20b.bin"}], "bufferViews": views,
            "accessors": accessors}), "mesh.gltf")
        expected = self.shade("mesh.gltf", "--resolution", "64")
        self.assertEqual(expected[10, 50][3], 255)
        self.assertEqual(self.shade(self.path("mesh.gltf"), "--resolution", "64"), expected)
        os.symlink("a b.bin", self.path("link.json"))
        for name in ("a b.bin", "./a b.bin", "link.json"):
            self.bad(2, [name, "would replace a file of mesh.gltf, which is INPUT"], "mesh.gltf", "out.png",
                     "--save-scene", name)
        self.assertEqual(self.shade("mesh.gltf", "--resolution", "64"), expected)

    def test_bad_files(self):
        self.bad(1, ["none.obj", "does not exist"], "none.obj", "out.png")
        self.bad(1, ["empty.stl", "empty"], self.mesh("", "empty.stl"), "out.png")
        self.bad(1, ["points.obj", "no polygons"], self.mesh("v 1 2 3\n", "points.obj"), "out.png")
        self.bad(1, ["far.obj", "of 5 points"], self.mesh(PYRAMID + "f 1 2 9\n", "far.obj"), "out.png")
        self.bad(1, ["other.ply", "no PLY"], self.mesh(PYRAMID, "other.ply"), "out.png")
        self.bad(1, ["flat.obj", "no sample"],
                 self.mesh("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", "flat.obj"), "out.png")
        self.assertFalse(os.path.exists(self.path("out.png")))


if __name__ == "__main__":
    unittest.main()
