# SPDX-License-Identifier: BSD-3-Clause
"""What the gallery's figures are made with: height fields, pictures, and what is said of them."""

import colorsys

import numpy as np
import reliefshading as rs
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkJPEGWriter
from vtkmodules.vtkRenderingCore import vtkLight


def image_of(array, spacing=1.0):
    """An image of VTK, of an array whose row 0 is at the bottom."""
    image = vtkImageData()
    image.SetDimensions(array.shape[1], array.shape[0], 1)
    image.SetSpacing(spacing, spacing, 1.0)
    values = np.ascontiguousarray(array, np.float32).reshape(array.shape[0] * array.shape[1], -1)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    return image


def array_of(image, name=None):
    """An array of an image, rows first, row 0 at the bottom."""
    columns, rows, _ = image.GetDimensions()
    scalars = image.GetPointData().GetArray(name) if name else image.GetPointData().GetScalars()
    return vtk_to_numpy(scalars).reshape(rows, columns, -1)


def ball(size):
    """A ball that is half sunk into level ground, of radius 1; its image is 3 wide."""
    spacing = 3.0 / size
    x, y = np.meshgrid(*2 * [(np.arange(size) + 0.5) * spacing - 1.5])
    return image_of(np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0)), spacing)


def rainbow(strength=3.6):
    """A latitude-longitude image: the hue runs around the horizon once and fades to black overhead."""
    columns, rows = 180, 90
    hues = np.array([colorsys.hsv_to_rgb(i / columns, 1.0, 1.0) for i in range(columns)])
    low = np.sin((np.arange(rows) + 0.5) / rows * np.pi)[:, None, None] ** 12
    # An image of VTK begins with its bottom row, and this one with the zenith.
    return image_of((strength * low * hues[None, :, :])[::-1])


class Stage:
    """A height field and the scene that lights it."""

    def __init__(self, heights):
        self.shading = rs.vtkImageReliefShading()
        if isinstance(heights, vtkImageData):
            self.shading.SetInputData(heights)
        else:
            self.shading.SetInputConnection(heights)
        self.shading.SetOutputScalarTypeToUnsignedChar()
        self.scene = self.shading.GetScene()
        self.material = self.scene.GetMaterial()

    def lamp(self, x, y, z, intensity=1.0, color=(1.0, 1.0, 1.0)):
        """A lamp at a place: shares of the image's width, from its middle; z from height 0."""
        self.shading.UpdateInformation()
        self.shading.GetInputAlgorithm().Update()
        bounds = self.shading.GetInputDataObject(0, 0).GetBounds()
        width = bounds[1] - bounds[0]
        lamp = vtkLight()
        lamp.SetLightTypeToSceneLight()
        lamp.PositionalOn()
        lamp.SetPosition((bounds[0] + bounds[1]) / 2 + x * width, (bounds[2] + bounds[3]) / 2 + y * width,
                         z * width)
        lamp.SetIntensity(intensity)
        lamp.SetDiffuseColor(*color)
        self.scene.AddLight(lamp)
        return lamp

    def picture(self):
        """Colours as the screen shows them, row 0 at the bottom, white where there are no data."""
        self.shading.Update()
        if self.shading.GetErrorCode():
            raise SystemExit("a figure could not be shaded")
        rgba = array_of(self.shading.GetOutput()).astype(np.float64)
        alpha = rgba[..., 3:] / 255.0
        return (rgba[..., :3] * alpha + 255.0 * (1.0 - alpha)).round().astype(np.uint8)

    def layer(self, name):
        """A layer, computed beside the picture."""
        getattr(self.shading, f"Generate{name}On")()
        self.picture()
        return array_of(self.shading.GetOutput(), name)

    def told(self):
        """What differs from a scene's defaults, for a caption."""
        owners = {"Scene": self.scene, "Material": self.material, "Environment": self.scene.GetEnvironment()}
        words = []
        for row in rs.parameters():
            owner = owners.get(row["owner"])
            if owner is None:
                continue
            value = getattr(owner, "Get" + row["name"])()
            usual = row["default"]
            if row["kind"] == "choice":
                value = row["choices"][value]
            elif row["kind"] == "flag":
                value = bool(value)
            if row["name"] == "SubsurfaceDepth" and self.material.GetAutomaticSubsurfaceDepth():
                continue
            if row["name"] == "AutomaticSubsurfaceDepth" or value == usual:
                continue
            words.append(f"{row['key']} {spoken(value)}")
        return "; ".join(words + [light_told(light) for light in self.lights()])

    def lights(self):
        lights = self.scene.GetLights()
        return [lights.GetItemAsObject(k) for k in range(lights.GetNumberOfItems())]


def spoken(value):
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple):
        return "(" + ", ".join(f"{v:.3g}" for v in value) + ")"
    return value if isinstance(value, str) else f"{value:.3g}"


def light_told(light):
    place = light.GetPosition()
    if light.GetPositional():
        words = "lamp at " + spoken(tuple(place))
    else:
        altitude = np.degrees(np.arcsin(np.clip(place[2] / np.linalg.norm(place), -1, 1)))
        azimuth = np.degrees(np.arctan2(place[0], place[1])) % 360
        words = f"sun {azimuth:.3g}, {altitude:.3g}"
    color = light.GetDiffuseColor()
    words += f", intensity {light.GetIntensity():.3g}" if light.GetIntensity() != 1.0 else ""
    return words + (f", colour {spoken(tuple(color))}" if color != (1.0, 1.0, 1.0) else "")


def side_by_side(pictures, gap=6):
    """Pictures of one height in a row, on white."""
    rows = max(picture.shape[0] for picture in pictures)
    white = np.full((rows, gap, 3), 255, np.uint8)
    parts = []
    for picture in pictures:
        below = (rows - picture.shape[0]) // 2
        parts += [white, np.pad(picture, ((below, rows - picture.shape[0] - below), (0, 0), (0, 0)),
                                constant_values=255)]
    return np.hstack(parts[1:])


def write(picture, file):
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    values = np.ascontiguousarray(picture).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    writer = vtkJPEGWriter()
    writer.SetQuality(90)
    writer.SetInputData(image)
    writer.SetFileName(str(file))
    writer.Write()
    if writer.GetErrorCode():
        raise SystemExit(f"{file} cannot be written")


def grey(values, low=None, high=None):
    """Numbers as grey, the least black; white where there are none."""
    low = np.nanmin(values) if low is None else low
    high = np.nanmax(values) if high is None else high
    share = np.clip((values - low) / (high - low if high > low else 1.0), 0.0, 1.0)
    codes = np.where(np.isnan(share), 255, np.nan_to_num(share) * 255).round().astype(np.uint8)
    return np.repeat(codes.reshape(*codes.shape[:2], 1), 3, axis=2)
