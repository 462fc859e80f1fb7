# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of reliefshade share: running it, making small rasters, reading pictures.

The environment names the program (RELIEFSHADE), whether it is built with GDAL
(RELIEFSHADE_GDAL, 1 or 0) and the folder of example data (RELIEFSHADE_DATA).
Only the standard library is used; gdal_translate and gdalinfo where they are installed.
"""

import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

PROGRAM = os.environ["RELIEFSHADE"]
GDAL = os.environ["RELIEFSHADE_GDAL"] == "1"
JACKSBORO = os.path.join(os.environ["RELIEFSHADE_DATA"], "jacksboro.tif")

needsGdal = unittest.skipUnless(GDAL, "built without GDAL")
needsGdalTools = unittest.skipUnless(
    GDAL and shutil.which("gdal_translate") and shutil.which("gdalinfo"),
    "needs GDAL and the tools of gdal-bin",
)


def waitForHandler(process, number, seconds=120):
    """Until a process that has been started handles a signal: before that it would just die of it."""
    end = time.monotonic() + seconds
    while True:
        with open(f"/proc/{process.pid}/status") as stream:
            caught = next(line for line in stream if line.startswith("SigCgt:"))
        if int(caught.split()[1], 16) >> (number - 1) & 1:
            return
        assert process.poll() is None, f"it ended with {process.returncode}"
        assert time.monotonic() < end, "it does not handle the signal"
        time.sleep(0.01)


def srgb(linear):
    """The 8-bit value of a linear one."""
    linear = min(max(linear, 0.0), 1.0)
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return round(255 * encoded)


class Picture:
    """An 8-bit PNG: picture[x, y] is a tuple of components, y downward from the top."""

    def __init__(self, name):
        with open(name, "rb") as stream:
            data = stream.read()
        assert data[:8] == b"\x89PNG\r\n\x1a\n"
        at, compressed = 8, b""
        while at < len(data):
            (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
            chunk = data[at + 8 : at + 8 + length]
            at += 12 + length
            if kind == b"IHDR":
                self.width, self.height, depth, colour = struct.unpack(">IIBB", chunk[:10])
                assert depth == 8 and chunk[12] == 0
                self.components = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
            elif kind == b"IDAT":
                compressed += chunk
        raw, step = zlib.decompress(compressed), self.components
        stride = self.width * step
        self.rows, above = [], bytes(stride)
        for y in range(self.height):
            kind = raw[y * (stride + 1)]
            row = bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
            for i in range(stride if kind else 0):  # rows as they are take no time
                a = row[i - step] if i >= step else 0
                b = above[i]
                c = above[i - step] if i >= step else 0
                near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
                row[i] = (row[i] + (0, a, b, (a + b) // 2, near)[kind]) & 255
            self.rows.append(bytes(row))
            above = row

    def __getitem__(self, place):
        x, y = place
        return tuple(self.rows[y][x * self.components : (x + 1) * self.components])

    def __eq__(self, other):
        return self.rows == other.rows

    def flipped(self):
        self.rows.reverse()
        return self


class Case(unittest.TestCase):
    """Runs each test in an empty folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="reliefshade-test-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_(self, *words, **options):
        words = [str(word) for word in words]
        return subprocess.run(
            [PROGRAM, *words], capture_output=True, text=True, cwd=self.folder, **options
        )

    def good(self, *words):
        """Runs it; it must succeed and say nothing on the error stream. Returns its output."""
        result = self.run_(*words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def bad(self, code, fragments, *words, **options):
        """Runs it; it must fail with one line that has all of the fragments."""
        result = self.run_(*words, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("reliefshade: "), lines[0])
        for fragment in [fragments] if isinstance(fragments, str) else fragments:
            self.assertIn(fragment, lines[0])
        self.assertNotRegex(lines[0], r"ERROR|\(0x[0-9a-f]{6}|vtk|\.cxx|\.tmp")
        return lines[0]

    def shade(self, *words):
        """Shades into a PNG of four components and returns it; the first word is the input."""
        self.good(words[0], "shaded.png", "--bands", "rgba", *words[1:])
        return Picture(self.path("shaded.png"))

    def assertColour(self, linear, *words, picture=None):
        picture = picture or self.shade(*words)
        expected = [srgb(value) for value in linear] + [255]
        for got, wanted in zip(picture[4, 4], expected):
            self.assertLessEqual(abs(got - wanted), 1, (picture[4, 4], expected))

    def statistics(self, *words):
        """The statistics of a run as a dictionary, without what is told of height scales."""
        output = self.good(words[0], "statistics.png", "--statistics", "--quiet", *words[1:])
        return dict(line.split(": ", 1) for line in output.splitlines())

    def grid(self, heights, name="grid.asc", nodata=None, size=1, corner=(0, 0), kind="corner"):
        """Writes an ESRI ASCII grid; the rows of the list begin with the northern one."""
        with open(self.path(name), "w") as stream:
            stream.write("ncols %d\nnrows %d\n" % (len(heights[0]), len(heights)))
            stream.write("xll%s %.10g\nyll%s %.10g\n" % (kind, corner[0], kind, corner[1]))
            stream.write("cellsize %.10g\n" % size)
            if nodata is not None:
                stream.write("NODATA_value %s\n" % nodata)
            for row in heights:
                stream.write(" ".join(str(value) for value in row) + "\n")
        return name

    def plane(self, height=5, name="plane.asc", width=8, **options):
        return self.grid([[height] * width for _ in range(width)], name, **options)

    def ramp(self, name="ramp.asc", **options):
        """Rises by 1 per sample eastward."""
        return self.grid([list(range(8)) for _ in range(8)], name, **options)

    def hills(self, name="hills.asc", **options):
        """Rough enough that every option shows."""
        return self.grid(
            [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)], name, **options
        )

    def png(self, rows, name, components=1):
        """Writes a 16-bit PNG, grey or grey and alpha; the rows begin with the upper one."""

        def chunk(kind, data):
            check = zlib.crc32(kind + data)
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

        width = len(rows[0]) // components
        header = struct.pack(">IIBBBBB", width, len(rows), 16, {1: 0, 2: 4}[components], 0, 0, 0)
        data = b"".join(b"\0" + struct.pack(">%dH" % len(row), *row) for row in rows)
        with open(self.path(name), "wb") as stream:
            stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
            stream.write(chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))
        return name

    def ppm(self, rows, name):
        """Writes an 8-bit RGB picture; the rows of (r, g, b) begin with the upper one."""
        with open(self.path(name), "wb") as stream:
            stream.write(b"P6 %d %d 255\n" % (len(rows[0]), len(rows)))
            stream.write(bytes(c for row in rows for colour in row for c in colour))
        return name

    def plainTiff(self, rows, name, samples=1, tags=(), order="<"):
        """Writes an 8-bit TIFF without a georeference; the rows begin with the stored first one.

        tags: more entries, (tag, values of 16 bits).
        """
        width, height = len(rows[0]) // samples, len(rows)
        data = b"".join(bytes(row) for row in rows)
        entries = {
            256: [width], 257: [height], 258: [8] * samples, 259: [1], 262: [2 if samples > 2 else 1],
            273: [8], 277: [samples], 278: [height], 279: [len(data)], **dict(tags),
        }
        extra, directory = b"", struct.pack(order + "H", len(entries))
        begin = 8 + len(data) + len(data) % 2
        behind = begin + 2 + 12 * len(entries) + 4
        for tag, values in sorted(entries.items()):
            packed = struct.pack(order + "%dH" % len(values), *values)
            if len(packed) > 4:
                place = struct.pack(order + "I", behind + len(extra))
                extra += packed
                packed = place
            directory += struct.pack(order + "HHI", tag, 3, len(values)) + packed.ljust(4, b"\0")
        mark = b"II*\0" if order == "<" else b"MM\0*"
        with open(self.path(name), "wb") as stream:
            stream.write(mark + struct.pack(order + "I", begin) + data.ljust(begin - 8, b"\0"))
            stream.write(directory + bytes(4) + extra)
        return name

    def exr(self, channels, name):
        """Writes an OpenEXR file of floats, uncompressed; {name: rows}, which begin with the upper one."""
        names = sorted(channels)
        rows = channels[names[0]]
        width, height = len(rows[0]), len(rows)

        def attribute(key, kind, data):
            return b"%s\0%s\0" % (key.encode(), kind.encode()) + struct.pack("<i", len(data)) + data

        window = struct.pack("<4i", 0, 0, width - 1, height - 1)
        listed = b"".join(n.encode() + struct.pack("<x4i", 2, 0, 1, 1) for n in names) + b"\0"
        header = struct.pack("<2i", 20000630, 2) + attribute("channels", "chlist", listed)
        header += attribute("compression", "compression", b"\0")
        header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
        header += attribute("lineOrder", "lineOrder", b"\0")
        header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
        header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
        header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
        line = 4 * width * len(names)
        begin = len(header) + 8 * height
        offsets = struct.pack("<%dQ" % height, *(begin + y * (8 + line) for y in range(height)))
        body = b"".join(
            struct.pack("<2i", y, line)
            + b"".join(struct.pack("<%df" % width, *channels[n][y]) for n in names)
            for y in range(height)
        )
        with open(self.path(name), "wb") as stream:
            stream.write(header + offsets + body)
        return name

    def tool(self, *words):
        words = [str(word) for word in words]
        done = subprocess.run(words, check=True, cwd=self.folder, capture_output=True, text=True)
        return done.stdout

    def tiff(self, source, name, *words):
        """A GeoTIFF of a raster, by gdal_translate."""
        self.tool("gdal_translate", "-q", "-of", "GTiff", *words, source, name)
        return name

    def info(self, name):
        return json.loads(self.tool("gdalinfo", "-json", name))

    def values(self, name, band=1):
        """The samples of a band as floats, row by row from the top."""
        self.tool(
            "gdal_translate", "-q", "-of", "ENVI", "-ot", "Float32", "-b", band, name, "v.raw"
        )
        with open(self.path("v.raw"), "rb") as stream:
            data = stream.read()
        return struct.unpack("<%df" % (len(data) // 4), data)
