# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade measures what accuracy costs, retraces what it shaded, and tells headers of it."""

import csv
import html.parser
import os
import re
import shutil
import signal
import subprocess
import unittest
import xml.etree.ElementTree

from Reliefshade import JACKSBORO, PROGRAM, Case, Picture, needsGdal, needsGdalTools, waitForHandler

ADVICE = re.compile(r"Take (?:--integrator exact )?(--tolerance [\d.]+): 99\.9 % of the samples err by no more than .*\n")
VERIFIED = re.compile(
    r"verified: (\d+) samples, seed (\d+): largest error (\S+) at column (\d+), row (\d+), "
    r"promised ([\d.]+)\S*(; rounding .*)?\n")


class Page(html.parser.HTMLParser):
    """The cells of a page's table, and whether its elements are closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.cells, self.rows, self.whole = [], [], [], True
        self.feed(text)
        self.whole = self.whole and not self.open

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta",):
            self.open.append(tag)
        if tag == "td":
            self.cells.append("")

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        self.whole = self.whole and bool(self.open) and self.open.pop() == tag
        if tag == "tr" and self.cells:
            self.rows.append(self.cells)
            self.cells = []

    def handle_data(self, data):
        if "td" in self.open:
            self.cells[-1] += data


class Report(Case):
    def csv(self, *words):
        said = self.good("hills.asc", "--accuracy-report", "report.csv", "--quiet", *words)
        self.assertRegex(said, ADVICE)
        with open(self.path("report.csv"), newline="") as stream:
            return said, list(csv.DictReader(stream))

    def test_numbers(self):
        self.hills(nodata=3)
        said, rows = self.csv("--point", "8,-20,4", "--tolerance", "0.002")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "report.csv"])
        exact = [row for row in rows if row["integrator"] == "exact"]
        steps = [row for row in rows if row["integrator"] == "fixed-step"]
        self.assertEqual([float(row["tolerance"]) for row in exact],
                         [0, 0.0001, 0.0003, 0.001, 0.002, 0.003, 0.01, 0.03, 0.1])
        self.assertEqual([int(row["steps"]) for row in steps], [8 << k for k in range(8)])
        self.assertEqual([row["tolerance"] for row in rows if row["present"] == "1"], ["0.002"])
        recommended = [row for row in rows if row["recommended"] == "1"]
        self.assertEqual(["--tolerance " + row["tolerance"] for row in recommended],
                         [ADVICE.match(said).group(1)])
        samples = sum((x * 7 + y * 5 + x * y) % 11 != 3 for x in range(16) for y in range(12))
        for row in rows:
            self.assertEqual((int(row["samples"]), row["seed"]), (samples, "1"))
            self.assertAlmostEqual(float(row["seconds"]),
                                   1e-9 * samples * float(row["nanoseconds_per_sample"]),
                                   delta=1e-4 * float(row["seconds"]))
            self.assertGreater(float(row["seconds"]), 0)
            self.assertLessEqual(float(row["error_rms"]), float(row["error_largest"]))
        for row in exact:
            self.assertLessEqual(float(row["error_999"]), float(row["tolerance"]) + 1e-5)
        self.assertGreater(float(exact[-1]["error_999"]), 1e-3)
        self.assertGreater(float(steps[-1]["error_999"]), 0.1)

    def test_fixed_steps_of_ones_own(self):
        self.hills()
        said, rows = self.csv("--integrator", "fixed-step", "--steps", "100")
        self.assertEqual([row["steps"] for row in rows if row["present"] == "1"], ["100"])
        self.assertIn("--integrator exact --tolerance", said)
        self.assertIn("--integrator fixed-step --steps 100", said)

    def test_page(self):
        os.makedirs(self.path("a&<b>"))
        hills = self.hills("a&<b>/hills.asc")
        self.good(hills, "shaded.png", "--quiet", "--accuracy-report", "report.HTML", "--depth", "2.5",
                  "--sun", "300,20")
        self.assertEqual(Picture(self.path("shaded.png")).width, 16)
        with open(self.path("report.HTML"), encoding="utf-8") as stream:
            text = stream.read()
        page = Page(text)
        self.assertTrue(page.whole)
        self.assertEqual(len(page.rows), 16)
        self.assertEqual(sum("(yours)" in row[0] for row in page.rows), 1)
        self.assertEqual(sum("(to take)" in row[0] for row in page.rows), 1)
        self.assertIn("a&amp;&lt;b&gt;/hills.asc", text)
        self.assertNotIn("<b>", text)
        self.assertIn("Take --tolerance", text)
        self.assertIn("16 x 12 samples", text)
        self.assertIn("at up to 192 of 192 samples, drawn by seed 1", text)
        self.assertIn('"subsurfaceDepth": 2.5', text)
        self.assertIn('"azimuth": 300', text)
        self.assertIn("prefers-color-scheme: dark", text)
        # It needs nothing else.
        self.assertNotRegex(text, r"<script|<link|<img|src=|url\(|@import")
        svg = xml.etree.ElementTree.fromstring(re.search(r"<svg.*</svg>", text, re.DOTALL).group(0))
        dots = [circle for circle in svg.iter("{http://www.w3.org/2000/svg}circle")
                if circle.get("class").startswith("dot")]
        self.assertEqual(len(dots), 16 + 2)  # the legend has two
        width, height = map(float, svg.get("viewBox").split()[2:])
        for text in svg.iter("{http://www.w3.org/2000/svg}text"):
            self.assertTrue(0 <= float(text.get("x")) <= width, text.text)
            self.assertTrue(0 <= float(text.get("y")) <= height, text.text)

    def test_chart(self):
        self.hills()
        self.good("hills.asc", "--accuracy-report", "report.png", "--quiet")
        picture = Picture(self.path("report.png"))
        self.assertEqual((picture.width, picture.components), (1000, 3))
        self.assertGreater(picture.height, 600)
        # White paper on all sides, lines of both colours, and letters.
        for x in range(picture.width):
            self.assertEqual(picture[x, 0], (255, 255, 255))
            self.assertEqual(picture[x, picture.height - 1], (255, 255, 255))
        colours = {}
        for y in range(picture.height):
            for x in range(picture.width):
                colours[picture[x, y]] = colours.get(picture[x, y], 0) + 1
        for colour, least in (((26, 98, 168), 100), ((179, 72, 11), 300), ((107, 114, 128), 1000),
                              ((17, 17, 17), 50)):
            self.assertGreater(colours.get(colour, 0), least, colour)
        left = sum(picture[x, y] != (255, 255, 255) for y in range(100, 570) for x in range(76))
        self.assertGreater(left, 200)  # the axis's numbers

    def test_refusals(self):
        self.hills()
        self.bad(2, ["--accuracy-report", "'report.pdf'", ".html"],
                 "hills.asc", "--accuracy-report", "report.pdf")
        self.bad(2, ["--accuracy-report", "OUTPUT"],
                 "hills.asc", "a.png", "--accuracy-report", "./a.png")
        os.rename(self.path("hills.asc"), self.path("hills.csv"))
        self.bad(2, ["hills.csv", "INPUT"], "hills.csv", "--accuracy-report", "hills.csv")
        self.bad(1, ["none/a.csv", "directory"],
                 "hills.csv", "--quiet", "--accuracy-report", "none/a.csv")
        os.makedirs(self.path("folder.html"))
        self.bad(1, ["folder.html", "is a directory"],
                 "hills.csv", "--quiet", "--accuracy-report", "folder.html")
        self.grid([[3, 3], [3, 3]], "empty.asc", nodata=3)
        self.bad(1, ["empty.asc", "no sample has data"],
                 "empty.asc", "--quiet", "--accuracy-report", "a.csv")
        self.assertEqual(sorted(os.listdir(self.folder)), ["empty.asc", "folder.html", "hills.csv"])

    @needsGdal
    def test_interrupt(self):
        self.hills()
        with open(self.path("report.csv"), "w") as stream:
            stream.write("old")
        process = subprocess.Popen(
            [PROGRAM, JACKSBORO, "--accuracy-report", "report.csv", "--preset",
             "sun-and-sky", "--quiet"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        waitForHandler(process, signal.SIGINT)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual((process.returncode, said), (130, "reliefshade: interrupted\n"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "report.csv"])
        with open(self.path("report.csv")) as stream:
            self.assertEqual(stream.read(), "old")


class Verify(Case):
    def test_kept(self):
        self.hills(nodata=3)
        samples = sum((x * 7 + y * 5 + x * y) % 11 != 3 for x in range(16) for y in range(12))
        said = self.good("hills.asc", "shaded.png", "--quiet", "--verify", "1000")
        count, seed, error, column, row, promised = VERIFIED.fullmatch(said).groups()[:6]
        self.assertEqual((int(count), seed, promised), (samples, "1", "0.000302"))
        self.assertLessEqual(float(error), float(promised))
        self.assertTrue(0 <= int(column) < 16 and 0 <= int(row) < 12)
        # What is asked for does not change what is shaded.
        self.good("hills.asc", "plain.png", "--quiet")
        self.assertEqual(Picture(self.path("shaded.png")), Picture(self.path("plain.png")))
        os.remove(self.path("plain.png"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "shaded.png"])
        os.remove(self.path("shaded.png"))
        # Without a picture, with other samples of which fewer are retraced.
        first = self.good("hills.asc", "--quiet", "--verify", "20,7")
        self.assertTrue(first.startswith("verified: 20 samples, seed 7: "))
        self.assertEqual(first, self.good("hills.asc", "--quiet", "--verify", "20,7"))
        self.assertNotEqual(first, self.good("hills.asc", "--quiet", "--verify", "20,8"))
        self.assertEqual(os.listdir(self.folder), ["hills.asc"])

    def test_whatever_is_shaded(self):
        self.hills(nodata=3)
        for words in (("--tolerance", "0"), ("--depth", "0", "--sun", "315,10"),
                      ("--offset", "normal", "--point", "8,8,14"), ("--floor", "-3", "--offset", "vertical"),
                      ("--preset", "sun-and-sky"), ("--sun", "315,40", "--sun", "100,5,-0.3"),
                      ("--threads", "1", "--tolerance", "0.1")):
            self.assertRegex(self.good("hills.asc", "--quiet", "--verify", "1000", *words), VERIFIED)

    def test_refusals(self):
        self.hills()
        self.bad(2, ["--verify", "'0'"], "hills.asc", "--verify", "0")
        self.bad(2, ["--verify", "'1,2,3'", "N,SEED"], "hills.asc", "--verify", "1,2,3")
        self.bad(2, ["--verify", "--integrator exact"],
                 "hills.asc", "--verify", "9", "--integrator", "fixed-step")
        self.bad(2, "OUTPUT", "hills.asc", "--verify", "9", "--layers", "illumination")


class Headers(Case):
    @needsGdalTools
    def test_tiff(self):
        self.tiff(self.hills(nodata=3), "in.tif", "-a_srs", "EPSG:32611")
        said = self.good("in.tif", "out.tif", "--quiet", "--verify", "50", "--tolerance", "0.002",
                         "--layers", "normals")
        told = self.info("out.tif")["metadata"][""]
        self.assertEqual(self.info("out-normals.tif")["metadata"][""], told)
        self.assertEqual("verified: " + told["RELIEF_VERIFIED"] + "\n", said)
        self.assertEqual((told["RELIEF_MODEL_VERSION"], told["RELIEF_TOLERANCE"]), ("1", "0.002"))
        self.assertRegex(told["TIFFTAG_SOFTWARE"], r"^ReliefShading \d")
        self.assertRegex(told["RELIEF_HEIGHT_HASH"], r"^[0-9a-f]{16}$")
        self.good("in.tif", "fixed.tif", "--quiet", "--integrator", "fixed-step")
        self.assertNotIn("RELIEF_TOLERANCE", self.info("fixed.tif")["metadata"][""])
        self.assertNotIn("RELIEF_VERIFIED", self.info("fixed.tif")["metadata"][""])

    @needsGdalTools
    def test_hash(self):
        hills = self.hills(nodata=3)

        def of(source, *words):
            self.good(source, "out.tif", "--quiet", *words)
            return self.info("out.tif")["metadata"][""]["RELIEF_HEIGHT_HASH"]

        words = ("-a_srs", "EPSG:32611")
        first = of(self.tiff(hills, "first.tif", *words))
        # The type of the numbers, their order of bytes, and how they are shaded do not count.
        for name, more in (("double", ["-ot", "Float64"]), ("short", ["-ot", "Int16"]),
                           ("big", ["-co", "ENDIANNESS=BIG"]), ("small", ["-co", "ENDIANNESS=LITTLE"])):
            self.assertEqual(of(self.tiff(hills, name + ".tif", *words, *more)), first, name)
        self.assertEqual(of("first.tif", "--height-scale", "3", "--depth", "7", "--sun", "9,9"), first)
        self.assertNotEqual(of("first.tif", "--nodata", "4"), first)
        self.assertNotEqual(of("first.tif", "--nodata", "none"), first)

    @unittest.skipUnless(shutil.which("exrheader"), "needs openexr")
    def test_layers(self):
        self.hills(nodata=3)
        said = self.good("hills.asc", "--quiet", "--layers", "all.exr", "--verify", "30,3")
        text = self.tool("exrheader", "all.exr")
        told = dict(re.findall(r"^([\w:]+) \(type \w+\):? ?(.*)$", text, re.MULTILINE))
        self.assertEqual(told["relief:modelVersion"], "1")
        self.assertEqual(told["relief:tolerance"], "0.0003")
        self.assertRegex(told["heights:hash"], r'^"[0-9a-f]{16}"$')
        self.assertEqual("verified: " + told["accuracy:verified"].strip('"') + "\n", said)
        self.good("hills.asc", "--quiet", "--layers", "other.exr")
        self.assertNotIn("accuracy:verified", self.tool("exrheader", "other.exr"))


if __name__ == "__main__":
    unittest.main()
