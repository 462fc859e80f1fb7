# SPDX-License-Identifier: BSD-3-Clause
"""Heights that are prepared once and shaded as often as one likes."""

import threading

import numpy as np

from . import vtkImageReliefShading, vtkReliefScene
from ._arrays import read_heights, read_mask, read_spacing, to_image
from ._colors import read_limits, to_table, to_texture
from ._errors import update
from ._keywords import (AUTOMATIC, LAYERS, OF_HEIGHTS, TABLE, check_names, color, converted, flag,
                        number, set_checked, suggestion)
from ._lights import Environments, preset_of, set_environment, set_lights
from ._results import ReliefImage

TEXTURES = {"diffuse_texture": "SetDiffuseTextureData", "base_texture": "SetBaseTextureData",
            "specular_texture": "SetSpecularTextureData"}


class Relief:
    """Heights, prepared once, for many pictures.

        relief = reliefshading.Relief(heights, spacing=30)
        for azimuth in range(0, 360, 15):
            relief.shade(sun=(azimuth, 30)).save(f"{azimuth}.png")

    Takes the keywords of reliefshading.shade(), which hold for every picture. Those of shade() itself
    hold for its picture alone. Kept between pictures: the prepared heights (about 8 bytes a sample),
    the light on them (4 bytes a sample and light, up to cache_memory_limit MiB) and the lights of an
    environment. An array that VTK can use where it lies is not copied: do not change it while there is
    a Relief of it, or give it to set_heights() again. Several threads may share one; they take turns.
    """

    def __init__(self, heights, *, cache_memory_limit=256, **keywords):
        check_names("Relief", keywords)
        self._lock = threading.RLock()
        self._filter = vtkImageReliefShading()
        limit = number(cache_memory_limit, "cache_memory_limit", "a number of MiB")
        if not 0.0 <= limit < 2.0 ** 40:
            raise ValueError(f"cache_memory_limit: {cache_memory_limit!r} was given, a number of MiB "
                             "of at least 0 is expected")
        self._filter.SetCacheMemoryLimit(int(1024 * limit))
        self._environments = Environments()
        self._keywords = keywords
        self._of_heights = {}
        self._kept = {}
        self.set_heights(heights, **{name: keywords.pop(name) for name in OF_HEIGHTS
                                     if name in keywords})

    def set_heights(self, heights, **keywords):
        """Takes other heights; spacing, mask and nodata stay unless they are given, too."""
        check_names("set_heights", keywords, [name for name in TABLE if name not in OF_HEIGHTS])
        known = {**self._of_heights, **keywords}
        array, covered = read_heights(heights)
        spacing = read_spacing(known.get("spacing", 1.0))
        mask = read_mask(known.get("mask"), array.shape, covered)
        nodata = known.get("nodata")
        if nodata is not None:
            nodata = number(nodata, "nodata")
            # It is compared in the type of the heights.
            nodata = float(np.float16(nodata)) if np.asarray(heights).dtype == np.float16 else nodata
        with self._lock:
            self._of_heights = known
            self._array, self._mask, self._spacing, self._nodata = array, mask, spacing, nodata
            self._image = to_image(array, spacing)
            self._mask_image = None if mask is None else to_image(mask, spacing)
            self._kept = {}
            self._filter.SetInputData(self._image)
            self._filter.SetMaskData(self._mask_image)
            self._filter.SetUseNoDataValue(nodata is not None)
            if nodata is not None:
                self._filter.SetNoDataValue(nodata)

    @property
    def shape(self):
        """(rows, columns)."""
        return self._array.shape

    @property
    def scene(self):
        """The vtkReliefScene of the last picture."""
        return self._filter.GetScene()

    @property
    def filter(self):
        """The vtkImageReliefShading that makes the pictures."""
        return self._filter

    def shade(self, **keywords):
        """A picture, a ReliefImage. Takes the keywords of reliefshading.shade() but spacing, mask and
        nodata."""
        check_names("shade", keywords, OF_HEIGHTS)
        with self._lock:
            values = _combined(self._keywords, keywords)
            scene = self._make_scene(values)
            self._set_output(values, scene)
            self._set_colors(values)
            self._filter.Modified()  # the last picture is its result's
            update(self._filter)
            output = self._filter.GetOutput()
            if output.GetNumberOfPoints() != self._array.size:
                raise RuntimeError("the picture is empty: the update was ended")
            result = ReliefImage(self._filter, _alpha(values), scene.GetHeightScale())
            # The picture belongs to the result, and the next one gets memory of its own.
            output.Initialize()
            return result

    # ------------------------------------------------------------------------------
    def _make_scene(self, values):
        """The filter's scene, set by keywords: all others are the table's or the given scene's."""
        given = values.get("scene")
        scene = self._filter.GetScene()
        if given is None:
            scene.SetEnvironment(None)
            scene.RemoveAllLights()
        else:
            if not isinstance(given, vtkReliefScene):
                raise TypeError(f"scene: a vtkReliefScene is expected, not {type(given).__name__}")
            scene.CopySharingImage(given)
        for name, row in TABLE.items():
            if row["owner"] == "Environment" or (given is not None and name not in values):
                continue
            value = values.get(name, row["default"])
            if name in AUTOMATIC and isinstance(value, str):
                if value != "auto":
                    raise ValueError(f'{name}: {value!r} was given, a number or "auto" is expected')
                continue
            owner = scene if row["owner"] == "Scene" else scene.GetMaterial()
            set_checked(name, owner, "Set" + row["name"], converted(row, value, name))
        self._set_automatic(scene, values)
        preset = values.get("preset")
        set_lights(scene, values, self._environments)
        if preset is not None and "response" in values:
            row = TABLE["response"]
            set_checked("response", scene, "SetResponse", converted(row, values["response"], "response"))
        set_environment(scene, values, TABLE)
        return scene

    def _set_automatic(self, scene, values):
        depth = values.get("depth")
        if depth == "auto":
            scene.GetMaterial().AutomaticSubsurfaceDepthOn()
        elif depth is not None:
            if isinstance(depth, str):
                raise ValueError(f'depth: {depth!r} was given, a number or "auto" is expected')
            set_checked("depth", scene.GetMaterial(), "SetSubsurfaceDepth", (number(depth, "depth"),))
        elif "subsurface_depth" in values and "automatic_subsurface_depth" not in values:
            scene.GetMaterial().AutomaticSubsurfaceDepthOff()
        if values.get("exposure") == "auto":
            scene.AutomaticExposureOn()
        if values.get("height_scale") == "auto":
            arguments = (self._image, self._mask_image)
            arguments += () if self._nodata is None else (self._nodata,)
            set_checked("height_scale", scene, "FitHeightScale", arguments)

    def _set_output(self, values, scene):
        try:
            kind = np.dtype(values.get("dtype", "uint8"))
        except TypeError:
            kind = None
        if kind not in (np.uint8, np.float32):
            raise ValueError(f"dtype: {values['dtype']!r} was given, uint8 or float32 is expected")
        if kind == np.uint8:
            self._filter.SetOutputScalarTypeToUnsignedChar()
        else:
            self._filter.SetOutputScalarTypeToFloat()
        wanted = _layers(values.get("layers", ()), scene)
        for layer in LAYERS:
            getattr(self._filter, "SetGenerate" + layer.capitalize())(layer in wanted)

    def _set_colors(self, values):
        self._filter.StretchTexturesOn()
        for name, setter in TEXTURES.items():
            value = values.get(name)
            getattr(self._filter, setter)(
                None if value is None else self._keep(name, value, lambda: to_texture(
                    value, name, self._spacing)))
        cmap, clim = values.get("cmap"), values.get("clim")
        if cmap is None and clim is not None:
            raise ValueError("clim: there is no cmap")
        self._filter.SetLookupTable(None if cmap is None else to_table(
            cmap, lambda: self._limits(clim)))

    def _limits(self, clim):
        if clim is not None:
            return read_limits(clim, self._array, None, None)
        if "limits" not in self._kept:
            self._kept["limits"] = read_limits(None, self._array, self._mask, self._nodata)
        return self._kept["limits"]

    def _keep(self, name, value, make):
        """What was made of the same object the last time."""
        kept = self._kept.get(name)
        if kept is None or kept[0] is not value or not self._keywords.get(name) is value:
            self._kept[name] = kept = (value, make())
        return kept[1]


