# SPDX-License-Identifier: BSD-3-Clause
"""The package offers every class, with its help, and reports errors as VTK does."""

import os
import subprocess
import sys
import unittest

import reliefshading
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonExecutionModel import vtkImageAlgorithm

# By the module that brings them.
ROOMS = {
    "Imaging": ("vtkImageReliefShading", "vtkReliefAccuracyReport", "vtkReliefEnvironment",
                "vtkReliefMaterial", "vtkReliefParameters", "vtkReliefScene", "vtkReliefStatistics",
                "vtkReliefStepSmoothing", "vtkReliefVerification"),
    "Rendering": ("vtkReliefImageMapper", "vtkOpenGLReliefImageMapper"),
    "Interaction": ("vtkReliefLightRepresentation", "vtkReliefLightWidget"),
    "IO": ("vtkReliefEnvironmentImage", "vtkReliefMeshReader", "vtkReliefSceneFile"),
    # What IO has only where it is built with OpenImageIO.
    "OpenImageIO": ("vtkOpenEXRLayerWriter", "vtkOpenImageIOReader", "vtkOpenImageIOWriter"),
    "Heights": ("vtkDepthToHeightField", "vtkNormalMapToHeightField", "vtkReliefCompression"),
    "Raster": ("vtkReliefRasterReader", "vtkReliefRasterWriter"),
    "Streaming": ("vtkReliefPieceWriter",),
}
BUILT = os.environ.get("RELIEFSHADING_ROOMS", " ".join(ROOMS)).split()
# Written in Python.
FUNCTIONS = ("Relief", "ReliefImage", "ReliefWarning", "raise_errors", "read_scene", "shade", "shade_pieces", "update",
             "write_scene")
CLASSES = [name for room in BUILT for name in ROOMS[room]]


class TestImport(unittest.TestCase):
    def test_classes(self):
        for name in CLASSES:
            with self.subTest(name):
                instance = getattr(reliefshading, name)()
                self.assertIsInstance(instance, vtkObject)
                self.assertIn(instance.GetClassName(), (name, name.replace("vtkRelief", "vtkOpenGLRelief")))
                self.assertIn(instance.GetClassName(), str(instance))
        self.assertTrue(issubclass(reliefshading.vtkImageReliefShading, vtkImageAlgorithm))

    def test_names(self):
        self.assertEqual(sorted(reliefshading.__all__), sorted(["__version__", "parameters", *FUNCTIONS, *CLASSES]))
        self.assertLessEqual(set(reliefshading.__all__), set(dir(reliefshading)))
        with self.assertRaises(AttributeError):
            reliefshading.vtkNoSuchClass
        everything = {}
        exec("from reliefshading import *", everything)
        self.assertLessEqual(set(CLASSES), set(everything))

    def test_loads_what_is_used(self):
        """The filter brings neither OpenGL nor the libraries of image formats."""
        program = ("import reliefshading; reliefshading.vtkImageReliefShading(); "
                   "reliefshading.shade([[1, 2], [3, 4]]); "
                   "print(open('/proc/self/maps', encoding='utf-8').read())")
        maps = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True,
                              text=True).stdout
        self.assertIn("libvtkReliefShading", maps)
        for library in ("libGL", "OpenImageIO", "OpenEXR", "libgdal", "vtkRenderingReliefShading"):
            self.assertNotIn(library, maps)

    def test_help(self):
        for name in CLASSES:
            with self.subTest(name):
                text = getattr(reliefshading, name).__doc__
                self.assertIn(name, text)
                self.assertGreater(len(text.splitlines()), 5)
        text = reliefshading.vtkReliefMaterial.SetSubsurfaceDepth.__doc__
        self.assertIn("how far below the surface", " ".join(text.split()))

    def test_modes(self):
        material = reliefshading.vtkReliefMaterial()
        material.SetOffsetModeToSurfaceNormal()
        self.assertEqual(material.GetOffsetMode(), reliefshading.vtkReliefMaterial.SurfaceNormal)
        material.SetOffsetMode(reliefshading.vtkReliefMaterial.Vertical)
        self.assertEqual(material.GetOffsetMode(), 0)
        material.SetOffsetModeToTangentPlane()
        self.assertEqual(material.GetOffsetMode(), reliefshading.vtkReliefMaterial.TangentPlane)

    def test_colors_are_tuples(self):
        material = reliefshading.vtkReliefMaterial()
        material.SetDiffuseColor(0.25, 0.5, 0.75)
        self.assertEqual(material.GetDiffuseColor(), (0.25, 0.5, 0.75))
        material.SetBaseColor((0.5, 0.25, 0.0))
        self.assertEqual(material.GetBaseColor(), (0.5, 0.25, 0.0))

    def test_refusal_keeps_the_value(self):
        material = reliefshading.vtkReliefMaterial()
        errors = []
        material.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        material.SetSpecularCoefficient(2.0)
        material.SetSubsurfaceDepth(-1.0)
        self.assertEqual(len(errors), 2)
        self.assertEqual(material.GetSpecularCoefficient(), 0.0)
        self.assertEqual(material.GetSubsurfaceDepth(), 1.0)

    def test_scene_owns_its_suns(self):
        scene = reliefshading.vtkReliefScene()
        sun = scene.AddSun(90.0, 30.0)
        self.assertEqual(scene.GetLights().GetNumberOfItems(), 1)
        toward = [a - b for a, b in zip(sun.GetPosition(), sun.GetFocalPoint())]
        length = sum(c * c for c in toward) ** 0.5
        self.assertAlmostEqual(toward[0] / length, 0.75 ** 0.5)
        self.assertAlmostEqual(toward[1] / length, 0.0)
        self.assertAlmostEqual(toward[2] / length, 0.5)


if __name__ == "__main__":
    unittest.main()
