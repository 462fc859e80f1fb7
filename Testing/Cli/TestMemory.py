# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade on heights that do not fit into the memory it may take: the same pictures, from runs that
are stopped, too, and from several processes."""

import array
import os
import random
import re
import shutil
import signal
import subprocess
import time
import unittest

try:
    import resource
except ImportError:
    resource = None  # Windows has none

from Reliefshade import JACKSBORO, PROGRAM, Case, needsGdalTools

# Less than the heights, and enough for pieces of some rows.
MEMORY = ("--memory", "20M")
LESS = ("--memory", "24M")  # too, where holes and cliffs let a piece depend on more
PARTS = "tiles.tif.parts"


@needsGdalTools
class Memory(Case):
    SIZE = ("-r", "bilinear", "-outsize", "400%", "400%")

    def setUp(self):
        super().setUp()
        self.translate()

    def translate(self, *options):
        subprocess.run(["gdal_translate", "-q", *self.SIZE, *options, JACKSBORO, "a.tif"],
                       cwd=self.folder, check=True)

    def bytes_(self, name):
        with open(self.path(name), "rb") as stream:
            return stream.read()

    def pieces(self):
        return sorted(n for n in os.listdir(self.path(PARTS))
                      if n[0].isdigit()) if os.path.isdir(self.path(PARTS)) else []

    def assertSame(self, *words, names=("%s.tif",), heights="a.tif"):
        whole = self.good(heights, "whole.tif", *words)
        tiles = self.good(heights, "tiles.tif", *words, *MEMORY)
        self.assertEqual(tiles, whole)
        self.assertTrue(os.path.exists(self.path(heights + ".bounds.tif")), "it was shaded in pieces")
        for name in names:
            self.assertEqual(self.bytes_(name % "tiles"), self.bytes_(name % "whole"), words)
        self.assertFalse(os.path.exists(self.path(PARTS)))


class Pictures(Memory):
    def test_are_those_of_the_whole(self):
        with open(self.path("tint.txt"), "w") as stream:
            stream.write("0% 0 0 255\n50% 255 255 200\n100% 255 0 0\n")
        for words in ((), ("--sun", "300,1"), ("--sun", "200,5,2", "--depth", "200"),
                      ("--preset", "multidirectional", "--height-scale", "2"),
                      ("--preset", "sky-dome", "--exposure", "auto"), ("--tint", "tint.txt"),
                      ("--sun", "30,20", "--ks", "0.4", "--kf", "0.3", "--type", "float"),
                      ("--height-scale", "auto", "--quiet"), ("--co", "TILED=YES", "--compress", "zstd"),
                      ("--overviews", "--compress", "deflate")):
            self.assertSame(*words)

    def test_layers_and_masks(self):
        names = ("%s.tif", "%s-illumination.tif", "%s-normals.tif", "%s-thickness.tif")
        self.assertSame("--layers", "illumination,normals,thickness", "--sun", "300,10", names=names)
        self.good("a.tif", "whole.tif", "--shadow-mask", "m1.tif", "--sun", "300,5")
        self.good("a.tif", "tiles.tif", "--shadow-mask", "m2.tif", "--sun", "300,5", *MEMORY)
        self.assertEqual(self.bytes_("m1.tif"), self.bytes_("m2.tif"))

    @unittest.skipUnless(shutil.which("idiff"), "needs idiff of OpenImageIO")
    def test_openexr_in_tiles(self):
        words = ("--sun", "300,10", "--layers", "illumination,normals")
        self.good("a.tif", "whole.exr", *words)
        self.good("a.tif", "tiles.exr", *words, *MEMORY)
        self.assertTrue(os.path.exists(self.path("a.tif.bounds.tif")), "it was shaded in pieces")
        for name in ("%s.exr", "%s-illumination.exr", "%s-normals.exr"):
            # Compared as numbers; those that are none are in both.
            result = subprocess.run(["idiff", "-fail", "0", name % "whole", name % "tiles"],
                                    cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout)
        header = subprocess.run(["iinfo", "-v", "tiles.exr"], cwd=self.folder, capture_output=True,
                                text=True).stdout
        self.assertIn("tile size: 64 x 64", header)

    def attributes(self, name):
        """What the header of an OpenEXR file says, but for how it is stored."""
        text = self.tool("exrheader", name).replace(name, "")
        return [line for line in text.splitlines()
                if not re.match(r"file format version|type |tiles |tile size|tiled image|single level|level |rounding", line.strip())]

    @unittest.skipUnless(shutil.which("idiff") and shutil.which("exrheader"), "needs idiff and exrheader")
    def test_layers_in_one_file(self):
        look = ("--sun", "300,10", "--ks", "0.3", "--base", "0.1,0.2,0.3", "--verify", "20")
        south = ("-a_ullr", "5000", "7000", "21120", "20760", "-a_srs", "EPSG:32611")  # its first row
        for options, words in (((), ["%s.tif", "--layers", "%s-l.exr"]),
                               ((), ["--layers", "normals,thickness,%s-l.exr"]),
                               ((), ["%s.tif", "--type", "float", "--layers", "base,%s-l.exr"]),
                               (south, ["%s.tif", "--layers", "illumination,%s-l.exr"])):
            self.translate(*options)
            told = [self.good("a.tif", *(w.replace("%s", name) for w in words), *look, *memory)
                    for name, memory in (("w", ()), ("t", MEMORY))]
            self.assertEqual(told[0], told[1])
            self.assertTrue(os.path.exists(self.path("a.tif.bounds.tif")), "it was shaded in pieces")
            result = subprocess.run(["idiff", "-a", "-fail", "0", "w-l.exr", "t-l.exr"],
                                    cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertEqual(self.attributes("t-l.exr"), self.attributes("w-l.exr"))
            self.assertIn("tile size", self.tool("exrheader", "t-l.exr"))
            if "%s.tif" in words:
                self.assertEqual(self.bytes_("t.tif"), self.bytes_("w.tif"))
                self.assertEqual(sorted(n for n in os.listdir(self.folder) if "parts" in n), [])

    def test_grids_of_esri(self):
        self.tool("gdal_translate", "-q", "-of", "AAIGrid", "a.tif", "a.asc")
        self.assertSame("--sun", "300,20", heights="a.asc")
        # Points that are commas, and commas that part numbers.
        with open(self.path("a.asc")) as stream:
            lines = stream.read().splitlines()
        head = next(k for k, line in enumerate(lines) if line.split()[0] == "cellsize") + 1
        head += lines[head].lower().startswith("nodata")
        for name, old, new in (("commas.asc", ".", ","), ("parted.asc", " ", ", ")):
            with open(self.path(name), "w") as stream:
                stream.write("\n".join(lines[:head] + [line.strip().replace(old, new) + ("," if new == ", " else "")
                                                       for line in lines[head:]])[:-1 if new == ", " else None])
            shutil.copy(self.path("a.prj"), self.path(name.replace(".asc", ".prj")))
            self.good(name, "tiles.tif", "--sun", "300,20", *MEMORY)
            self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"), name)
        # A mark before the text, with which GDAL does not know it.
        with open(self.path("marked.asc"), "w", encoding="utf-8-sig") as stream:
            stream.write("\n".join(lines))
        shutil.copy(self.path("a.prj"), self.path("marked.prj"))
        self.good("marked.asc", "tiles.tif", "--sun", "300,20", *MEMORY)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
        self.assertTrue(os.path.exists(self.path("marked.asc.bounds.tif")))
        # A word that is no number is told by its line, as of the whole.
        lines[head + 700] = lines[head + 700].replace(" ", " x", 3)
        with open(self.path("wrong.asc"), "w") as stream:
            stream.write("\n".join(lines))
        said = [self.bad(1, "line %d" % (head + 701), "wrong.asc", "o.tif", *words) for words in ((), MEMORY)]
        self.assertEqual(said[0], said[1])

    def test_heights_in_three_bytes(self):
        size = self.info("a.tif")["size"]
        heights = self.values("a.tif")
        for encoding, code in (("terrarium", lambda h: int((h + 32768) * 256)),
                               ("terrain-rgb", lambda h: int((h + 10000) * 10))):
            with open(self.path("rgb.ppm"), "wb") as stream:
                stream.write(b"P6 %d %d 255\n" % tuple(size))
                stream.write(b"".join(code(h).to_bytes(3, "big") for h in heights))
            name = encoding + ".tif"
            self.tool("gdal_translate", "-q", "-a_ullr", "0", "13760", "16120", "0", "-a_srs", "EPSG:32611",
                      "rgb.ppm", name)
            self.assertSame("--encoding", encoding, "--sun", "300,15", heights=name)
        # Bounds are not those of another reading.
        self.good(name, "whole.tif", "--encoding", "terrarium", "--quiet")
        self.good(name, "tiles.tif", "--encoding", "terrarium", "--quiet", *MEMORY)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))

    def test_undeclared_no_data(self):
        sun = ("--sun", "300,85")  # a high one, for what is taken for a height would throw long shadows
        # 0 lies far from all others where these are high.
        for value, rows, kinds, scale in (
                ("-9999", range(700, 720), ("Float32", "asc"), ()), ("99999", range(1300, 1302), ("Int32",), ()),
                ("0", range(0, 30), ("Int16",), ("-scale", "0", "1000", "5000", "5300"))):
            self.tool("gdal_translate", "-q", "-of", "AAIGrid", *scale, "a.tif", "b.asc")
            with open(self.path("b.asc")) as stream:
                lines = stream.read().splitlines()
            head = next(k for k, line in enumerate(lines) if line.split()[0] == "cellsize") + 1
            head += lines[head].lower().startswith("nodata")
            kept = [line for line in lines[:head] if not line.lower().startswith("nodata")]
            text = list(lines)
            for row in rows:
                words = text[head + row].split()
                text[head + row] = " ".join([value] * 40 + words[40:])
            with open(self.path("b.asc"), "w") as stream:
                stream.write("\n".join(kept + text[head:]) + "\n")
            for kind in kinds:
                name = "b.asc" if kind == "asc" else "b.tif"
                if kind != "asc":
                    self.tool("gdal_translate", "-q", "-ot", kind, "b.asc", name)
                whole = self.run_(name, "whole.tif", *sun)
                self.assertIn(" %s in %d of " % (value, 40 * len(rows)), whole.stderr)
                for _ in range(2):  # by a pass, then by what it has kept
                    tiles = self.run_(name, "tiles.tif", *sun, *LESS)
                    self.assertEqual((tiles.returncode, tiles.stderr), (whole.returncode, whole.stderr))
                    self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
                self.assertTrue(os.path.exists(self.path(name + ".bounds.tif")))
                self.good(name, "tiles.tif", "--nodata", "none", *sun, *LESS)
                self.good(name, "tiles.tif", "--nodata", value, *sun, *LESS)

    def test_verification(self):
        # A part without data, in which samples are drawn in vain.
        self.tool("gdal_translate", "-q", "-ot", "Int16", "a.tif", "i.tif")
        self.tool("gdal_translate", "-q", "-a_nodata", "282", "i.tif", "n.tif")
        for heights in ("a.tif", "n.tif"):
            self.assertSame("--verify", "300,5", "--sun", "300,8", heights=heights)
        self.assertSame("--verify", "40", "--preset", "sky-dome")
        told = [self.good("a.tif", "--verify", "10,3", *words) for words in ((), MEMORY)]
        self.assertIn("verified: 10 samples, seed 3", told[0])
        self.assertEqual(told[0], told[1])
        self.assertEqual([n for n in os.listdir(self.folder) if n.endswith(".parts")], [])

    def test_verification_where_few_have_data(self):
        self.tool("gdal_translate", "-q", "-ot", "Byte", "-scale", "280", "300", "1", "0", "a.tif", "few.tif")
        self.good("a.tif", "whole.tif", "--mask", "few.tif")  # that there are any
        told = [self.good("a.tif", "--mask", "few.tif", "--verify", "30000,2", "--sun", "300,30", *words)
                for words in ((), LESS)]
        self.assertEqual(told[0], told[1])

    def test_a_mask_that_is_given(self):
        subprocess.run(["gdal_translate", "-q", "-ot", "Byte", "-scale", "300", "700", "0", "4", "a.tif",
                        "mask.tif"], cwd=self.folder, check=True)
        self.assertSame("--mask", "mask.tif", "--sun", "300,10")

    def test_numbers_of_any_type_and_layout(self):
        for options in (("-ot", "Int16"), ("-ot", "Float64"), ("-ot", "UInt16", "-a_nodata", "282"),
                        ("-ot", "Int32", "-scale", "0", "1000", "1000000", "1001000"),
                        ("-co", "TILED=YES", "-co", "COMPRESS=DEFLATE"), ("-of", "VRT")):
            name = "a.vrt" if "VRT" in options else "a.tif"
            if name == "a.vrt":
                shutil.move(self.path("a.tif"), self.path("b.tif"))
                subprocess.run(["gdal_translate", "-q", "-of", "VRT", "b.tif", "a.tif"],
                               cwd=self.folder, check=True)
            else:
                self.translate(*options)
            self.assertSame("--sun", "300,60")

    def test_memory_does_not_matter_nor_do_threads(self):
        self.good("a.tif", "whole.tif", "--sun", "300,8")
        for words in (("--memory", "14M"), ("--memory", "17000K", "--threads", "1"), ("--memory", "20.5m")):
            self.good("a.tif", "tiles.tif", "--sun", "300,8", *words)
            self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"), words)

    def test_several_times(self):
        frames = ("--quiet", "--frames", "2026-06-21T10:00-06:00,2026-06-21T14:00-06:00,2h")
        self.good("a.tif", "w.tif", *frames)
        self.good("a.tif", "t.tif", *frames, *MEMORY)
        whole = sorted(n for n in os.listdir(self.folder) if n.startswith("w"))
        self.assertEqual(len(whole), 3)
        for name in whole:
            self.assertEqual(self.bytes_("t" + name[1:]), self.bytes_(name), name)

    def test_bounds_are_kept_beside_the_raster(self):
        self.good("a.tif", "tiles.tif", *MEMORY)
        kept = self.bytes_("a.tif.bounds.tif")
        self.good("a.tif", "tiles.tif", *MEMORY, "--sun", "100,20")
        self.assertEqual(self.bytes_("a.tif.bounds.tif"), kept)
        # Those that are damaged are made anew, those of another raster, too.
        with open(self.path("a.tif.bounds.tif"), "r+b") as stream:
            stream.seek(len(kept) // 2)
            stream.write(bytes([kept[len(kept) // 2] ^ 1]))
        self.assertSame("--sun", "100,20")
        # A file of that name that is somebody else's stays.
        with open(self.path("a.tif.bounds.tif"), "w") as stream:
            stream.write("mine")
        self.assertSame("--sun", "100,20")
        self.assertEqual(self.bytes_("a.tif.bounds.tif"), b"mine")


class Stopped(Memory):
    WORDS = ("--sun", "300,3", "--preset", "sky-dome")

    def start(self, *words):
        return subprocess.Popen([PROGRAM, "a.tif", "tiles.tif", *self.WORDS, *MEMORY, *words],
                                cwd=self.folder, stderr=subprocess.PIPE, text=True)

    def stopAfter(self, pieces, number=signal.SIGKILL):
        """Starts a run and stops it when so many pieces are there."""
        process = self.start()
        end = time.monotonic() + 300
        while len(self.pieces()) < pieces and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        process.send_signal(number)
        process.wait()
        process.stderr.close()
        return process.returncode

    def rays(self, *words):
        result = self.run_("a.tif", "tiles.tif", *self.WORDS, *MEMORY, "--statistics", *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return int(next(line for line in result.stdout.splitlines()
                        if line.startswith("rays-traced")).split()[1])

    def test_goes_on_where_it_was(self):
        self.good("a.tif", "whole.tif", *self.WORDS)
        all_ = self.rays()
        os.remove(self.path("tiles.tif"))
        if self.stopAfter(3) != -signal.SIGKILL:
            self.skipTest("it was done before it could be stopped")
        self.assertFalse(os.path.exists(self.path("tiles.tif")))
        self.assertGreaterEqual(len(self.pieces()), 3)
        self.assertLess(self.rays(), all_)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
        self.assertFalse(os.path.exists(self.path(PARTS)))

    def test_killed_at_any_moment(self):
        self.good("a.tif", "whole.tif", *self.WORDS)
        begin = time.monotonic()
        self.good("a.tif", "tiles.tif", *self.WORDS, *MEMORY)
        took = time.monotonic() - begin
        seed = random.randrange(1 << 30)
        print("seed", seed)
        moments = random.Random(seed)
        with open(self.path("tiles.tif"), "w") as stream:
            stream.write("before")
        for _ in range(10):
            process = self.start()
            time.sleep(moments.uniform(0.0, took / 3))
            process.kill()
            process.wait()
            process.stderr.close()
            self.assertIn(self.bytes_("tiles.tif"), (b"before", self.bytes_("whole.tif")))
        self.good("a.tif", "tiles.tif", *self.WORDS, *MEMORY)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
        left = [n for n in os.listdir(self.folder) if n.startswith(".") and "before" in n]
        self.assertEqual(left, [])

    def test_verified_where_it_goes_on(self):
        whole = self.good("a.tif", "whole.tif", *self.WORDS, "--verify", "60")
        process = self.start("--verify", "60")
        end = time.monotonic() + 300
        while len(self.pieces()) < 3 and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        process.kill()
        process.wait()
        process.stderr.close()
        if process.returncode == 0:
            self.skipTest("it was done before it could be stopped")
        tiles = self.good("a.tif", "tiles.tif", *self.WORDS, *MEMORY, "--verify", "60")
        self.assertEqual(tiles, whole)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))

    def test_interrupted(self):
        code = self.stopAfter(2, signal.SIGINT)
        if code == 0:
            self.skipTest("it was done before it could be stopped")
        self.assertIn(code, (130, -signal.SIGINT))
        self.assertFalse(os.path.exists(self.path("tiles.tif")))
        self.good("a.tif", "tiles.tif", *self.WORDS, *MEMORY)

    def prepare(self):
        if self.stopAfter(3) == 0:
            self.skipTest("it was done before it could be stopped")
        return self.pieces()

    def test_a_damaged_piece_is_made_again(self):
        self.good("a.tif", "whole.tif", *self.WORDS)
        piece = self.path(os.path.join(PARTS, self.prepare()[0]))
        name = next(os.path.join(piece, n) for n in os.listdir(piece))
        with open(name, "r+b") as stream:
            stream.seek(os.path.getsize(name) // 2)
            stream.write(b"damage")
        result = self.run_("a.tif", "tiles.tif", *self.WORDS, *MEMORY)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("is damaged", lines[0])
        self.assertIn("shaded again", lines[0])
        self.assertLessEqual(len(lines[0]), 240)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))

    def test_another_run_is_refused(self):
        pieces = self.prepare()
        said = self.bad(1, [PARTS, "another run"], "a.tif", "tiles.tif", "--sun", "100,30", *MEMORY)
        self.assertIn("remove", said)
        self.assertEqual(self.pieces(), pieces)

    def test_a_raster_that_has_changed_is_refused(self):
        pieces = self.prepare()
        with open(self.path("a.tif"), "r+b") as stream:
            stream.seek(os.path.getsize(self.path("a.tif")) // 2)
            stream.write(bytes(8))
        self.bad(1, [PARTS, "heights"], "a.tif", "tiles.tif", *self.WORDS, *MEMORY)
        self.assertEqual(self.pieces(), pieces)

    def test_two_runs_at_once(self):
        first = self.start("--threads", "1")
        end = time.monotonic() + 300
        while not self.pieces() and first.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        second = self.run_("a.tif", "tiles.tif", *self.WORDS, *MEMORY)
        _, said = first.communicate()
        self.assertEqual((first.returncode, said), (0, ""))
        if second.returncode != 0:  # else it came when the first one was done
            self.assertIn("another run is writing", second.stderr)
        self.good("a.tif", "whole.tif", *self.WORDS)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))

    @unittest.skipUnless(resource, "needs limits of resources")
    def test_a_full_disk(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (8000, 8000))

        said = self.bad(1, [PARTS, "cannot be written"], "a.tif", "tiles.tif", *self.WORDS, *MEMORY, preexec_fn=limit)
        self.assertLessEqual(len(said), 240)
        self.assertFalse(os.path.exists(self.path("tiles.tif")))
        self.good("a.tif", "tiles.tif", *self.WORDS, *MEMORY)


class Errors(Memory):
    def test_words(self):
        for word in ("0", "-5M", "M", "4X", "four", "1e999", "nan", "4MM"):
            self.bad(2, ["--memory", "a number of bytes"], "a.tif", "o.tif", "--memory=" + word)

    def test_too_little(self):
        self.bad(1, ["--memory", "give at least"], "a.tif", "o.tif", "--memory", "40K")
        self.assertFalse(os.path.exists(self.path("o.tif.parts")))

    def test_formats_that_are_written_as_a_whole(self):
        self.good("a.tif", "whole.png")
        self.good("a.tif", "tiles.png", "--memory", "20M")
        self.assertEqual(self.bytes_("tiles.png"), self.bytes_("whole.png"))
        self.bad(1, ["--memory", "kept", "TIFF or OpenEXR"], "a.tif", "o.png", "--memory", "10M")

    def test_what_needs_all_heights(self):
        for words in (("--smooth-steps",), ("--accuracy-report", "r.csv")):
            said = self.bad(1, [words[0], "all heights in memory"], "a.tif", "o.tif", *words, *MEMORY)
            self.assertIn("--memory", said)

    def test_a_limit_alone_refuses(self):
        self.bad(1, "--memory-limit", "a.tif", "o.tif", "--memory-limit", "1")
        self.good("a.tif", "o.tif", "--memory-limit", "1", *MEMORY)

    def test_what_fits_is_no_run_of_pieces(self):
        self.good("a.tif", "o.tif", "--memory", "1G")
        self.assertFalse(os.path.exists(self.path("a.tif.bounds.tif")))


class Beyond(Memory):
    """Runs that even small pieces have too many heights for."""

    LOW = ("--sun", "300,3", "--layers", "illumination")
    LITTLE = ("--memory", "11M")
    BOUNDS = ("--beyond-memory", "bounds")

    def statistics_(self, *words):
        result = self.run_("a.tif", "tiles.tif", *self.LOW, *self.LITTLE, *self.BOUNDS, "--statistics", *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return dict(line.split(": ", 1) for line in result.stdout.splitlines()), result.stderr

    def values(self, name):
        subprocess.run(["gdal_translate", "-q", "-of", "ENVI", name, name + ".raw"], cwd=self.folder, check=True)
        values = array.array("f")
        values.frombytes(self.bytes_(name + ".raw"))
        return values

    def tolerance(self):
        """The least that the run may have, as it is told."""
        said = self.bad(1, ["--beyond-memory", "uncertain by", "give --memory"], "a.tif", "tiles.tif", *self.LOW,
                        *self.LITTLE, *self.BOUNDS, "--tolerance", "0.0001")
        shutil.rmtree(self.path(PARTS))
        return said.rsplit("--tolerance ", 1)[1]

    def test_refused_unless_asked_for(self):
        for words in ((), ("--beyond-memory", "refuse")):
            self.bad(1, ["--memory", "give at least"], "a.tif", "tiles.tif", *self.LOW, *self.LITTLE, *words)
        self.bad(2, "--beyond-memory", "a.tif", "tiles.tif", "--beyond-memory", "more")
        self.bad(1, ["--memory", "none can be left out"], "a.tif", "tiles.tif", *self.LOW, *self.BOUNDS,
                 "--memory", "1M")

    def test_within_the_tolerance(self):
        told = self.tolerance()
        tolerance = "0.001"
        self.assertLess(0.0001, float(told))
        self.assertLess(float(told), float(tolerance))
        result = self.run_("a.tif", "tiles.tif", *self.LOW, *self.LITTLE, *self.BOUNDS, "--tolerance", tolerance)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("bounds only", result.stderr)
        found, said = self.statistics_("--tolerance", tolerance, "--quiet")
        self.assertEqual(said, "")
        taken = float(found["tolerance-taken"])
        self.assertLessEqual(taken, float(tolerance))
        self.assertGreater(taken, 0.0)
        self.assertGreater(int(found["pieces-by-bounds"]), 0)
        self.good("a.tif", "whole.tif", *self.LOW, "--tolerance", "0")
        off = [abs(a - b) for a, b in zip(self.values("tiles-illumination.tif"),
                                          self.values("whole-illumination.tif")) if a == a]
        self.assertLessEqual(max(off), float(tolerance) + 1e-3)
        # Threads do not matter, nor whether a run was stopped; and what was told is told again.
        kept = self.bytes_("tiles.tif"), self.bytes_("tiles-illumination.tif")
        again, _ = self.statistics_("--tolerance", tolerance, "--threads", "1")
        self.assertEqual((self.bytes_("tiles.tif"), self.bytes_("tiles-illumination.tif")), kept)
        self.assertEqual(again["tolerance-taken"], found["tolerance-taken"])
        process = subprocess.Popen([PROGRAM, "a.tif", "tiles.tif", *self.LOW, *self.LITTLE, *self.BOUNDS,
                                    "--tolerance", tolerance, "--quiet"], cwd=self.folder)
        end = time.monotonic() + 300
        while len(self.pieces()) < 5 and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        process.kill()
        process.wait()
        self.assertGreaterEqual(len(self.pieces()), 5)
        # Those pieces are of another memory.
        self.bad(1, [PARTS, "another run"], "a.tif", "tiles.tif", *self.LOW, *self.BOUNDS, "--tolerance", tolerance,
                 "--memory", "11500K")
        resumed, _ = self.statistics_("--tolerance", tolerance)
        self.assertEqual((self.bytes_("tiles.tif"), self.bytes_("tiles-illumination.tif")), kept)
        self.assertEqual({k: resumed[k] for k in ("pieces-by-bounds", "tolerance-taken")},
                         {k: found[k] for k in ("pieces-by-bounds", "tolerance-taken")})

    def test_what_knows_no_tolerance(self):
        self.bad(1, ["--beyond-memory", "no tolerance", "give --memory"], "a.tif", "tiles.tif", *self.LITTLE,
                 *self.BOUNDS, "--sun", "300,1.5", "--tolerance", "1", "--layers", "thickness")

    def test_verified(self):
        said = self.run_("a.tif", "tiles.tif", *self.LOW, *self.LITTLE, *self.BOUNDS, "--tolerance", "0.001",
                         "--verify", "100")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("bounds only", said.stderr)
        self.assertIn("100 samples", said.stdout)

    def test_tiles_know_the_memory(self):
        words = ("a.tif", "--xyz", "tiles", "--zoom", "9", "--quiet", *self.LOW[:2], *self.BOUNDS,
                 "--tolerance", "0.01")
        self.good(*words, "--memory", "11M")
        self.bad(1, ["tiles", "another run", "heights by bounds"], *words, "--memory", "11500K")
        self.good(*words, "--memory", "11264K")  # as much as the first

    def test_nothing_is_left_out_of_what_fits(self):
        self.assertSame("--sun", "300,8", *self.BOUNDS)


@unittest.skipUnless(shutil.which("mpirun"), "needs mpirun")
class Processes(Memory):
    ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1",
                       PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe",  # Open MPI 5
                       OMPI_MCA_btl_vader_single_copy_mechanism="none")

    def mpi(self, count, *words):
        done = subprocess.run(["mpirun", "-np", str(count), PROGRAM, *words], cwd=self.folder,
                              env=self.ENVIRONMENT, capture_output=True, text=True, timeout=500)
        # Open MPI may have something to say of the machine itself.
        done.stderr = "".join(line for line in done.stderr.splitlines(True)
                              if line.startswith("reliefshade:"))
        return done

    def setUp(self):
        super().setUp()
        works = subprocess.run(["mpirun", "-np", "2", "true"], env=self.ENVIRONMENT, capture_output=True)
        if works.returncode != 0:
            self.skipTest("mpirun starts nothing here")
        result = self.mpi(2, "a.tif", "tiles.tif", *MEMORY)
        if "without MPI" in result.stderr:
            self.skipTest("built without MPI")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_the_same_picture(self):
        words = ("--sun", "300,5", "--layers", "illumination")
        self.good("a.tif", "whole.tif", *words)
        for count in (1, 2, 4):
            result = self.mpi(count, "a.tif", "tiles.tif", *words, *MEMORY)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
            for name in ("%s.tif", "%s-illumination.tif"):
                self.assertEqual(self.bytes_(name % "tiles"), self.bytes_(name % "whole"), count)
            self.assertFalse(os.path.exists(self.path(PARTS)))

    def test_the_same_beyond_memory(self):
        words = (*Beyond.LOW, *Beyond.LITTLE, *Beyond.BOUNDS, "--tolerance", "0.001", "--verify", "50")
        whole = self.run_("a.tif", "whole.tif", *words)
        self.assertIn("bounds only", whole.stderr)
        result = self.mpi(3, "a.tif", "tiles.tif", *words)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, whole.stdout, whole.stderr))
        for name in ("%s.tif", "%s-illumination.tif"):
            self.assertEqual(self.bytes_(name % "tiles"), self.bytes_(name % "whole"))

    @unittest.skipUnless(shutil.which("idiff"), "needs idiff of OpenImageIO")
    def test_layers_in_one_file(self):
        words = ("--sun", "300,10", "--layers", "illumination,base,%s.exr", "--verify", "20")
        whole = self.good("a.tif", "whole.tif", *(w.replace("%s", "w") for w in words))
        result = self.mpi(3, "a.tif", "tiles.tif", *(w.replace("%s", "t") for w in words), *MEMORY)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, whole, ""))
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
        compared = subprocess.run(["idiff", "-a", "-fail", "0", "w.exr", "t.exr"], cwd=self.folder,
                                  capture_output=True, text=True)
        self.assertEqual(compared.returncode, 0, compared.stdout)

    def test_one_of_them_killed(self):
        words = ("--preset", "sky-dome")
        self.good("a.tif", "whole.tif", *words)
        os.remove(self.path("tiles.tif"))
        process = subprocess.Popen(["mpirun", "-np", "2", PROGRAM, "a.tif", "tiles.tif", *words, *MEMORY],
                                   cwd=self.folder, env=self.ENVIRONMENT, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 300
        while len(self.pieces()) < 2 and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True)
        for child in children.stdout.split()[:1]:
            os.kill(int(child), signal.SIGKILL)
        if process.wait() == 0:
            self.skipTest("it was done before it could be stopped")
        self.assertFalse(os.path.exists(self.path("tiles.tif")))
        result = self.mpi(2, "a.tif", "tiles.tif", *words, *MEMORY)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))

    def test_one_message(self):
        result = self.mpi(3, "a.tif", "o.tif", "--sun", "north")
        self.assertNotEqual(result.returncode, 0)
        said = [line for line in result.stderr.splitlines() if line.startswith("reliefshade:")]
        self.assertEqual(len(said), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
