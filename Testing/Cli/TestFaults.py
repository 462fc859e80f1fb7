# SPDX-License-Identifier: BSD-3-Clause
"""Memory that is not there, disks that are full, signals: reliefshade says so in one line, leaves
what was there before, and nothing else."""

import os
import re
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

from Reliefshade import JACKSBORO, PROGRAM, Case, needsGdal, needsGdalTools

SLOW = ("--integrator", "fixed-step", "--steps", "20000")


def pngHeader(width, height):
    """The beginning of a grey PNG of 16 bits, and no pixels."""

    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    pixels = chunk(b"IDAT", zlib.compress(bytes(100)))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + pixels + chunk(b"IEND", b"")


class Memory(Case):
    def setUp(self):
        super().setUp()
        self.hills()
        with open(self.path("bomb.png"), "wb") as stream:
            stream.write(pngHeader(1000000, 1000000))

    def needed(self, *words):
        """The mebibytes that a refusal says would do."""
        line = self.bad(1, "--memory-limit allows 1 MiB", *words, "--memory-limit", "1")
        return int(re.search(r"(\d+) MiB of memory are needed", line).group(1))

    def test_option(self):
        self.bad(2, "--memory-limit", "hills.asc", "o.png", "--memory-limit", "-1")
        self.bad(2, "--memory-limit", "hills.asc", "o.png", "--memory-limit", "much")
        for limit in ("0", "1", "0.5", "1e6"):
            self.good("hills.asc", "o.png", "--memory-limit", limit)

    def test_every_file(self):
        # OpenImageIO 3.1 has a limit of its own.
        refused = "MiB of memory are needed, --memory-limit allows |MB exceeds the [0-9]+ MB limit"
        self.assertRegex(self.bad(1, "bomb.png: ", "bomb.png", "o.png"), refused)
        for option in ("--mask", "--texture", "--base-texture", "--specular-texture", "--env"):
            self.assertRegex(self.bad(1, "bomb.png: ", "hills.asc", "o.png", option, "bomb.png"), refused)
        self.assertFalse(os.path.exists(self.path("o.png")))

    @needsGdalTools
    def test_raster(self):
        self.tool(
            "gdal_create", "-q", "-outsize", 1000000, 1000000, "-ot", "Int16",
            "-a_srs", "EPSG:32632", "-a_ullr", 0, 1000000, 1000000, 0, "-co", "SPARSE_OK=TRUE",
            "-co", "TILED=YES", "-co", "BLOCKXSIZE=8192", "-co", "BLOCKYSIZE=8192",
            "-co", "BIGTIFF=YES", "-co", "COMPRESS=DEFLATE", "sparse.tif",
        )
        self.assertLess(os.path.getsize(self.path("sparse.tif")), 2000000)
        self.bad(1, ["sparse.tif: ", "MiB of memory are needed"], "sparse.tif", "o.png")

    def test_large_tile(self):
        # One sample in a tile of a gibibyte.
        def entry(tag, kind, value):
            return struct.pack("<HHII", tag, kind, 1, value)

        tags = [
            entry(256, 4, 1), entry(257, 4, 1), entry(258, 3, 8), entry(259, 3, 1),
            entry(262, 3, 1), entry(277, 3, 1), entry(322, 4, 32768), entry(323, 4, 32768),
            entry(324, 4, 8), entry(325, 4, 1 << 30),
        ]
        with open(self.path("tile.tif"), "wb") as stream:
            stream.write(b"II*\0\x08\0\0\0" + struct.pack("<H", len(tags)))
            stream.write(b"".join(tags) + bytes(4))
        self.bad(1, ["tile.tif: ", "--memory-limit"], "tile.tif", "o.png", "--memory-limit", "500")

    @needsGdalTools
    def test_estimate_covers_what_is_taken(self):
        def peak(*words):
            process = subprocess.Popen([PROGRAM, *words], cwd=self.folder)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = status
            self.assertEqual(status, 0)
            return usage.ru_maxrss / 1024

        self.tiff(JACKSBORO, "small.tif", "-outsize", 16, 16)
        self.tiff(JACKSBORO, "large.tif", "-outsize", 2000, 2000)
        self.tiff(JACKSBORO, "stored.tif", "-outsize", 2000, 2000, "-ot", "Int16")
        # What libraries take for themselves, and the bands in which files are written.
        besides = 100
        for words in (
            ["large.tif", "o.png"],
            ["stored.tif", "o.exr"],
            ["stored.tif", "o.tif", "--layers", "normals,illumination"],
            ["large.tif", "o.jpg"],
            ["large.tif", "--layers", "all.exr", "--type", "uint8"],
        ):
            base = peak("small.tif", *words[1:])
            self.assertLessEqual(peak(*words) - base, self.needed(*words) + besides, words)

    def test_enough_is_enough(self):
        self.grid([[(x * y) % 17 for x in range(700)] for y in range(500)], "large.asc")
        needed = self.needed("large.asc", "o.png")
        self.good("large.asc", "o.png", "--memory-limit", needed)
        self.bad(1, "large.asc: ", "large.asc", "p.png", "--memory-limit", needed - 1)


