#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tiles for web maps: where they lie, what is in them, and runs that go on."""

import json
import math
import os
import random
import signal
import subprocess
import time
import unittest

from Reliefshade import JACKSBORO, PROGRAM, Case, Picture, needsGdal, needsGdalTools, waitForHandler

# Of the terrain, from its file.
WEST, SOUTH, EAST, NORTH = -84.41375, 36.44625, -84.077916667, 36.732916667


def tileAt(longitude, latitude, zoom, size=256):
    """The tile of a place, and the sample in it, both with fractions."""
    n = 2**zoom
    x = (longitude + 180) / 360 * n
    y = (1 - math.asinh(math.tan(math.radians(latitude))) / math.pi) / 2 * n
    return x, y


@needsGdal
class Tiles(Case):
    def contents(self, folder="tiles"):
        files = {}
        for place, _, names in os.walk(self.path(folder)):
            for name in names:
                file = os.path.join(place, name)
                with open(file, "rb") as stream:
                    files[os.path.relpath(file, self.path(folder))] = stream.read()
        return files

    def names(self, zoom, folder="tiles"):
        return sorted(name for name in self.contents(folder) if name.startswith(f"{zoom}/"))

    def test_places_and_zoom(self):
        self.good(JACKSBORO, "--xyz", "tiles")
        with open(self.path("tiles/tiles.json")) as stream:
            about = json.load(stream)
        self.assertEqual(about["tilejson"], "3.0.0")
        self.assertEqual((about["minzoom"], about["maxzoom"], about["scheme"]), (5, 11, "xyz"))
        for found, wanted in zip(about["bounds"], (WEST, SOUTH, EAST, NORTH)):
            self.assertAlmostEqual(found, wanted, 6)
        for zoom in range(5, 12):
            x0, y0 = map(int, tileAt(WEST, NORTH, zoom))
            x1, y1 = map(int, tileAt(EAST, SOUTH, zoom))
            wanted = [f"{zoom}/{x}/{y}.png" for x in range(x0, x1 + 1) for y in range(y0, y1 + 1)]
            self.assertEqual(self.names(zoom), sorted(wanted))
        # Nothing else is left but what the run is known by.
        others = {name for name in self.contents() if not name[0].isdigit()}
        self.assertEqual(others, {"run.txt", "tiles.json"})
        # Data end where they do, to a sample.
        x, y = tileAt(WEST, NORTH, 11)
        tile = Picture(self.path(f"tiles/11/{int(x)}/{int(y)}.png"))
        self.assertEqual((tile.width, tile.height, tile.components), (256, 256, 4))
        column, row = 256 * (x % 1), 256 * (y % 1)
        for j in range(256):
            for i in range(256):
                outside = i + 0.5 < column - 1.5 or j + 0.5 < row - 1.5
                inside = i + 0.5 > column + 1.5 and j + 0.5 > row + 1.5
                if inside or outside:
                    self.assertEqual(tile[i, j][3], 255 if inside else 0, (i, j))

    def test_size_and_zoom(self):
        self.good(JACKSBORO, "--xyz", "tiles", "--zoom", "8-9", "--xyz-size=512")
        self.assertTrue(self.names(8) and self.names(9))
        self.assertFalse(self.names(7) or self.names(10))
        tile = Picture(self.path("tiles/" + self.names(9)[0]))
        self.assertEqual((tile.width, tile.height), (512, 512))
        # Half the tiles' size is one zoom more: the same samples.
        self.good(JACKSBORO, "--xyz", "small", "--zoom", "10")
        self.assertEqual(len({name.split("/")[0] for name in self.contents("small") if "/" in name}), 1)
        for name in self.names(9):
            _, x, y = name.split("/")
            large = Picture(self.path("tiles/" + name))
            quarter = self.path(f"small/10/{2 * int(x)}/{2 * int(y[:-4])}.png")
            if os.path.exists(quarter):
                small = Picture(quarter)
                self.assertEqual([row[: 4 * 256] for row in large.rows[:256]], small.rows)

    def test_what_is_shaded(self):
        # Level ground is one colour, whatever the zoom.
        self.good(JACKSBORO, "--xyz", "tiles", "--height-scale", "0", "--sun", "0,90", "--diffuse", "1,1,1")
        found = set()
        for name, data in self.contents().items():
            if name.endswith(".png"):
                tile = Picture(self.path("tiles/" + name))
                found |= {tile[x, y] for x in range(0, 256, 3) for y in range(0, 256, 3)}
        full = {colour for colour in found if colour[3] == 255}
        self.assertEqual(full, {(255, 255, 255, 255)})
        self.assertTrue(all(colour[:3] == (255, 255, 255) for colour in found if colour[3] > 0))

    def test_degrees(self):
        self.grid([[i * j % 7 * 900 for i in range(40)] for j in range(30)], corner=(10, 45), size=0.01)
        line = self.bad(1, ["grid.asc", "no coordinate reference system"], "grid.asc", "--xyz", "tiles", "--quiet")
        self.assertIn("gdal_edit.py", line)
        self.assertFalse(os.path.exists(self.path("tiles")))
        self.good("grid.asc", "--degrees", "--xyz", "tiles")
        x, y = tileAt(10.2, 45.15, 7)
        self.assertIn(f"7/{int(x)}/{int(y)}.png", self.names(7))

    @needsGdalTools
    def test_round_the_earth(self):
        self.grid([[(i * 7 + j * 5) % 11 * 900 for i in range(40)] for j in range(30)])
        for west, name in ((179.8, "east"), (-180.2, "west")):
            ends = (west, 10.3, west + 0.4, 10.0)
            self.tool("gdal_translate", "-q", "-a_srs", "EPSG:4326", "-a_ullr", *ends, "grid.asc", name + ".tif")
            self.good(name + ".tif", "--xyz", name, "--zoom", "8-9")
            self.assertEqual({int(file.split("/")[1]) for file in self.names(9, name)}, {0, 511})
        tiles = [{k: v for k, v in self.contents(name).items() if k[0].isdigit()} for name in ("east", "west")]
        self.assertEqual(set(tiles[0]), set(tiles[1]))

    def test_going_on(self):
        self.good(JACKSBORO, "--xyz", "tiles")
        whole = self.contents()
        dates = {name: os.stat(self.path("tiles/" + name)).st_mtime_ns for name in whole}
        # All is there: nothing is done, however many threads may do it.
        self.good(JACKSBORO, "--xyz=tiles", "--threads", "1", "--quiet")
        for name, date in dates.items():
            self.assertEqual(os.stat(self.path("tiles/" + name)).st_mtime_ns, date)
        # Without the last file what is missing is made.
        gone = self.names(11)[3]
        os.remove(self.path("tiles/tiles.json"))
        os.remove(self.path("tiles/" + gone))
        self.good(JACKSBORO, "--xyz", "tiles")
        self.assertEqual(self.contents(), whole)
        self.assertEqual(os.stat(self.path("tiles/" + self.names(11)[0])).st_mtime_ns, dates[self.names(11)[0]])
        # Another run is refused, and changes nothing.
        for words in (["--sun", "90,30"], ["--zoom", "3-4"]):
            line = self.bad(1, ["tiles", "another run", words[0], "remove it"], JACKSBORO, "--xyz", "tiles", *words)
            self.assertLess(len(line), 220)
        self.hills()
        self.bad(1, ["another run", "hills.asc"], "hills.asc", "--xyz", "tiles")
        self.assertEqual(self.contents(), whole)

    @needsGdalTools
    def test_another_file_of_that_name(self):
        self.grid([[i * j % 7 * 900 for i in range(40)] for j in range(30)], corner=(10, 45), size=0.01)
        self.tool("gdal_translate", "-q", "-a_srs", "EPSG:4326", "grid.asc", "in.tif")
        self.good("in.tif", "--xyz", "tiles")
        os.utime(self.path("in.tif"), (1, 1))
        self.bad(1, ["another run", "in.tif"], "in.tif", "--xyz", "tiles")

    @needsGdalTools
    def test_sources_of_a_virtual_raster(self):
        self.grid([[i * j % 7 * 900 for i in range(40)] for j in range(30)], corner=(10, 45), size=0.01)
        self.tool("gdal_translate", "-q", "-a_srs", "EPSG:4326", "grid.asc", "in.tif")
        self.tool("gdal_translate", "-q", "-of", "VRT", "in.tif", "in.vrt")
        self.good("in.vrt", "--xyz", "tiles")
        self.good("in.vrt", "--xyz", "tiles")
        os.utime(self.path("in.tif"), (1, 1))
        self.bad(1, ["another run", "in.vrt"], "in.vrt", "--xyz", "tiles")

    def test_killed_and_interrupted(self):
        words = [JACKSBORO, "--xyz", "tiles", "--zoom", "5-13", "--quiet"]
        self.good(JACKSBORO, "--xyz", "whole", "--zoom", "5-13", "--quiet")
        whole = self.contents("whole")
        rng = random.Random(4)
        killed = interrupted = 0
        for turn in range(60):
            process = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stderr=subprocess.PIPE, text=True)
            number = signal.SIGTERM if turn % 3 == 2 else signal.SIGKILL
            waitForHandler(process, signal.SIGTERM)
            time.sleep(rng.uniform(0, 0.4))
            process.send_signal(number)
            message = process.communicate()[1]
            killed += process.returncode == -signal.SIGKILL
            interrupted += process.returncode == 130
            if process.returncode == 0:
                break
            if process.returncode == 130:
                self.assertEqual(message, "reliefshade: interrupted\n")
        self.assertGreater(killed + interrupted, 1)
        self.good(*words)
        self.assertEqual(self.contents(), whole)

    def test_refusals(self):
        self.hills()
        for fragments, words in (
            (["--xyz", "OUTPUT"], [JACKSBORO, "out.tif", "--xyz", "tiles"]),
            (["--xyz", "--layers"], [JACKSBORO, "--layers", "normals", "--xyz", "tiles"]),
            (["--xyz", "--type"], [JACKSBORO, "--type", "float", "--xyz", "tiles"]),
            (["--xyz", "--bands"], [JACKSBORO, "--bands", "grey", "--xyz", "tiles"]),
            (["--compress"], [JACKSBORO, "--compress", "deflate", "--xyz", "tiles"]),
            (["--zoom", "--xyz"], [JACKSBORO, "out.tif", "--zoom", "3"]),
            (["--xyz-size", "--xyz"], [JACKSBORO, "out.tif", "--xyz-size", "512"]),
            (["--xyz-size", "300"], [JACKSBORO, "--xyz", "tiles", "--xyz-size", "300"]),
            (["--zoom", "9-3"], [JACKSBORO, "--xyz", "tiles", "--zoom", "9-3"]),
            (["--zoom", "25"], [JACKSBORO, "--xyz", "tiles", "--zoom", "3-25"]),
            (["--zoom", "-1"], [JACKSBORO, "--xyz", "tiles", "--zoom=-1"]),
            (["--zoom", "x"], [JACKSBORO, "--xyz", "tiles", "--zoom", "3-x"]),
            (["--xyz", "file"], ["-", "--xyz", "tiles"]),
            (["OUTPUT"], [JACKSBORO, "--xyz", ""]),
        ):
            self.bad(2, fragments, *words)
        self.bad(1, ["no/tiles", "cannot be made"], JACKSBORO, "--xyz", "no/tiles")
        self.bad(1, ["hills.asc", "cannot be made"], JACKSBORO, "--xyz", "hills.asc")
        self.bad(1, "none.tif", "none.tif", "--xyz", "tiles")
        self.assertEqual(os.listdir(self.folder), ["hills.asc"])

    def test_two_runs_at_once(self):
        import fcntl

        os.mkdir(self.path("tiles"))
        with open(self.path("tiles/lock"), "w") as stream:
            fcntl.flock(stream, fcntl.LOCK_EX)
            self.bad(1, ["tiles", "another run is writing"], JACKSBORO, "--xyz", "tiles")
        self.good(JACKSBORO, "--xyz", "tiles", "--zoom", "9")


if __name__ == "__main__":
    unittest.main()
