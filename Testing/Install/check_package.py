# SPDX-License-Identifier: BSD-3-Clause
"""Uses the installed Python package: shades level ground of 3 x 3 samples."""

import os
import sys

import reliefshading
from vtkmodules.vtkCommonDataModel import vtkImageData

prefix = os.path.realpath(sys.argv[1])

heights = vtkImageData()
heights.SetDimensions(3, 3, 1)
heights.AllocateScalars(10, 1)  # VTK_FLOAT
heights.GetPointData().GetScalars().Fill(7.0)

shading = reliefshading.vtkImageReliefShading()
shading.SetInputData(heights)
shading.GetScene().AddSun(90.0, 30.0)
shading.GetScene().SetTolerance(0.0)
shading.Update()
middle = shading.GetOutput().GetScalarComponentAsDouble(1, 1, 0, 0)
assert abs(middle - 0.5) < 1e-5, middle

# The package and its library are the installed ones, not those of the build.
assert os.path.realpath(reliefshading.__file__).startswith(prefix), reliefshading.__file__
with open("/proc/self/maps", encoding="utf-8") as maps:
    libraries = {line.split()[-1] for line in maps if "libvtkReliefShading" in line}
assert libraries and all(path.startswith(prefix) for path in libraries), libraries

# What is written in Python is there as well, and so are its types.
picture = reliefshading.shade([[7.0] * 3] * 3, sun=(90, 30), tolerance=0.0, dtype="float32")
assert picture[1, 1, 0] == middle, picture[1, 1]
folder = os.path.dirname(reliefshading.__file__)
assert {"__init__.pyi", "py.typed", "pyvista.py", "xarray.py"} <= set(os.listdir(folder)), os.listdir(folder)
