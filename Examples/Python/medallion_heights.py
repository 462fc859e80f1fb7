# SPDX-License-Identifier: BSD-3-Clause
"""The height field of a medallion: a sunflower, an inscription, beads and a rim."""

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (text)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingGeneral import vtkImageGaussianSmooth
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

# All lengths are in radii of the medallion, which is centred in the image.
SAMPLES = 900
SPACING = 2.2 / SAMPLES
FIRST = -1.1 + SPACING / 2.0
FIELD = 0.05  # height of the medallion's field above the plate that it lies on
TEXT = "EX VMBRA IN LVCEM \u00b7 VTK RELIEF SHADING \u00b7 "
GOLDEN_ANGLE = np.pi * (3.0 - np.sqrt(5.0))


def smooth(array, deviation):
    """Rounds edges, as wear does. The deviation is in samples."""
    image = vtkImageData()
    image.SetDimensions(array.shape[1], array.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(array.astype(np.float32).ravel(), deep=True))
    gauss = vtkImageGaussianSmooth()
    gauss.SetInputData(image)
    gauss.SetDimensionality(2)
    gauss.SetStandardDeviation(deviation)
    gauss.SetRadiusFactor(3.0)
    gauss.Update()
    return vtk_to_numpy(gauss.GetOutput().GetPointData().GetScalars()).reshape(array.shape)


def letters():
    """The text, 0 to 1, with bevelled edges; row 0 is at the bottom."""
    font = vtkTextProperty()
    font.SetFontFamilyToTimes()
    font.BoldOn()
    font.SetFontSize(48)
    image, size = vtkImageData(), [0, 0]
    vtkTextRenderer.GetInstance().RenderString(font, TEXT, image, size, 400,
                                               vtkTextRenderer.Default)
    columns, rows, _ = image.GetDimensions()
    rgba = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, 4)
    return smooth(rgba[:size[1], :size[0], 3] / 255.0, 9.0)


def ridge(distance, half_width, height):
    """Half an ellipse, across a line or about a point."""
    return height * np.sqrt(np.maximum(1.0 - (distance / half_width) ** 2, 0.0))


def add_ball(heights, x, y, center, radius, base):
    """A ball, half sunk, painted into the samples about its centre."""
    column, row = (int((c - FIRST) / SPACING) for c in center)
    reach = int(radius / SPACING) + 2
    near = np.s_[row - reach:row + reach + 1, column - reach:column + reach + 1]
    square = radius ** 2 - (x[near] - center[0]) ** 2 - (y[near] - center[1]) ** 2
    ball = base + np.sqrt(np.maximum(square, 0.0))
    heights[near] = np.where(square > 0.0, np.maximum(heights[near], ball), heights[near])


def medallion_heights(plate=0.0):
    """An image of heights. The plate about the medallion has the height given."""
    x, y = np.meshgrid(*2 * [FIRST + SPACING * np.arange(SAMPLES)])
    radius, angle = np.hypot(x, y), np.arctan2(y, x)

    heights = np.where(radius < 1.0, FIELD, 0.0)
    heights += ridge(radius - 0.95, 0.05, 0.05)  # the rim
    heights += ridge(radius - 0.855, 0.012, 0.015) + ridge(radius - 0.605, 0.012, 0.015)
    heights = np.where(radius > 0.95, np.maximum(heights, plate), heights)

    # Two whorls of 18 petals with a vein, the inner one higher and between those of the outer one.
    for shift, length, height in ((0.0, 0.32, 0.045), (0.5, 0.23, 0.06)):
        along = np.clip((radius - 0.25) / length, 0.0, 1.0)
        across = 2.0 * np.mod(9.0 * angle / np.pi + shift, 1.0) - 1.0
        width = np.sqrt(np.sin(np.pi * along ** 0.7)) + 1e-6
        vein = 1.0 - 0.25 * np.exp(-(across / 0.12) ** 2)
        crest = height * vein * np.sqrt(np.sin(np.pi * (0.15 + 0.85 * along)))
        heights = np.maximum(heights, FIELD + ridge(across, width, crest))

    # Seeds on a dome, in the spiral in which sunflowers grow them; then the beads.
    heights = np.maximum(heights, FIELD + ridge(radius, 0.27, 0.05))
    for k in range(1, 160):
        r, turn = 0.245 * np.sqrt(k / 160.0), k * GOLDEN_ANGLE
        add_ball(heights, x, y, (r * np.cos(turn), r * np.sin(turn)), 0.014 + 0.006 * k / 160.0,
                 FIELD + ridge(r, 0.27, 0.05))
    for turn in np.arange(96) * (2.0 * np.pi / 96.0):
        add_ball(heights, x, y, (0.893 * np.cos(turn), 0.893 * np.sin(turn)), 0.022, FIELD)

    # The text runs clockwise about the circle of radius 0.73, as wide as it is long.
    text = letters()
    rows, columns = text.shape
    u = np.mod(0.5 - angle / (2.0 * np.pi), 1.0) * (columns - 1)
    v = (radius - 0.73) / (2.0 * np.pi * 0.73) * columns + rows / 2.0
    inside = (v >= 0.0) & (v < rows)
    heights += np.where(inside, 0.035 * text[np.where(inside, v, 0).astype(int), u.astype(int)], 0.0)
    heights = smooth(heights, 1.2)

    image = vtkImageData()
    image.SetDimensions(SAMPLES, SAMPLES, 1)
    image.SetSpacing(SPACING, SPACING, 1.0)
    image.SetOrigin(FIRST, FIRST, 0.0)
    image.GetPointData().SetScalars(numpy_to_vtk(heights.ravel(), deep=True))
    return image
