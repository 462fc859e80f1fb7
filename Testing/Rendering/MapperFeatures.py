# SPDX-License-Identifier: BSD-3-Clause
"""Every feature of vtkReliefImageMapper in a picture of its own, all in one window.

    MapperFeatures.py PICTURE.png
"""

import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (windows and mappers)
from reliefshading import vtkReliefImageMapper
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkImageSlice, vtkLight,
                                         vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

SIZE = 200


def image(values):
    result = vtkImageData()
    result.SetDimensions(values.shape[1], values.shape[0], 1)
    components = 1 if values.ndim == 2 else values.shape[2]
    result.GetPointData().SetScalars(numpy_to_vtk(values.reshape(-1, components), deep=True))
    return result


def relief():
    """A dome in a hollow, with letters of bars beside it."""
    y, x = np.mgrid[0:SIZE, 0:SIZE].astype(np.float32)
    r = np.hypot(x - 90.0, y - 110.0)
    heights = 28.0 * np.sqrt(np.clip(1.0 - (r / 48.0) ** 2, 0.0, 1.0))
    heights -= 10.0 * np.exp(-((r - 62.0) / 9.0) ** 2)
    heights += 1.5 * np.sin(0.4 * x) * np.sin(0.3 * y)
    for column in range(5):
        left = 150 + 8 * column
        heights[20 + 12 * column:90, left:left + 4] += 8.0 + 3.0 * column
    return heights.astype(np.float32)


def add_lamp(mapper, x, y, z):
    lamp = vtkLight()
    lamp.PositionalOn()
    lamp.SetPosition(x, y, z)
    mapper.GetScene().AddLight(lamp)


def material(mapper):
    return mapper.GetScene().GetMaterial()


def default_sun(mapper, image_slice, renderer):
    pass


def lamp(mapper, image_slice, renderer):
    add_lamp(mapper, 30.0, 150.0, 45.0)


def deep_along_the_normal(mapper, image_slice, renderer):
    mapper.GetScene().AddSun(300.0, 15.0)
    material(mapper).SetOffsetModeToSurfaceNormal()
    material(mapper).SetSubsurfaceDepth(6.0)


def exponential(mapper, image_slice, renderer):
    mapper.GetScene().AddSun(300.0, 15.0)
    material(mapper).SetAttenuationToExponential()
    material(mapper).SetDensity(0.1)


def lit_from_behind(mapper, image_slice, renderer):
    add_lamp(mapper, 90.0, 110.0, -60.0)
    material(mapper).UseFloorOn()
    material(mapper).SetFloorHeight(-16.0)
    material(mapper).SetSubsurfaceDepth(12.0)
    material(mapper).SetForwardScatterCoefficient(0.6)
    material(mapper).SetDiffuseColor(1.0, 0.7, 0.5)


def highlights(mapper, image_slice, renderer):
    mapper.GetScene().AddSun(300.0, 50.0)
    material(mapper).SetSpecularCoefficient(0.5)
    material(mapper).SetSpecularRange(0.4, 1.0)
    material(mapper).SetSpecularPower(4.0)
    material(mapper).SetDiffuseColor(0.6, 0.35, 0.1)


def sun_and_sky(mapper, image_slice, renderer):
    mapper.GetScene().SetLightsToSunAndSky(240.0, 35.0)


def texture_and_table(mapper, image_slice, renderer):
    table = vtkColorTransferFunction()
    table.AddRGBPoint(-10.0, 0.1, 0.4, 0.3)
    table.AddRGBPoint(30.0, 0.95, 0.85, 0.7)
    mapper.SetLookupTable(table)
    checks = (np.indices((10, 10)).sum(axis=0) % 2 * 255).astype(np.uint8)
    picture = np.dstack([np.full_like(checks, 200), checks, checks, np.full_like(checks, 110)])
    mapper.SetDiffuseTextureData(image(picture))
    mapper.StretchTexturesOn()


def holes(mapper, image_slice, renderer):
    y, x = np.mgrid[0:SIZE, 0:SIZE]
    mapper.SetMaskData(image((np.hypot(x - 130, y - 60) > 35).astype(np.uint8)))
    renderer.SetBackground(0.2, 0.3, 0.6)


def fixed_step(mapper, image_slice, renderer):
    mapper.GetScene().AddSun(300.0, 15.0)
    mapper.GetScene().SetIntegratorToFixedStep()


def cropped_and_clipped(mapper, image_slice, renderer):
    mapper.CroppingOn()
    mapper.SetCroppingRegion(20, 170, 30, 199, 0, 0)
    plane = vtkPlane()
    plane.SetOrigin(0.0, 180.0, 0.0)
    plane.SetNormal(0.3, -1.0, 0.0)
    mapper.AddClippingPlane(plane)
    image_slice.GetProperty().SetOpacity(0.6)
    renderer.SetBackground(0.5, 0.1, 0.1)


def slanted(mapper, image_slice, renderer):
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOff()
    camera.SetPosition(250.0, -120.0, 150.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCameraClippingRange()


FEATURES = [default_sun, lamp, deep_along_the_normal, exponential, lit_from_behind, highlights,
            sun_and_sky, texture_and_table, holes, fixed_step, cropped_and_clipped, slanted]

window = vtkRenderWindow()
window.OffScreenRenderingOn()
window.SetMultiSamples(0)
window.SetSize(4 * SIZE, 3 * SIZE)
heights = image(relief())
for number, feature in enumerate(FEATURES):
    mapper = vtkReliefImageMapper()
    mapper.SetInputData(heights)
    image_slice = vtkImageSlice()
    image_slice.SetMapper(mapper)
    renderer = vtkRenderer()
    column, row = number % 4, 2 - number // 4
    renderer.SetViewport(column / 4.0, row / 3.0, (column + 1) / 4.0, (row + 1) / 3.0)
    renderer.AddViewProp(image_slice)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    renderer.GetActiveCamera().ParallelProjectionOn()
    renderer.GetActiveCamera().SetParallelScale(SIZE / 2.0)
    feature(mapper, image_slice, renderer)
    print(f"Picture {number}: {feature.__name__}")

picture = vtkWindowToImageFilter()
picture.SetInput(window)
picture.ReadFrontBufferOff()
writer = vtkPNGWriter()
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName(sys.argv[1])
writer.Write()
if writer.GetErrorCode():
    raise SystemExit(f"{sys.argv[1]} cannot be written")
