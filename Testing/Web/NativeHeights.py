# SPDX-License-Identifier: BSD-3-Clause
"""Finds the heights of the jobs of a file by the native filters, for Heights.test.mjs.

    NativeHeights.py JOBS

JOBS is JSON that the test writes; meshes and arrays lie beside it, rows of arrays from the top.
"""

import json
import pathlib
import sys

import numpy as np
from reliefshading import vtkDepthToHeightField, vtkNormalMapToHeightField, vtkReliefMeshReader
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

GREEN = {"auto": 0, "up": 1, "down": 2}
METHOD = {"least-squares": 0, "cliffs": 1, "path-sums": 2}


def to_image(values, spacing):
    rows, columns, components = values.shape
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetSpacing(*spacing, 1.0)
    turned = np.ascontiguousarray(values[::-1]).reshape(rows * columns, components)
    image.GetPointData().SetScalars(numpy_to_vtk(turned, deep=True))
    return image


def mesh_heights(job, folder):
    reader = vtkReliefMeshReader()
    reader.SetFileName(str(folder / job["mesh"]))
    heights = vtkDepthToHeightField()
    heights.SetInputConnection(reader.GetOutputPort())
    heights.SetOutputScalarTypeToDouble()
    options = job["options"]
    if "viewDirection" in options:
        heights.SetViewDirection(*options["viewDirection"])
    if "viewUp" in options:
        heights.SetViewUp(*options["viewUp"])
    if "resolution" in options:
        heights.SetResolution(options["resolution"])
    heights.Update()
    return heights.GetOutput(), {"triangles": heights.GetNumberOfTriangles()}


def normal_heights(job, folder):
    values = np.fromfile(folder / job["normals"], np.dtype(job["type"]))
    options = job["options"]
    spacing = options.get("spacing", [1.0, 1.0])
    shape = (job["height"], job["width"], -1)
    heights = vtkNormalMapToHeightField()
    heights.SetInputData(to_image(values.reshape(shape), spacing))
    if "mask" in job:
        mask = np.fromfile(folder / job["mask"], np.uint8)
        heights.SetMaskData(to_image(mask.reshape(shape), spacing))
    heights.SetGreen(GREEN[options.get("green", "auto")])
    heights.SetMethod(METHOD[options.get("method", "least-squares")])
    heights.Update()
    return heights.GetOutput(), {"green": ["", "up", "down"][heights.GetUsedGreen()],
                                 "greenKnown": bool(heights.IsGreenKnown()), "parts": heights.GetNumberOfParts(),
                                 "encoding": ["", "unsigned", "signed"][heights.GetUsedEncoding()]}


def run(job, folder):
    image, told = (mesh_heights if "mesh" in job else normal_heights)(job, folder)
    columns, rows = image.GetDimensions()[:2]
    heights = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns)
    np.ascontiguousarray(heights[::-1]).tofile(folder / f"{job['name']}.heights")
    return {"width": columns, "height": rows, "spacing": image.GetSpacing()[:2], "origin": image.GetOrigin()[:2],
            "type": str(heights.dtype), **told}


def main():
    jobs = pathlib.Path(sys.argv[1])
    results = [run(job, jobs.parent) for job in json.loads(jobs.read_text(encoding="utf-8"))]
    (jobs.parent / "results.json").write_text(json.dumps(results), encoding="utf-8")


main()
