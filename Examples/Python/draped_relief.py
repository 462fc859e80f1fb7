# SPDX-License-Identifier: BSD-3-Clause
"""A shaded picture as the texture of the relief itself, in three dimensions."""

from vtkmodules.vtkFiltersGeneral import vtkWarpScalar
from vtkmodules.vtkFiltersGeometry import vtkImageDataGeometryFilter
from vtkmodules.vtkFiltersTexture import vtkTextureMapToPlane
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkTexture


def draped_relief(heights, shading, height_scale):
    """An actor. Both are algorithms that make an image: of heights, up to date, and of colours for
    the same samples. `height_scale` is that of the shaded scene."""
    grid = vtkImageDataGeometryFilter()
    grid.SetInputConnection(heights.GetOutputPort())
    warp = vtkWarpScalar()
    warp.SetInputConnection(grid.GetOutputPort())
    warp.SetScaleFactor(height_scale)

    # A texture runs from the outer edge of its first texel to that of its last one, half a sample
    # beyond the image's bounds. The plane is set so that each texel's centre falls on its sample.
    bounds = heights.GetOutput().GetBounds()
    dx, dy, _ = heights.GetOutput().GetSpacing()
    west, east = bounds[0] - dx / 2.0, bounds[1] + dx / 2.0
    south, north = bounds[2] - dy / 2.0, bounds[3] + dy / 2.0
    coordinates = vtkTextureMapToPlane()
    coordinates.SetInputConnection(warp.GetOutputPort())
    coordinates.SetOrigin(west, south, 0.0)
    coordinates.SetPoint1(east, south, 0.0)
    coordinates.SetPoint2(west, north, 0.0)

    texture = vtkTexture()
    texture.SetInputConnection(shading.GetOutputPort())
    texture.SetColorModeToDirectScalars()
    texture.InterpolateOn()
    texture.MipmapOn()

    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(coordinates.GetOutputPort())
    mapper.ScalarVisibilityOff()
    relief = vtkActor()
    relief.SetMapper(mapper)
    relief.SetTexture(texture)
    relief.GetProperty().LightingOff()  # the texture is lit already
    return relief
