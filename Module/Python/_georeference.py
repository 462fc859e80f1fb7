# SPDX-License-Identifier: BSD-3-Clause
"""Where an array of xarray is on a map: its rows and columns, and how far apart they are in metres."""

import math

import numpy as np

from ._keywords import shown

X_NAMES = ("x", "lon", "longitude", "easting", "long", "xc")
Y_NAMES = ("y", "lat", "latitude", "northing", "yc")
# Metres of the units that coordinates and heights have.
METRES = {"m": 1.0, "meter": 1.0, "meters": 1.0, "metre": 1.0, "metres": 1.0, "km": 1000.0,
          "kilometer": 1000.0, "kilometers": 1000.0, "kilometre": 1000.0, "kilometres": 1000.0,
          "cm": 0.01, "dm": 0.1, "mm": 0.001, "ft": 0.3048, "foot": 0.3048, "feet": 0.3048,
          "us survey foot": 1200.0 / 3937.0, "us-ft": 1200.0 / 3937.0, "fathom": 1.8288}
# Of WGS 84: half the longer axis, and the square of the eccentricity.
AXIS, ECCENTRICITY = 6378137.0, 0.0066943799901413165


class Georeference:
    """Of an array: its dimensions y and x, and whether they run down and to the right.

    spacing      (dx, dy) in metres where in_metres, else in the unit of the coordinates
    place        (longitude, latitude, convergence) in the middle, or None
    nodata       the number that marks samples without data, or None
    height_unit  metres per unit of the heights, or 1
    """

    def __init__(self, array, measure=True):
        """Without measure, coordinates tell the way alone, and may be uneven."""
        if array.size == 0:
            raise ValueError(f"heights: the array is empty, its shape is {shown(array.shape)}; at least one "
                             "row and one column are expected")
        self.y, self.x = _dimensions(array)
        self.crs = _crs_of(array)
        xs, ys = (_coordinates(array, name) for name in (self.x, self.y))
        self.flip_y = ys is not None and len(ys) > 1 and ys[-1] > ys[0]
        self.flip_x = xs is not None and len(xs) > 1 and xs[-1] < xs[0]
        self.in_metres, self.place = False, None
        steps = (_step(xs, self.x), _step(ys, self.y)) if measure else (None, None)
        self.spacing = tuple(step or 1.0 for step in steps)
        if measure and xs is not None and ys is not None:
            steps = tuple(step or other or 1.0 for step, other in (steps, steps[::-1]))
            self._measure(array, (xs[0] + xs[-1]) / 2.0, (ys[0] + ys[-1]) / 2.0, steps)
        self.nodata = _nodata_of(array)
        unit = str(array.attrs.get("units", "")).strip().lower()
        self.height_unit = METRES.get(unit, 1.0) if self.in_metres else 1.0

    def _measure(self, array, x, y, steps):
        """Spacing in metres, and the place."""
        if self.crs is not None and self.crs.is_projected:
            self._measure_map(x, y, steps)
        elif _is_degrees(array, self.x, self.y, self.crs):
            if not -90.0 <= y <= 90.0:
                raise ValueError(f"{self.y}: latitudes from -90 to 90 are expected, their middle is {y:g}")
            per_x, per_y = metres_of_degrees(y)
            self.spacing = (steps[0] * per_x, steps[1] * per_y)
            if not min(self.spacing) > 0.0:
                raise ValueError("at a pole a degree of longitude has no length; project the heights")
            self.in_metres = True
            self.place = ((x + 180.0) % 360.0 - 180.0, y, 0.0)
        else:
            units = [str(array[name].attrs.get("units", "")).strip().lower() for name in (self.x, self.y)]
            if all(unit in METRES for unit in units):
                self.spacing = tuple(step * METRES[unit] for step, unit in zip(steps, units))
                self.in_metres = True

    def _measure_map(self, x, y, steps):
        import pyproj
        factor = self.crs.axis_info[0].unit_conversion_factor if self.crs.axis_info else 1.0
        nominal = tuple(step * factor for step in steps)
        to_degrees = pyproj.Transformer.from_crs(self.crs, self.crs.geodetic_crs, always_xy=True)
        longitude, latitude = to_degrees.transform(x, y)
        self.spacing, self.in_metres = nominal, True
        if not (math.isfinite(longitude) and math.isfinite(latitude)):
            return
        # What the projection makes of a sample there. Half a per cent is left alone, so that round
        # numbers stay.
        geod = self.crs.get_geod()
        measured = []
        for dx, dy in ((steps[0] / 2.0, 0.0), (0.0, steps[1] / 2.0)):
            ends = to_degrees.transform((x - dx, x + dx), (y - dy, y + dy))
            measured.append(geod.inv(ends[0][0], ends[1][0], ends[0][1], ends[1][1])[2])
        ends = to_degrees.transform((x, x), (y - steps[1] / 2.0, y + steps[1] / 2.0))
        # From true north to the map's, clockwise.
        convergence = geod.inv(ends[0][0], ends[1][0], ends[0][1], ends[1][1])[0]
        if all(0.0 < size < math.inf for size in measured):
            if any(abs(a / b - 1.0) > 0.005 for a, b in zip(measured, nominal)):
                self.spacing = tuple(measured)
            self.place = (longitude, latitude, convergence)


