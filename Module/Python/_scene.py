# SPDX-License-Identifier: BSD-3-Clause
"""A scene set by keywords."""

from . import _pipeline, vtkReliefScene
from ._keywords import AUTOMATIC, TABLE, converted, number, set_checked, shown
from ._lights import set_environment, set_lights


def set_scene(scene, values, heights, environments):
    """Sets all of a scene: what keywords do not say is the table's, or a given scene's."""
    given = values.get("scene")
    if given is None:
        scene.SetEnvironment(None)
        scene.RemoveAllLights()
    elif not isinstance(given, vtkReliefScene):
        raise TypeError(f"scene: a vtkReliefScene or a file's name is expected, not {type(given).__name__}")
    elif given is not scene:
        scene.CopySharingImage(given)
    for name, row in TABLE.items():
        if row["owner"] == "Environment" or (given is not None and name not in values):
            continue
        value = values.get(name, row["default"])
        if name in AUTOMATIC and isinstance(value, str):
            if value != "auto":
                raise ValueError(f'{name}: {shown(value)} was given, a number or "auto" is expected')
            continue
        owner = scene if row["owner"] == "Scene" else scene.GetMaterial()
        set_checked(name, owner, "Set" + row["name"], converted(row, value, name))
    _set_automatic(scene, values, heights)
    if "floor_height" in values and "use_floor" not in values:
        scene.GetMaterial().UseFloorOn()
    set_lights(scene, values, environments)
    if values.get("preset") is not None and "response" in values:
        row = TABLE["response"]
        set_checked("response", scene, "SetResponse", converted(row, values["response"], "response"))
    set_environment(scene, values, TABLE)


def _set_automatic(scene, values, heights):
    depth = values.get("depth")
    if isinstance(depth, str):
        if depth != "auto":
            raise ValueError(f'depth: {shown(depth)} was given, a number or "auto" is expected')
        scene.GetMaterial().AutomaticSubsurfaceDepthOn()
    elif depth is not None:
        set_checked("depth", scene.GetMaterial(), "SetSubsurfaceDepth", (number(depth, "depth"),))
    elif "subsurface_depth" in values and "automatic_subsurface_depth" not in values:
        scene.GetMaterial().AutomaticSubsurfaceDepthOff()
    if isinstance(values.get("exposure"), str):
        scene.AutomaticExposureOn()
    if isinstance(values.get("height_scale"), str):
        set_checked("height_scale", scene, _pipeline.fit_height_scale, (scene, *heights.fit_arguments()))
