# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade in pipes: rasters come through the standard input and go through the standard output."""

import gzip
import os
import pty
import shutil
import signal
import subprocess
import tempfile
import unittest

from Reliefshade import JACKSBORO, PROGRAM, Case, needsGdal, needsGdalTools, waitForHandler


class Pipes(Case):
    def setUp(self):
        super().setUp()
        # Whatever is kept while it runs lies here, and is gone afterwards.
        self.kept = tempfile.mkdtemp(prefix="reliefshade-kept-")
        self.addCleanup(shutil.rmtree, self.kept, ignore_errors=True)
        self.addCleanup(lambda: self.assertEqual(os.listdir(self.kept), []))

    def piped(self, *words, data=None, folder=None, **options):
        environment = dict(os.environ, TMPDIR=folder or self.kept)
        given = {"stdin": subprocess.DEVNULL} if data is None else {"input": data}
        given.update(options)
        return subprocess.run([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              cwd=self.folder, env=environment, **given)

    def through(self, *words, data=None):
        """What comes out; nothing else may be said."""
        result = self.piped(*words, data=data)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return result.stdout

    def refused(self, code, fragments, *words, **options):
        """One line, and not a byte of a picture."""
        result = self.piped(*words, **options)
        said = result.stderr.decode()
        self.assertEqual((result.returncode, result.stdout), (code, b""), said)
        self.assertRegex(said, r"^reliefshade: [^\n]{1,200}\n$")
        for fragment in [fragments] if isinstance(fragments, str) else fragments:
            self.assertIn(fragment, said)
        self.assertNotRegex(said, r"reliefshade-\d|\.tmp|vsistdin[^/]|vsistdout[^/]")
        return said

    def bytes(self, name):
        with open(self.path(name), "rb") as stream:
            return stream.read()

    def chain(self, *commands):
        """Runs commands as a shell chains them with |. Returns their codes."""
        before, running = subprocess.DEVNULL, []
        for number, command in enumerate(commands, 1):
            last = number == len(commands)
            running.append(subprocess.Popen(
                list(map(str, command)), stdin=before, stdout=None if last else subprocess.PIPE, cwd=self.folder))
            if before != subprocess.DEVNULL:
                before.close()
            before = running[-1].stdout
        return [process.wait(timeout=300) for process in running]


class Streams(Pipes):
    """What comes out of a pipe is what a run with files writes, byte for byte."""

    @needsGdal
    def test_geotiff(self):
        words = ("--sun", "300,25", "--preset", "sky-dome", "--diffuse", "1,0.5,0.2")
        self.good(JACKSBORO, "o.tif", *words)
        heights, expected = self.bytes(JACKSBORO), self.bytes("o.tif")
        for source in ("/vsistdin/", "-", "/dev/stdin"):
            for target in ("/vsistdout/", "-", "/dev/stdout"):
                self.assertEqual(self.through(source, target, *words, data=heights), expected)
        self.assertEqual(self.through(JACKSBORO, "-", *words), expected)
        self.through("-", "p.tif", *words, data=heights)
        self.assertEqual(self.bytes("p.tif"), expected)

    @needsGdal
    def test_cog(self):
        self.good(JACKSBORO, "o.tif", "--format", "cog")
        self.assertEqual(self.through(JACKSBORO, "-", "--format", "cog"), self.bytes("o.tif"))
        self.good(JACKSBORO, "o.tif", "--format", "gtiff", "--compress", "deflate")
        self.assertEqual(self.through(JACKSBORO, "-", "--compress", "deflate"), self.bytes("o.tif"))

    def test_pictures(self):
        hills = self.hills(nodata=0)
        for extension in ("png", "jpg", "exr", "hdr", "bmp", "ppm"):
            name = "o." + extension
            self.good(hills, name)
            got = self.through("-", "-", "--format", extension, "--quiet", data=self.bytes(hills))
            if extension == "exr":  # its header has the date
                self.assertEqual((got[:4], len(got)), (self.bytes(name)[:4], os.path.getsize(self.path(name))))
            else:
                self.assertEqual(got, self.bytes(name), extension)

    def test_pictures_as_heights(self):
        self.png([[x * y for x in range(16)] for y in range(12)], "relief.png")
        self.good("relief.png", "o.png", "--quiet")
        got = self.through("-", "-", "--format", "png", "--quiet", data=self.bytes("relief.png"))
        self.assertEqual(got, self.bytes("o.png"))

    @needsGdal
    def test_archives(self):
        self.good(JACKSBORO, "o.tif")
        zipped = gzip.compress(self.bytes(JACKSBORO))
        self.assertEqual(self.through("/vsigzip//vsistdin/", "-", data=zipped), self.bytes("o.tif"))

    @needsGdal
    def test_what_is_said_stays_out_of_the_picture(self):
        self.good(JACKSBORO, "o.tif")
        result = self.piped("-", "-", "--statistics", "--verify", "10", data=self.bytes(JACKSBORO))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stdout[:4], b"II*\0")
        self.assertIn(b"size: 403 344\n", result.stderr)
        self.assertIn(b"verified: ", result.stderr)
        result = self.piped("-", "-", data=self.bytes(self.hills(size=0.01, corner=(10, 60))))
        self.assertIn(b"reliefshade: /vsistdin/: warning: its coordinates look like degrees", result.stderr)
        self.assertEqual(result.stdout[:4], b"II*\0")

    @needsGdal
    def test_a_file_named_dash(self):
        shutil.copy(JACKSBORO, self.path("-"))
        self.good("./-", "o.tif")
        self.assertEqual(self.through("./-", "-"), self.bytes("o.tif"))


