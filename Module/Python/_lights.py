# SPDX-License-Identifier: BSD-3-Clause
"""Suns, lamps, presets and environments, from keywords into a scene."""

import numpy as np
from vtkmodules.vtkRenderingCore import vtkLight

from . import vtkReliefEnvironment
from ._arrays import color_array, to_upright_image
from ._keywords import OF_LIGHT, converted, several, set_checked, shown, suggestion

PRESETS = {
    "default": (0, "SetLightsToDefault"),
    "multidirectional": (0, "SetLightsToMultidirectional"),
    "sky-dome": (0, "SetLightsToSkyDome"),
    "sun-and-sky": (2, "SetLightsToSunAndSky"),
    "combined": (2, "SetLightsToCombined"),
    "igor": (1, "SetLightsToIgor"),
}


def preset_of(name):
    if not isinstance(name, str):
        raise TypeError(f"preset: one of {', '.join(PRESETS)} is expected, not {shown(name)}")
    key = name.replace("_", "-")
    if key not in PRESETS:
        raise ValueError(f"preset: {shown(name)} was given, one of {', '.join(PRESETS)} is expected"
                         + suggestion(key, list(PRESETS)))
    return key


def set_lights(scene, values, environments):
    """Replaces the lights and the environment of a scene by what keywords ask for, if they do."""
    suns, moments, lamps = _lights_of(values)
    preset, environment = values.get("preset"), values.get("environment")
    if preset is not None:
        _set_preset(scene, preset_of(preset), suns, moments, environment)
        suns = []
    elif suns or moments or lamps or environment is not None:
        scene.RemoveAllLights()
        scene.SetEnvironment(None)
    if environment is not None:
        set_checked("environment", scene, "SetEnvironment", (environments.find(environment),))
    for name, sun in suns:
        _add_sun(scene, name, sun)
    for name, moment in moments if preset is None else ():
        _add_sun_at(scene, name, moment)
    for name, lamp in lamps:
        _add_lamp(scene, name, lamp)


def _lights_of(values):
    suns = _one_and_several(values, "sun", "suns")
    moments = [("sun_at", values["sun_at"])] if values.get("sun_at") is not None else []
    return suns, moments, _one_and_several(values, "lamp", "lamps")


def _one_and_several(values, one, many):
    lights = [(one, values[one])] if values.get(one) is not None else []
    if values.get(many) is not None:
        try:
            if isinstance(values[many], (str, dict)):
                raise TypeError
            lights += [(f"{many}[{i}]", light) for i, light in enumerate(values[many])]
        except TypeError:
            raise TypeError(f"{many}: a list of lights is expected, each as {one} has it") from None
    return lights


def _set_preset(scene, preset, suns, moments, environment):
    wanted, setter = PRESETS[preset]
    if environment is not None and preset in ("sky-dome", "sun-and-sky"):
        raise ValueError(f"environment: the preset {preset} has its own")
    if len(suns) + len(moments) > (1 if wanted else 0):
        raise ValueError(f"preset: {preset} takes {'one sun' if wanted else 'no sun'}, "
                         f"{len(suns) + len(moments)} were given")
    angles = (315.0, 45.0)
    for name, sun in suns:
        if isinstance(sun, dict):
            angles = _angles(name, dict(sun), only=True)
        else:
            angles = several(sun, name, (2,), f"(azimuth, altitude), for the preset {preset},")
    for name, moment in moments:
        arguments, _ = _moment(name, moment)
        found = [0.0, 0.0]
        time, longitude, latitude, convergence, elevation, refraction = arguments
        set_checked(name, scene, "FindSun",
                    (time, longitude, latitude, elevation, refraction, found))
        angles = (found[0] - convergence, found[1])
    set_checked("sun", scene, setter, angles[:wanted])


# ------------------------------------------------------------------------------
def _angles(name, sun, only=False):
    """Azimuth and altitude of a dict, which are taken out of it."""
    for key in ("azimuth", "altitude"):
        if key not in sun:
            raise TypeError(f"{name}: the dict lacks {key!r}")
    angles = (sun.pop("azimuth"), sun.pop("altitude"))
    if only and sun:
        raise ValueError(f"{name}: a preset's sun has no {shown(next(iter(sun)))}")
    return several(angles, name, (2,), "(azimuth, altitude)")


