# SPDX-License-Identifier: BSD-3-Clause
"""Reliefs in PyVista.

    import pyvista as pv
    import reliefshading.pyvista as rs

    dem = rs.read("jacksboro.tif")
    look = dict(sun=(315, 25), height_scale=2, depth=120, cmap="gist_earth")
    pl = pv.Plotter()
    rs.add_drape(pl, dem, **look)
    pl.show()

A look is any keywords of reliefshading.shade(), whose help tells them. Heights are an ImageData, with
point or cell data, or a StructuredGrid or RectilinearGrid of equal steps. North is +y. Whatever fails
raises; nothing comes back empty.
"""

import os
import weakref

import numpy as np
import pyvista as pv

import reliefshading

if not hasattr(pv, "ImageData"):
    raise ImportError("reliefshading.pyvista needs PyVista 0.40 or later; this is "
                      f"{getattr(pv, '__version__', 'another module')}")

from ._arrays import read_spacing
from ._colors import Colors
from ._datasets import Source, look_of
from ._errors import update as update_algorithm
from ._heights import Heights
from ._keywords import LAYERS, OF_HEIGHTS, brief, check_names, kept
from ._lights import Environments
from ._relief import Relief, combined
from ._scene import set_scene

__all__ = ["LiveRelief", "add_drape", "add_light_widget", "add_relief", "drape", "from_xarray", "read",
           "shade", "update"]
# What is of arrays alone.
_OF_ARRAYS = ("spacing", "alpha", "background")


def read(file_name, *, spacing=None, georeference=False):
    """Heights from a file, the north up, as an ImageData with the point data "Heights".

    spacing: a number or (dx, dy), for files without a georeference, or instead of it; else rasters have
    that of the map in metres. georeference: whether the place on the map stays as field data, for
    vtkReliefRasterWriter; other attributes of the file are left out. A build without readers, as the
    wheel is, reads rasters by rioxarray, where that is installed.
    """
    name = os.fsdecode(file_name)
    if spacing is not None:
        # That of another image has a third number.
        spacing = read_spacing(spacing[:2] if np.shape(spacing) == (3,) else spacing)
    kinds = reliefshading.__all__
    if "vtkReliefRasterReader" in kinds:
        reader = reliefshading.vtkReliefRasterReader()
    elif "vtkOpenImageIOReader" in kinds:
        reader = reliefshading.vtkOpenImageIOReader()
    else:
        return _read_by_rioxarray(name, spacing, georeference)
    reader.SetFileName(os.fsencode(name))
    if spacing is not None:
        reader.SetDataSpacing(*spacing, 1.0)
    update_algorithm(reader)
    image = pv.ImageData(reader.GetOutput())
    heights = image.GetPointData().GetScalars()
    heights.SetName("Heights")
    field = {key: image.field_data[key] for key in image.field_data if key.startswith("geo:")}
    image.clear_data()
    image.GetPointData().SetScalars(heights)
    if spacing is not None:
        image.spacing = (*spacing, 1.0)
    if georeference and spacing is None:
        for key, value in field.items():
            image.field_data[key] = value
    return image


def from_xarray(array):
    """Heights from an array of xarray, the north up, as an ImageData with the point data "Heights".

    Spacing is as reliefshading.xarray has it: in metres where the coordinates tell it; heights in feet
    become metres then. Where there is no data, they are NaN.
    """
    if type(array).__name__ != "DataArray":
        raise TypeError(f"a DataArray of xarray is expected, not {type(array).__name__}")
    from .xarray import ArrayRelief
    placed = ArrayRelief(array, {})
    heights = placed.relief._heights
    values = heights.array
    if heights.nodata is not None or placed.height_unit != 1.0:
        values = np.where(values == heights.nodata, np.nan, values * placed.height_unit)
    return _image_of(values, (heights.image.GetSpacing()[0], -heights.image.GetSpacing()[1]))


def _image_of(values, spacing):
    """An image of an array, whose first row is in the north."""
    image = pv.ImageData(dimensions=(*values.shape[::-1], 1), spacing=(*spacing, 1.0))
    image.point_data["Heights"] = np.ascontiguousarray(values[::-1]).ravel()
    image.set_active_scalars("Heights")
    return image


def _read_by_rioxarray(name, spacing, georeference):
    if georeference:
        raise RuntimeError("georeference: this build of reliefshading writes no rasters, so it keeps no place on "
                           "the map; rioxarray does both")
    try:
        import rioxarray
    except ImportError:
        raise RuntimeError("this build of reliefshading has no readers; install rioxarray, by which it reads "
                           "rasters") from None
    try:
        raster = rioxarray.open_rasterio(name, mask_and_scale=True)
    except Exception as error:  # of rasterio, which has many
        told = str(error).replace(name, "").strip(" :'`")
        raise RuntimeError(f"{brief(name, 70)} cannot be read: {brief(told, 110)}") from None
    with raster:
        image = from_xarray(raster.isel(band=0) if "band" in raster.dims else raster)
    if spacing is not None:
        image.spacing = (*spacing, 1.0)
    return image


