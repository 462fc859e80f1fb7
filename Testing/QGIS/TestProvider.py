# SPDX-License-Identifier: BSD-3-Clause
"""The algorithm of QGIS's Processing, run from the command line and shown as a layer.

TestProvider.py QGIS_PROCESS RELIEFSHADE PLUGINS JACKSBORO
"""

import json
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

QGIS_PROCESS, RELIEFSHADE, PLUGINS, JACKSBORO = sys.argv[1:5]
home = tempfile.TemporaryDirectory()
os.environ.update(HOME=home.name, QT_QPA_PLATFORM="offscreen", QGIS_PLUGINPATH=PLUGINS,
                  RELIEFSHADE=RELIEFSHADE, XDG_RUNTIME_DIR=home.name)
SHADE = "reliefshading:shade"

sys.path[:0] = ["/usr/share/qgis/python", "/usr/share/qgis/python/plugins", PLUGINS]
from osgeo import gdal  # noqa: E402
from qgis.core import (  # noqa: E402
    QgsApplication, QgsContrastEnhancement, QgsProcessingContext, QgsProcessingException,
    QgsProcessingFeedback, QgsProject, QgsRasterLayer)
from qgis.PyQt.QtGui import QColor, QPainter  # noqa: E402

gdal.UseExceptions()
application = QgsApplication([], False)
application.initQgis()

from processing.core.Processing import Processing  # noqa: E402
import processing  # noqa: E402

Processing.initialize()
import reliefshading_qgis  # noqa: E402
from reliefshading_qgis import algorithm, program  # noqa: E402


def table():
    return json.loads(subprocess.run([RELIEFSHADE, "--parameters"], check=True,
                                     stdout=subprocess.PIPE).stdout)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def shaded(self, name, *words):
        """What the program itself makes."""
        subprocess.run([RELIEFSHADE, JACKSBORO, self.path(name), "--quiet", *words], check=True)
        return self.values(name)

    def values(self, name):
        return gdal.Open(self.path(name)).ReadAsArray().tolist()


class CommandLine(Case):
    def qgis(self, *words):
        return subprocess.run([QGIS_PROCESS, *words], capture_output=True, text=True, check=False,
                              cwd=self.folder)

    @classmethod
    def setUpClass(cls):
        subprocess.run([QGIS_PROCESS, "plugins", "enable", "reliefshading_qgis"], check=True,
                       capture_output=True)

    def test_is_listed_with_all_parameters(self):
        self.assertIn(SHADE + "\tRelief shading", self.qgis("list").stdout)
        told = self.qgis("help", SHADE).stdout
        for entry in table():
            self.assertIn("\n" + algorithm.nameOf(entry) + ": ", told)
            self.assertIn(entry["help"], told)

    def test_runs(self):
        done = self.qgis("run", SHADE, "--INPUT=" + JACKSBORO, "--OUTPUT=" + self.path("o.tif"),
                         "--SHADOW=" + self.path("s.tif"), "--AZIMUTH=200", "--ALTITUDE=15",
                         "--DEPTH=100", "--OFFSET=0", "--KS=0.2", "--SPECULAR_RANGE=0.5,1",
                         "--SUN_SAMPLES=5", "--SUN_DIAMETER=3")
        self.assertEqual(done.returncode, 0, done.stderr)
        wanted = self.shaded("p.tif", "--sun", "200,15", "--depth", "100", "--offset", "vertical",
                             "--ks", "0.2", "--specular-range", "0.5,1", "--sun-samples", "5",
                             "--sun-diameter", "3", "--shadow-mask", self.path("q.tif"))
        self.assertEqual(self.values("o.tif"), wanted)
        self.assertEqual(self.values("s.tif"), self.values("q.tif"))
        # It lies over the input.
        one, other = gdal.Open(JACKSBORO), gdal.Open(self.path("o.tif"))
        self.assertEqual(one.GetGeoTransform(), other.GetGeoTransform())
        self.assertTrue(one.GetSpatialRef().IsSame(other.GetSpatialRef()))

    def test_tells_what_is_wrong(self):
        done = self.qgis("run", SHADE, "--INPUT=" + JACKSBORO, "--OUTPUT=" + self.path("o.tif"),
                         "--TIME=today")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("'today' is no date", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])