def _set_light(scene, light, name, values):
    """Sets what the table says of lights, from a dict."""
    known = {key: row for key, row in OF_LIGHT.items()
             if not (key == "angular_diameter" and light.GetPositional())}
    for key, value in values.items():
        row = known.get({"diffuse_color": "color", "switch": "on"}.get(key, key))
        if row is None:
            raise TypeError(f"{name}: there is no {shown(key)}" + suggestion(key, list(known)))
        place = f"{name}: {key}"
        arguments = converted(row, value, place)
        if not np.isfinite(arguments).all():
            raise ValueError(f"{place}: {shown(value)} was given, finite numbers are expected")
        if row["name"] == "AngularDiameter":
            set_checked(place, scene, "SetAngularDiameter", (light, *arguments))
        else:
            getattr(light, "Set" + row["name"])(*arguments)


def _add_sun(scene, name, sun):
    if isinstance(sun, vtkLight):
        scene.AddLight(sun)
        return
    rest = {}
    if isinstance(sun, dict):
        rest = dict(sun)
        angles = _angles(name, rest)
    else:
        angles = several(sun, name, (2, 3), "(azimuth, altitude[, angular diameter])")
    light = set_checked(name, scene, "AddSun", angles)
    _set_light(scene, light, name, rest)


def _moment(name, moment):
    """The arguments of AddSunAt, and what else a dict says."""
    rest = {}
    if isinstance(moment, dict):
        rest = dict(moment)
        try:
            values = [rest.pop(key) for key in ("time", "longitude", "latitude")]
        except KeyError as error:
            raise TypeError(f"{name}: the dict lacks {error}") from None
        values += [rest.pop("convergence", 0.0), rest.pop("elevation", 0.0)]
        refraction = converted({"kind": "flag"}, rest.pop("refraction", True), name + ": refraction")[0]
    else:
        expected = "(time, longitude, latitude[, convergence])"
        if (isinstance(moment, str) or not hasattr(moment, "__len__") or getattr(moment, "ndim", 1) != 1
                or len(moment) not in (3, 4)):
            raise TypeError(f"{name}: {expected} is expected, not {shown(moment)}")
        values, refraction = [*moment, 0.0][:4] + [0.0], True
    time = values[0].isoformat() if hasattr(values[0], "isoformat") else values[0]
    if not isinstance(time, str):
        raise TypeError(f"{name}: a time is an aware datetime or a text, not {shown(time)}")
    degrees = several(values[1:], name, (4,), "a number of degrees")
    return (time, *degrees, refraction), rest


def _add_sun_at(scene, name, moment):
    arguments, rest = _moment(name, moment)
    light = set_checked(name, scene, "AddSunAt", arguments)
    _set_light(scene, light, name, rest)


def _add_lamp(scene, name, lamp):
    if isinstance(lamp, vtkLight):
        scene.AddLight(lamp)
        return
    rest = {}
    if isinstance(lamp, dict):
        rest = dict(lamp)
        if "position" not in rest:
            raise TypeError(f"{name}: the dict lacks 'position'")
        lamp = rest.pop("position")
    position = several(lamp, name, (3,), "(x, y, z)")
    if not np.isfinite(position).all():
        raise ValueError(f"{name}: {shown(lamp)} was given, finite numbers are expected")
    light = vtkLight()
    light.PositionalOn()
    light.SetPosition(position)
    light.SetFocalPoint(position[0], position[1], position[2] - 1.0)
    _set_light(scene, light, name, rest)
    scene.AddLight(light)


# ------------------------------------------------------------------------------
class Environments:
    """The environment of the last array, whose lights are kept while the array says the same."""

    def __init__(self):
        self._array = None
        self._image = None

    def find(self, value):
        """An environment of its own, which may be changed."""
        environment = vtkReliefEnvironment()
        if isinstance(value, vtkReliefEnvironment):
            environment.ShallowCopy(value)
            return environment
        array = color_array(value, "environment")
        if self._array is None or self._array.dtype != array.dtype or not np.array_equal(
                self._array, array, equal_nan=array.dtype.kind == "f"):
            self._array = array.copy()
            self._image = to_upright_image(self._array)
        environment.SetImage(self._image)
        return environment


def set_environment(scene, values, table):
    """Sets what keywords say of the scene's environment."""
    for name, row in table.items():
        if row["owner"] == "Environment" and name in values:
            environment = scene.GetEnvironment()
            if environment is None:
                raise ValueError(f"{name}: there is no environment; give one, or a preset with a sky")
            set_checked(name, environment, "Set" + row["name"], converted(row, values[name], name))
