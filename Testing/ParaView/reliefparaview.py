# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of ParaView's plugin share. Each is run by pvpython or pvbatch, with the plugin's
file and the folder that reliefParaViewReference has filled as its arguments."""

import os
import sys

import numpy as np
import paraview.simple as pv
from paraview.vtk.util.numpy_support import vtk_to_numpy

pv._DisableFirstRenderCameraReset()
PLUGIN, FOLDER = sys.argv[1:3]
SHAPE = (39, 47)
# Where a light stands in the reference's scenes.
LIGHTS = {"Lighting": "Sun and environment", "SunAzimuth": 230.0, "SunAltitude": 35.0,
          "EnvironmentSource": "Clear sky", "Turbidity": 4.0, "UseLamp": 1,
          "LampPosition": [4600.0, -104.0, 25.0]}


def load(remote=False):
    """Loads the plugin; its filter then is one of paraview.simple."""
    if remote:
        pv.LoadPlugin(PLUGIN, remote=True, ns=pv.__dict__)
    pv.LoadPlugin(PLUGIN, remote=False, ns=pv.__dict__)
    assert hasattr(pv, "ReliefShading"), "the plugin brings no filter ReliefShading"


def heights(name="heights"):
    reader = pv.LegacyVTKReader(registrationName=name,
                                FileNames=[os.path.join(FOLDER, name + ".vtk")])
    reader.UpdatePipeline()
    return reader


def cases():
    """The name of each case, and what it sets: property names and values."""
    result = {}
    with open(os.path.join(FOLDER, "cases.txt"), encoding="utf-8") as lines:
        for line in lines:
            name, *assignments = line.split()
            settings = {}
            for assignment in assignments:
                parameter, _, values = assignment.partition("=")
                numbers = [float(value) for value in values.split(",")]
                settings[property_name(parameter)] = numbers if len(numbers) > 1 else numbers[0]
            result[name] = settings
    return result


def property_name(parameter):
    """As the plugin names the parameter of an owner."""
    owner, _, name = parameter.partition(".")
    if owner in ("Sun", "Lamp"):
        return owner + name.replace("DiffuseColor", "Color")
    return "Environment" + name if owner == "Environment" else name


def reference(name):
    """The filter's own picture of a case."""
    return np.fromfile(os.path.join(FOLDER, name + ".raw"), np.float32).reshape(SHAPE + (4,))


def assign(proxy, settings, prefix=""):
    for name, value in settings.items():
        prop = proxy.GetProperty(prefix + name)
        if prop is None:
            raise AssertionError(f"there is no property {prefix + name}")
        whole = prop.SMProperty.IsA("vtkSMIntVectorProperty") and not isinstance(value, str)
        setattr(proxy, prefix + name, int(value) if whole else value)


def shade(source, settings, name="relief"):
    relief = pv.ReliefShading(registrationName=name, Input=source, Output="Float linear",
                              UseNoDataValue=1, NoDataValue=-9999.0)
    assign(relief, settings)
    return relief


def fetch(proxy, array="Shading"):
    proxy.UpdatePipeline()
    return picture_of(pv.servermanager.Fetch(proxy), array)


def picture_of(image, array="Shading"):
    columns, rows, _ = image.GetDimensions()
    values = vtk_to_numpy(image.GetPointData().GetArray(array))
    return values.reshape(rows, columns, -1).copy()


def check_equal(got, wanted, what):
    if got.shape != wanted.shape or not np.array_equal(got, wanted, equal_nan=True):
        worst = np.abs(got - wanted).max() if got.shape == wanted.shape else got.shape
        raise AssertionError(f"{what}: not as the filter has it, off by {worst}")
