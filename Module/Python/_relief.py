# SPDX-License-Identifier: BSD-3-Clause
"""Heights that are prepared once and shaded as often as one likes."""

import threading

import numpy as np

from . import vtkImageReliefShading
from ._colors import Colors
from ._errors import update
from ._heights import Heights
from ._keywords import (LAYERS, OF_HEIGHTS, TABLE, check_names, color, flag, kept, number, shown,
                        suggestion)
from ._lights import PRESETS, Environments, preset_of
from ._results import ReliefImage
from ._scene import set_scene


class Relief:
    """Heights, prepared once, for many pictures.

        relief = reliefshading.Relief(heights, spacing=30)
        for azimuth in range(0, 360, 15):
            relief.shade(sun=(azimuth, 30)).save(f"{azimuth}.png")

    Takes the keywords of reliefshading.shade(), which hold for every picture. Those of shade() itself
    hold for its picture alone; lights among them replace all lights, but a preset that goes by a sun
    stays where a sun is given. Kept between pictures: the prepared heights (about 8 bytes a sample),
    the light of the last one (4 bytes a sample and light, up to cache_memory_limit MiB) and the lights
    of an environment. An array that VTK can use where it lies is not copied: do not change it while there is
    a Relief of it, or give it to set_heights() again. Several threads may share one; they take turns.
    """

    def __init__(self, heights, *, cache_memory_limit=256, **keywords):
        check_names("Relief", keywords)
        keywords = kept(keywords)
        self._lock = threading.RLock()
        self._filter = vtkImageReliefShading()
        limit = number(cache_memory_limit, "cache_memory_limit", "a number of MiB")
        if not 0.0 <= limit < 2.0 ** 40:
            raise ValueError(f"cache_memory_limit: {shown(cache_memory_limit)} was given, a number of MiB "
                             "of at least 0 is expected")
        self._filter.SetCacheMemoryLimit(int(1024 * limit))
        self._environments = Environments()
        self._colors = Colors()
        self._of_heights = {}
        self.set_heights(heights, **{name: keywords.pop(name) for name in OF_HEIGHTS
                                     if name in keywords})
        self._keywords = keywords

    def set_heights(self, heights, **keywords):
        """Takes other heights; spacing, mask and nodata stay unless they are given, too."""
        check_names("set_heights", keywords, [name for name in TABLE if name not in OF_HEIGHTS])
        known = {**self._of_heights, **kept(keywords)}
        read = Heights(heights, **known)
        with self._lock:
            self._of_heights = known
            self._heights = read
            self._colors.forget()
            read.connect(self._filter)

    @property
    def shape(self):
        """(rows, columns)."""
        return self._heights.array.shape

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
            values = combined(self._keywords, kept(keywords))
            alpha, background = _background(values)
            self._update(values)
            result = ReliefImage(self._filter, self._heights, background, alpha)
            # The picture belongs to the result, and the next one gets memory of its own.
            self._filter.GetOutput().Initialize()
            return result

    def _update(self, values):
        """Lets the filter make the picture of keywords."""
        scene = self._filter.GetScene()
        set_scene(scene, values, self._heights, self._environments)
        self._set_output(values, scene)
        self._colors.connect(self._filter, values, self._heights)
        self._filter.Modified()  # the last picture is its result's
        update(self._filter)
        if self._filter.GetOutput().GetNumberOfPoints() != self._heights.array.size:
            raise RuntimeError("the picture is empty: the update was ended")

    def _set_output(self, values, scene):
        value = values.get("dtype", "uint8")
        if not isinstance(value, (str, type, np.dtype)):
            raise TypeError(f"dtype: uint8 or float32 is expected, not {shown(value)}")
        try:
            kind = np.dtype(value)
        except Exception:  # which NumPy raises depends on the value, and what its text does
            kind = None
        if kind not in (np.uint8, np.float32):
            raise ValueError(f"dtype: {shown(value)} was given, uint8 or float32 is expected")
        if kind == np.uint8:
            self._filter.SetOutputScalarTypeToUnsignedChar()
        else:
            self._filter.SetOutputScalarTypeToFloat()
        wanted = _layers(values.get("layers", ()), scene)
        for layer in LAYERS:
            getattr(self._filter, "SetGenerate" + layer.capitalize())(layer in wanted)


def combined(usual, special):
    """Keywords of all pictures and of one: lights of the one replace those of all, but for a preset
    that goes by a sun."""
    suns = ("sun", "suns", "sun_at")
    lights = (*suns, "lamp", "lamps", "preset", "environment")
    given = [name for name in lights if name in special]
    if given:
        preset = usual.get("preset")
        usual = {name: value for name, value in usual.items() if name not in lights}
        if preset is not None and set(given) <= set(suns) and PRESETS[preset_of(preset)][0]:
            usual["preset"] = preset
    depths = ("depth", "subsurface_depth", "automatic_subsurface_depth")
    if any(name in special for name in depths):
        usual = {name: value for name, value in usual.items() if name not in depths}
    values = {**usual, **special}
    if values.get("depth") is not None and len([name for name in depths if name in values]) > 1:
        raise ValueError("depth: it is subsurface_depth by another name; give one of them")
    if values.get("preset") is not None:
        preset_of(values["preset"])
    return values


def _background(values):
    """Whether there is alpha, and the background of pictures without."""
    alpha = flag(values.get("alpha", True), "alpha")
    value = values.get("background", (0.0, 0.0, 0.0))
    background = color(value, "background")
    if not all(0.0 <= component <= 1.0 for component in background):
        raise ValueError(f"background: {shown(value)} was given, linear RGB from 0 to 1 is expected")
    return alpha, background


def _layers(layers, scene):
    if isinstance(layers, str):
        layers = (layers,)
    try:
        names = [name.lower() for name in layers]
    except (TypeError, AttributeError):
        raise TypeError(f"layers: names of layers are expected, not {shown(layers)}") from None
    if "all" in names:
        suns = [light for light in scene.GetLights() if not light.GetPositional()]
        lit = suns or not (scene.GetLights().GetNumberOfItems() or scene.GetEnvironment())
        return [name for name in LAYERS if name != "shadow" or lit]
    for name in names:
        if name not in LAYERS:
            raise ValueError(f"layers: {shown(name)} was given, names of {', '.join(LAYERS)} are expected"
                             + suggestion(name, LAYERS))
    return names
