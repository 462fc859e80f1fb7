# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade says in one line what is wrong, ends with its code and leaves files alone."""

import os
import resource
import signal
import subprocess
import unittest

from Reliefshade import JACKSBORO, PROGRAM, Case, needsGdal, needsGdalTools, waitForHandler


class Usage(Case):
    def test_words(self):
        self.bad(2, "INPUT")
        self.bad(2, "OUTPUT", "a.tif")
        self.bad(2, "third.png", "a.tif", "b.png", "third.png")
        self.bad(2, ["--frobnicate", "unknown option"], "a.tif", "b.png", "--frobnicate")
        self.bad(2, "--ks", "a.tif", "b.png", "--ks")
        twice = self.bad(2, "--ks", "a.tif", "b.png", "--ks", "0", "--ks", "1")
        self.assertRegex(twice, "more than once|At most 1 required")  # the latter by CLI11 2.6

    def test_numbers(self):
        for option in ("--ks", "--kf", "--specular-power", "--scatter-power", "--depth",
                       "--density", "--floor", "--height-scale", "--tolerance", "--steps",
                       "--threads", "--band", "--nodata"):
            for value in ("x", "1x"):
                said = [option, "'%s' is not a number" % value]
                self.bad(2, said, "a.tif", "b.png", option, value)
        for value in ("", " 1", "1 2", "1,", "0x", "0x1", "0X1p2", "--kf"):
            self.bad(2, ["--ks", "'%s' is not a number" % value], "a.tif", "b.png", "--ks", value)
        for value in ("1e999", "-1e999"):
            said = ["--tolerance", "'%s' is too large a number" % value]
            self.bad(2, said, "a.tif", "b.png", "--tolerance", value)

    def test_whole_numbers(self):
        for option in ("--steps", "--threads", "--band", "--sun-samples"):
            self.bad(2, [option, "'1.5' is not a whole number"], "a.tif", "b.png", option, "1.5")
            for value in ("0", "-3", "99999999999"):
                said = self.bad(2, [option, "was given, "], "a.tif", "b.png", option, value)
                self.assertRegex(said, r"from 1 to \d+|\[1, \d+\]")
                self.assertIn(value[:5], said)

    def test_suggestions(self):
        for word, meant in (("--snu", "--sun"), ("--sunn", "--sun"), ("--Height-Scale", "--height-scale"),
                            ("--height-scal=2", "--height-scale"), ("--tolerence", "--tolerance"),
                            ("--help-al", "--help-all")):
            said = self.bad(2, [word, "unknown option"], "a.tif", "b.png", word)
            self.assertTrue(said.endswith("; did you mean %s?" % meant), said)
        for option, word, meant in (
            ("--integrator", "fixdstep", "fixed-step"), ("--offset", "norml", "normal"),
            ("--type", "floats", "float"), ("--preset", "skydom", "sky-dome"),
            ("--preset", "sun-and-ski,0,20", "sun-and-sky"), ("--layers", "normal", "normals"),
        ):
            said = self.bad(2, "'%s' is none of " % word, "a.tif", "b.png", option, word)
            self.assertTrue(said.endswith("; did you mean %s?" % meant), said)
        for words in (("--frobnicate",), ("--type", "none such"), ("--preset", "x")):
            self.assertNotIn("did you mean", self.bad(2, words[0], "a.tif", "b.png", *words))

    def test_long_words_are_shortened(self):
        """Whatever is long: a message has 200 characters, its beginning and its end are there."""
        self.hills()
        for long in ("a" * 50000, "\u00fc" * 30000, "a b " * 10000, "a/" * 20000 + "end.png"):
            for code, words in (
                (1, (long, "o.png")), (1, ("hills.asc", long + "/o.png")),
                (2, (long, long)), (2, ("hills.asc", "o.png", long)),
                (2, ("hills.asc", "o.png", "--" + long)),
                (2, ("hills.asc", "o.png", "--type", long)),
                (2, ("hills.asc", "o.png", "--layers", long)),
                (2, ("hills.asc", "o.png", "--sun", long)),
                (2, ("hills.asc", "o.png", "--ks", long)),
                (1, ("hills.asc", "o.png", "--scene", long)),
                (1, ("hills.asc", "o.png", "--tint", long)),
                (1, ("hills.asc", "o.png", "--texture", long)),
                (1, ("hills.asc", "o.png", "--mask", long)),
                (1, ("hills.asc", "o.png", "--env", long)),
            ):
                said = self.bad(code, "...", *words)
                self.assertLessEqual(len(said.encode()), 220, said)
                self.assertGreater(len(said), 60, said)
            self.assertNotIn("\ufffd", said)

    def test_lists(self):
        lists = {
            "--base": ("1,1", "1,1,1,1", "1,,1", "1,1,1,", "1;1;1", "a,b,c", "1,1,1x", "1,nan,1"),
            "--sun": ("315", "1,2,3,4", "1,2,3,4,5", "315,45 ", "315,45,", "inf,45"),
            "--point": ("1,2", "1,2,3,4,5", "1,2,z"),
            "--spacing": ("1,2,3", "m", "1x1", "1,inf"),
            "--specular-range": ("0", "0,1,2"),
        }
        for option, values in lists.items():
            for value in values:
                self.bad(2, option, "a.tif", "b.png", option, value)

    def test_ranges(self):
        for option, value in (
            ("--ks", "1.5"), ("--kf", "-0.1"), ("--depth", "-1"), ("--density", "-1"),
            ("--specular-power", "-1"), ("--scatter-power", "-1"), ("--specular-range", "1,0"),
            ("--scatter-range", "1,0"), ("--base", "-1,0,0"), ("--diffuse", "0,-1,0"),
            ("--specular", "0,0,-1"), ("--tolerance", "-1"), ("--steps", "0"),
            ("--steps", "1000001"), ("--sun-samples", "0"), ("--sun-samples", "4097"),
            ("--sun-diameter", "91"), ("--env-radius", "0"), ("--env-radius", "far"), ("--threads", "0"), ("--threads", "1.5"), ("--band", "0"),
            ("--spacing", "0"), ("--spacing", "1,-1"), ("--sun", "0,91"), ("--floor", "inf"), ("--height-scale", "nan"),
        ):
            self.bad(2, option, "a.tif", "b.png", option, value)

    def test_names(self):
        for option in ("--offset", "--attenuation", "--integrator", "--type", "--layers"):
            self.bad(2, [option, "'none such'"], "a.tif", "b.png", option, "none such")
        self.bad(2, ["--layers", "''"], "a.tif", "b.png", "--layers", "normals,")


