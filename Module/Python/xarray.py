# SPDX-License-Identifier: BSD-3-Clause
"""Reliefs of xarray's arrays.

    import reliefshading.xarray
    picture = dem.relief.shade(sun=(315, 35), depth=100)
    picture.plot.imshow()

Importing this module gives every DataArray the accessor relief. It knows from the coordinates which way
the rows run and how far apart samples are, in metres where they are degrees or have a coordinate
reference system (by pyproj, and rioxarray where it is there), and what number stands for no data.
"""

import numpy as np
import xarray as xr

from ._georeference import Georeference
from ._keywords import OF_HEIGHTS, brief, check_names, shown
from ._relief import Relief

__all__ = ["ReliefAccessor"]


@xr.register_dataarray_accessor("relief")
class ReliefAccessor:
    """Heights as they are on the map."""

    def __init__(self, array):
        self._array = array

    @property
    def spacing(self):
        """(dx, dy) of the samples, in metres where the map tells it, else of the coordinates."""
        return Georeference(self._array).spacing

    @property
    def nodata(self):
        """The number that marks samples without data, or None."""
        return Georeference(self._array).nodata

    @property
    def place(self):
        """Longitude, latitude and convergence in the middle, in degrees, or None."""
        return Georeference(self._array).place

    def shade(self, **keywords):
        """The picture as a DataArray of (y, x, band), with the coordinates of the heights.

        Takes the keywords of reliefshading.shade(). spacing and nodata are those of the coordinates
        and attributes unless they are given; heights in feet, by their attribute units, are taken for
        such where the spacing is in metres; sun_at may be the time alone where the place is known.
        mask has the dimensions of the heights. With layers the result is a Dataset of shading and
        the layers.
        """
        return self.prepare(**{name: keywords.pop(name) for name in list(keywords)
                               if name in OF_HEIGHTS}).shade(**keywords)

    def prepare(self, **keywords):
        """Heights, read and prepared once, for many pictures: shade(**keywords) gives each.

        Keywords hold for all pictures, as those of reliefshading.Relief do.
        """
        return ArrayRelief(self._array, keywords)


class ArrayRelief:
    """A Relief of an array of xarray."""

    def __init__(self, array, keywords):
        check_names("prepare", keywords)
        self._array = array
        self._map = place = Georeference(array, keywords.get("spacing") is None)
        order = [name for name in array.dims if name not in (place.y, place.x)]
        self._one = {name: 0 for name in order}
        keywords = dict(keywords)
        if keywords.get("spacing") is None:
            keywords["spacing"] = place.spacing
        keywords.setdefault("nodata", place.nodata)
        if keywords.get("mask") is not None:
            keywords["mask"] = self._turned(self._mask_of(keywords["mask"]))
        self.relief = Relief(self._turned(array), **self._placed(keywords))

    @property
    def height_unit(self):
        """Metres per unit of the heights, or 1."""
        return self._map.height_unit

    def shade(self, **keywords):
        result = self.relief.shade(**self._placed(keywords))
        bands = ["red", "green", "blue", "alpha"][:result.shape[2]]
        shading = self._back(result.image, "shading", {"band": bands})
        shading.attrs = {"long_name": "shaded relief"}
        if not result.layers:
            return shading
        named = {"shading": shading}
        for name, values in result.layers.items():
            extra = {} if values.ndim == 2 else (
                {"axis": ["x", "y", "z"]} if name == "normals" else {"color": bands[:3]})
            named[name] = self._back(values, name, extra)
        return xr.Dataset(named)

    def _mask_of(self, mask):
        """A mask as an array of xarray with the dimensions of the heights."""
        wanted = {name: self._array.sizes[name] for name in (self._map.y, self._map.x)}
        if isinstance(mask, xr.DataArray):
            sizes = {name: size for name, size in mask.sizes.items() if size != 1 or name in wanted}
            if sizes != wanted:
                raise ValueError(f"mask: {_sizes(mask.sizes)} was given, {_sizes(wanted)} is expected, "
                                 "the dimensions of the heights")
            return mask.isel({name: 0 for name in mask.dims if name not in wanted})
        mask = mask if isinstance(mask, np.ma.MaskedArray) else np.asarray(mask)
        # As the heights lie in their own array, or as rows and columns.
        own = [name for name in self._array.dims if name in wanted]
        for names in (self._array.dims, own, list(wanted)):
            if mask.shape == tuple(self._array.sizes[name] for name in names):
                # xarray knows no masked arrays; one without the mask's own is as good.
                mask = xr.DataArray(np.ma.filled(mask, False), dims=names)
                return mask.isel({name: 0 for name in names if name not in wanted})
        raise ValueError(f"mask: the shape is {shown(mask.shape)}, {shown(self._array.shape)} is expected, "
                         "that of the heights")

    def _turned(self, array):
        """NumPy's array of heights or of a mask, the north on top."""
        one = {name: 0 for name in array.dims if name in self._one}
        array = array.isel(one).transpose(self._map.y, self._map.x).data
        array = np.asarray(array.compute() if hasattr(array, "compute") else array)
        return array[::-1 if self._map.flip_y else 1, ::-1 if self._map.flip_x else 1]

    def _back(self, values, name, extra):
        """An array of xarray, its rows and columns as those of the heights."""
        values = values[::-1 if self._map.flip_y else 1, ::-1 if self._map.flip_x else 1]
        kept = {key: coordinate for key, coordinate in self._array.isel(self._one).coords.items()
                if set(coordinate.dims) <= {self._map.y, self._map.x}}
        return xr.DataArray(values, dims=(self._map.y, self._map.x, *extra),
                            coords={**kept, **extra}, name=name)

    def _placed(self, keywords):
        """Keywords with what the map adds."""
        keywords = dict(keywords)
        moment = keywords.get("sun_at")
        if moment is not None and (isinstance(moment, str) or hasattr(moment, "isoformat")):
            if self._map.place is None:
                raise ValueError("sun_at: where the heights are is not known; give (time, longitude, "
                                 "latitude)")
            keywords["sun_at"] = (moment, *self._map.place)
        unit = self._map.height_unit
        if unit != 1.0 and not isinstance(keywords.get("height_scale"), str):
            if "height_scale" in keywords or not hasattr(self, "relief"):
                keywords["height_scale"] = unit * keywords.get("height_scale", 1.0)
        return keywords


def _sizes(sizes):
    return brief("(" + ", ".join(f"{name}: {size}" for name, size in sizes.items()) + ")")
