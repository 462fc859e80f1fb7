# SPDX-License-Identifier: BSD-3-Clause
"""A picture, as NumPy, notebooks and files want it."""

import os
import re
import shutil
import uuid

import numpy as np

from ._arrays import from_image, to_upright_image
from ._errors import checked, write
from ._keywords import LAYERS, brief

LARGEST_SHOWN = 2048  # of either side, in a notebook
# Extensions of formats of linear numbers, of such that hold no others, and of such without alpha.
LINEAR = (".exr", ".hdr", ".rgbe", ".pfm", ".tif", ".tiff")
LINEAR_ALONE = (".exr", ".hdr", ".rgbe", ".pfm")
OPAQUE = (".jpg", ".jpeg", ".jpe", ".jfif", ".jif", ".jfi", ".gif", ".hdr", ".rgbe", ".pfm",
          ".pnm", ".ppm", ".pgm", ".pbm")


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

    def __init__(self, shading, heights, background, alpha):
        output = shading.GetOutput()
        points = output.GetPointData()
        self.image = heights.turned(from_image(output, points.GetScalars()))
        self._covered = None
        self._background = background
        if not alpha:
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
        return _encoded(self.image)

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
        checked(writer, write, writer)
        return bytes(memoryview(writer.GetResult()))

    def save(self, file_name):
        """Writes the picture, its first row on top.

        OpenEXR, Radiance (.hdr) and PFM hold float32 pictures, linear; TIFF has the numbers as they are;
        PNG, JPEG and all others are in 8 bits, sRGB-encoded. JPEG, GIF and others that know no alpha
        get the background where there is no data. All but PNG and TIFF need the package's room for
        image files. The file is there when it is whole: after an error one that was there before is as
        it was. Other threads run meanwhile.
        """
        name = os.fsdecode(file_name)
        extension = os.path.splitext(name)[1].lower()
        array = self.image
        if extension in LINEAR_ALONE and array.dtype == np.uint8:
            raise ValueError(f"{extension} holds linear numbers: shade with dtype=\"float32\"")
        # WebP itself drops alpha that is full everywhere, which its writer takes for a loss.
        if array.shape[2] == 4 and (extension in OPAQUE or (
                extension == ".webp" and self.mask.all())):
            array = _on_background(array, self.mask, self._background)
        if extension not in LINEAR:
            array = _encoded(array)
        place = os.path.realpath(name)  # of what a link is of
        if not os.path.isdir(os.path.dirname(place)):
            raise FileNotFoundError(f"{brief(name, 140)}: there is no such folder")
        if os.path.isdir(place):
            raise IsADirectoryError(f"{brief(name, 140)}: a file's name is expected, this is a folder")
        if os.path.exists(place) and not os.access(place, os.W_OK):
            raise PermissionError(f"{brief(name, 140)}: the file there is read-only")
        _write_whole(name, place, extension, array)


def _write_whole(name, place, extension, array):
    """Writes beside the place, and takes the place when all is written."""
    staged = os.path.join(os.path.dirname(place), f".{uuid.uuid4().hex[:12]}.tmp{extension}")
    try:
        if extension == ".png":
            # From memory: its library prints what is wrong with a disk.
            with open(staged, "xb") as file:
                file.write(ReliefImage._png(array))
        else:
            writer = _writer(extension)
            writer.SetFileName(os.fsencode(staged))
            writer.SetInputData(to_upright_image(array))
            checked(writer, write, writer)
            if writer.GetErrorCode() or not os.path.exists(staged):
                raise OSError("its writer does not tell why")
        if os.path.exists(place):
            shutil.copymode(place, staged)
        os.replace(staged, place)
    except (OSError, RuntimeError) as error:
        told = getattr(error, "strerror", None) or str(error)
        raise OSError(_why(told.replace(staged, name), name, array)) from None
    finally:
        if os.path.exists(staged):
            os.remove(staged)


def _why(text, name, array):
    """A writer's message, without what is of its setters."""
    text = re.sub(r"\ACannot write \".*?\": ", "", text.strip())
    text = re.sub(r"[.;] (what it would|Set a PixelType).*", "", text, flags=re.DOTALL).rstrip(".")
    more = "; shade with alpha=False" if "components" in text and array.shape[2] == 4 else ""
    begin = f"{brief(name, 70)} cannot be written: "
    return begin + brief(text, 200 - len(begin) - len(more)) + more


def _writer(extension):
    import reliefshading
    from vtkmodules.vtkIOImage import vtkTIFFWriter
    if "vtkOpenImageIOWriter" in reliefshading.__all__:
        writer = reliefshading.vtkOpenImageIOWriter()
        writer.StagingOff()
        return writer
    if extension in (".tif", ".tiff"):
        return vtkTIFFWriter()
    raise ValueError(f"{brief(extension) or 'a file without an extension'} cannot be written by this build; "
                     ".png and .tif can")


def encode(linear):
    """sRGB codes from 0 to 1 of linear numbers, which are clamped."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1.0 / 2.4) - 0.055)


def _encoded(array):
    """A picture's numbers in 8 bits."""
    if array.dtype == np.uint8:
        return array
    codes = array.copy()
    codes[..., :3] = encode(codes[..., :3])
    return (255.0 * np.clip(codes, 0.0, 1.0) + 0.5).astype(np.uint8)


def _on_background(image, covered, background):
    colors = np.ascontiguousarray(image[..., :3])
    if not covered.all():
        if colors.dtype == np.uint8:
            background = np.round(255.0 * encode(np.asarray(background))).astype(np.uint8)
        colors[~covered] = background
    return colors
