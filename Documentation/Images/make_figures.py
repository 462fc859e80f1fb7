#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of the documentation: hillshade.png, depth.png and thickness.svg.

    PYTHONPATH=build/lib/python3/dist-packages python3 Documentation/Images/make_figures.py [folder]

The other pictures come from the programs in Examples.
"""

import math
import os
import sys

import numpy as np
from reliefshading import vtkImageReliefShading, vtkOpenImageIOReader
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageResize, vtkImageSincInterpolator
from vtkmodules.vtkIOImage import vtkPNGWriter

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = sys.argv[1] if len(sys.argv) > 1 else HERE
TERRAIN = os.path.join(HERE, "..", "..", "Examples", "Data", "jacksboro.tif")


def image_of(heights, spacing):
    image = vtkImageData()
    image.SetDimensions(heights.shape[1], heights.shape[0], 1)
    image.SetSpacing(*spacing, 1.0)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(heights).ravel(), deep=True))
    return image


def array_of(image, name=None):
    data = image.GetPointData()
    array = vtk_to_numpy(data.GetArray(name) if name else data.GetScalars())
    columns, rows, _ = image.GetDimensions()
    return array.reshape(rows, columns, -1)


def write_grey(name, panels):
    """Panels side by side; row 0 of each is its lowest."""
    gap = np.full((panels[0].shape[0], 8), 255, np.uint8)
    row = [part for panel in panels for part in (panel, gap)][:-1]
    writer = vtkPNGWriter()
    writer.SetInputData(image_of(np.concatenate(row, axis=1), (1.0, 1.0)))
    writer.SetFileName(os.path.join(FOLDER, name))
    writer.Write()


def encode(linear):
    """Linear to sRGB, 8 bit."""
    c = np.clip(linear, 0.0, 1.0)
    return (np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055) * 255 + 0.5).astype(
        np.uint8)


def terrain(size):
    """A part of the example terrain, resampled to `size` samples."""
    reader = vtkOpenImageIOReader()
    reader.SetFileName(TERRAIN)
    reader.Update()
    heights = array_of(reader.GetOutput())[20:200, 60:250, 0].astype(np.float32)
    resize = vtkImageResize()
    resize.SetInputData(image_of(heights, (74.6, 92.5)))
    resize.SetOutputDimensions(*size, 1)
    resize.SetInterpolator(vtkImageSincInterpolator())
    resize.Update()
    return resize.GetOutput()


def shade(image, sun, depth=None, scale=1.0, vertical=False):
    shading = vtkImageReliefShading()
    shading.SetInputData(image)
    shading.GetScene().AddSun(*sun)
    shading.GetScene().SetHeightScale(scale)
    if depth is not None:
        shading.GetScene().GetMaterial().SetSubsurfaceDepth(depth)
    if vertical:
        shading.GetScene().GetMaterial().SetOffsetModeToVertical()
    shading.GenerateNormalsOn()
    shading.GenerateThicknessOn()
    shading.GenerateIlluminationOn()
    shading.Update()
    return shading.GetOutput()


def hillshade_and_depth():
    sun = (315.0, 25.0)
    azimuth, altitude = map(math.radians, sun)
    toward = np.array([math.sin(azimuth) * math.cos(altitude),
                       math.cos(azimuth) * math.cos(altitude), math.sin(altitude)])
    wide = terrain((440, 400))
    shaded = shade(wide, sun, 90.0, 2.0)
    plain = array_of(shaded, "Normals") @ toward
    write_grey("hillshade.png", [encode(plain), encode(array_of(shaded)[:, :, 0])])
    narrow = terrain((290, 290))
    write_grey("depth.png", [encode(array_of(shade(narrow, sun, depth, 2.0))[:, :, 0])
                             for depth in (10.0, 90.0, 500.0)])


def thickness():
    """A section through a relief with one ray. The numbers in it are the filter's."""
    x = np.arange(701.0)
    h = (60.0 + 85.0 * np.exp(-((x - 430.0) / 55.0) ** 2) + 25.0 * np.exp(-((x - 150.0) / 90.0) ** 2)
         + 12.0 * np.sin(x / 60.0))
    at, depth, altitude = 250, 30.0, 22.0
    # Straight down by t: the drawing's is the simplest offset.
    result = shade(image_of(np.stack([h, h]).astype(np.float32), (1.0, 1.0)), (90.0, altitude), depth,
                   vertical=True)
    r = array_of(result, "Thickness")[0, at, 0]
    d = array_of(result, "Illumination")[0, at, 0]

    # The same ray, step by step, to draw which parts are inside.
    rise = math.tan(math.radians(altitude))
    along = np.linspace(0.0, 330.0, 6601)
    z = h[at] - depth + rise * along
    inside = z < np.interp(at + along, x, h)
    drawn = inside.mean() * 330.0 / math.cos(math.radians(altitude))
    if abs(drawn - r) > 0.5:
        raise SystemExit(f"the filter measures {r}, the drawing shows {drawn}")
    edges = np.flatnonzero(np.diff(inside.astype(int)))
    cuts = [0, *edges, len(along) - 1]

    top = 230.0

    def point(px, pz):
        return f"{px + 10.0:.1f},{top - pz:.1f}"

    def line(a, b, style):
        (xa, ya), (xb, yb) = point(*a).split(","), point(*b).split(",")
        return f'<line x1="{xa}" y1="{ya}" x2="{xb}" y2="{yb}" {style}/>'

    def label(px, pz, text, extra=""):
        lx, ly = point(px, pz).split(",")
        return f'<text x="{lx}" y="{ly}" {extra}>{text}</text>'

    outline = " ".join(point(px, pz) for px, pz in zip(x[::5], h[::5]))
    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 250" width="720" height="250" '
        'font-family="sans-serif" font-size="15">',
        '<rect width="720" height="250" fill="#ffffff"/>',
        f'<polygon points="{point(0, 0)} {outline} {point(700, 0)}" fill="#e8d9c0"/>',
        f'<polyline points="{outline}" fill="none" stroke="#5b4a32" stroke-width="2"/>']
    for begin, end in zip(cuts[:-1], cuts[1:]):
        within = inside[(begin + end) // 2]
        style = ('stroke="#c03020" stroke-width="5"' if within
                 else 'stroke="#e0a000" stroke-width="2"')
        parts.append(line((at + along[begin], z[begin]), (at + along[end], z[end]), style))
    sunk = h[at] - depth
    parts += [
        line((at, h[at]), (at, sunk), 'stroke="#202020" stroke-width="1.5" stroke-dasharray="4 3"'),
        *(f'<circle cx="{px + 10.0}" cy="{top - pz:.1f}" r="4" fill="#202020"/>'
          for px, pz in ((at, h[at]), (at, sunk))),
        label(at - 5, h[at] + 10, "p", 'text-anchor="end"'),
        label(at - 8, sunk - 2, "p&#8242;", 'text-anchor="end"'),
        label(at + 6, h[at] - 0.5 * depth + 2, "t", 'font-style="italic"'),
        label(at + 338, h[at] - depth + rise * 330.0 - 3, "to the light", 'fill="#a07000"'),
        label(0, 212, f"t = {depth:.0f}, r = the red lengths together = {r:.0f}, "
                      f"d = t / r = {d:.2f}", 'fill="#202020"'),
        "</svg>"]
    with open(os.path.join(FOLDER, "thickness.svg"), "w", encoding="ascii") as file:
        file.write("\n".join(parts) + "\n")


hillshade_and_depth()
thickness()