def metres_of_degrees(latitude):
    """Metres of a degree of longitude and of latitude there."""
    sine, cosine = math.sin(math.radians(latitude)), math.cos(math.radians(latitude))
    root = math.sqrt(1.0 - ECCENTRICITY * sine * sine)
    along = AXIS / root * cosine if abs(latitude) < 90.0 else 0.0
    upward = AXIS * (1.0 - ECCENTRICITY) / root ** 3
    return math.radians(along), math.radians(upward)


# ------------------------------------------------------------------------------
def _dimensions(array):
    """The names of the dimensions y and x."""
    names = [name for name in array.dims if array.sizes[name] > 1 or len(array.dims) <= 2]
    if len(names) < 2:  # lines and points have a dimension of one sample
        names = list(array.dims)[-2:]
    if len(names) != 2:
        raise ValueError(f"heights: two dimensions are expected, these have {shown(tuple(array.dims))}; "
                         "take one of each other dimension (isel)")
    y, x = names
    if _is_of(array, y, "X", X_NAMES) or _is_of(array, x, "Y", Y_NAMES):
        y, x = x, y
    return y, x


def _is_of(array, name, axis, names):
    attributes = array[name].attrs if name in array.coords else {}
    return str(name).lower() in names or attributes.get("axis") == axis


def _coordinates(array, name):
    """The coordinates of a dimension as floats, or None."""
    if name not in array.coords or array[name].ndim != 1:
        return None
    values = np.asarray(array[name])
    if values.dtype.kind not in "iuf":
        return None
    return values.astype(float)


def _step(values, name):
    """How far apart they are, or None where there is but one or none."""
    if values is None or len(values) < 2:
        return None
    steps = np.diff(values)
    mean = (values[-1] - values[0]) / (len(values) - 1)
    # Coordinates of single precision are no more even than this.
    loose = 1e-3 * abs(mean) + 4e-7 * np.abs(values).max()
    if not np.isfinite(values).all() or mean == 0.0 or (np.abs(steps - mean) > loose).any():
        raise ValueError(f"{name}: the coordinates are not at equal steps; interpolate the heights, or "
                         "say spacing=")
    return abs(float(mean))


def _is_degrees(array, x, y, crs):
    if crs is not None:
        return crs.is_geographic
    for name, word in ((x, "lon"), (y, "lat")):
        attributes = array[name].attrs
        unit, standard = (str(attributes.get(key, "")) for key in ("units", "standard_name"))
        if not (unit.startswith("degree") or standard in ("longitude", "latitude")
                or str(name).lower().startswith(word)):
            return False
    return True


def _crs_of(array):
    """A CRS of pyproj, or None."""
    try:
        import pyproj
    except ImportError:
        return None
    try:
        import rioxarray  # noqa: F401  gives arrays .rio
        if array.rio.crs is not None:
            return pyproj.CRS.from_user_input(array.rio.crs)
    except Exception:  # whatever is wrong with it, there may be another
        pass
    for attributes in [coordinate.attrs for coordinate in array.coords.values()] + [array.attrs]:
        for key in ("crs_wkt", "spatial_ref", "crs"):
            if isinstance(attributes.get(key), str):
                try:
                    return pyproj.CRS.from_user_input(attributes[key])
                except pyproj.exceptions.CRSError:
                    pass
    return None


def _nodata_of(array):
    for source in (array.attrs, array.encoding):
        for key in ("_FillValue", "missing_value", "nodata", "nodatavals"):
            value = source.get(key)
            if value is None:
                continue
            value = np.asarray(value).ravel()
            if len(value) and value.dtype.kind in "iuf" and not np.isnan(value[0]):
                # What was read with masks has NaN there; another height may well be the number.
                scaled = source is array.encoding and array.dtype.kind == "f"
                return None if scaled else float(value[0])
    return None
