# SPDX-License-Identifier: BSD-3-Clause
"""Shades terrain into a multi-layer OpenEXR file and does with it what a compositor does: another
light, without shading again.

    python3 LayersForCompositing.py ../Data/jacksboro.tif layers.exr [picture.png]
"""

import argparse

import numpy as np
from reliefshading import (vtkImageReliefShading, vtkOpenEXRLayerWriter, vtkOpenImageIOReader,
                           vtkReliefRasterReader)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGWriter

from NumpyShading import to_image

parser = argparse.ArgumentParser(description="Shade terrain into layers and combine them anew.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("layers", help="OpenEXR file to write")
parser.add_argument("picture", nargs="?", help="PNG file of the new combination")
arguments = parser.parse_args()

heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)

shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
scene = shading.GetScene()
scene.SetHeightScale(2.0)
scene.AddSun(315.0, 30.0)
material = scene.GetMaterial()
material.SetSubsurfaceDepth(80.0)
material.SetBaseColor(0.02, 0.03, 0.05)
material.SetDiffuseColor(0.7, 0.7, 0.7)
material.SetSpecularCoefficient(0.15)
material.SetSpecularPower(8.0)
shading.GenerateBaseOn()
shading.GenerateDiffuseOn()
shading.GenerateSpecularOn()
shading.GenerateIlluminationOn()
shading.GenerateNormalsOn()

writer = vtkOpenEXRLayerWriter()
writer.SetInputConnection(shading.GetOutputPort())
writer.SetScene(scene)  # its parameters go into the file's header
writer.SetPixelTypeToHalf()  # enough for the eye
writer.SetFileName(arguments.layers)
writer.Write()
if writer.GetErrorCode():
    raise SystemExit(1)  # the writer has said why

# What follows needs the file alone.
reader = vtkOpenImageIOReader()
reader.SetFileName(arguments.layers)
reader.Update()
image = reader.GetOutput()
columns, rows, _ = image.GetDimensions()
channels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[::-1]
names = image.GetFieldData().GetAbstractArray("ChannelNames")
names = [names.GetValue(i) for i in range(names.GetNumberOfValues())]


def layer(name, components="RGB"):
    """A layer's array of (rows, columns, components)."""
    return channels[..., [names.index(f"{name}.{c}") for c in components]]


# The sun goes down: its light becomes warm, highlights stronger, and a blue sky fills the shadows
# of what faces up. The layers are linear, so all of this is sums and products.
sky = (1.0 - layer("Illumination", "Y")) * (0.5 + 0.5 * layer("Normals", "XYZ")[..., 2:])
evening = (layer("Base") + layer("Diffuse") * (1.1, 0.72, 0.42) + 2.0 * layer("Specular")
           + sky * (0.05, 0.09, 0.2))

if arguments.picture:
    linear = np.clip(evening, 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    png = vtkPNGWriter()
    png.SetInputData(to_image(np.round(255.0 * encoded).astype(np.uint8)))
    png.SetFileName(arguments.picture)
    png.Write()