class Outputs(Case):
    """Several outputs appear together or not at all."""

    def setUp(self):
        super().setUp()
        self.hills()

    def before(self, *names):
        for name in names:
            with open(self.path(name), "w") as stream:
                stream.write("before")

    def assertBefore(self, *names):
        for name in names:
            with open(self.path(name), "rb") as stream:
                self.assertEqual(stream.read(), b"before", name)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["hills.asc", *names]))

    def test_scene_without_a_place(self):
        self.before("o.png")
        os.mkdir(self.path("folder"))
        words = ("hills.asc", "o.png", "--save-scene")
        self.bad(1, ["none/s.json", "directory"], *words, "none/s.json")
        self.bad(1, ["folder", "directory"], *words, "folder")
        self.bad(1, "hills.asc/s.json", *words, "hills.asc/s.json")
        os.rmdir(self.path("folder"))
        self.assertBefore("o.png")

    def test_scene_that_cannot_be_written(self):
        # Found out only as it is written: the environment's file lies in a folder that is gone.
        self.before("o.png", "s.json")
        self.bad(1, "sky.hdr", "hills.asc", "o.png", "--env", "sky.hdr", "--save-scene", "s.json")
        self.assertBefore("o.png", "s.json")

    def test_layer_without_a_place(self):
        self.before("o.png")
        os.mkdir(self.path("o-normals.tif"))
        self.bad(1, "o-normals.tif", "hills.asc", "o.png", "--layers", "illumination,normals")
        os.rmdir(self.path("o-normals.tif"))
        self.assertBefore("o.png")

    def test_all_appear(self):
        names = ["o.png", "o-normals.tif", "s.json"]
        self.before(*names)
        os.chmod(self.path("o.png"), 0o640)
        self.good("hills.asc", "o.png", "--layers", "normals", "--save-scene", "s.json")
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["hills.asc", *names]))
        for name in names:
            self.assertGreater(os.path.getsize(self.path(name)), 100)
        self.assertEqual(os.stat(self.path("o.png")).st_mode & 0o777, 0o640)

    @needsGdal
    def test_full_disk(self):
        names = ["o.png", "o-normals.tif", "o-base.tif", "s.json"]
        words = [JACKSBORO, "o.png", "--layers", "normals,base", "--save-scene", "s.json"]
        self.good(*words)
        sizes = [os.path.getsize(self.path(name)) for name in names]
        self.before(*names)
        for limit in (100, min(sizes) + 1, min(sizes[:2]), max(sizes) - 1):

            def fewBytes():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

            self.bad(1, "", *words, preexec_fn=fewBytes, restore_signals=False)
            self.assertBefore(*names)

    def test_small_disk(self):
        disk = tempfile.mkdtemp(prefix="reliefshade-disk-")
        self.addCleanup(os.rmdir, disk)
        mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk]
        if os.geteuid() != 0 or subprocess.run(mount, capture_output=True).returncode != 0:
            self.skipTest("no file system can be mounted here")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.grid([[(x * y * 7919) % 1009 for x in range(300)] for y in range(300)], "rough.asc", size=90)
        # Messages have to shorten the longer name, which must not keep them from saying it.
        for folder in (os.path.join(disk, "d"), os.path.join(disk, "d" * 150)):
            os.mkdir(folder)
            for name in ("o.exr", "o.tif", "o.png"):
                with open(os.path.join(folder, name), "w") as stream:
                    stream.write("before")
            for name in ("o.exr", "o.tif", "o.png"):
                path = os.path.join(folder, name)
                said = self.bad(1, name + ": ", "rough.asc", path,
                                "--save-scene", os.path.join(folder, "s.json"))
                self.assertLessEqual(len(said), 220)
                with open(path) as stream:
                    self.assertEqual(stream.read(), "before")
                self.assertEqual(sorted(os.listdir(folder)), ["o.exr", "o.png", "o.tif"])

    def start(self, *words):
        return subprocess.Popen(
            [PROGRAM, *words], cwd=self.folder, stderr=subprocess.PIPE, text=True
        )

    def waitForStaged(self, process, count):
        """Until so many outputs have passed their trial."""
        end = time.monotonic() + 60
        while len([n for n in os.listdir(self.folder) if n.endswith(".tmp" + os.path.splitext(n)[1])]) < count:
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    @needsGdal
    def test_signals(self):
        names = ["o.png", "o-normals.tif", "s.json"]
        for number in (signal.SIGINT, signal.SIGTERM):
            self.before(*names)
            process = self.start(
                JACKSBORO, "o.png", "--layers", "normals", "--save-scene", "s.json", *SLOW
            )
            self.waitForStaged(process, 2)
            process.send_signal(number)
            _, errors = process.communicate(timeout=120)
            self.assertEqual((process.returncode, errors), (130, "reliefshade: interrupted\n"))
            self.assertBefore(*names)

    @needsGdal
    def test_last_output_cannot_be_replaced(self):
        for names in ([], ["o.png"]):
            self.before(*names)
            steps = ("--integrator", "fixed-step", "--steps", "400")
            process = self.start(JACKSBORO, "o.png", "--layers", "normals", *steps)
            self.waitForStaged(process, 2)
            # Meanwhile a folder takes the place of the second.
            os.makedirs(self.path("o-normals.tif/full"))
            _, errors = process.communicate(timeout=120)
            self.assertEqual(process.returncode, 1, errors)
            self.assertIn("o-normals.tif: cannot be replaced", errors)
            shutil.rmtree(self.path("o-normals.tif"))
            self.assertBefore(*names)


if __name__ == "__main__":
    unittest.main()
