# SPDX-License-Identifier: BSD-3-Clause
"""Drapes a picture over a tinted elevation model and shows the two in perspective.

    python3 TextureTerrain.py ../Data/jacksboro.tif [picture.png]

The picture is invented: autumn woods wherever the ground is steep, as they are in the Appalachians,
where the farms have the valleys. Put an aerial photograph or a map of land cover in its place.
"""

import argparse

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageCast, vtkImageResample
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkRenderer, vtkRenderWindow

from draped_relief import draped_relief
from show_or_write import show_or_write

EXAGGERATION = 2.0
TEXEL = 30.0  # metres; the heights' samples are about 28 m apart


def smooth(array, radius):
    """The mean over squares, twice, which is smooth enough for land."""
    size = 2 * radius + 1
    for axis in (0, 1, 0, 1):
        sums = np.cumsum(np.pad(array, [(radius + 1, radius) if a == axis else (0, 0)
                                        for a in (0, 1)], "edge"), axis)
        count = array.shape[axis]
        array = (sums.take(range(size, size + count), axis) - sums.take(range(count), axis)) / size
    return array


def woods(image):
    """A picture of woods over an image of heights, transparent where there are none."""
    columns, rows, _ = image.GetDimensions()
    dx, dy, _ = image.GetSpacing()
    heights = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns)
    steepness = smooth(np.hypot(*np.gradient(heights.astype(float), dy, dx)), 6)

    # The texture has texels of its own, as a photograph would: here from the nearest height.
    y = np.arange(0.0, (rows - 1) * dy, TEXEL)
    x = np.arange(0.0, (columns - 1) * dx, TEXEL)
    at = np.ix_(np.rint(y / dy).astype(int), np.rint(x / dx).astype(int))
    random = np.random.default_rng(5)
    trees = random.random((y.size, x.size))
    stands = smooth(random.random((y.size, x.size)), 6)
    stands = (stands - stands.mean()) / stands.std()

    autumn = np.clip(0.4 + 0.2 * stands + 0.9 * (trees - 0.5), 0.0, 1.0)[..., np.newaxis]
    green, rust = np.array((0.25, 0.34, 0.17)), np.array((0.58, 0.38, 0.18))
    rgba = np.empty((y.size, x.size, 4))
    rgba[..., :3] = (green + autumn * (rust - green)) * (0.7 + 0.5 * trees[..., np.newaxis])
    rgba[..., 3] = 25.0 * (steepness[at] - 0.15) + 0.7 * stands + 2.0 * trees

    picture = vtkImageData()
    picture.SetDimensions(x.size, y.size, 1)
    picture.SetSpacing(TEXEL, TEXEL, 1.0)
    codes = np.rint(255.0 * np.clip(rgba, 0.0, 1.0)).astype(np.uint8)  # as pictures are: sRGB
    picture.GetPointData().SetScalars(numpy_to_vtk(codes.reshape(-1, 4), deep=True))
    return picture


parser = argparse.ArgumentParser(description="Drape a picture over an elevation model.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

# The file's samples are 3 seconds of arc apart. They come in metres, as heights do.
reader = vtkReliefRasterReader()
reader.SetFileName(arguments.heights)
reader.Update()
if reader.GetErrorCode():
    raise SystemExit(1)  # the reader has said why

# The foreground is nearer than the samples are dense.
floats = vtkImageCast()
floats.SetInputConnection(reader.GetOutputPort())
floats.SetOutputScalarTypeToFloat()
heights = vtkImageResample()
heights.SetInputConnection(floats.GetOutputPort())
heights.SetMagnificationFactors(3.0, 3.0, 1.0)
heights.SetInterpolationModeToCubic()
heights.Update()

# Meadows and fields below, bare summits above.
tints = vtkColorTransferFunction()
tints.AddRGBPoint(240.0, 0.33, 0.44, 0.22)
tints.AddRGBPoint(320.0, 0.52, 0.54, 0.28)
tints.AddRGBPoint(420.0, 0.60, 0.53, 0.33)
tints.AddRGBPoint(1080.0, 0.52, 0.49, 0.36)

shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
shading.SetDiffuseTextureData(woods(heights.GetOutput()))
shading.SetLookupTable(tints)  # shows where the picture is transparent
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects

scene = shading.GetScene()
scene.SetHeightScale(EXAGGERATION)
scene.GetMaterial().SetSubsurfaceDepth(60.0)
scene.SetLightsToSunAndSky(290.0, 26.0)
scene.GetLights().GetItemAsObject(0).SetIntensity(2.0)
scene.GetEnvironment().SetIntensity(0.7)
scene.GetEnvironment().SetNumberOfSamples(32)

renderer = vtkRenderer()
renderer.AddActor(draped_relief(heights, shading, EXAGGERATION))
renderer.GradientBackgroundOn()
renderer.SetBackground(0.93, 0.89, 0.80)
renderer.SetBackground2(0.52, 0.66, 0.82)
camera = renderer.GetActiveCamera()
camera.SetPosition(20500.0, -5500.0, 7600.0)
camera.SetFocalPoint(17500.0, 12000.0, 900.0)
camera.SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCameraClippingRange()

window = vtkRenderWindow()
window.SetSize(900, 600)
window.SetWindowName("TextureTerrain")
window.AddRenderer(renderer)
show_or_write(window, arguments.picture)