def shade(dem, *, scalars=None, **look):
    """The picture of heights: a dataset of the same geometry with uint8 RGBA "Shading".

    Layers that are asked for are arrays beside it. Show it by
    plotter.add_mesh(shaded, scalars="Shading", rgb=True, lighting=False).
    """
    source = Source(dem, scalars)
    relief = _relief_of(source, "shade", look, cache_memory_limit=0)
    result = source.copy()
    _render(relief, source, result)
    return result


def drape(dem, *, scalars=None, **look):
    """The surface of the heights, with the height scale of the look, and "Shading" upon it.

    A StructuredGrid with the heights in "Heights", and "Shading" as shade() gives it; points without
    data are hidden. update() gives it another look. Show it by add_drape().
    """
    source = Source(dem, scalars)
    relief = _relief_of(source, "drape", look)
    if source.where == "cell":
        # Its samples are the centers of the cells.
        source = Source(pv.wrap(source.image))
    terrain = pv.StructuredGrid()
    terrain.dimensions = source.dem.dimensions
    flat = np.array(source.dem.points, float)
    if isinstance(source.dem, pv.StructuredGrid):
        flat[:, 2] = 0.0
    terrain.points = flat
    source.put(terrain, "Heights", source.image.GetPointData().GetScalars())
    terrain.set_active_scalars("Heights")
    _render(relief, source, terrain)
    _raise_points(terrain, flat, relief, source)
    _Draped.remember(terrain, relief, source, flat)
    return terrain


def update(terrain, scene=None, **look):
    """Shades what drape() has made anew, in place.

    By a scene, such as that of a live relief whose light has been moved (a LiveRelief will do, too), or
    by a look, which is added to the look it was made with.
    """
    draped = _Draped.find(terrain)
    if scene is not None:
        look["scene"] = getattr(scene, "scene", scene)
        draped.relief.drop_lights()
    check_names("update", look, (*OF_HEIGHTS, *_OF_ARRAYS))
    _render(draped.relief, draped.source, terrain, look_of(look))
    _raise_points(terrain, draped.flat, draped.relief, draped.source)


def add_drape(plotter, dem, *, scalars=None, **look):
    """Adds the surface of heights with its picture to a plotter; returns the actor and the surface.

    dem may be what drape() has returned. The colours are shown as they are, not lit again.
    """
    terrain = dem if _Draped.knows(dem) else drape(dem, scalars=scalars, **look)
    if terrain is dem and look:
        update(terrain, **look)
    # Ambient light alone leaves colours as they are, and VTK's shadows fail on meshes without any.
    actor = plotter.add_mesh(terrain, scalars="Shading", rgb=True, lighting=True, ambient=1.0,
                             diffuse=0.0, specular=0.0)
    return actor, terrain


class LiveRelief:
    """A relief that a plotter shades as its scene is.

    scene, mapper, actor     vtkReliefScene, vtkReliefImageMapper, vtkImageSlice
    dem                      the heights
    """

    def __init__(self, plotter, dem, scalars, look):
        from vtkmodules.vtkRenderingCore import vtkImageSlice
        self._source = Source(dem, scalars)
        self.dem = self._source.dem
        self.plotter = plotter
        self.renderer = plotter.renderer
        self._keywords = {}
        self._heights = _heights_of(self._source, look)
        self._environments, self._colors = Environments(), Colors()
        self.mapper = reliefshading.vtkReliefImageMapper()
        # Somebody must be there to wait for the details.
        self.mapper.SetProgressive(not plotter.off_screen)
        self._heights.connect(self.mapper)
        self.scene = self.mapper.GetScene()
        self.update(**{name: value for name, value in look.items() if name not in OF_HEIGHTS})
        self.actor = vtkImageSlice()
        self.actor.SetMapper(self.mapper)
        self.widgets = []

    def update(self, **look):
        """Adds to the look, and lets the plotter show it in its next frame."""
        check_names("update", look, (*OF_HEIGHTS, *_OF_ARRAYS, "layers", "dtype"))
        values = combined(self._keywords, kept(look_of(look)))
        set_scene(self.scene, values, self._heights, self._environments)
        if not self.scene.GetLights().GetNumberOfItems() and not self.scene.GetEnvironment():
            # Else it would take the plotter's own lights.
            self.scene.SetLightsToDefault()
        self._colors.connect(self.mapper, values, self._heights)
        # What a scene was given counts once: its lights may be moved from now on.
        values.pop("scene", None)
        self._keywords = values


def add_relief(plotter, dem, *, scalars=None, view=True, **look):
    """Adds heights to the plotter's active view as a flat picture that is shaded while it is shown.

    Returns a LiveRelief: change its look by update(), or its scene, and the next frame shows it. view:
    whether the camera looks straight down on it, in parallel projection.
    """
    check_names("add_relief", look, (*_OF_ARRAYS, "layers", "dtype"))
    relief = LiveRelief(plotter, dem, scalars, look)
    plotter.add_actor(relief.actor, reset_camera=False, render=False)
    if view:
        plotter.enable_parallel_projection()
        plotter.view_xy(render=False)
        plotter.reset_camera(render=False)
    return relief


