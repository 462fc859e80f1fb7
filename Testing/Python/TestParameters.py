# SPDX-License-Identifier: BSD-3-Clause
"""The list of parameters is complete, and what is written about them is what they are."""

import math
import os
import re
import subprocess
import unittest

import reliefshading
from vtkmodules.vtkRenderingCore import vtkLight

PAGES = os.path.join(os.path.dirname(__file__), "..", "..", "Documentation")
PARAMETERS = reliefshading.parameters()


def page(name):
    with open(os.path.join(PAGES, name + ".md"), encoding="utf-8") as stream:
        return stream.read()


def number(value):
    return "infinite" if math.isinf(value) else "%.9g" % value


def described(parameter):
    """A parameter's row in SceneFile.md."""
    kind, default = parameter["kind"], parameter["default"]
    low, high = parameter["minimum"], parameter["maximum"]
    if kind == "choice":
        value = ", ".join('`"%s"`' % name for name in parameter["choices"])
        usual = '`"%s"`' % default
    elif kind == "flag":
        value, usual = "`true`, `false`", "`%s`" % str(default).lower()
    elif kind == "length" and math.isinf(default):
        value, usual = "above 0, or `\"infinite\"`", "`\"infinite\"`"
    else:
        items = default if isinstance(default, tuple) else (default,)
        usual = ", ".join(number(item) for item in items)
        usual = "[%s]" % usual if len(items) > 1 else usual
        value = {"color": "three numbers", "range": "two numbers, the first not the larger",
                 "count": "a whole number"}.get(kind, "a number")
        if math.isfinite(low) and math.isfinite(high):
            value += ", %s to %s" % (number(low), number(high))
        elif math.isfinite(low):
            value += (", above %s" if parameter["minimum_open"] else ", at least %s") % number(low)
    unit = parameter["unit"]
    return "| `%s` | %s%s | %s | %s |" % (
        parameter["key"], value, " (%s)" % unit if unit else "", usual, parameter["help"])


class TestParameters(unittest.TestCase):
    def each(self, check):
        for parameter in PARAMETERS:
            with self.subTest(parameter["owner"] + "." + parameter["name"]):
                check(parameter)

    def test_setters(self):
        owners = {"Scene": reliefshading.vtkReliefScene, "Material": reliefshading.vtkReliefMaterial,
                  "Environment": reliefshading.vtkReliefEnvironment, "Light": vtkLight}

        def check(parameter):
            owner, name = owners[parameter["owner"]](), parameter["name"]
            if name == "AngularDiameter":
                scene = reliefshading.vtkReliefScene()
                scene.SetAngularDiameter(owner, 2.0)
                self.assertEqual(scene.GetAngularDiameter(owner), 2.0)
                return
            value = getattr(owner, "Get" + name)()
            if parameter["kind"] == "choice":
                self.assertEqual(parameter["choices"][value], parameter["default"])
                self.assertEqual(getattr(type(owner), parameter["default"]), value)
            else:
                self.assertEqual(value, parameter["default"])
            setter = getattr(owner, "Set" + name)
            setter(*value) if isinstance(value, tuple) else setter(value)

        self.each(check)

    def test_entries(self):
        self.assertGreater(len(PARAMETERS), 25)
        self.assertIn("parameters", reliefshading.__all__)

        def check(parameter):
            self.assertLessEqual(parameter["minimum"], parameter["maximum"])
            self.assertEqual(bool(parameter["choices"]), parameter["kind"] == "choice")
            self.assertTrue(parameter["help"])

        self.each(check)

    @unittest.skipUnless("RELIEFSHADE" in os.environ, "reliefshade is not built")
    def test_help_of_the_program(self):
        text = subprocess.run([os.environ["RELIEFSHADE"], "--help-all"], capture_output=True, text=True,
                              check=True).stdout
        entries = {}
        for entry in re.split(r"\n(?=  -)|\n\n", text):
            match = re.match(r"  (--[a-z-]+)", entry)
            if match:
                entries[match[1]] = " ".join(entry.split())

        def check(parameter):
            if parameter["option"]:
                entry = entries[parameter["option"]]
                self.assertIn(parameter["help"], entry)
                self.assertIn("Default: ", entry)
                if math.isfinite(parameter["maximum"]) and not parameter["choices"]:
                    self.assertIn("From %s to %s." % (
                        number(parameter["minimum"]), number(parameter["maximum"])), entry)

        self.each(check)

    def test_pages(self):
        scene_file, layers = page("SceneFile"), page("Layers")
        model = page("Model") + page("Environment") + page("Conventions")
        prefixes = {"Scene": "relief:", "Material": "relief:", "Environment": "relief:environment:",
                    "Light": "relief:lightN:"}
        attributes = " ".join(re.findall(r"^\| (`.*?) \|", layers, re.MULTILINE))

        def check(parameter):
            row = described(parameter)
            self.assertTrue(row in scene_file.splitlines(), "SceneFile.md lacks " + row)
            self.assertRegex(attributes, r"[:`]%s`" % parameter["key"])
            self.assertIn(prefixes[parameter["owner"]], attributes)
            if parameter["owner"] != "Light":
                self.assertIn(parameter["name"], model)

        self.each(check)


if __name__ == "__main__":
    unittest.main()
