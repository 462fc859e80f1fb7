# SPDX-License-Identifier: BSD-3-Clause
"""Every option of reliefshade does what its help says."""

import math
import os
import pty
import re
import shlex
import shutil
import subprocess
import unittest

from Reliefshade import JACKSBORO, PROGRAM, Case, Picture, needsGdal, needsGdalTools, srgb

# An option that is new in the help belongs here, and into a test.
OPTIONS = """
    --accuracy-report --attenuation --band --bands --base --base-texture --beyond-memory --channel --co --compress --degrees --density --depth --diffuse --encoding --env
    --env-intensity --env-mirror --env-radius --env-rotation --env-samples --env-sampling --env-tilt --floor
    --exposure --format --frames --height-scale --help --help-all --integrator --kf --ks --layers --mask --memory --memory-limit --nodata
    --nodata-out --normal-map --normal-method
    --offset --overviews --parameters --part --point --preset --quiet --refraction --relief --resolution --save-scene --response --scatter-power --scatter-range --scene
    --smooth-steps --spacing --specular --specular-power --specular-range --specular-texture
    --shadow-mask --statistics --steps --sun --sun-at --sun-diameter --sun-samples --texture --threads --tint --tolerance --type --verify --version --view --view-up --xyz
    --xyz-size --zoom
""".split()
WITHOUT_DEFAULT = """
    --accuracy-report --base-texture --co --degrees --env --env-mirror --frames --help --help-all --layers --mask --normal-map --overviews --parameters --point --preset --quiet --relief
    --save-scene --scene --shadow-mask --smooth-steps --specular-texture --statistics --sun --texture --tint --version --xyz
""".split()


class Help(Case):
    def options(self, text):
        """Each option's entry, with the blanks of one line."""
        entries = re.split(r"\n(?= +-)|\n\n", text)
        found = [re.match(r" +(?:-\w, *)?(--[a-z-]+)", entry) for entry in entries]
        return {match.group(1): " ".join(entry.split())
                for match, entry in zip(found, entries) if match}

    def test_help_lists_every_option_in_short(self):
        text = self.good("--help")
        self.assertEqual(sorted(self.options(text)), sorted(OPTIONS))
        self.assertLessEqual(max(map(len, text.splitlines())), 80)
        self.assertLess(len(text.splitlines()), 180)
        for group in text.split("\n\n"):
            self.assertLess(len(self.options(group)), 14, group)
        for name, entry in self.options(text).items():
            self.assertRegex(entry, r"[a-z]{3}", name)
            self.assertLess(len(entry), 180, entry)
        self.assertIn("[exact]", self.options(text)["--integrator"])
        self.assertIn("--help-all", text.splitlines()[-1])

    def test_long_help_has_every_default(self):
        text = self.good("--help-all")
        listed = self.options(text)
        self.assertEqual(sorted(listed), sorted(OPTIONS))
        for name in set(listed) - set(WITHOUT_DEFAULT):
            self.assertIn("Default: ", listed[name])
        for part in ("Exit codes", "Coordinates", "Pictures", "metres", "Usage: reliefshade INPUT OUTPUT"):
            self.assertIn(part, text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)

    @needsGdal
    def test_examples_of_the_help(self):
        text = self.good("--help")
        self.assertLess(text.index("Examples"), 60)
        examples = re.findall(r"^  reliefshade (.*)$", text, re.MULTILINE)
        self.assertEqual(len(examples), 5)
        shutil.copy(JACKSBORO, self.path("terrain.tif"))
        self.hills("grid.asc")
        self.good("terrain.tif", "orthophoto.tif")
        self.png([[x * y for x in range(16)] for y in range(12)], "relief.png")
        for example in examples:
            words = example.split()
            self.good(*words)
            self.assertGreater(os.path.getsize(self.path(words[1])), 100)

    def test_short_help_and_version(self):
        self.assertEqual(self.good("-h"), self.good("--help"))
        self.assertRegex(self.good("--version"), r"^reliefshade \d+\.\d+\.\d+\n$")

    @unittest.skipUnless(shutil.which("bash"), "needs bash")
    def test_completion(self):
        script = os.path.join(os.path.dirname(__file__),
                              "../../Module/Programs/share/reliefshade.bash")

        def completed(*words):
            line = ". %s; COMP_WORDS=(%s); COMP_CWORD=%d; _reliefshade %s; echo ${COMPREPLY[@]}" % (
                shlex.quote(script), " ".join(map(shlex.quote, [PROGRAM, *words])), len(words),
                shlex.quote(PROGRAM))
            result = subprocess.run(["bash", "-c", line], capture_output=True, text=True)
            return result.stdout.split()

        self.assertEqual(completed("--help-"), ["--help-all"])
        self.assertEqual(sorted(set(completed("--")) & set(OPTIONS)), sorted(OPTIONS))
        self.assertEqual(completed("--attenuation", ""), ["reciprocal", "exponential"])
        self.assertEqual(completed("--integrator", "f"), ["fixed-step"])


