# SPDX-License-Identifier: BSD-3-Clause
"""The filter in ParaView gives the numbers of vtkImageReliefShading, for every parameter of the table,
in whatever order they are set; and says what is wrong."""

import random

import numpy as np
from reliefparaview import *

# These change no linear colour of the exact integrator.
IDLE = {"Scene.NumberOfSteps", "Scene.Exposure", "Scene.AutomaticExposure"}

load()
source = heights()
every = cases()
base = dict(LIGHTS, **every["base"])

# Every parameter reaches the model.
relief = shade(source, base)
wanted_base = reference("base")
check_equal(fetch(relief), wanted_base, "base")
unchanged = set()
for name, settings in every.items():
    if "." not in name:
        continue
    assign(relief, settings)
    check_equal(fetch(relief), reference(name), name)
    if np.array_equal(reference(name), wanted_base):
        unchanged.add(name)
    assign(relief, every["base"])
    parameter = property_name(name)
    if parameter not in every["base"]:
        relief.GetProperty(parameter).SMProperty.ResetToDefault()
        relief.SMProxy.UpdateVTKObjects()
check_equal(fetch(relief), wanted_base, "base, after everything has been set back")
assert unchanged == IDLE, f"these parameters change nothing: {unchanged}"
assert len(every) >= 41, f"{len(every)} cases are too few"

# In any order.
for seed in range(5):
    shuffled = list(base.items())
    random.Random(seed).shuffle(shuffled)
    other = shade(source, dict(shuffled), f"shuffled{seed}")
    check_equal(fetch(other), wanted_base, f"base in the order {seed}")
    pv.Delete(other)

# The lights that come ready.
for name, settings in {"usual": {}, "multidirectional": {"Lighting": "Multidirectional"},
                       "sky-dome": {"Lighting": "Sky dome"},
                       "sun-and-sky": {"Lighting": "Sun and sky", "SunAzimuth": 120, "SunAltitude": 25}
                       }.items():
    ready = shade(source, settings, name)
    check_equal(fetch(ready), reference(name), name)
    pv.Delete(ready)

# Cells, as ParaView's own reader of rasters has them: the same numbers, at their middles.
of_cells = shade(heights("cells"), base, "of_cells")
check_equal(fetch(of_cells), wanted_base, "heights of cells")
made = pv.servermanager.Fetch(of_cells)
given = pv.servermanager.Fetch(source)
assert np.allclose(made.GetOrigin(), given.GetOrigin(), rtol=0, atol=1e-9), made.GetOrigin()
assert of_cells.GetDataInformation().GetExtent() == source.GetDataInformation().GetExtent()

# The picture is the default output; layers come as arrays.
plain = pv.ReliefShading(Input=source, Illumination=1, Normals=1)
plain.UpdatePipeline()
shaded = pv.servermanager.Fetch(plain)
assert shaded.GetPointData().GetScalars().GetDataTypeAsString() == "unsigned char"
assert shaded.GetPointData().GetArray("Illumination").GetNumberOfComponents() == 1
assert shaded.GetPointData().GetArray("Normals").GetNumberOfComponents() == 3

# The scale of heights without a unit.
plain.FitHeightScale = 1
fitted = fetch(plain)
plain.FitHeightScale = 0
assert not np.array_equal(fetch(plain), fitted), "FitHeightScale changes nothing"
print("passed")