class InProcess(Case):
    @classmethod
    def setUpClass(cls):
        cls.plugin = reliefshading_qgis.classFactory(None)
        cls.plugin.initProcessing()

    @classmethod
    def tearDownClass(cls):
        cls.plugin.unload()

    def run_(self, **parameters):
        given = {"INPUT": JACKSBORO, "OUTPUT": self.path("o.tif"), **parameters}
        return processing.run(SHADE, given)

    def refused(self, fragment, **parameters):
        with self.assertRaises(QgsProcessingException) as caught:
            self.run_(**parameters)
        self.assertIn(fragment, str(caught.exception))

    def test_lights(self):
        for light, words in enumerate((["--sun", "315,45"], ["--preset", "multidirectional"],
                                       ["--preset", "sky-dome", "--env-samples", "16"],
                                       ["--preset", "sun-and-sky,315,45", "--env-samples", "16"],
                                       ["--preset", "combined,315,45"], ["--preset", "igor,315"])):
            more = {"ENV_SAMPLES": 16} if light in (2, 3) else {}
            self.run_(LIGHT=light, **more)
            self.assertEqual(self.values("o.tif"), self.shaded("p.tif", *words), words)
        self.run_(TIME="2026-06-21T15:00Z")
        self.assertEqual(self.values("o.tif"), self.shaded("p.tif", "--sun-at", "2026-06-21T15:00Z"))

    def test_what_is_chosen_is_taken(self):
        # Also where it is the default, if the light brings another one.
        words = ["--preset", "sun-and-sky,315,45", "--env-samples", "16", "--env-sampling"]
        spread = [entry for entry in table() if entry["option"] == "--env-sampling"][0]
        for at, word in enumerate(spread["choices"]):
            self.run_(LIGHT=3, ENV_SAMPLES=16, ENV_SAMPLING=at)
            self.assertEqual(self.values("o.tif"), self.shaded("p.tif", *words, word), word)

    def test_colors_are_those_of_the_screen(self):
        self.run_(BASE="#ff0000", DIFFUSE="#000000", SPECULAR="#000000")
        red = self.values("o.tif")
        self.assertEqual({value for row in red[0] for value in row}, {255})
        self.run_(BASE="#804020", DIFFUSE="#000000")
        self.assertEqual([{value for row in band for value in row} for band in self.values("o.tif")],
                         [{128}, {64}, {32}])

    def test_more_options(self):
        self.run_(EXTRA="--point '-84.3,36.6,2000' --nodata 300")
        self.assertEqual(
            self.values("o.tif"),
            self.shaded("p.tif", "--sun", "315,45", "--point", "-84.3,36.6,2000", "--nodata", "300"))
        self.refused("quotes come in pairs", EXTRA="--point '1")
        self.refused("--dept", EXTRA="--dept 3")

    def test_refusals(self):
        self.refused("it is that of 'One sun'", LIGHT=2, TIME="2026-06-21T15:00Z")
        memory = QgsRasterLayer(
            "crs=EPSG:4326&url=http://localhost/none&layers=a&styles=&format=image/png", "web", "wms")
        QgsProject.instance().addMapLayer(memory)
        try:
            if memory.isValid():
                self.refused("a raster file is expected", INPUT=memory.id())
        finally:
            QgsProject.instance().removeMapLayer(memory)
        self.refused("none.tif", INPUT=self.path("none.tif"))
        self.assertFalse(os.path.exists(self.path("o.tif")))

    def test_missing_program(self):
        os.environ["RELIEFSHADE"] = self.path("nothing")
        try:
            possible, why = algorithm.Shading().canExecute()
            self.assertFalse(possible)
            self.assertIn("is no program", why)
        finally:
            os.environ["RELIEFSHADE"] = RELIEFSHADE
        self.assertTrue(algorithm.Shading().canExecute()[0])

    def test_cancel(self):
        rows = 4000
        large = gdal.Translate(self.path("large.tif"), JACKSBORO, width=rows, height=rows)
        del large
        feedback = QgsProcessingFeedback()
        threading.Timer(0.5, feedback.cancel).start()
        begun = time.monotonic()
        done = program.run([self.path("large.tif"), self.path("o.tif"), "--preset", "sun-and-sky",
                            "--threads", "1"], feedback)
        self.assertFalse(done)
        self.assertLess(time.monotonic() - begun, 20)
        self.assertEqual(os.listdir(self.folder), ["large.tif"])

    def test_is_shown_as_it_is(self):
        for more, bands in (({}, 1), ({"DIFFUSE": "#ff8040"}, 3),
                            ({"EXTRA": "--nodata 300 --bands rgba"}, 4)):
            self.run_(**more)
            layer = QgsRasterLayer(self.path("o.tif"), "shaded")
            self.assertEqual(layer.bandCount(), bands)
            algorithm.style(layer, bands == 1)
            renderer = layer.renderer()
            if bands == 1:
                self.assertEqual(renderer.contrastEnhancement().contrastEnhancementAlgorithm(),
                                 QgsContrastEnhancement.NoEnhancement)
                self.assertEqual(layer.blendMode(), QPainter.CompositionMode_Multiply)
            else:
                self.assertIsNone(renderer.redContrastEnhancement())
                self.assertEqual(layer.blendMode(), QPainter.CompositionMode_SourceOver)
            self.assertEqual(renderer.alphaBand(), 4 if bands == 4 else -1)
            # The picture on the map is the file's.
            block = renderer.block(1, layer.extent(), layer.width(), layer.height())
            values = self.values("o.tif")
            first = values if bands == 1 else values[0]
            for x, y in ((10, 10), (200, 100), (300, 300)):
                color = QColor.fromRgba(block.color(y, x))
                if color.alpha() == 255:
                    self.assertEqual(color.red(), first[y][x])

    def test_loaded_layers_get_the_style(self):
        context = QgsProcessingContext()
        context.setProject(QgsProject())
        feedback = QgsProcessingFeedback()
        shading = QgsApplication.processingRegistry().createAlgorithmById(SHADE)
        details = QgsProcessingContext.LayerDetails("shaded", context.project(), "OUTPUT")
        context.addLayerToLoadOnCompletion(self.path("o.tif"), details)
        results, done = shading.run({"INPUT": JACKSBORO, "OUTPUT": self.path("o.tif"),
                                     "MULTIPLY": True}, context, feedback)
        self.assertTrue(done)
        layer = QgsRasterLayer(results["OUTPUT"], "shaded")
        post = context.layerToLoadOnCompletionDetails(self.path("o.tif")).postProcessor()
        post.postProcessLayer(layer, context, feedback)
        self.assertEqual(layer.blendMode(), QPainter.CompositionMode_Multiply)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