def _combined(usual, special):
    """Keywords of all pictures and of one: lights of the one replace those of all."""
    lights = ("sun", "suns", "sun_at", "lamp", "lamps", "preset", "environment")
    if any(name in special for name in lights):
        usual = {name: value for name, value in usual.items() if name not in lights}
    depths = ("depth", "subsurface_depth", "automatic_subsurface_depth")
    if any(name in special for name in depths):
        usual = {name: value for name, value in usual.items() if name not in depths}
    values = {**usual, **special}
    if values.get("depth") is not None and len([name for name in depths if name in values]) > 1:
        raise ValueError("depth: it is subsurface_depth by another name; give one of them")
    if values.get("preset") is not None:
        preset_of(values["preset"])
    return values


def _alpha(values):
    """None, or the background of pictures without alpha."""
    alpha = flag(values.get("alpha", True), "alpha")
    background = color(values.get("background", (0.0, 0.0, 0.0)), "background")
    return None if alpha else background


def _layers(layers, scene):
    if isinstance(layers, str):
        layers = (layers,)
    try:
        names = [name.lower() for name in layers]
    except (TypeError, AttributeError):
        raise TypeError(f"layers: names of layers are expected, not {layers!r}") from None
    if "all" in names:
        shadow = [light for light in scene.GetLights() if not light.GetPositional()]
        lit = shadow or not (scene.GetLights().GetNumberOfItems() or scene.GetEnvironment())
        return [name for name in LAYERS if name != "shadow" or lit]
    for name in names:
        if name not in LAYERS:
            raise ValueError(f"layers: {name!r} was given, names of {', '.join(LAYERS)} are expected"
                             + suggestion(name, LAYERS))
    return names
