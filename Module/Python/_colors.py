# SPDX-License-Identifier: BSD-3-Clause
"""Colours by height and textures, from whatever they are given as."""

import numpy as np
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkScalarsToColors
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

from ._arrays import color_array, to_image
from ._keywords import encoded_color, several, shown, suggestion

TEXTURES = {"diffuse_texture": "SetDiffuseTextureData", "base_texture": "SetBaseTextureData",
            "specular_texture": "SetSpecularTextureData"}


class Colors:
    """Textures and the colormap of a filter or a mapper."""

    def __init__(self):
        self._limits = None

    def forget(self):
        """There are other heights."""
        self._limits = None

    def connect(self, host, values, heights):
        host.StretchTexturesOn()
        for name, setter in TEXTURES.items():
            value = values.get(name)
            getattr(host, setter)(None if value is None else to_texture(value, name, heights))
        cmap, clim = values.get("cmap"), values.get("clim")
        if clim is not None and (cmap is None or isinstance(cmap, vtkScalarsToColors)):
            raise ValueError(f"clim: {'there is no cmap' if cmap is None else 'the table has its own'}")
        host.SetLookupTable(None if cmap is None else to_table(
            cmap, lambda: self._find_limits(clim, heights), clim is not None))

    def _find_limits(self, clim, heights):
        if clim is not None:
            return read_limits(clim, heights.array, None, None)
        if self._limits is None:
            self._limits = read_limits(None, heights.array, heights.mask, heights.nodata)
        return self._limits


def to_texture(values, name, heights):
    """A texture, first row on top, which is to be stretched over the relief."""
    # Stretched, it lies as the heights lie in memory, whatever its own spacing says.
    return to_image(np.ascontiguousarray(heights.turned(color_array(values, name))))


def read_limits(limits, heights, covered, nodata):
    """The heights of a colormap's ends."""
    if limits is not None:
        low, high = several(limits, "clim", (2,), "a pair (low, high)")
        if not (np.isfinite(low) and np.isfinite(high) and low < high):
            raise ValueError(f"clim: {shown(limits)} was given, two finite numbers are expected, the first "
                             "the smaller")
        return low, high
    counts = np.isfinite(heights) if heights.dtype.kind == "f" else np.ones(heights.shape, bool)
    if covered is not None:
        counts &= covered != 0
    if nodata is not None:
        counts &= heights != nodata
    if not counts.any():
        return 0.0, 1.0
    low = float(heights.min(where=counts, initial=_top(heights.dtype)))
    high = float(heights.max(where=counts, initial=_bottom(heights.dtype)))
    return (low, high) if low < high else (low, np.nextafter(low, np.inf) + abs(low) * 1e-6)


def _top(dtype):
    return np.inf if dtype.kind == "f" else np.iinfo(dtype).max


def _bottom(dtype):
    return -np.inf if dtype.kind == "f" else np.iinfo(dtype).min


def to_table(cmap, limits, limited=False):
    """A table of VTK from a colormap; limits is a function that tells its ends, which were given if
    limited."""
    if isinstance(cmap, vtkScalarsToColors):
        return cmap
    if isinstance(cmap, str):
        return _sampled(_named(cmap), limits())
    if callable(cmap):
        return _sampled(cmap, limits())
    pairs = _stops(cmap)
    if pairs is not None:
        if limited:
            raise ValueError("clim: the pairs of cmap have heights of their own; leave clim out, or give "
                             "colours alone")
        return _between(pairs)
    array = np.asarray(cmap)
    if array.ndim != 2 or array.shape[1] not in (3, 4) or len(array) == 0 or (
            array.dtype.kind not in "fiu"):
        raise TypeError("cmap: a name, a colormap, an array of (n, 3) or (n, 4), pairs of (height, "
                        f"colour) or a vtkScalarsToColors is expected, not {type(cmap).__name__}")
    scale = 1.0 if array.dtype.kind == "f" else 255.0
    return _table(array / scale, limits())


def _named(name):
    try:
        from matplotlib import colormaps as maps
        names, find = list(maps), maps.__getitem__
    except ImportError:
        try:
            from matplotlib import cm
            names, find = list(cm.cmap_d if hasattr(cm, "cmap_d") else cm._cmap_registry), cm.get_cmap
        except ImportError:
            raise ValueError(f"cmap: Matplotlib, which has the colormap {shown(name)}, is not installed; "
                             "an array of colours will do") from None
    try:
        return find(name)
    except (KeyError, ValueError):
        raise ValueError(f"cmap: Matplotlib has no colormap {shown(name)}"
                         + suggestion(name, names)) from None


def _sampled(function, limits):
    """A colormap of Matplotlib, which gives RGBA for 0 to 1, at as many places as it has colours."""
    count = max(int(getattr(function, "N", 256)), 2)
    colors = np.asarray(function(np.linspace(0.0, 1.0, count)), float)
    if colors.ndim != 2 or colors.shape[1] not in (3, 4):
        raise TypeError("cmap: the function gives no colours of (n, 3) or (n, 4)")
    return _table(colors, limits)


def _table(colors, limits):
    """Equal steps of colours, sRGB codes from 0 to 1."""
    if not (np.isfinite(colors).all() and colors.min() >= 0.0 and colors.max() <= 1.0):
        raise ValueError("cmap: colours are sRGB codes from 0 to 1, or integers from 0 to 255")
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(colors))
    table.SetTableRange(*limits)
    for i, row in enumerate(colors):
        table.SetTableValue(i, *row[:3], row[3] if len(row) > 3 else 1.0)
    return table


def _stops(cmap):
    """Pairs of (height, colour), or None."""
    try:
        pairs = [tuple(pair) for pair in cmap]
    except TypeError:
        return None
    if not pairs or any(len(pair) != 2 for pair in pairs):
        return None
    return pairs


def _between(pairs):
    function = vtkColorTransferFunction()
    function.SetColorSpaceToRGB()
    for height, color in pairs:
        (height,) = several((height,), "cmap", (1,), "a height")
        codes = encoded_color(color, "cmap") if isinstance(color, str) else several(
            color, "cmap", (3,), "a colour, three sRGB codes or a name,")
        if not (np.isfinite(height) and 0.0 <= min(codes) and max(codes) <= 1.0):
            raise ValueError("cmap: finite heights and sRGB codes from 0 to 1 are expected, not "
                             f"{shown((height, color))}")
        function.AddRGBPoint(height, *codes)
    return function