class Look(Case):
    """Closed forms on a plane of height 5 and on a slope of 45 degrees."""

    def test_sun(self):
        plane = self.plane()
        self.assertColour([1, 1, 1], plane, "--sun", "0,90")
        self.assertColour([0.5, 0.5, 0.5], plane, "--sun", "123,30")
        self.assertColour([0.2, 0.2, 0.2], plane, "--sun", "0,90,0.2")
        self.assertColour([0.2, 0.1, 0.4], plane, "--sun", "0,90,0.4,0.5,0.25,1")
        self.assertColour([0.7, 0.7, 0.7], plane, "--sun", "0,90,0.2", "--sun=-90,30")
        self.assertColour([0.95 * math.sqrt(0.5)] * 3, plane)  # the sun of a scene without lights
        usual = re.search(r"Without any\s+light: --sun (\S+)", self.good("--help-all")).group(1)
        self.assertEqual(self.shade(self.hills(), "--sun", usual), self.shade("hills.asc"))

    def test_sun_azimuth_is_clockwise_from_north(self):
        # A pyramid with slopes of 45 degrees.
        self.grid([[4 - max(abs(x - 4), abs(y - 4)) for x in range(9)] for y in range(9)], "peak.asc")
        picture = self.shade("peak.asc", "--sun", "90,40", "--depth", "0.2")
        self.assertGreater(picture[6, 4][0], 200)  # lit from the east (the right)
        self.assertLess(picture[2, 4][0], 200)
        picture = self.shade("peak.asc", "--sun", "0,40", "--depth", "0.2")
        self.assertGreater(picture[4, 2][0], 200)  # lit from the north (the top)
        self.assertLess(picture[4, 6][0], 200)

    def test_point(self):
        # Over the sample that is tested, row 4 from the top: the centre of the lowest row is at 0.5.
        plane = self.plane()
        self.assertColour([1, 1, 1], plane, "--point", "4.5,3.5,50")
        self.assertColour([0.3, 0.3, 0.3], plane, "--point", "4.5,3.5,50,0.3")
        self.assertColour([0.3, 0.6, 0], plane, "--point", "4.5,3.5,50,0.6,0.5,1,0")
        far = self.shade(plane, "--point", "4.5,100003.5,100005", "--depth", "0.01")
        self.assertColour([math.sqrt(0.5)] * 3, picture=far)

    def test_base_and_diffuse(self):
        plane = self.plane()
        self.assertColour([0.2, 0.4, 0.6], plane, "--base", "0.2,0.4,0.6", "--sun", "0,-90")
        self.assertColour([0.5, 0.25, 0], plane, "--diffuse", "0.5,0.25,0", "--sun", "0,90")

    def test_specular(self):
        plane, sun = self.plane(), ("--sun", "0,90", "--diffuse", "0,0,0")
        self.assertColour([0.5, 0.5, 0.5], plane, "--ks", "0.5", *sun)
        self.assertColour([0.5, 0.25, 0], plane, "--ks", "0.5", "--specular", "1,0.5,0", *sun)
        self.assertColour([0.5] * 3, plane, "--ks", "1", "--specular-range", "0,2", *sun)
        self.assertColour(
            [0.25] * 3, plane, "--ks", "1", "--specular-range", "0,2", "--specular-power", "2", *sun
        )

    def test_floor_and_forward_scattering(self):
        # Light from straight below: 2 of material from the floor at 2 to the point sunk to 4.
        plane, below = self.plane(), ("--sun", "0,-90", "--floor", "2", "--depth", "1")
        self.assertColour([0.5] * 3, plane, *below)
        self.assertColour([0.5] * 3, plane, *below, "--kf", "1")
        self.assertColour([0.25] * 3, plane, *below, "--kf", "1", "--scatter-range", "0,2")
        self.assertColour(
            [0.125] * 3,
            plane, *below, "--kf", "1", "--scatter-range", "0,2", "--scatter-power", "2",
        )
        self.assertColour([0] * 3, plane, "--sun", "0,90", "--kf", "1")

    def test_attenuation_and_density(self):
        plane = self.plane()
        below = ("--sun", "0,-90", "--floor", "2", "--depth", "1", "--attenuation")
        self.assertColour([0.5] * 3, plane, *below, "reciprocal")
        self.assertColour([math.exp(-1)] * 3, plane, *below, "exponential")
        self.assertColour([math.exp(-0.5)] * 3, plane, *below, "exponential", "--density", "0.5")

    def test_depth(self):
        plane, below = self.plane(), ("--sun", "0,-90", "--floor", "2", "--depth")
        self.assertColour([0.25 / 2.75] * 3, plane, *below, "0.25")
        self.assertColour([0.5] * 3, plane, *below, "auto")  # the mean spacing, 1
        self.assertColour([0.25] * 3, plane, *below, "auto", "--spacing", "0.6")
        self.assertColour([0] * 3, plane, *below, "0")

    def test_offset_height_scale_and_spacing(self):
        ramp, above = self.ramp(), ("--sun", "0,90", "--depth", "0.5")
        self.assertColour([1] * 3, ramp, *above, "--offset", "vertical")
        self.assertColour([math.sqrt(0.5)] * 3, ramp, *above, "--offset", "tangent-plane")
        self.assertColour([math.sqrt(0.5)] * 3, ramp, *above)
        normal = above + ("--offset", "normal")
        self.assertColour([math.sqrt(0.5)] * 3, ramp, *normal)
        self.assertColour([math.sqrt(0.2)] * 3, ramp, *normal, "--height-scale", "2")
        self.assertColour([math.sqrt(0.8)] * 3, ramp, *normal, "--spacing", "2")
        self.assertColour([math.sqrt(0.8)] * 3, ramp, *normal, "--spacing", "2,7")
        self.assertColour([math.sqrt(0.5)] * 3, ramp, *normal, "--spacing", "1,7")

    def test_nodata(self):
        self.grid([[1, 1, 1], [1, 7, 1], [3, 1, 1]], "g.asc", nodata=7)
        self.assertEqual(self.shade("g.asc")[1, 1], (0, 0, 0, 0))
        picture = self.shade("g.asc", "--nodata", "3")
        self.assertEqual((picture[1, 1][3], picture[0, 2]), (255, (0, 0, 0, 0)))
        picture = self.shade("g.asc", "--nodata", "none")
        self.assertEqual((picture[1, 1][3], picture[0, 2][3]), (255, 255))

    def test_mask(self):
        self.plane(width=3)
        self.grid([[0, 1, 1], [1, 1, 1], [1, 1, 9]], "mask.asc")
        picture = self.shade("plane.asc", "--mask", "mask.asc")
        self.assertEqual(picture[0, 0], (0, 0, 0, 0))
        self.assertEqual([picture[x, 2][3] for x in range(3)], [255] * 3)

    def test_mask_adds_to_the_alpha_of_the_file(self):
        self.png([[9, 0, 9, 65535], [9, 65535, 9, 65535]], "alpha.png", components=2)
        self.grid([[1, 1], [1, 0]], "mask.asc")
        picture = self.shade("alpha.png", "--mask", "mask.asc")
        alpha = [[picture[x, y][3] for x in range(2)] for y in range(2)]
        self.assertEqual(alpha, [[0, 255], [255, 0]])

    def test_band(self):
        with open(self.path("rgb.ppm"), "wb") as stream:
            stream.write(b"P6 8 8 255\n" + bytes(v for _ in range(8) for x in range(8)
                                                 for v in (5, x, 0)))
        words = ("--sun", "0,90", "--offset", "normal", "--depth", "0.5", "--height-scale", "1")
        self.assertColour([1] * 3, "rgb.ppm", "--band", "1", *words)
        self.assertColour([math.sqrt(0.5)] * 3, "rgb.ppm", "--band", "2", *words)


