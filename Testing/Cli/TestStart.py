# SPDX-License-Identifier: BSD-3-Clause
"""A run of reliefshade loads the libraries that it uses and no others: time is lost in them."""

import os
import re
import subprocess
import sys
import unittest

from Reliefshade import JACKSBORO, PROGRAM, Case, needsGdal

FORMATS = r"OpenImageIO|OpenEXR|IOReliefShading|reliefshade-formats"
WINDOWS = r"libGL|libOpenGL|libGLX|libEGL|libX11|libQt|RenderingOpenGL2|InteractionWidgets"


@unittest.skipUnless(sys.platform == "linux", "asks Linux's loader")
@unittest.skipIf(os.environ["RELIEFSHADE_SHARED"] != "1", "libraries are static")
class Start(Case):
    def loaded(self, *words):
        """The libraries that a run looks for, as the loader tells them."""
        environment = dict(os.environ, LD_DEBUG="files")
        result = subprocess.run([PROGRAM, *words], cwd=self.folder, env=environment,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0)
        return set(re.findall(r"file=(\S+) \[0\];  generating link map", result.stderr))

    def assertLoads(self, libraries, pattern):
        self.assertTrue([name for name in libraries if re.search(pattern, name)], pattern)

    def assertSpares(self, libraries, pattern):
        self.assertEqual([name for name in libraries if re.search(pattern, name)], [])

    def test_version(self):
        libraries = self.loaded("--version")
        self.assertLoads(libraries, "vtkReliefShading")
        self.assertSpares(libraries, FORMATS + "|" + WINDOWS)

    @needsGdal
    def test_raster_to_raster(self):
        self.assertSpares(self.loaded(JACKSBORO, "out.tif"), FORMATS + "|" + WINDOWS)

    def test_other_formats_when_they_are_used(self):
        libraries = self.loaded(self.hills(), "out.png")
        self.assertLoads(libraries, "OpenImageIO")
        libraries = self.loaded("hills.asc", "out.png", "--save-scene", "scene.json")
        self.assertLoads(libraries, "IOReliefShading")


if __name__ == "__main__":
    unittest.main()
