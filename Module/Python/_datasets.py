# SPDX-License-Identifier: BSD-3-Clause
"""Heights in datasets of PyVista, and what is made of them back in such datasets."""

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkImageData

from ._heights import image_of_cells
from ._keywords import TABLE, brief, shown

COLORS = (*[name for name, row in TABLE.items() if row["kind"] == "color"], "background")
TEXTURES = ("diffuse_texture", "base_texture", "specular_texture")


class Source:
    """The heights of a dataset.

    image      them as an image whose point scalars they are, the last row on top
    where      "point" or "cell": what of the dataset they belong to
    """

    def __init__(self, dem, scalars=None):
        self.dem = dem = as_dataset(dem)
        self.where = "point"
        self._across = False  # a lattice whose rows run along x
        self._steps = (1, 1)  # -1 for the axis of a lattice, x or y, along which coordinates descend
        if isinstance(dem, pv.ImageData):
            self._read_image(dem, scalars)
        elif isinstance(dem, pv.StructuredGrid):
            self._read_lattice(dem, scalars)
        else:
            raise TypeError("an ImageData, or a StructuredGrid or RectilinearGrid of equal steps, is "
                            f"expected, not {type(dem).__name__}")

    def _read_image(self, dem, scalars):
        name, self.where = find_scalars(dem, scalars)
        if self.where == "cell":
            self.image = image_of_cells(dem, name)
            return
        self.image = vtkImageData()
        self.image.CopyStructure(dem)
        self.image.GetPointData().SetScalars(dem.GetPointData().GetArray(name))

    def _read_lattice(self, dem, scalars):
        columns, rows, slices = dem.dimensions
        if slices != 1 or columns * rows < 1:
            raise ValueError(f"the grid has {dem.dimensions} points, one slice is expected")
        points = np.asarray(dem.points, float).reshape(rows, columns, 3)
        heights = points[..., 2]
        if scalars is not None:
            name, self.where = find_scalars(dem, scalars)
            if self.where == "cell":
                raise ValueError(f"{shown(name)} belongs to the cells of a {type(dem).__name__}; heights of "
                                 "points are expected (cell_data_to_point_data())")
            heights = np.asarray(dem.point_data[name]).reshape(rows, columns)
        # The first axis of a grid may run along x, as an image's, or along y.
        along = np.abs(points[:, -1] - points[:, 0]).max(axis=0)
        self._across = along[1] > along[0]
        if self._across:
            points, heights = points.transpose(1, 0, 2), heights.T
        xs, ys = points[0, :, 0], points[:, 0, 1]
        steps = [(line[-1] - line[0]) / max(len(line) - 1, 1) or 1.0 for line in (xs, ys)]
        # An image whose coordinates ascend: masks and textures lie on it as on the map.
        self._steps = tuple(-1 if step < 0.0 else 1 for step in steps)
        turn = np.s_[::self._steps[1], ::self._steps[0]]
        points, heights = points[turn], heights[turn]
        xs, ys = points[0, :, 0], points[:, 0, 1]
        steps = [abs(step) for step in steps]
        # Coordinates of maps are large, and points mostly of single precision.
        loose = 1e-2 * np.abs(steps) + 4e-7 * max(np.abs(xs).max(), np.abs(ys).max())
        if (np.abs(points[..., 0] - (xs[0] + steps[0] * np.arange(len(xs)))) > loose[0]).any() or (
                np.abs(points[..., 1] - (ys[0] + steps[1] * np.arange(len(ys)))[:, None])
                > loose[1]).any():
            raise ValueError("the points of the grid are not at equal steps of x and y; interpolate "
                             "them to an ImageData")
        image = pv.ImageData(dimensions=(len(xs), len(ys), 1), spacing=(*steps, 1.0),
                             origin=(xs[0], ys[0], 0.0))
        image.point_data["Heights"] = np.ascontiguousarray(heights).ravel()
        image.set_active_scalars("Heights")
        self.image = image

    def copy(self):
        """A dataset of the same geometry for results."""
        result = type(self.dem)()
        result.copy_structure(self.dem)
        return result

    def put(self, dataset, name, array):
        """Gives a dataset an array of VTK of the image's samples."""
        values = pv.convert_array(array)
        if self._across or min(self._steps) < 0:
            columns, rows, _ = self.image.GetDimensions()
            shape = values.shape[1:]
            values = values.reshape(rows, columns, *shape)[::self._steps[1], ::self._steps[0]]
            values = values.swapaxes(0, 1) if self._across else values
            values = values.reshape(-1, *shape)
        data = dataset.point_data if self.where == "point" else dataset.cell_data
        data[name] = values


def as_dataset(dem):
    if not isinstance(dem, pv.DataSet):
        try:
            dem = pv.wrap(dem)
        except (TypeError, NotImplementedError):
            pass
    if isinstance(dem, pv.RectilinearGrid):
        return dem.cast_to_structured_grid()
    return dem


def find_scalars(dem, scalars):
    """The name of the heights, and whether they are of points or of cells."""
    if scalars is not None:
        for where, data in (("point", dem.point_data), ("cell", dem.cell_data)):
            if scalars in data:
                return scalars, where
        raise ValueError(f"there is no array {shown(scalars)}; there are "
                         + brief(", ".join(map(str, dem.array_names)), 100))
    for where, data in (("point", dem.point_data), ("cell", dem.cell_data)):
        # What is active, or the only one.
        name = data.active_scalars_name or (data.keys()[0] if len(data) == 1 else None)
        if name is not None:
            return name, where
    raise ValueError("the dataset has no scalars that could be heights; name them by scalars=")


# ------------------------------------------------------------------------------
def look_of(keywords):
    """Keywords as shade() takes them from colours, colormaps and textures of PyVista."""
    look = dict(keywords)
    for name in COLORS:
        if isinstance(look.get(name), (str, pv.Color)):
            try:
                look[name] = pv.Color(look[name]).hex_rgb
            except ValueError:
                raise ValueError(f"{name}: {shown(look[name])} is no colour; a name as PyVista has it or "
                                 "#rrggbb is expected") from None
    if isinstance(look.get("cmap"), str):
        from pyvista.plotting.colors import get_cmap_safe
        try:
            look["cmap"] = get_cmap_safe(look["cmap"])
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"cmap: {brief(str(error), 160)}") from None
    for name in TEXTURES:
        if look.get(name) is not None:
            look[name] = _array_of(look[name])
    return look


def _array_of(texture):
    """The colours of a texture, first row on top."""
    image = texture.to_image() if isinstance(texture, pv.Texture) else texture
    if not isinstance(image, vtkImageData):
        return texture
    image = pv.wrap(image)
    values = np.asarray(image.active_scalars)
    columns, rows, _ = image.dimensions
    return values.reshape(rows, columns, -1)[::-1]
