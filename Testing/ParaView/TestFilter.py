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

# The sun of a time and a place, against NREL's own: 2003-10-17 in Golden, azimuth 194.34, altitude 39.89.
timed = shade(source, {"SunTime": "2003-10-17T12:30:30-07:00", "SunPlace": [-105.1786, 39.742476],
                       "SunElevation": 1830.14, "SunConvergence": 4.34, "SunByTime": 1}, "timed")
by_hand = shade(source, {"SunAzimuth": 190.0, "SunAltitude": 39.888}, "by_hand")
assert np.abs(fetch(timed) - fetch(by_hand)).mean() < 0.002, np.abs(fetch(timed) - fetch(by_hand)).mean()
by_hand.SunAzimuth = 194.34
assert np.abs(fetch(timed) - fetch(by_hand)).mean() > 0.01, "the convergence changes nothing"

# Cells, as ParaView's own reader of rasters has them: the same numbers, at their middles.
of_cells = shade(heights("cells"), base, "of_cells")
check_equal(fetch(of_cells), wanted_base, "heights of cells")
made = pv.servermanager.Fetch(of_cells)
given = pv.servermanager.Fetch(source)
assert np.allclose(made.GetOrigin(), given.GetOrigin(), rtol=0, atol=1e-9), made.GetOrigin()
assert of_cells.GetDataInformation().GetExtent() == source.GetDataInformation().GetExtent()

# The picture is the default output; layers come as arrays.
plain = pv.ReliefShading(Input=source, Illumination=1, Normals=1, Shadow=1)
plain.UpdatePipeline()
shaded = pv.servermanager.Fetch(plain)
assert shaded.GetPointData().GetScalars().GetDataTypeAsString() == "unsigned char"
assert shaded.GetPointData().GetArray("Illumination").GetNumberOfComponents() == 1
assert shaded.GetPointData().GetArray("Shadow").GetNumberOfComponents() == 1
assert shaded.GetPointData().GetArray("Normals").GetNumberOfComponents() == 3

# The scale of heights without a unit.
plain.FitHeightScale = 1
fitted = fetch(plain)
plain.FitHeightScale = 0
assert not np.array_equal(fetch(plain), fitted), "FitHeightScale changes nothing"
print("passed")
