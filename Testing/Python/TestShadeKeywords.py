# SPDX-License-Identifier: BSD-3-Clause
"""Keywords of shade(): one for each parameter, what they refuse; and pictures by one Relief."""

import ast
import inspect
import io
import math
import os
import re
import subprocess
import sys
import unittest

import numpy as np
import reliefshading
from reliefshading import Relief, shade
from vtkmodules.vtkCommonCore import vtkLookupTable


def hills(rows=60, columns=80, dtype=np.float32):
    y, x = np.mgrid[0:rows, 0:columns]
    return (30.0 * np.sin(x / 7.0) * np.cos(y / 9.0) + 30.0).astype(dtype)


class TestRelief(unittest.TestCase):
    def test_light_is_kept(self):
        relief = Relief(hills(), spacing=2.0, diffuse_color=0.5)
        first = relief.shade(sun=(300, 30))
        self.assertEqual(first.statistics["rays_traced"], 4800)
        again = relief.shade(sun=(300, 30), diffuse_color="red")
        self.assertEqual(again.statistics["rays_traced"], 0)
        self.assertEqual(again.statistics["lights_reused"], 1)
        np.testing.assert_array_equal(again.image, shade(
            hills(), spacing=2, sun=(300, 30), diffuse_color="red").image)
        # What one picture was given is forgotten.
        np.testing.assert_array_equal(relief.shade(sun=(300, 30)).image, first.image)
        np.testing.assert_array_equal(relief.shade(sun=(300, 30)).image, first.image)
        np.testing.assert_array_equal(
            relief.shade().image, shade(hills(), spacing=2, diffuse_color=0.5).image)

    def test_an_environment_is_kept(self):
        relief = Relief(hills())
        sky = np.random.default_rng(1).random((16, 32))
        first = relief.shade(environment=sky)
        again = relief.shade(environment=sky.copy(), diffuse_color=0.5)
        self.assertGreater(first.statistics["rays_traced"], 0)
        self.assertEqual(again.statistics["rays_traced"], 0)
        sky[:8] *= 2.0
        self.assertFalse(np.array_equal(relief.shade(environment=sky).image, first.image))

    def test_lights_replace_those_of_all_pictures(self):
        relief = Relief(hills(), preset="sky-dome")
        np.testing.assert_array_equal(relief.shade(sun=(0, 45)).image, shade(hills(), sun=(0, 45)).image)
        np.testing.assert_array_equal(relief.shade().image, shade(hills(), preset="sky-dome").image)
        relief = Relief(hills(), preset="combined")
        np.testing.assert_array_equal(relief.shade(sun=(0, 45)).image,
                                      shade(hills(), preset="combined", sun=(0, 45)).image)
        np.testing.assert_array_equal(relief.shade(lamp=(9, 9, 99)).image,
                                      shade(hills(), lamp=(9, 9, 99)).image)

    def test_other_heights(self):
        relief = Relief(hills(), spacing=2.0, cmap=np.array(((0, 0, 255), (255, 0, 0))))
        relief.shade()
        other = np.ascontiguousarray(hills()[:40, ::-1]) + 7
        relief.set_heights(other)
        self.assertEqual(relief.shape, (40, 80))
        np.testing.assert_array_equal(relief.shade().image, shade(
            other, spacing=2, cmap=np.array(((0, 0, 255), (255, 0, 0)))).image)
        relief.set_heights(other, spacing=1.0, nodata=other[0, 0])
        self.assertFalse(relief.shade().mask[0, 0])
        with self.assertRaises(TypeError):
            relief.shade(spacing=3.0)

    def test_iterators_serve_all_pictures(self):
        suns, lamps = [(0, 45), (90, 45)], [(9, 9, 99), (50, 30, 60)]
        layers, cmap = ["illumination", "diffuse"], [(0.0, "black"), (60.0, "red")]
        expected = shade(hills(), suns=suns, lamps=lamps, layers=layers, cmap=cmap, spacing=(2, 3))
        relief = Relief(hills(), suns=iter(suns), lamps=(lamp for lamp in lamps), layers=iter(layers),
                        cmap=zip(*zip(*cmap)), spacing=iter((2, 3)))
        for _ in range(3):
            result = relief.shade()
            np.testing.assert_array_equal(result.image, expected.image)
            self.assertEqual(list(result.layers), layers)
            relief.set_heights(hills())
        np.testing.assert_array_equal(
            relief.shade(suns=iter(suns), lamps=iter(lamps)).image, expected.image)


