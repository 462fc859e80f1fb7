# SPDX-License-Identifier: BSD-3-Clause
"""Runs of reliefshade in pieces, of what changes under them: heights, what they are read from, options; and
what killed runs leave."""

import os
import shutil
import signal
import subprocess
import time
import unittest
import zipfile

from Reliefshade import JACKSBORO, PROGRAM
from TestMemory import MEMORY, PARTS, Memory

SUN = ("--sun", "300,20", "--height-scale", "1")


class Changes(Memory):
    def stopped(self, heights, *words, pieces=3):
        """Kills a run when so many pieces are there."""
        process = subprocess.Popen([PROGRAM, heights, "tiles.tif", *SUN, *words, *MEMORY, "--quiet"], cwd=self.folder)
        end = time.monotonic() + 300
        while len(self.pieces()) < pieces and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        process.kill()
        if process.wait() != -signal.SIGKILL:
            self.skipTest("it was done before it could be stopped")

    def rewritten(self, name, offset, data):
        """Writes over a part of a file, which keeps its date."""
        was = os.stat(self.path(name))
        with open(self.path(name), "r+b") as stream:
            stream.seek(offset)
            stream.write(data)
        os.utime(self.path(name), ns=(was.st_atime_ns, was.st_mtime_ns))

    def test_heights_in_an_archive(self):
        def pack():
            with zipfile.ZipFile(self.path("z.zip"), "w") as archive:
                archive.write(self.path("a.tif"), "a.tif")

        pack()
        self.assertEqual(self.good("/vsizip/z.zip/a.tif", "tiles.tif", *SUN, *MEMORY), "")
        self.good("a.tif", "whole.tif", *SUN)
        self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
        self.stopped("/vsizip/z.zip/a.tif")
        self.translate("-scale", "0", "1000", "0", "900")
        pack()
        self.bad(1, [PARTS, "another run", "heights"], "/vsizip/z.zip/a.tif", "tiles.tif", *SUN, *MEMORY, "--quiet")

    def test_an_option_that_spaces_the_heights(self):
        self.translate("-co", "PROFILE=BASELINE", "-co", "TFW=YES", "--config", "GDAL_PAM_ENABLED", "NO", "-a_ullr",
                       "10", "46.4", "10.4", "46", "-scale", "0", "1000", "0", "0.003")  # and no name of a system
        self.stopped("a.tif")
        self.bad(1, [PARTS, "another run", "spacing"], "a.tif", "tiles.tif", *SUN, *MEMORY, "--quiet", "--degrees")

    def test_heights_that_look_the_same(self):
        """Some samples are others, in no row that is looked at; size and date are the same."""
        self.good("a.tif", "tiles.tif", *SUN, *MEMORY)
        before = self.bytes_("tiles.tif")
        # About the middle row; the same number, 51015.3, wherever samples begin.
        self.rewritten("a.tif", os.path.getsize(self.path("a.tif")) // 2, b"\x47" * 12)
        said = self.bad(1, ["a.tif", "changed", ".bounds.tif"], "a.tif", "tiles.tif", *SUN, *MEMORY)
        self.assertLessEqual(len(said), 240)
        self.assertEqual(self.bytes_("tiles.tif"), before)
        # Done as it says, the pieces of before are another run's.
        os.remove(self.path("a.tif.bounds.tif"))
        self.bad(1, [PARTS, "another run"], "a.tif", "tiles.tif", *SUN, *MEMORY)
        shutil.rmtree(self.path(PARTS))
        self.assertSame(*SUN)

    def test_heights_that_change_while_they_are_shaded(self):
        process = subprocess.Popen([PROGRAM, "a.tif", "tiles.tif", *SUN, *MEMORY, "--threads", "1"], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 300
        while not self.pieces() and process.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        size = os.path.getsize(self.path("a.tif"))
        with open(self.path("a.tif"), "r+b") as stream:
            stream.seek(size // 8)
            stream.write(bytes(size * 3 // 4))
        _, said = process.communicate()
        if process.returncode == 0:
            self.skipTest("it was done before they changed")
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn("changed", said)
        self.assertFalse(os.path.exists(self.path("tiles.tif")))

    def test_a_virtual_raster_that_resamples(self):
        """Bicubic it has the same heights whatever part is read, but for rounding; by means it has not."""
        self.tool("gdal_translate", "-q", "-r", "bilinear", "-outsize", 2015, 1720, JACKSBORO, "large.tif")
        for method, good in (("cubic", True), ("average", False)):
            self.tool("gdal_translate", "-q", "-of", "VRT", "-r", method, "-outsize", 1700, 1451, "large.tif", "a.vrt")
            if good:
                self.good("a.vrt", "whole.tif", *SUN)
                self.good("a.vrt", "tiles.tif", *SUN, *MEMORY)
                self.assertEqual(self.bytes_("tiles.tif"), self.bytes_("whole.tif"))
            else:
                said = self.bad(1, ["a.vrt", "part by part", "plain raster"], "a.vrt", "other.tif", *SUN, *MEMORY)
                self.assertLessEqual(len(said), 240)
            os.remove(self.path("a.vrt.bounds.tif"))

    def test_bounds_that_are_an_empty_file(self):
        """As a power cut leaves them."""
        self.good("a.tif", "tiles.tif", *SUN, *MEMORY)
        with open(self.path("a.tif.bounds.tif"), "w"):
            pass
        self.assertSame(*SUN)
        self.assertGreater(os.path.getsize(self.path("a.tif.bounds.tif")), 0)

    def test_what_killed_runs_have_left(self):
        mine = subprocess.Popen(["sleep", "600"])
        self.addCleanup(mine.wait)
        self.addCleanup(mine.kill)  # first
        dead = subprocess.Popen(["true"])  # whose number nobody has for a while
        dead.wait()
        for name, number in (("tiles.tif", dead.pid), ("tiles-illumination.tif", dead.pid), ("tiles.tif", mine.pid),
                             ("other.tif", dead.pid)):
            for end in ("tif", "old"):
                with open(self.path(".%s.%d-0.tmp.%s" % (name, number, end)), "w") as stream:
                    stream.write("half")
        self.good("a.tif", "tiles.tif", *SUN, "--layers", "illumination", *MEMORY)
        left = sorted(n for n in os.listdir(self.folder) if n.startswith("."))
        self.assertEqual(left, sorted(".%s.%d-0.tmp.%s" % (name, number, end) for end in ("old", "tif")
                                      for name, number in (("other.tif", dead.pid), ("tiles.tif", mine.pid))))

    @unittest.skipUnless(os.name == "posix", "needs a terminal")
    def test_time_left_is_that_of_all_pieces(self):
        """Each piece takes less than what the time is told of."""
        import pty

        terminal, other = pty.openpty()
        process = subprocess.Popen([PROGRAM, "a.tif", "tiles.tif", *SUN, "--sun-diameter", "1", "--sun-samples", "300",
                                    "--threads", "1", *MEMORY], cwd=self.folder, stderr=other)
        os.close(other)
        said = b""
        try:
            while b" left" not in said:
                part = os.read(terminal, 4096)
                if not part:
                    break
                said += part
        except OSError:  # it has ended
            pass
        begun = len(self.pieces())
        process.kill()
        process.wait()
        os.close(terminal)
        if begun < 2 and b" left" in said:
            self.skipTest("single pieces take that long here")
        self.assertIn(b" left", said)


if __name__ == "__main__":
    unittest.main()
