# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of the examples, and hero.png: terrain at sunset beside the two medallions.

    python3 make_hero.py
"""

import pathlib
import subprocess
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (windows and mappers)
from reliefshading import vtkImageReliefShading, vtkOpenImageIOReader
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import (vtkImageCast, vtkImageResample, vtkImageResize,
                                        vtkImageSincInterpolator)
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

IMAGES = pathlib.Path(__file__).resolve().parent
EXAMPLES = IMAGES.parents[1] / "Examples"
HEIGHTS = EXAMPLES / "Data" / "jacksboro.tif"

sys.path.insert(0, str(EXAMPLES / "Python"))
from draped_relief import draped_relief  # noqa: E402

EXAGGERATION = 2.5
OVERSAMPLING = 2


def pixels(image):
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[..., :3]


def terrain(width, height):
    metres = vtkOpenImageIOReader()
    metres.SetFileName(str(HEIGHTS))
    metres.SetDataSpacing(74.6, 92.5, 1.0)  # 3 seconds of arc
    floats = vtkImageCast()
    floats.SetInputConnection(metres.GetOutputPort())
    floats.SetOutputScalarTypeToFloat()
    heights = vtkImageResample()  # the foreground is nearer than the samples are dense
    heights.SetInputConnection(floats.GetOutputPort())
    heights.SetMagnificationFactors(3.0, 3.0, 1.0)
    heights.SetInterpolationModeToCubic()

    shading = vtkImageReliefShading()
    shading.SetInputConnection(heights.GetOutputPort())
    shading.SetOutputScalarTypeToUnsignedChar()
    scene = shading.GetScene()
    scene.SetHeightScale(EXAGGERATION)
    scene.GetMaterial().SetSubsurfaceDepth(70.0)
    scene.GetMaterial().SetDiffuseColor(1.0, 0.9, 0.78)
    sun = scene.AddSun(292.0, 16.0)
    sun.SetDiffuseColor(1.0, 0.64, 0.33)
    sun.SetIntensity(1.2)
    for azimuth in range(0, 360, 30):
        sky = scene.AddSun(azimuth, 45.0)
        sky.SetDiffuseColor(0.3, 0.52, 1.0)
        sky.SetIntensity(0.018)

    heights.Update()
    renderer = vtkRenderer()
    renderer.AddActor(draped_relief(heights, shading, EXAGGERATION))
    renderer.GradientBackgroundOn()
    renderer.SetBackground(1.0, 0.72, 0.45)
    renderer.SetBackground2(0.62, 0.7, 0.82)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(17000.0, -8000.0, 8500.0)
    camera.SetFocalPoint(15200.0, 14000.0, 200.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(OVERSAMPLING * width, OVERSAMPLING * height)
    window.AddRenderer(renderer)
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    fine = pixels(picture.GetOutput())
    return fine.reshape(height, OVERSAMPLING, width, OVERSAMPLING, 3).mean(axis=(1, 3))


def run_example(name, picture, *arguments):
    subprocess.run([sys.executable, EXAMPLES / "Python" / f"{name}.py", *arguments,
                    IMAGES / picture], check=True)


def relief(picture, size):
    reader = vtkPNGReader()
    reader.SetFileName(str(IMAGES / picture))
    sinc = vtkImageSincInterpolator()
    sinc.AntialiasingOn()
    resize = vtkImageResize()
    resize.SetInputConnection(reader.GetOutputPort())
    resize.SetInterpolator(sinc)
    resize.SetOutputDimensions(size, size, 1)
    resize.Update()
    return pixels(resize.GetOutput())


def main():
    run_example("ShadeTerrain", "shade-terrain.png", HEIGHTS)
    run_example("DrapeTerrain", "drape-terrain.png", HEIGHTS)
    run_example("TintTerrain", "tint-terrain.png", HEIGHTS)
    run_example("TextureTerrain", "texture-terrain.png", HEIGHTS)
    run_example("DragLight", "drag-light.png", HEIGHTS)
    run_example("Medallion", "medallion.png")
    run_example("BacklitMedallion", "backlit-medallion.png")

    # Row 0 is at the bottom, as in an image of VTK.
    reliefs = np.vstack((relief("backlit-medallion.png", 400), relief("medallion.png", 400)))
    colors = np.hstack((terrain(1200, 800), reliefs)).round().astype(np.uint8)
    image = vtkImageData()
    image.SetDimensions(colors.shape[1], colors.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(colors.reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(str(IMAGES / "hero.png"))
    writer.SetInputData(image)
    writer.Write()


if __name__ == "__main__":
    main()