def add_light_widget(plotter, relief, callback=None):
    """Lets people drag the first light of a live relief; returns the vtkReliefLightWidget.

    callback is called, without arguments, whenever the light has been moved.
    """
    if not isinstance(relief, LiveRelief):
        raise TypeError(f"what add_relief() has returned is expected, not {type(relief).__name__}")
    if plotter.iren is None:
        raise RuntimeError("the plotter has no interactor")
    widget = reliefshading.vtkReliefLightWidget()
    widget.SetInteractor(plotter.iren.interactor)
    widget.SetDefaultRenderer(relief.renderer)
    widget.SetCurrentRenderer(relief.renderer)
    dot = widget.GetLightRepresentation()
    dot.SetScene(relief.scene)
    dot.PlaceOnHeights(relief._heights.image)
    dot.SetProp(relief.actor)
    widget.On()
    if callback is not None:
        widget.AddObserver("InteractionEvent", lambda *_: callback())
    relief.widgets.append(widget)  # which nobody else may keep
    # As long as the plotter is there, and no longer.
    plotter.__dict__.setdefault("_reliefs", []).append(relief)
    return widget


# ------------------------------------------------------------------------------
class _ImageRelief(Relief):
    """Pictures for datasets."""

    def drop_lights(self):
        self._keywords = {name: value for name, value in self._keywords.items()
                          if name in ("cmap", "clim", "layers", "dtype") or name.endswith("texture")}

    def picture(self, look):
        with self._lock:
            self._keywords = values = combined(self._keywords, kept(look))
            self._update(values)
            self._keywords.pop("scene", None)
            output = self._filter.GetOutput()
            arrays = [output.GetPointData().GetArray(i)
                      for i in range(output.GetPointData().GetNumberOfArrays())]
            output.Initialize()
            return arrays


def _heights_of(source, look):
    return Heights(source.image, mask=look.get("mask"), nodata=look.get("nodata"))


def _relief_of(source, function, look, **more):
    check_names(function, look, _OF_ARRAYS)
    return _ImageRelief(source.image, **look_of(look), **more)


def _render(relief, source, dataset, look=None):
    arrays = relief.picture(look or {})
    for array in arrays:
        source.put(dataset, array.GetName(), array)
    data = dataset.point_data if source.where == "point" else dataset.cell_data
    for layer in LAYERS:
        if layer.capitalize() in data and not any(a.GetName() == layer.capitalize() for a in arrays):
            del data[layer.capitalize()]
    dataset.set_active_scalars("Shading", preference=source.where)


def _raise_points(terrain, flat, relief, source):
    """Moves points to their scaled heights, and hides those without data."""
    heights = np.asarray(terrain["Heights"], float) * relief.scene.GetHeightScale()
    covered = np.asarray(terrain["Shading"])[:, 3] != 0
    lowest = heights[covered].min() if covered.any() else 0.0
    out = np.array([0.0, 0.0, 1.0])
    if isinstance(source.dem, pv.ImageData):
        out = pv.array_from_vtkmatrix(source.dem.GetDirectionMatrix())[:, 2]
    terrain.points = flat + np.where(covered, heights, lowest)[:, None] * out
    if not covered.all():
        terrain.hide_points(~covered)


class _Draped:
    """What update() needs of the surfaces that drape() has made, as long as they live."""

    known = {}

    def __init__(self, terrain, relief, source, flat):
        self.terrain = weakref.ref(terrain, lambda _, key=id(terrain): _Draped.known.pop(key, None))
        self.relief, self.source, self.flat = relief, source, flat

    @classmethod
    def remember(cls, terrain, relief, source, flat):
        cls.known[id(terrain)] = cls(terrain, relief, source, flat)

    @classmethod
    def knows(cls, terrain):
        return id(terrain) in cls.known and cls.known[id(terrain)].terrain() is terrain

    @classmethod
    def find(cls, terrain):
        if not cls.knows(terrain):
            raise ValueError("a surface that drape() has returned is expected (copies are others)")
        return cls.known[id(terrain)]


class Accessor:
    """dem.relief.shade(...), where PyVista has accessors (0.48 and later)."""

    def __init__(self, dem):
        self._dem = dem

    def shade(self, **look):
        return shade(self._dem, **look)

    def drape(self, **look):
        return drape(self._dem, **look)

    def add_to(self, plotter, **look):
        return add_relief(plotter, self._dem, **look)


for _name in ("shade", "drape"):
    getattr(Accessor, _name).__doc__ = globals()[_name].__doc__
Accessor.add_to.__doc__ = add_relief.__doc__
if hasattr(pv, "register_dataset_accessor"):
    for _kind in (pv.ImageData, pv.StructuredGrid, pv.RectilinearGrid):
        pv.register_dataset_accessor("relief", _kind)(Accessor)
