# SPDX-License-Identifier: BSD-3-Clause
"""Shades the jobs of a file by the native filter, for Agreement.test.mjs.

    Native.py JOBS

JOBS is JSON that the test writes; arrays lie beside it as raw numbers, the first row on top.
"""

import json
import pathlib
import sys

import numpy as np
from reliefshading import (vtkImageReliefShading, vtkReliefEnvironment, vtkReliefSceneFile)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData


def read(folder, array):
    """An array of rows, columns and components."""
    values = np.fromfile(folder / array["file"], np.dtype(array["type"]))
    return values.reshape(array["height"], array["width"], -1)


def to_image(values, spacing=(1.0, 1.0)):
    rows, columns, components = values.shape
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetSpacing(spacing[0], spacing[1], 1.0)
    turned = np.ascontiguousarray(values[::-1]).reshape(rows * columns, components)
    image.GetPointData().SetScalars(numpy_to_vtk(turned, deep=True))
    return image


def write(array, shape, file):
    np.ascontiguousarray(vtk_to_numpy(array).reshape(*shape, -1)[::-1]).tofile(file)


def run(job, folder):
    file = vtkReliefSceneFile()
    if not file.FromText(job["scene"]):
        raise SystemExit(f"{job['name']}: the scene is not read")
    scene = file.GetScene()
    if "environment" in job:
        environment = vtkReliefEnvironment()
        environment.SetImage(to_image(read(folder, job["environment"]["image"])))
        for name, value in job["environment"]["values"].items():
            getattr(environment, f"Set{name}")(value)
        scene.SetEnvironment(environment)
    heights = read(folder, job["heights"])
    image = to_image(heights, job["spacing"])
    shading = vtkImageReliefShading()
    shading.SetScene(scene)
    shading.SetInputData(image)
    mask = to_image(read(folder, job["mask"]), job["spacing"]) if "mask" in job else None
    if mask:
        shading.SetMaskData(mask)
    if "nodata" in job:
        shading.SetNoDataValue(job["nodata"])
    if job.get("fit"):
        scene.FitHeightScale(image, mask)
    shading.SetStretchTextures(True)
    for name, texture in job["textures"].items():
        getattr(shading, f"Set{name}TextureData")(to_image(read(folder, texture)))
    for name in job["layers"]:
        getattr(shading, f"Generate{name}On")()
    shading.SetOutputScalarType(VTK_FLOAT if job["output"] == "float" else VTK_UNSIGNED_CHAR)
    shading.Update()

    points = shading.GetOutput().GetPointData()
    shape = heights.shape[:2]
    write(points.GetScalars(), shape, folder / f"{job['name']}.picture")
    for name in job["layers"]:
        write(points.GetArray(name), shape, folder / f"{job['name']}.{name}")
    statistics = shading.GetStatistics()
    return {"exposure": statistics.GetExposure(), "heightScale": scene.GetHeightScale(),
            "lightsTraced": statistics.GetLightsTraced(), "raysTraced": statistics.GetRaysTraced()}


def main():
    jobs = pathlib.Path(sys.argv[1])
    results = [run(job, jobs.parent) for job in json.loads(jobs.read_text(encoding="utf-8"))]
    (jobs.parent / "results.json").write_text(json.dumps(results), encoding="utf-8")


main()