class Computation(Case):
    def test_integrator_and_steps(self):
        hills = self.hills()
        exact = self.shade(hills)
        self.assertEqual(exact, self.shade(hills, "--integrator", "exact"))
        fixed = self.shade(hills, "--integrator", "fixed-step")
        self.assertNotEqual(exact, fixed)
        self.assertEqual(fixed, self.shade(hills, "--integrator", "fixed-step", "--steps", "256"))
        self.assertNotEqual(fixed, self.shade(hills, "--integrator", "fixed-step", "--steps", "16"))

    def test_tolerance(self):
        hills, low = self.hills(), ("--sun", "300,10")
        exact = int(self.statistics(hills, *low, "--tolerance", "0")["cells-visited"])
        rough = int(self.statistics(hills, *low, "--tolerance", "0.5")["cells-visited"])
        self.assertLess(rough, exact)

    @needsGdal
    def test_threads_do_not_change_the_file(self):
        files = []
        for threads in (1, 2):
            name = "threads%d.tif" % threads
            output = self.good(JACKSBORO, name, "--threads", threads, "--statistics")
            self.assertIn("threads: %d\n" % threads, output)
            with open(self.path(name), "rb") as stream:
                files.append(stream.read())
        self.assertEqual(files[0], files[1])

    def test_statistics(self):
        hills = self.hills(size=2)
        found = self.statistics(hills, "--height-scale", "3")
        self.assertEqual(found["size"], "16 12")
        self.assertEqual(found["spacing"], "2 2")
        self.assertEqual(found["height-scale"], "3")
        self.assertEqual(found["effects"], "Illumination")
        self.assertEqual(found["lights-traced"], "1")
        self.assertEqual(found["rays-traced"], str(16 * 12))
        found = self.statistics(hills, "--ks", "1")
        self.assertEqual((found["lights-traced"], found["rays-traced"]), ("0", "0"))
        self.assertIn("Specular", found["effects"])