class Input(Case):
    def bad_input(self, name, *fragments):
        self.bad(1, [name, *fragments], name, "out.png")
        self.assertFalse(os.path.exists(self.path("out.png")))

    def write(self, name, data):
        with open(self.path(name), "wb") as stream:
            stream.write(data)
        return name

    def test_no_file(self):
        self.bad_input("missing.tif")
        self.bad_input("missing.asc")
        os.mkdir(self.path("folder"))
        self.bad_input("folder", "is a directory")

    def test_other_files(self):
        self.write("text.tif", b"This is no picture, whatever its name says.\n" * 20)
        self.bad_input("text.tif")
        self.write("empty.tif", b"")
        self.bad_input("empty.tif")
        self.write("garbage.png", os.urandom(5000))
        self.bad_input("garbage.png")

    @needsGdalTools
    def test_truncated_tiff(self):
        self.tiff(JACKSBORO, "whole.tif")
        with open(self.path("whole.tif"), "rb") as stream:
            data = stream.read()
        for part in (0.9, 0.5, 0.01):
            self.write("part.tif", data[: int(len(data) * part)])
            self.bad_input("part.tif")

    def test_truncated_picture(self):
        self.png([[x * y % 65536 for x in range(300)] for y in range(300)], "whole.png")
        with open(self.path("whole.png"), "rb") as stream:
            data = stream.read()
        self.write("part.png", data[: len(data) // 2])
        self.bad_input("part.png")

    def test_damaged_grids(self):
        with open(self.path(self.hills())) as stream:
            text = stream.read()
        damages = {
            "short.asc": text[: len(text) - 40],
            "word.asc": text.replace(" 7 ", " seven ", 1),
            "header.asc": text.replace("nrows 12", "nrows -12"),
            "huge.asc": text.replace("nrows 12", "nrows 2000000000"),
            "long.asc": text + "1 2 3\n",
            "cell.asc": text.replace("cellsize 1", "cellsize 0"),
            "place.asc": text.replace("xllcorner", "xll"),
            "comma.asc": text.replace(" 7 ", " 7,5 ", 1).replace(" 6 ", " 6.5 ", 1),
            "null.asc": text.replace("cellsize 1", "cellsize 1\nNODATA_value null"),
            "wide.asc": text.replace(" 7 ", " " + "7,x," * 5000 + " ", 1),
            "twice.asc": "ncols 16\n" + text,
        }
        for name, damaged in damages.items():
            self.write(name, damaged.encode())
            self.bad_input(name)
            self.assertLess(len(self.bad(1, name, name, "out.png")), 200)

    def test_long_names(self):
        with open(self.path(self.hills())) as stream:
            text = stream.read()
        name = "name-" * 49
        contents = {
            ".png": b"no picture", ".exr": b"no picture", ".tif": b"II*\0" + bytes(60), ".jpg": b"\xff\xd8\xff\xe0" * 9,
            ".asc": text.replace(" 7 ", " seven ").encode(), ".hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n",
        }
        for extension, content in contents.items():
            self.write(name + extension, content)
            for words in ((name + extension, "o.png"), ("hills.asc", "o.png", "--texture", name + extension),
                          ("hills.asc", "o.png", "--env", name + extension)):
                if extension == ".asc" and "--texture" in words:
                    continue  # a grid of numbers may be a picture
                self.assertLess(len(self.bad(1, "name-", *words)), 210)
        self.assertLess(len(self.bad(1, "name-", name + ".none", "o.png")), 210)

    def test_colours(self):
        self.write("rgb.ppm", b"P6 4 4 255\n" + bytes(48))
        self.bad_input("rgb.ppm", "3 components; expected 1 (height)", "--band")
        self.bad(1, ["rgb.ppm", "band 4"], "rgb.ppm", "out.png", "--band", "4")

    def test_mask(self):
        self.hills()
        self.plane()
        self.bad(1, ["plane.asc", "8 x 8", "16 x 12"], "hills.asc", "o.png", "--mask", "plane.asc")
        self.bad(1, "missing.png", "hills.asc", "o.png", "--mask", "missing.png")


class Output(Case):
    def setUp(self):
        super().setUp()
        self.hills()

    def test_places(self):
        self.bad(1, ["none/out.png", "directory"], "hills.asc", "none/out.png")
        self.bad(1, ["none/out.tif", "directory"], "hills.asc", "none/out.tif")
        self.bad(1, "hills.asc/out.png", "hills.asc", "hills.asc/out.png")
        os.mkdir(self.path("folder.png"))
        self.bad(1, ["folder.png", "is a directory"], "hills.asc", "folder.png")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_folder_without_permission(self):
        os.mkdir(self.path("locked"))
        for name in ("locked/out.png", "locked/out.tif"):
            with open(self.path(name), "w") as stream:
                stream.write("before")
        os.chmod(self.path("locked"), 0o500)
        for name in ("locked/out.png", "locked/out.tif"):
            self.bad(1, name, "hills.asc", name)
            with open(self.path(name)) as stream:
                self.assertEqual(stream.read(), "before")
        os.chmod(self.path("locked"), 0o700)

    def test_formats(self):
        self.bad(1, ["out.none", "'.none'"], "hills.asc", "out.none")
        self.bad(1, ["out", "''"], "hills.asc", "out")
        self.bad(1, ["out.exr", "--type"], "hills.asc", "out.exr", "--type", "uint8")
        for name in ("out.jpg", "out.png"):
            self.bad(1, [name, "--type"], "hills.asc", name, "--type", "float")

    @needsGdal
    def test_full_disk_leaves_the_old_file(self):
        for name in ("out.png", "out.tif"):
            with open(self.path(name), "w") as stream:
                stream.write("before")

            def fewBytes():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

            self.bad(1, name, JACKSBORO, name, preexec_fn=fewBytes, restore_signals=False)
            with open(self.path(name)) as stream:
                self.assertEqual(stream.read(), "before")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "out.png", "out.tif"])

    @needsGdal
    def test_interrupt(self):
        for name in ("out.png", "out.tif"):
            with open(self.path(name), "w") as stream:
                stream.write("before")
            slow = ("--integrator", "fixed-step", "--steps", "20000")
            process = subprocess.Popen(
                [PROGRAM, JACKSBORO, name, *slow],
                cwd=self.folder, stderr=subprocess.PIPE, text=True,
            )
            waitForHandler(process, signal.SIGINT)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
            self.assertEqual((process.returncode, errors), (130, "reliefshade: interrupted\n"))
            with open(self.path(name)) as stream:
                self.assertEqual(stream.read(), "before")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "out.png", "out.tif"])


if __name__ == "__main__":
    unittest.main()
