# SPDX-License-Identifier: BSD-3-Clause
"""A picture, as NumPy, notebooks and files want it."""

import os

import numpy as np

from ._arrays import from_image, to_upright_image
from ._errors import checked
from ._keywords import LAYERS

LARGEST_SHOWN = 2048  # of either side, in a notebook


class ReliefImage:
    """A shaded relief.

    image        the array of (rows, columns, 4), or 3 without alpha: uint8 and sRGB-encoded, or
                 float32 and linear; row 0 is on top. np.asarray(result) is the same array.
    layers       a dict of arrays by their names, NaN where there is no data
    mask         where there is data, as the keyword mask has it
    statistics   what it took: lights_traced, rays_traced, cells_visited, lights_reused, effects,
                 exposure, height_scale
    save(name)   writes a file; notebooks show the picture by themselves
    """

    def __init__(self, shading, heights, background):
        output = shading.GetOutput()
        points = output.GetPointData()
        self.image = heights.turned(from_image(output, points.GetScalars()))
        self._covered = None
        if background is not None:
            self._covered = self.mask
            self.image = _on_background(self.image, self._covered, background)
        self.layers = {name: heights.turned(from_image(output, points.GetArray(name.capitalize())))
                       for name in LAYERS if points.HasArray(name.capitalize())}
        statistics = shading.GetStatistics()
        self.statistics = {
            "lights_traced": statistics.GetLightsTraced(),
            "rays_traced": statistics.GetRaysTraced(),
            "cells_visited": statistics.GetCellsVisited(),
            "lights_reused": statistics.GetLightsReused(),
            "effects": tuple(statistics.GetEffectNames().split()),
            "exposure": statistics.GetExposure(),
            "height_scale": shading.GetScene().GetHeightScale()}

    @property
    def mask(self):
        """Where there is data."""
        return self._covered if self._covered is not None else self.image[..., 3] != 0

    @property
    def shape(self):
        return self.image.shape

    @property
    def dtype(self):
        return self.image.dtype

    @property
    def ndim(self):
        return 3

    @property
    def size(self):
        return self.image.size

    @property
    def __array_interface__(self):
        # With its strides, so that Pillow asks for the bytes.
        return {**self.image.__array_interface__, "strides": self.image.strides}

    def tobytes(self):
        return self.image.tobytes()

    def __array__(self, dtype=None, copy=None):
        if dtype is not None and np.dtype(dtype) != self.image.dtype:
            if copy is False:
                raise ValueError(f"{self.image.dtype} does not become {dtype} without a copy")
            return self.image.astype(dtype)
        return self.image.copy() if copy else self.image

    def __getitem__(self, index):
        return self.image[index]

    def __len__(self):
        return len(self.image)

    def __repr__(self):
        rows, columns = self.shape[:2]
        layers = f", layers {', '.join(self.layers)}" if self.layers else ""
        return f"<ReliefImage of {rows} rows and {columns} columns, {self.dtype}{layers}>"

    def encoded(self):
        """The picture in 8 bits, sRGB-encoded, as screens and PNG files have it."""
        if self.image.dtype == np.uint8:
            return self.image
        codes = self.image.copy()
        codes[..., :3] = encode(codes[..., :3])
        return (255.0 * np.clip(codes, 0.0, 1.0) + 0.5).astype(np.uint8)

    def _repr_png_(self):
        """For notebooks: of a large picture every second, third ... sample."""
        step = -(-max(self.shape[:2]) // LARGEST_SHOWN)
        return self._png(self.encoded()[::step, ::step])

    @staticmethod
    def _png(codes):
        from vtkmodules.vtkIOImage import vtkPNGWriter
        writer = vtkPNGWriter()
        writer.WriteToMemoryOn()
        writer.SetInputData(to_upright_image(codes))
        checked(writer, writer.Write)
        return bytes(memoryview(writer.GetResult()))

    def save(self, file_name):
        """Writes the picture, its first row on top. PNG, JPEG and BMP are in 8 bits; other formats
        (TIFF, OpenEXR ...) have the numbers as they are. All but PNG and TIFF need the package's room
        for image files; JPEG and others that know no alpha want alpha=False."""
        name = os.fspath(file_name)
        extension = os.path.splitext(name)[1].lower()
        array = self.image
        if extension in (".png", ".jpg", ".jpeg", ".bmp", ".gif", ".webp"):
            array = self.encoded()
        elif extension in (".exr", ".hdr") and array.dtype == np.uint8:
            raise ValueError(f"{extension} holds linear numbers: shade with dtype=\"float32\"")
        writer = _writer(extension)
        writer.SetFileName(name)
        writer.SetInputData(to_upright_image(array))
        folder = os.path.dirname(name) or "."
        if not os.path.isdir(folder):
            raise FileNotFoundError(f"{name}: there is no folder {folder}")
        try:
            checked(writer, writer.Write)
        except RuntimeError as error:
            raise OSError(f"{name}: {error}" if name not in str(error) else str(error)) from None
        if writer.GetErrorCode():
            raise OSError(f"{name} cannot be written")


def _writer(extension):
    import reliefshading
    from vtkmodules.vtkIOImage import vtkPNGWriter, vtkTIFFWriter
    if extension == ".png":
        return vtkPNGWriter()
    if "vtkOpenImageIOWriter" in reliefshading.__all__:
        return reliefshading.vtkOpenImageIOWriter()
    if extension in (".tif", ".tiff"):
        return vtkTIFFWriter()
    raise ValueError(f"{extension or 'a file without an extension'} cannot be written by this build; "
                     ".png and .tif can")


def encode(linear):
    """sRGB codes from 0 to 1 of linear numbers, which are clamped."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1.0 / 2.4) - 0.055)


def _on_background(image, covered, background):
    colors = np.ascontiguousarray(image[..., :3])
    if not covered.all():
        if colors.dtype == np.uint8:
            background = np.round(255.0 * encode(np.asarray(background))).astype(np.uint8)
        colors[~covered] = background
    return colors