class Output(Case):
    def test_formats(self):
        hills = self.hills(nodata=0)
        for extension in ("png", "jpg", "tif", "exr", "hdr", "bmp", "ppm"):
            name = "out." + extension
            self.good(hills, name)
            self.assertGreater(os.path.getsize(self.path(name)), 100)
        for left in os.listdir(self.folder):
            self.assertFalse(left.startswith("."), left)

    @needsGdalTools
    def test_type(self):
        plane = self.plane()
        types = lambda name: [band["type"] for band in self.info(name)["bands"]]
        self.good(plane, "out.tif", "--sun", "0,30")
        self.assertEqual(types("out.tif"), ["Byte"])
        self.assertEqual(self.values("out.tif")[0], srgb(0.5))
        self.good(plane, "out.tif", "--sun", "0,30", "--type", "float")
        self.assertEqual(types("out.tif"), ["Float32"])
        self.assertAlmostEqual(self.values("out.tif")[0], 0.5, places=5)
        self.good(plane, "out.tif", "--type", "uint8", "--bands", "rgba")
        self.assertEqual(types("out.tif"), ["Byte"] * 4)

    def test_layers_are_files_beside_the_output(self):
        os.mkdir(self.path("sub"))
        names = ["illumination", "thickness", "normals", "base", "diffuse", "scatter", "specular"]
        self.good(self.hills(), "sub/a.b.png", "--layers", ",".join(names))
        wanted = ["a.b.png"] + ["a.b-%s.tif" % name for name in names]
        self.assertEqual(sorted(os.listdir(self.path("sub"))), sorted(wanted))
        self.good("hills.asc", "c.exr", "--layers", "base")
        self.assertTrue(os.path.exists(self.path("c-base.exr")))

    @needsGdalTools
    def test_values_of_layers(self):
        self.grid([[5, 5, 5], [5, -1, 5], [5, 5, 5]], "g.asc", nodata=-1)
        words = ("--sun", "0,30", "--depth", "1", "--base", "0.1,0.2,0.3", "--ks", "0.5")
        self.good("g.asc", "g.png", *words, "--layers", "illumination,thickness,normals,base")
        illumination = self.values("g-illumination.tif")
        self.assertAlmostEqual(illumination[0], 0.5, places=5)
        self.assertTrue(math.isnan(illumination[4]))
        self.assertAlmostEqual(self.values("g-thickness.tif")[0], 2, places=5)
        for band, value in ((1, 0), (2, 0), (3, 1)):
            self.assertAlmostEqual(self.values("g-normals.tif", band)[0], value, places=5)
            self.assertAlmostEqual(self.values("g-base.tif", band)[0], 0.05 * band, places=5)

    def test_a_layer_is_a_raster_again(self):
        self.good(self.hills(), "h.exr", "--layers", "illumination")
        self.assertEqual(self.statistics("h-illumination.exr")["type"], "float")

    def terminal(self, *words):
        """What the error stream gets when it is a terminal."""
        reader, writer = pty.openpty()
        process = subprocess.Popen([PROGRAM, *words], stderr=writer, cwd=self.folder)
        os.close(writer)
        text = b""
        try:
            while True:
                part = os.read(reader, 4096)
                if not part:
                    break
                text += part
        except OSError:  # how Linux tells that the other side is closed
            pass
        os.close(reader)
        self.assertEqual(process.wait(), 0)
        return text

    def test_progress_bar(self):
        hills = self.hills()
        self.assertIn(b"shading [", self.terminal(hills, "out.png"))
        self.assertEqual(self.terminal(hills, "out.png", "--quiet"), b"")


if __name__ == "__main__":
    unittest.main()