@needsGdalTools
class Chains(Pipes):
    def test_between_translations(self):
        self.tool("gdal_translate", "-q", "-outsize", 300, 200, JACKSBORO, "small.tif")
        self.good("small.tif", "o.tif", "--bands", "rgba")
        codes = self.chain(
            ["gdal_translate", "-q", "-outsize", 300, 200, JACKSBORO, "/vsistdout/"],
            [PROGRAM, "/vsistdin/", "/vsistdout/", "--bands", "rgba"],
            ["gdal_translate", "-q", "/vsistdin/", "p.tif"])
        self.assertEqual(codes, [0, 0, 0])
        for band in range(1, 5):
            self.assertEqual(self.values("p.tif", band), self.values("o.tif", band))
        one, other = self.info("o.tif"), self.info("p.tif")
        for key in ("geoTransform", "coordinateSystem", "size"):
            self.assertEqual(other[key], one[key])

    def test_larger_than_what_gdal_keeps_of_a_stream(self):
        codes = self.chain(
            ["gdal_translate", "-q", "-outsize", 2500, 1500, JACKSBORO, "/vsistdout/"],
            [PROGRAM, "-", "-", "--type", "float", "--bands", "rgba"],
            ["gdal_translate", "-q", "/vsistdin/", "p.tif"])
        self.assertEqual(codes, [0, 0, 0])
        self.assertGreater(os.path.getsize(self.path("p.tif")), 2500 * 1500 * 16)

    def test_warped(self):
        # Virtual rasters are a text that names its files; they come through the pipe as well.
        self.tool("gdalwarp", "-q", "-t_srs", "EPSG:32616", JACKSBORO, "warped.tif")
        self.good("warped.tif", "o.tif")
        for form in ("GTiff", "VRT"):
            codes = self.chain(
                ["gdalwarp", "-q", "-t_srs", "EPSG:32616", "-of", form, JACKSBORO, "/vsistdout/"],
                [PROGRAM, "-", "p.tif"])
            self.assertEqual(codes, [0, 0], form)
            self.assertEqual(self.values("p.tif"), self.values("o.tif"), form)

    def test_what_fails_before_it_ends_it(self):
        with open(self.path("o.tif"), "w") as stream:
            stream.write("before")
        self.refused(1, ["/vsistdin/", "nothing came"], "-", "o.tif", data=b"")
        whole = self.bytes(JACKSBORO)
        self.refused(1, "/vsistdin/: ", "-", "o.tif", data=whole[: len(whole) // 2])
        self.refused(1, "/vsistdin/: ", "-", "-", data=whole[: len(whole) // 2])
        self.assertEqual(self.bytes("o.tif"), b"before")


class Refused(Pipes):
    def test_what_is_no_raster(self):
        self.refused(1, "/vsistdin/: ", "-", "o.png", data=b"no raster")
        self.assertEqual(os.listdir(self.folder), [])
        # A long name of the temporary folder may cost its middle, but no clear message.
        folder = os.path.join(self.kept, "d" * 200)
        os.mkdir(folder)
        self.refused(1, "/vsistdin/: ", "-", "-", data=b"no raster", folder=folder)
        self.assertEqual(os.listdir(folder), [])
        os.rmdir(folder)

    def test_no_place_to_keep_it(self):
        said = self.refused(1, "TMPDIR", "-", "-", data=b"x", folder=self.path("none"))
        self.assertIn("none", said)

    def test_options(self):
        hills = self.hills()
        self.refused(2, ["--format", "standard output"], hills, "o.png", "--format", "png")
        self.refused(2, ["--format", "none of"], hills, "-", "--format", "gif")
        self.refused(2, ["--layers", ".exr"], hills, "-", "--layers", "normals")
        self.refused(2, ["--frames"], hills, "-", "--frames", "2026-06-21T06:00Z,2026-06-21T08:00Z,60")
        for option in ("--mask", "--texture", "--tint", "--env"):
            self.refused(2, [option, "only INPUT"], hills, "o.png", option, "/vsistdin/")
        for option in ("--save-scene", "--shadow-mask"):
            self.refused(2, [option, "only OUTPUT"], hills, "o.png", option, "/vsistdout/")
        self.assertEqual(os.listdir(self.folder), ["hills.asc"])

    def test_the_file_behind_a_stream_is_not_replaced(self):
        shutil.copy(JACKSBORO, self.path("a.tif"))
        before = self.bytes("a.tif")
        with open(self.path("a.tif"), "rb") as stream:
            self.refused(2, ["a.tif", "OUTPUT would replace"], "-", "a.tif", stdin=stream)
        with open(self.path("a.tif"), "ab") as stream:
            result = subprocess.run([PROGRAM, "a.tif", "-"], stdout=stream, stderr=subprocess.PIPE, cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"OUTPUT would replace", result.stderr)
        with open(self.path("a.tif"), "rb") as source, open(self.path("a.tif"), "ab") as stream:
            result = subprocess.run([PROGRAM, "-", "-"], stdin=source, stdout=stream,
                                    stderr=subprocess.PIPE, cwd=self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(self.bytes("a.tif"), before)

    @needsGdalTools
    def test_what_a_virtual_raster_reads_is_not_replaced(self):
        shutil.copy(JACKSBORO, self.path("a.tif"))
        before = self.bytes("a.tif")
        text = self.tool("gdal_translate", "-q", "-of", "VRT", self.path("a.tif"), "/vsistdout/").encode()
        self.refused(2, ["a.tif", "would replace"], "-", "a.tif", data=text)
        self.assertEqual(self.bytes("a.tif"), before)

    @needsGdal
    def test_nobody_reads(self):
        reader, writer = os.pipe()
        os.close(reader)
        result = subprocess.run([PROGRAM, JACKSBORO, "-"], stdout=writer, stderr=subprocess.PIPE, cwd=self.folder,
                                env=dict(os.environ, TMPDIR=self.kept))
        os.close(writer)
        self.assertEqual((result.returncode, result.stderr),
                         (1, b"reliefshade: /vsistdout/: cannot be written: Broken pipe\n"))

    @needsGdal
    def test_full_device(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no device is full here")
        with open("/dev/full", "wb") as full:
            result = subprocess.run([PROGRAM, JACKSBORO, "-"], stdout=full, stderr=subprocess.PIPE,
                                    env=dict(os.environ, TMPDIR=self.kept))
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr.decode(), r"^reliefshade: /vsistdout/: cannot be written: [^\n]+\n$")

    def test_nothing_else_is_replaced_then(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("there is no such device")
        hills = self.hills()
        for words in (["--shadow-mask", "old.png", "--sun", "300,20"],
                      ["--save-scene", "old.json"]):
            with open(self.path(words[1]), "w") as stream:
                stream.write("before")
            with open("/dev/full", "wb") as full:
                code = subprocess.run([PROGRAM, hills, "-", "--quiet", *words], cwd=self.folder,
                                      stdout=full, stderr=subprocess.PIPE, check=False).returncode
            self.assertEqual(code, 1)
            self.assertEqual(self.bytes(words[1]), b"before")

    def test_folders_named_as_streams(self):
        os.makedirs(self.path("vsistdin"))
        os.makedirs(self.path("vsistdout"))
        heights = os.path.join(self.folder, "vsistdin", "hills.asc")
        os.rename(self.path(self.hills()), heights)
        picture = os.path.join(self.folder, "vsistdout", "o.png")
        self.good(heights, picture, "--quiet")
        self.assertGreater(os.path.getsize(picture), 50)

    def test_terminals(self):
        hills = self.hills()
        reader, writer = pty.openpty()
        self.addCleanup(os.close, reader)
        self.addCleanup(os.close, writer)
        self.refused(2, ["INPUT", "terminal"], "-", "o.png", stdin=writer)
        result = subprocess.run([PROGRAM, hills, "-"], stdout=writer, stderr=subprocess.PIPE, cwd=self.folder,
                                env=dict(os.environ, TMPDIR=self.kept))
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, b"OUTPUT: the standard output is a terminal")

    @needsGdal
    def test_signals(self):
        environment = dict(os.environ, TMPDIR=self.kept)
        for number in (signal.SIGINT, signal.SIGTERM):
            # While it waits for what does not come, and for somebody who does not read.
            for words in (("-", "o.png"), (JACKSBORO, "-", "--type", "float", "--bands", "rgba")):
                process = subprocess.Popen([PROGRAM, *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, cwd=self.folder, env=environment)
                waitForHandler(process, number)
                if words[0] == JACKSBORO:
                    first = os.read(process.stdout.fileno(), 4)
                    self.assertEqual(first, b"II*\0")
                process.send_signal(number)
                self.assertEqual(process.wait(timeout=60), 130)
                self.assertEqual(process.stderr.read(), b"reliefshade: interrupted\n")
                for stream in (process.stdin, process.stdout, process.stderr):
                    stream.close()
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
