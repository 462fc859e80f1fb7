# SPDX-License-Identifier: BSD-3-Clause
"""The widget for lights, driven from Python and heard there."""

import math
import unittest

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (windows and mappers)
from reliefshading import vtkReliefLightRepresentation, vtkReliefLightWidget, vtkReliefScene
from vtkmodules.vtkCommonCore import VTK_FLOAT
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkInteractionWidgets import vtkAbstractWidget, vtkWidgetRepresentation
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor


class TestLightWidget(unittest.TestCase):
    def test_drag(self):
        self.assertTrue(issubclass(vtkReliefLightWidget, vtkAbstractWidget))
        self.assertTrue(issubclass(vtkReliefLightRepresentation, vtkWidgetRepresentation))
        renderer = vtkRenderer()
        window = vtkRenderWindow()
        window.OffScreenRenderingOn()
        window.SetSize(200, 200)
        window.AddRenderer(renderer)
        interactor = vtkRenderWindowInteractor()
        interactor.SetRenderWindow(window)
        renderer.GetActiveCamera().ParallelProjectionOn()
        renderer.GetActiveCamera().SetParallelScale(1.0)  # 100 pixels a unit

        scene = vtkReliefScene()
        sun = scene.AddSun(0.0, 45.0)
        widget = vtkReliefLightWidget()
        widget.SetInteractor(interactor)
        dot = widget.GetLightRepresentation()
        dot.SetScene(scene)
        dot.PlaceWidget([-0.8, 0.8, -0.8, 0.8, 0.0, 0.0])
        altitudes = []
        widget.AddObserver("InteractionEvent", lambda *_: altitudes.append(
            math.degrees(math.asin(sun.GetPosition()[2]))))
        widget.On()
        window.Render()

        for event, x, y in (("LeftButtonPressEvent", 100, 140), ("MouseMoveEvent", 100, 120),
                            ("MouseMoveEvent", 160, 100), ("LeftButtonReleaseEvent", 160, 100)):
            interactor.SetEventInformation(x, y, 0, 0, "\0", 0, None)
            interactor.InvokeEvent(event)
        self.assertEqual(len(altitudes), 2)
        self.assertAlmostEqual(altitudes[0], 67.5)
        self.assertAlmostEqual(altitudes[1], 22.5)
        self.assertAlmostEqual(sun.GetPosition()[1], 0.0)
        at = [0.0, 0.0, 0.0]
        self.assertTrue(dot.GetDotPosition(at))
        self.assertAlmostEqual(at[0], 0.6)
        self.assertEqual(dot.GetInteractionState(), vtkReliefLightRepresentation.Nearby)
        widget.Off()

    def test_an_image_that_can_be_indexed(self):
        """As PyVista's, which VTK would take for bounds."""
        class Image(vtkImageData):
            def __getitem__(self, key):
                return self.GetPointData().GetArray(key)

        heights = Image()
        heights.SetDimensions(21, 11, 1)
        heights.SetSpacing(10.0, 10.0, 1.0)
        heights.AllocateScalars(VTK_FLOAT, 1)
        heights.GetPointData().GetScalars().Fill(0.0)
        scene = vtkReliefScene()
        scene.AddSun(90.0, 45.0)
        dot = vtkReliefLightRepresentation()
        dot.SetScene(scene)
        dot.PlaceOnHeights(heights)
        at = [0.0, 0.0, 0.0]
        self.assertTrue(dot.GetDotPosition(at))
        self.assertAlmostEqual(at[0], 125.0)
        self.assertAlmostEqual(at[1], 50.0)


if __name__ == "__main__":
    unittest.main()
