# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade writes colour and layers into one OpenEXR file, for compositing."""

import math
import os
import re
import shutil
import unittest

from Reliefshade import Case, Picture, needsGdalTools

needsTools = unittest.skipUnless(
    shutil.which("oiiotool") and shutil.which("exrheader"),
    "needs openimageio-tools and openexr",
)

COLOUR = ["R", "G", "B", "A"]
ALL = COLOUR + ["%s.%s" % (layer, c) for layer, components in (
    ("Base", "RGB"), ("Diffuse", "RGB"), ("Scatter", "RGB"), ("Specular", "RGB"),
    ("Illumination", "Y"), ("Thickness", "Z"), ("Normals", "XYZ")) for c in components]
LOOK = ("--ks", "0.25", "--kf", "0.5", "--base", "0.1,0.2,0.3", "--sun", "300,40",
        "--sun", "90,-20,0.5", "--floor", "-3")


@needsTools
class Layers(Case):
    def setUp(self):
        super().setUp()
        self.hills(nodata=3, size=10, corner=(5000, 7000))

    def header(self, name):
        """The attributes of an OpenEXR file as exrheader prints them."""
        text = self.tool("exrheader", name)
        return dict(re.findall(r"^([\w:]+) \(type \w+\):? ?(.*)$", text, re.MULTILINE))

    def channels(self, name):
        return sorted(re.findall(r"^    ([\w.]+), (?:16|32)-bit", self.tool("exrheader", name),
                                 re.MULTILINE))

    def samples(self, name, channels):
        """Lists of samples, one for each channel, rows from the top."""
        self.tool("oiiotool", name, "--ch", ",".join(channels), "-o", "all.tif")
        return [self.values("all.tif", band + 1) for band in range(len(channels))]

    def test_one_file_alone(self):
        self.good("hills.asc", "--layers", "comp.exr")
        self.assertEqual(sorted(os.listdir(self.folder)), ["comp.exr", "hills.asc"])
        self.assertEqual(self.channels("comp.exr"), sorted(ALL))

    @needsGdalTools
    def test_layers_sum_to_the_colour(self):
        # Whether the picture is linear, 8 bit, or not wanted.
        for words in (["out.png"], ["out.exr"], []):
            self.good("hills.asc", *words, "--layers", "comp.exr", *LOOK)
            found = dict(zip(ALL, self.samples("comp.exr", ALL)))
            for c in "RGB":
                parts = zip(*(found["%s.%s" % (layer, c)]
                              for layer in ("Base", "Diffuse", "Scatter", "Specular")))
                for colour, summands in zip(found[c], parts):
                    self.assertAlmostEqual(colour, math.fsum(summands), delta=1e-6)
            self.assertGreater(max(found["Scatter.R"]), 0)
            self.assertGreater(max(found["Specular.R"]), 0)
            self.assertEqual(set(found["A"]), {0, 1})
            for name, values in found.items():
                self.assertTrue(all(value == 0 for value, a in zip(values, found["A"]) if a == 0))

    @needsGdalTools
    def test_colour_is_that_of_the_picture(self):
        self.good("hills.asc", "linear.exr", *LOOK)
        wanted = self.samples("linear.exr", COLOUR)
        for output in ("out.png", "out.exr"):
            self.good("hills.asc", output, "--layers", "comp.exr", *LOOK)
            for one, other in zip(self.samples("comp.exr", COLOUR), wanted):
                for a, b in zip(one, other):
                    self.assertAlmostEqual(a, b, delta=1e-6)
        self.assertEqual(Picture(self.path("out.png")), self.shade("hills.asc", *LOOK))

    def test_some_layers(self):
        self.good("hills.asc", "out.png", "--layers", "normals,base,a,b.exr")
        self.assertEqual(self.channels("a,b.exr"), sorted(
            COLOUR + ["Normals.X", "Normals.Y", "Normals.Z", "Base.R", "Base.G", "Base.B"]))
        self.good("hills.asc", "--layers", "thickness,../%s/T.EXR" % os.path.basename(self.folder))
        self.assertEqual(self.channels("T.EXR"), sorted(COLOUR + ["Thickness.Z"]))

    @needsGdalTools
    def test_metadata(self):
        self.tiff("hills.asc", "in.tif", "-a_srs", "EPSG:32611")
        self.good("in.tif", "--layers", "comp.exr", *LOOK, "--depth", "2.5", "--height-scale", "2")
        header = self.header("comp.exr")
        for name, value in {
            "relief:lights": "2", "relief:light1:azimuth": "300", "relief:light1:altitude": "40",
            "relief:light2:altitude": "-20", "relief:light2:intensity": "0.5",
            "relief:subsurfaceDepth": "2.5", "relief:specularCoefficient": "0.25",
            "relief:heightScale": "2", "relief:floorHeight": "-3",
            "geo:transform": '"5000 10 0 7120 0 -10"',
        }.items():
            self.assertEqual(header[name], value, name)
        self.assertIn('ID["EPSG",32611]', header["geo:crs"])
        self.assertIn("ReliefShading ", header["Software"])

        # A raster whose first row is the southern one: the file's is not.
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        self.grid(rows[::-1], "turned.asc", nodata=3)
        self.tiff("turned.asc", "south.tif", "-a_ullr", 5000, 7000, 5160, 7120)
        self.good("south.tif", "--layers", "turned.exr", *LOOK, "--depth", "2.5",
                  "--height-scale", "2")
        self.assertEqual(self.header("turned.exr")["geo:transform"], header["geo:transform"])
        self.assertEqual(self.samples("turned.exr", ALL), self.samples("comp.exr", ALL))
        self.good(self.png(rows, "plain.png"), "--quiet", "--layers", "plain.exr")
        self.assertNotIn("geo:transform", self.header("plain.exr"))

    def test_environment(self):
        self.png([[255, 40], [90, 10]], "sky.png")
        self.good("hills.asc", "--layers", "comp.exr", "--env", "sky.png")
        header = self.header("comp.exr")
        self.assertEqual(header["relief:environment:image"], '"file"')
        self.assertEqual(header["relief:environment:file"], '"sky.png"')
        # The mirrored picture is in no file.
        self.good("hills.asc", "--layers", "comp.exr", "--env", "sky.png", "--env-mirror")
        header = self.header("comp.exr")
        self.assertEqual(header["relief:environment:image"], '"userImage"')
        self.assertNotIn("relief:environment:file", header)
        self.good("hills.asc", "--layers", "comp.exr")
        self.assertNotIn("relief:environment:image", self.header("comp.exr"))

    @needsGdalTools
    def test_shadow_mask(self):
        sun = ("--sun", "300,9", "--floor", "-3", "--depth", "40")
        self.good("hills.asc", "mask.tif", "--quiet", "--layers", "shadow", *sun, "--shadow-mask",
                  "shadow.tif")
        share = self.values("mask-shadow.tif")
        codes, alpha = self.values("shadow.tif"), self.values("shadow.tif", 2)
        self.assertEqual({0, 1}, {value for value in share if not math.isnan(value)})
        self.assertEqual(list(codes),
                         [0 if math.isnan(value) else 255 * value for value in share])
        self.assertEqual(list(alpha), [0 if math.isnan(value) else 255 for value in share])
        self.assertEqual(self.info("shadow.tif")["geoTransform"],
                         self.info("mask.tif")["geoTransform"])
        # Nothing of the material matters; a width makes edges soft.
        self.good("hills.asc", "--shadow-mask", "alone.tif", "--sun", "300,9", "--ks", "1")
        self.assertEqual(self.values("alone.tif"), codes)
        self.good("hills.asc", "--shadow-mask", "soft.tif", "--sun", "300,9", "--sun-diameter", "8")
        self.assertTrue(any(0 < value < 255 for value in self.values("soft.tif")))
        self.good("hills.asc", "--shadow-mask", "value.tif", "--sun", "300,9", "--nodata-out",
                  "value")
        self.assertEqual(self.info("value.tif")["bands"][0]["noDataValue"], 0)
        self.good("hills.asc", "--shadow-mask", "a.png", "--sun", "300,9")
        self.assertEqual(self.values("a.png"), codes)

    def test_shadow_mask_refusals(self):
        self.bad(1, ["no sun is on"], "hills.asc", "--shadow-mask", "a.png", "--preset", "sky-dome")
        self.bad(2, ["--shadow-mask", "'a.exr'", "--layers shadow"],
                 "hills.asc", "--shadow-mask", "a.exr")
        self.bad(2, ["--shadow-mask"], "hills.asc", "o.png", "--shadow-mask", "./o.png")
        self.bad(2, ["INPUT"], "hills.asc", "--shadow-mask", "hills.asc")
        self.assertEqual(os.listdir(self.folder), ["hills.asc"])

    def test_refusals(self):
        self.bad(2, "OUTPUT", "hills.asc")
        self.bad(2, "OUTPUT", "hills.asc", "--layers", "normals")
        self.bad(2, ["--layers", "'comp.tif'", ".exr"], "hills.asc", "--layers", "comp.tif")
        self.bad(2, ["--layers", "'a.exr'"], "hills.asc", "o.png", "--layers", "a.exr,normals")
        self.bad(2, ["--layers", "o.exr: "], "hills.asc", "o.exr", "--layers", "o.exr")
        self.bad(2, ["--layers", "./o.exr"], "hills.asc", "o.exr", "--layers", "./o.exr")
        self.bad(1, ["none/a.exr", "directory"], "hills.asc", "--layers", "none/a.exr")
        os.mkdir(self.path("folder.exr"))
        self.bad(1, ["folder.exr", "is a directory"], "hills.asc", "--layers", "folder.exr")
        self.assertEqual(sorted(os.listdir(self.folder)), ["folder.exr", "hills.asc"])


if __name__ == "__main__":
    unittest.main()
