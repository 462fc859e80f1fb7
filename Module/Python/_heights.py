# SPDX-License-Identifier: BSD-3-Clause
"""Heights with their mask, of an array or of an image of VTK, as the filter and the mapper take them."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImageData

from ._arrays import from_image, read_heights, read_mask, read_spacing, to_image
from ._keywords import number


class Heights:
    """What is shaded.

    image       for the filter; of an array upon its memory
    array       its scalars as rows and columns, in the order of the image
    mask        bytes in the same order, 0 where there is no data, or None; mask_image is theirs
    nodata      a number or None
    upright     whether the last row is on top, as in VTK's own images
    """

    def __init__(self, heights, spacing=None, mask=None, nodata=None):
        covered = None
        if isinstance(heights, vtkImageData):
            self.image = heights
            self.array = _array_of(heights)
            self.upright = heights.GetSpacing()[1] >= 0.0
            if spacing is not None:
                raise ValueError("spacing: the image has its own")
        else:
            self.array, covered = read_heights(heights)
            self.image = to_image(self.array, read_spacing(1.0 if spacing is None else spacing))
            self.upright = False
        mask = read_mask(mask, self.array.shape, covered)
        if mask is not None and self.upright:
            mask = np.ascontiguousarray(mask[::-1])
        self.mask = mask
        self.mask_image = None if mask is None else like(self.image, mask)
        if nodata is not None:
            nodata = number(nodata, "nodata")
            # It is compared in the type of the heights.
            if getattr(heights, "dtype", None) == np.float16:
                with np.errstate(over="ignore"):
                    nodata = float(np.float16(nodata))
        self.nodata = nodata

    def connect(self, host):
        """Gives them to a filter or a mapper."""
        host.SetInputData(self.image)
        host.SetMaskData(self.mask_image)
        host.SetUseNoDataValue(self.nodata is not None)
        if self.nodata is not None:
            host.SetNoDataValue(self.nodata)

    def fit_arguments(self):
        """Those of vtkReliefScene::FitHeightScale()."""
        return (self.image, self.mask_image, *(() if self.nodata is None else (self.nodata,)))

    def turned(self, array):
        """An array in the image's order with its first row on top."""
        return array[::-1] if self.upright else array


def like(image, array):
    """An image upon an array's memory, of the structure of another."""
    result = to_image(array)
    scalars = result.GetPointData().GetScalars()
    result.CopyStructure(image)
    result.GetPointData().SetScalars(scalars)
    return result


def _array_of(image):
    scalars = image.GetPointData().GetScalars()
    if scalars is None:
        raise ValueError("heights: the image has no point scalars")
    columns, rows, slices = image.GetDimensions()
    if slices != 1 or scalars.GetNumberOfComponents() != 1 or columns * rows == 0:
        raise ValueError(f"heights: one slice in x and y of one component is expected, the image has "
                         f"({columns}, {rows}, {slices}) samples of {scalars.GetNumberOfComponents()}")
    return from_image(image, scalars)


def image_of_cells(image, name):
    """An image whose samples are the centers of another's cells, with an array of its cell data."""
    scalars = image.GetCellData().GetArray(name) if name else image.GetCellData().GetScalars()
    columns, rows, _ = (max(n - 1, 1) for n in image.GetDimensions())
    result = vtkImageData()
    result.SetDimensions(columns, rows, 1)
    result.SetSpacing(image.GetSpacing())
    result.SetDirectionMatrix(image.GetDirectionMatrix())
    extent = image.GetExtent()
    origin = [0.0, 0.0, 0.0]
    image.TransformContinuousIndexToPhysicalPoint(
        extent[0] + 0.5, extent[2] + 0.5, float(extent[4]), origin)
    result.SetOrigin(origin)
    result.GetPointData().SetScalars(scalars)
    return result
