# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of NumPy as images of VTK, and back.

An image's rows run upward by its spacing, an array's first row is on top. So an image of an array has
a negative spacing along y: both have their samples in one order, and nothing is copied.
"""

import numpy as np
from vtkmodules.util.numpy_support import create_vtk_array, get_vtk_array_type, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

from ._keywords import brief, several, shown


def plain_array(values, name):
    """An array in the order and of a type that VTK can use where it is: the given one, if it is so."""
    array = np.asarray(as_array(values, name))
    if array.dtype.kind == "b":
        return np.require(array, requirements="C").view(np.uint8)
    if array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float32 if array.dtype.itemsize == 2 else np.float64)
    return np.require(array, array.dtype.newbyteorder("="), "CA")


def as_array(values, name, expected="an array of real numbers"):
    """An array of real numbers or bools as it is, masks included."""
    try:
        array = values if isinstance(values, np.ma.MaskedArray) else np.asarray(values)
    except ValueError:  # lists of several lengths
        raise ValueError(f"{name}: {expected} is expected, all rows of one length") from None
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name}: {expected} is expected, not of {brief(str(array.dtype))}")
    return array


def color_array(values, name):
    """An array of colours, sRGB codes or linear, whichever they have the type of."""
    kind = as_array(values, name).dtype
    if not (kind.kind == "f" or kind in (np.uint8, np.uint16)):
        raise TypeError(f"{name}: uint8 or uint16 (sRGB), float32 or float64 (linear) is expected, not "
                        f"{brief(str(kind))}")
    array = plain_array(values, name)
    if array.ndim not in (2, 3) or (array.ndim == 3 and not 1 <= array.shape[2] <= 4) or not array.size:
        raise ValueError(f"{name}: an array of (rows, columns) with 1 to 4 components is expected, "
                         f"its shape is {shown(array.shape)}")
    return array


def to_image(array, spacing=(1.0, 1.0)):
    """An image upon the memory of a contiguous array of (rows, columns[, components])."""
    rows, columns = array.shape[:2]
    components = array.shape[2] if array.ndim > 2 else 1
    scalars = create_vtk_array(get_vtk_array_type(array.dtype))
    scalars.SetNumberOfComponents(components)
    scalars.SetVoidArray(array.reshape(-1), array.size, 1)
    scalars._numpy_reference = array  # as long as anybody has the scalars
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetSpacing(spacing[0], -spacing[1], 1.0)
    # The lower left sample is the origin of the world.
    image.SetOrigin(0.0, (rows - 1) * spacing[1], 0.0)
    image.GetPointData().SetScalars(scalars)
    return image


def to_upright_image(array):
    """An image whose last row is the array's first, for those who do not look at the spacing."""
    image = to_image(np.ascontiguousarray(array[::-1]))
    image.SetSpacing(1.0, 1.0, 1.0)
    image.SetOrigin(0.0, 0.0, 0.0)
    return image


def from_image(image, array):
    """An array upon the memory of one of an image's arrays, its rows as they lie there."""
    columns, rows, _ = image.GetDimensions()
    values = vtk_to_numpy(array)
    return values.reshape(rows, columns, -1) if values.ndim > 1 else values.reshape(rows, columns)


def flat_shape(array, name):
    """An array of two dimensions from one that has a third of length 1, first or last."""
    if array.ndim == 3 and 1 in (array.shape[0], array.shape[2]):
        array = array[..., 0] if array.shape[2] == 1 else array[0]
    if array.ndim != 2:
        raise ValueError(f"{name}: an array of (rows, columns) is expected, its shape is "
                         f"{shown(array.shape)}")
    if array.size == 0:
        raise ValueError(f"{name}: the array is empty, its shape is {shown(array.shape)}")
    return array


def read_heights(heights):
    """The array of heights, and where a masked array has data, or None."""
    covered = None
    if isinstance(heights, np.ma.MaskedArray):
        if np.ma.getmask(heights) is not np.ma.nomask:
            covered = ~flat_shape(np.ma.getmaskarray(heights), "heights")
        heights = np.ma.getdata(heights)
    return flat_shape(plain_array(heights, "heights"), "heights"), covered


def read_mask(mask, shape, covered):
    """Bytes that are 0 where there is no data, or None."""
    if mask is not None:
        mask = flat_shape(as_array(mask, "mask", "an array of bools or numbers"), "mask")
        if mask.shape != shape:
            raise ValueError(f"mask: the shape is {mask.shape}, that of the heights is {shape}")
        # What a masked array masks is no data, and so is NaN.
        mask = np.ma.filled(mask, 0)
        mask = (mask != 0) & (mask == mask)
    if covered is not None:
        mask = covered if mask is None else mask & covered
    return None if mask is None else np.ascontiguousarray(mask).view(np.uint8)


def read_spacing(spacing):
    pair = spacing if np.ndim(spacing) or isinstance(spacing, str) else (spacing, spacing)
    pair = several(pair, "spacing", (2,), "a number or a pair (dx, dy)")
    if not all(1e-32 <= size <= 1e32 for size in pair):  # as the filter takes it
        raise ValueError(f"spacing: {shown(spacing)} was given, numbers from 1e-32 to 1e32 are expected")
    return pair