class TestKeywords(unittest.TestCase):
    def keyword(self, row):
        name = re.sub(r"(?<!^)([A-Z])", r"_\1", row["name"]).lower()
        return "environment_" + name if row["owner"] == "Environment" else name

    def rows(self):
        return [row for row in reliefshading.parameters() if row["owner"] != "Light"]

    def test_every_parameter_is_a_keyword(self):
        """And is set by it, told in help() and refused beyond its range."""
        keywords = inspect.signature(shade).parameters
        text = shade.__doc__
        for row in self.rows():
            name = self.keyword(row)
            with self.subTest(name):
                self.assertIn(name, keywords)
                default = keywords[name].default
                if row["kind"] != "choice":
                    self.assertEqual(default, row["default"])
                value, got = {
                    "number": lambda: (self.inside(row),) * 2, "length": lambda: (50.0, 50.0),
                    "count": lambda: (max(int(row["minimum"]), 8) + 8,) * 2,
                    "flag": lambda: (not row["default"],) * 2,
                    "color": lambda: ((0.25, 0.5, 0.75),) * 2, "range": lambda: ((0.25, 0.5),) * 2,
                    "choice": lambda: (row["choices"][-1], len(row["choices"]) - 1)}[row["kind"]]()
                relief = Relief(hills(12, 10))
                sky = {"environment": np.ones((4, 8))} if row["owner"] == "Environment" else {}
                relief.shade(**{name: value}, **sky)
                owner = {"Scene": relief.scene, "Material": relief.scene.GetMaterial(),
                         "Environment": relief.scene.GetEnvironment()}[row["owner"]]
                self.assertEqual(getattr(owner, "Get" + row["name"])(), got)
                paragraph = re.search(rf"^{name}: (.*)\n((?:    .*\n?)+)", text, re.MULTILINE)
                self.assertIn(f"default {default!r}", paragraph[1])
                self.assertIn(row["unit"], paragraph[1])
                self.assertEqual(" ".join(paragraph[2].split()), row["help"] + ".")
                self.refuses(name, row, sky)

    def inside(self, row):
        high = row["maximum"]
        return 0.5 * (max(row["minimum"], -1.0) + high) + 0.25 if math.isfinite(high) else 2.5

    def refuses(self, name, row, sky):
        heights = hills(12, 10)
        outside = {"choice": "nonsense", "color": (-1, 0, 0), "range": (1.0, 0.0)}.get(
            row["kind"], row["minimum"] - 1 if math.isfinite(row["minimum"]) else math.inf)
        outside = int(outside) if row["kind"] == "count" else outside
        wrong = {"flag": 1, "choice": 2, "count": 2.5}.get(row["kind"], [1, 2, 3, 4])
        if row["kind"] != "flag":
            with self.assertRaisesRegex(ValueError, rf"{name}: .*expected"):
                shade(heights, **{name: outside}, **sky)
        with self.assertRaisesRegex(TypeError, rf"{name}: .*is expected, not"):
            shade(heights, **{name: wrong}, **sky)

    def test_what_a_keyword_turns(self):
        relief = Relief(hills(12, 10))
        relief.shade(floor_height=-3, subsurface_depth=2)
        material = relief.scene.GetMaterial()
        self.assertTrue(material.GetUseFloor() and not material.GetAutomaticSubsurfaceDepth())
        relief.shade(floor_height=-3, use_floor=False, subsurface_depth=2, automatic_subsurface_depth=True)
        self.assertFalse(material.GetUseFloor() or not material.GetAutomaticSubsurfaceDepth())
        relief.shade()
        self.assertFalse(material.GetUseFloor() or not material.GetAutomaticSubsurfaceDepth())

    def test_fixed_keywords_are_told(self):
        for name, parameter in inspect.signature(shade).parameters.items():
            if name != "heights":
                self.assertRegex(shade.__doc__, rf"(?m)^{name}: ")
                self.assertEqual(parameter.kind, parameter.KEYWORD_ONLY)
        stream = io.StringIO()
        import pydoc
        pydoc.Helper(output=stream)(shade)
        self.assertIn("subsurface_depth", stream.getvalue())
        self.assertIn("sun", inspect.signature(Relief.shade).parameters)
        self.assertNotIn("spacing", inspect.signature(Relief.shade).parameters)

    @unittest.skipUnless(os.path.exists(os.path.join(os.path.dirname(reliefshading.__file__), "py.typed")),
                         "the package could not run when it was built")
    def test_type_stubs(self):
        """They have every name and every keyword, and no other."""
        with open(reliefshading.__file__ + "i", encoding="utf-8") as file:
            tree = ast.parse(file.read())
        defined = {node.name: node for node in tree.body if hasattr(node, "name")}
        names = set(reliefshading.__all__) - {"__version__"}
        self.assertEqual(set(defined), names)
        methods = {node.name: node for node in defined["Relief"].body if hasattr(node, "name")}
        for stub, function, more in ((defined["shade"], shade, []), (methods["shade"], Relief.shade, []),
                                     (methods["__init__"], shade, ["cache_memory_limit"])):
            keywords = [name for name, parameter in inspect.signature(function).parameters.items()
                        if parameter.kind is parameter.KEYWORD_ONLY]
            self.assertEqual([argument.arg for argument in stub.args.kwonlyargs], more + keywords)
        material = [node.name for node in defined["vtkReliefMaterial"].body if hasattr(node, "name")]
        self.assertIn("SetSubsurfaceDepth", material)

    def test_refused(self):
        heights = hills(12, 10)
        cases = (
            (TypeError, "unexpected keyword argument 'depht'; did you mean 'depth'", {"depht": 1}),
            (TypeError, "unexpected keyword argument 'SubsurfaceDepth'", {"SubsurfaceDepth": 1}),
            (TypeError, "did you mean 'height_scale'", {"vert_exag": 1}),
            (ValueError, "spacing: 0 ", {"spacing": 0}),
            (ValueError, "spacing", {"spacing": (1, math.nan)}),
            (TypeError, "spacing", {"spacing": "wide"}),
            (ValueError, "spacing: .*from 1e-32 to 1e32", {"spacing": 2e32}),
            (ValueError, "spacing", {"spacing": (1, 9e-33)}),
            (ValueError, "mask: the shape", {"mask": np.ones((3, 3))}),
            (ValueError, "mask: .*one length", {"mask": [[1, 0], [1]]}),
            (TypeError, "mask", {"mask": "here"}),
            (TypeError, "mask", {"mask": object()}),
            (TypeError, "environment: .*not int32", {"environment": np.ones((2, 4), np.int32)}),
            (TypeError, "environment: .*not bool", {"environment": np.ones((2, 4), bool)}),
            (TypeError, "base_texture: .*not int64", {"base_texture": [[1, 2]]}),
            (ValueError, "did you mean 'igor'", {"preset": "igo"}),
            (ValueError, "takes no sun", {"preset": "sky-dome", "sun": (1, 2)}),
            (ValueError, "has its own", {"preset": "sky-dome", "environment": np.ones((2, 4))}),
            (ValueError, "altitude", {"sun": (0, 91)}),
            (TypeError, r"sun: \(azimuth, altitude", {"sun": 45}),
            (TypeError, "sun: there is no 'colour'; did you mean 'color'",
             {"sun": dict(azimuth=1, altitude=2, colour="red")}),
            (TypeError, "lacks 'altitude'", {"sun": dict(azimuth=1)}),
            (ValueError, r"sun: angular_diameter: 500 .*\[0, 90\] is expected$",
             {"sun": dict(azimuth=1, altitude=2, angular_diameter=500)}),
            (TypeError, "suns: a list", {"suns": 3}),
            (TypeError, r"suns\[0\]", {"suns": (0, 45)}),
            (ValueError, "lamp", {"lamp": (0, 0, math.inf)}),
            (TypeError, "lamp: there is no 'angular_diameter'$",
             {"lamp": dict(position=(1, 2, 3), angular_diameter=1)}),
            (TypeError, "sun_at: ", {"sun_at": np.array(0.5)}),
            (ValueError, "there is no environment", {"environment_tilt": 3}),
            (ValueError, "did you mean 'shadow'", {"layers": "shadows"}),
            (TypeError, "layers", {"layers": 3}),
            (ValueError, "dtype", {"dtype": "int16"}),
            (ValueError, "dtype", {"dtype": "nonsense"}),
            (TypeError, "dtype", {"dtype": 3}),
            (ValueError, "no colour", {"diffuse_color": "reddishest"}),
            (ValueError, "background: .*from 0 to 1 is expected", {"background": (5, -1, math.nan)}),
            (ValueError, "background: ", {"background": (0, 0, math.nan), "alpha": False}),
            (ValueError, "background: ", {"background": 1.5}),
            (ValueError, "background: ", {"background": (0, math.inf, 0), "dtype": "float32"}),
            (ValueError, "background: .*no colour", {"background": "reddishest"}),
            (ValueError, 'depth: .*"auto"', {"depth": "automatic"}),
            (ValueError, "give one of them", {"depth": 1, "subsurface_depth": 2}),
            (ValueError, 'exposure: .*"auto"', {"exposure": "bright"}),
            (ValueError, "there is no cmap", {"clim": (0, 1)}),
            (ValueError, "clim", {"clim": (1, 1), "cmap": np.eye(3)}),
            (ValueError, "clim: the table", {"clim": (0, 1), "cmap": vtkLookupTable()}),
            (ValueError, "clim: the pairs", {"clim": (0, 1), "cmap": [(0, "black"), (9, (1, 1, 1))]}),
            (ValueError, "clim: the pairs", {"clim": (0, 1), "cmap": iter([(0, "black"), (9, "red")])}),
            (TypeError, "cmap", {"cmap": 3}),
            (TypeError, "scene", {"scene": 3}),
            (TypeError, "alpha", {"alpha": 0}),
        )
        for kind, text, keywords in cases:
            with self.subTest(str(keywords)), self.assertRaisesRegex(kind, text):
                shade(heights, **keywords)
        for shape in ((0, 5), (5,), (2, 3, 4), ()):
            with self.subTest(shape), self.assertRaises(ValueError) as raised:
                shade(np.zeros(shape))
            self.assertRegex(str(raised.exception), "^heights: ")
            self.assertIn(str(shape), str(raised.exception))
        with self.assertRaisesRegex(ValueError, "heights: .*one length"):
            shade([[1.0, 2.0], [3.0]])

    def test_spacing_is_as_the_filter_takes_it(self):
        for size in (1e-32, 1e32):
            shade(hills(12, 10) * size, spacing=size)

    def test_messages_are_short(self):
        """Whatever is given and however long it is."""
        class Unshown:
            def __repr__(self):
                raise RuntimeError

        values = ("x" * 9999, b"y" * 9999, "line\n" * 99, 10 ** 400, -10 ** 30, 10 ** 9999, 1 << 31,
                  [[0.5] * 999] * 3, [10 ** 400] * 2, [10 ** 400] * 3, [10 ** 9999] * 4, "n" * 70,
                  np.zeros((300, 300), complex), np.zeros(3, [("a" * 99 + str(i), float) for i in range(9)]),
                  np.zeros((1,) * 32), {"a" * 9999: 1}, {"azimuth": 1, "altitude": 2, "b" * 999: 3},
                  {"position": (1, 2, 3), "intensity": 10 ** 400}, ["z" * 999], ("2026" * 99, 1, 2),
                  [(10 ** 400, "red")], [(1, "r" * 999)], Unshown(), [Unshown()], ...)
        heights, refused = hills(12, 10), 0
        for name in inspect.signature(shade).parameters:
            for i, value in enumerate(values):
                try:
                    if name == "heights":
                        shade(value)
                    else:
                        shade(heights, **{name: value})
                except (TypeError, ValueError, FileNotFoundError) as error:
                    refused += 1
                    with self.subTest(f"{name} {i}"):
                        self.assertLessEqual(len(str(error)), 200)
                        self.assertNotIn("\n", str(error))
                        self.assertIn(name, str(error))
        self.assertGreater(refused, 1000)
        with self.assertRaises(TypeError) as raised:
            shade(heights, **{"n" * 9999: 1})
        self.assertLess(len(str(raised.exception)), 200)

    def test_large_whole_numbers(self):
        """Are out of range as others are, and told the range."""
        heights = hills(12, 10)
        for row in self.rows():
            name = self.keyword(row)
            sky = {"environment": np.ones((4, 8))} if row["owner"] == "Environment" else {}
            for value in (10 ** 400, -10 ** 400, 1 << 31, -1 - (1 << 31)):
                if row["kind"] not in ("number", "length", "count", "color"):
                    continue
                if row["kind"] != "count" and abs(value) < 10 ** 99:
                    continue
                with self.subTest(f"{name} {value.bit_length()}"):
                    with self.assertRaisesRegex(ValueError, rf"{name}: .* was given, .*expected") as raised:
                        shade(heights, **{name: value}, **sky)
                    if math.isfinite(row["minimum"]):
                        self.assertIn(f"{row['minimum']:.9g}", str(raised.exception))
        for keywords in ({"nodata": 10 ** 400}, {"spacing": 10 ** 400}, {"sun": (10 ** 400, 45)},
                         {"lamp": (0, 0, 10 ** 400)}, {"clim": (0, 10 ** 400), "cmap": np.eye(3)},
                         {"depth": 10 ** 400}, {"background": (0, 0, 10 ** 400), "alpha": False}):
            with self.subTest(str(list(keywords))), self.assertRaisesRegex(ValueError, "expected"):
                shade(heights, **keywords)

    def test_nothing_is_printed(self):
        program = """if True:
            import numpy as np, reliefshading as r
            for keywords in (dict(tolerance=-1), dict(sun=(0, 99)), dict(layers="shadow", preset="sky-dome"),
                             dict(environment=np.ones((2, 2, 5)))):
                try:
                    r.shade(np.zeros((4, 4)), **keywords)
                except (RuntimeError, ValueError) as error:
                    assert len(str(error)) < 200 and "\\n" not in str(error), error
                else:
                    raise AssertionError(keywords)
        """
        result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    @unittest.skipUnless(sys.platform == "linux", "memory cannot be limited")
    def test_not_enough_memory(self):
        """Wherever it runs out there is a MemoryError or a picture, and nothing is printed."""
        program = """if True:
            import re, resource, numpy as np, reliefshading as r
            heights = np.add.outer(np.arange(2500.0, dtype="f4"), np.arange(2500.0, dtype="f4"))
            r.shade(heights[:99, :99])
            size = int(re.search(r"VmSize:\\s+(\\d+)", open("/proc/self/status").read())[1]) * 1024
            got = set()
            for more in (4, 30, 50, 60, 70, 80, 100, 150, 1000):
                resource.setrlimit(resource.RLIMIT_AS, (size + more * 2 ** 20, resource.RLIM_INFINITY))
                try:
                    got.add(r.shade(heights, layers=("illumination", "diffuse")).shape)
                except MemoryError as error:
                    got.add(type(error).__name__)
            print(sorted(map(str, got)))
        """
        result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout, "['(2500, 2500, 4)', 'MemoryError']\n")


if __name__ == "__main__":
    unittest.main()
