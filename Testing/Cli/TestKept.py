# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade writes over nothing that it reads, and no output over another, whatever the names."""

import gzip
import os
import tarfile
import unittest
import zipfile

from Reliefshade import Case, needsGdal, needsGdalTools


class Kept(Case):
    def contents(self):
        """Every file and link of the folder, byte for byte."""
        found = {}
        for folder, _, names in os.walk(self.folder):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as stream:
                    found[os.path.relpath(path, self.folder)] = (os.path.islink(path), stream.read())
        return found

    def refused(self, name, *words, role=""):
        """A run that would write over `name` is refused, and the folder is as before."""
        before = self.contents()
        said = self.bad(2, [name + ": ", "would replace", role, "; choose another name"], *words)
        self.assertLessEqual(len(said), 200)
        self.assertEqual(self.contents(), before)

    def heights(self, name):
        """Heights in a file of that name: one that can be read and written under it."""
        return self.hills() if name.endswith(".asc") else self.png(
            [[x * y for x in range(16)] for y in range(12)], name)


class Inputs(Kept):
    def test_heights(self):
        self.heights("a.png")
        for same in ("a.png", "./a.png", "../%s/a.png" % os.path.basename(self.folder),
                     self.path("a.png"), self.folder + "//a.png"):
            self.refused(same, "a.png", same, role="INPUT")
            self.refused(same, "a.png", "o.png", "--save-scene", same, role="--save-scene")
        self.refused("a.png", "./a.png", "a.png")

    @needsGdalTools
    def test_georeferenced_heights(self):
        self.tiff(self.hills(), "a.tif", "-a_srs", "EPSG:32632")
        self.refused("a.tif", "a.tif", "a.tif", role="INPUT")
        self.refused("a.tif", "a.tif", "o.tif", "--save-scene", "a.tif", role="INPUT")

    def test_layers(self):
        os.rename(self.path(self.heights("a.png")), self.path("a-normals.tif"))
        self.refused("a-normals.tif", "a-normals.tif", "a.png", "--layers", "base,normals")
        os.rename(self.path("a-normals.tif"), self.path("a.exr"))
        self.refused("a.exr", "a.exr", "--layers", "./a.exr", role="--layers")
        self.refused("a.exr", "a.exr", "o.png", "--layers", "a.exr", role="--layers")

    def test_links(self):
        self.heights("a.png")
        os.mkdir(self.path("deep"))
        os.symlink("../a.png", self.path("deep/link.png"))
        os.symlink("deep/link.png", self.path("far.png"))
        os.symlink(self.folder, self.path("deep/folder"))
        os.link(self.path("a.png"), self.path("hard.png"))
        for name in ("deep/link.png", "far.png", "deep/folder/a.png", "deep/folder/deep/../a.png",
                     "hard.png"):
            self.refused(name, "a.png", name, role="a.png, which is INPUT")
            self.refused("a.png", name, "a.png", role=name + ", which is INPUT")

    def test_other_inputs(self):
        hills = self.hills()
        self.ppm([[(9, 8, 7)]], "a.ppm")
        self.png([[1] * 16] * 12, "mask.png")
        with open(self.path("tint.png"), "w") as stream:
            stream.write("0 0 0 0\n100% 255 255 255\n")
        for option, name in (("--mask", "mask.png"), ("--env", "a.ppm"), ("--texture", "a.ppm"),
                             ("--base-texture", "a.ppm"), ("--specular-texture", "a.ppm"),
                             ("--tint", "tint.png")):
            words = (hills, "o.png", option, name)
            self.good(*words)
            os.remove(self.path("o.png"))
            self.refused("./" + name, hills, "./" + name, option, name, role=option)
            self.refused(name, *words, "--save-scene", name, role=option)

    def test_scenes(self):
        hills = self.hills()
        self.ppm([[(9, 8, 7)]], "sky.ppm")
        self.good(hills, "o.png", "--env", "sky.ppm", "--save-scene", "s.json")
        words = (hills, "o.png", "--scene", "s.json")
        self.refused("s.json", *words, "--save-scene", "s.json", role="--scene")
        self.refused("sky.ppm", *words, "--save-scene", "sky.ppm", role="the environment of --scene")
        self.refused("sky.ppm", hills, "sky.ppm", "--scene", "s.json")

    @needsGdal
    def test_archives(self):
        self.hills()
        with zipfile.ZipFile(self.path("a.zip"), "w") as archive:
            archive.write(self.path("hills.asc"), "in/hills.asc")
        with tarfile.open(self.path("a.tgz"), "w:gz") as archive:
            archive.add(self.path("hills.asc"), "hills.asc")
        with open(self.path("hills.asc"), "rb") as plain, gzip.open(self.path("a.gz"), "w") as packed:
            packed.write(plain.read())
        for name, source in (("a.zip", "/vsizip/a.zip/in/hills.asc"),
                             ("a.zip", "/vsizip/%s/in/hills.asc" % self.path("a.zip")),
                             ("a.zip", "/vsizip/{a.zip}/in/hills.asc"),
                             ("a.tgz", "/vsitar/a.tgz/hills.asc"), ("a.gz", "/vsigzip/a.gz"),
                             ("hills.asc", "vrt://hills.asc?bands=1")):
            words = (source, "o.png")
            if not source.startswith("vrt"):  # which GDAL before 3.1 does not know
                self.good(*words)
            self.refused(name, *words, "--save-scene", name, role=source)
            for extension in (".png", ".exr"):
                copy = name + extension
                os.rename(self.path(name), self.path(copy))
                self.refused(copy, source.replace(name, copy), copy)
                os.rename(self.path(copy), self.path(name))

    def test_files_beside(self):
        self.heights("a.png")
        for name in ("a.pgw", "a.pngw", "a.wld", "A.PGW", "a.png.aux.xml", "a.aux.xml", "a.prj"):
            with open(self.path(name), "w") as stream:
                stream.write("1\n0\n0\n-1\n0\n0\n")
            self.refused(name, "a.png", "o.png", "--save-scene", name, role="a file of a.png")
            os.remove(self.path(name))

    @needsGdal
    def test_header_of_raw_heights(self):
        with open(self.path("a.flt"), "wb") as stream:
            stream.write(bytes(4 * 16 * 12))
        with open(self.path("a.hdr"), "w") as stream:
            stream.write("ncols 16\nnrows 12\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                         "byteorder LSBFIRST\n")
        self.good("a.flt", "o.png")
        self.refused("a.hdr", "a.flt", "a.hdr", role="a file of a.flt")
        # Beside it a picture of Radiance may be replaced: it has no part in the heights.
        self.heights("b.png")
        for _ in range(2):
            self.good("b.png", "b.hdr", "--height-scale", "1")

    @needsGdalTools
    def test_sources_of_virtual_rasters(self):
        self.tiff(self.hills(), "a.tif", "-a_srs", "EPSG:32632")
        self.tool("gdal_translate", "-q", "-of", "VRT", "a.tif", "a.vrt")
        self.tool("gdal_translate", "-q", "-of", "VRT", "a.vrt", "b.vrt")
        for source in ("a.vrt", "b.vrt"):
            self.refused("a.tif", source, "a.tif", role="a file of " + source)
            self.refused("a.tif", "hills.asc", "a.tif", "--texture", source, role="--texture")
        with zipfile.ZipFile(self.path("a.zip"), "w") as archive:
            archive.write(self.path("hills.asc"), "hills.asc")
        self.tool("gdal_translate", "-q", "-of", "VRT", "/vsizip/a.zip/hills.asc", "c.vrt")
        self.refused("a.zip", "c.vrt", "o.png", "--save-scene", "a.zip", role="c.vrt")


class Outputs(Kept):
    def test_other_outputs(self):
        self.hills()
        words = ("hills.asc", "o.png")
        self.refused("./o.png", *words, "--save-scene", "./o.png", role="o.png, which is OUTPUT")
        self.refused("o-base.tif", *words, "--layers", "base", "--save-scene", "o-base.tif",
                     role="--layers")
        self.refused("l.exr", "hills.asc", "l.exr", "--layers", "l.exr", role="OUTPUT")
        self.refused("./l.exr", *words, "--layers", "l.exr", "--save-scene", "./l.exr",
                     role="l.exr, which is --layers")
        # The same place through a link at whose end nothing is yet, and through one of a folder.
        os.symlink("o.png", self.path("link.json"))
        os.symlink(".", self.path("here"))
        self.bad(2, "link.json: ", *words, "--save-scene", "link.json")
        self.bad(2, "here/o.png: ", *words, "--save-scene", "here/o.png")
        self.assertFalse(os.path.exists(self.path("o.png")))

    def test_a_layer_named_twice_is_one_file(self):
        self.good(self.hills(), "o.png", "--layers", "base,base")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "o-base.tif", "o.png"])

    def test_other_names_are_free(self):
        """What only looks like an input is written, and again."""
        self.heights("a.png")
        os.mkdir(self.path("b"))
        for name in ("b/a.png", "a.png.png", "aa.png", "a.tif", "a.exr", "A.png"):
            for _ in range(2):
                self.good("a.png", name, "--save-scene", "a.json", "--height-scale", "1")

    def test_links_without_an_end_are_written_through(self):
        self.hills()
        os.mkdir(self.path("far"))
        os.symlink("far/o.png", self.path("o.png"))
        os.symlink("s.json", self.path("far/link.json"))
        for _ in range(2):
            self.good("hills.asc", "o.png", "--save-scene", "far/link.json")
            self.assertEqual(os.readlink(self.path("o.png")), "far/o.png")
            self.assertEqual(os.readlink(self.path("far/link.json")), "s.json")
            self.assertEqual(sorted(os.listdir(self.path("far"))), ["link.json", "o.png", "s.json"])

    def test_links_that_lead_nowhere(self):
        self.hills()
        os.symlink("none/o.png", self.path("o.png"))
        os.symlink("two.png", self.path("one.png"))
        os.symlink("one.png", self.path("two.png"))
        self.bad(1, ["o.png: ", "no directory"], "hills.asc", "o.png")
        self.bad(1, ["one.png: ", "circles"], "hills.asc", "one.png")
        self.bad(1, "one.png: ", "one.png", "o.tif")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "o.png", "one.png", "two.png"])
        self.assertTrue(os.path.islink(self.path("o.png")))


if __name__ == "__main__":
    unittest.main()
