# SPDX-License-Identifier: BSD-3-Clause
"""The gallery's figures: each is a row of pictures, with what is different in each.

The numbers are those of the figures that they follow in F. N. Pramananda Perumal's thesis of 2017; the shapes
are our own.
"""

import reliefshading as rs
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageResample

import numpy as np

from stage import Stage, array_of, ball, grey, image_of, rainbow


class Panel:
    def __init__(self, label, picture, told):
        self.label, self.picture, self.told = label, picture, told


class Subjects:
    """The height fields, in pictures as wide as is asked for."""

    def __init__(self, size, folder, terrain):
        self.size, self.folder, self.terrain_file = size, folder, terrain

    def carved(self, name):
        reader = rs.vtkOpenImageIOReader()
        reader.SetFileName(str(self.folder / f"{name}.tif"))
        reader.Update()
        return reader.GetOutput()

    def owl(self):
        return self.carved("owl")

    def on_plate(self, name, thickness=0.0):
        """A sculpture on level ground: no sample is without data."""
        image = self.carved(name)
        heights = array_of(image)[..., 0]
        ground = np.nanmin(heights)
        return image_of(np.where(np.isnan(heights), ground, heights) - ground + thickness)

    def medal(self, name="owl", budget=0.06):
        """A sculpture squeezed into a relief, on its plate."""
        squeeze = rs.vtkReliefCompression()
        squeeze.SetInputData(self.carved(name))
        squeeze.SetHeightBudget(budget)
        squeeze.Update()
        heights = array_of(squeeze.GetOutput())[..., 0]
        return image_of(np.nan_to_num(heights, nan=0.0))

    def ball(self):
        return ball(self.size)

    def terrain(self):
        """Some of the mountains in the repository, in metres."""
        reader = rs.vtkReliefRasterReader()
        reader.SetFileName(str(self.terrain_file))
        reader.Update()
        image = reader.GetOutput()
        resample = vtkImageResample()
        resample.SetInputData(image)
        factor = self.size / image.GetDimensions()[0]
        resample.SetMagnificationFactors(factor, factor, 1.0)
        resample.SetInterpolationModeToCubic()
        resample.Update()
        small = vtkImageData()
        small.ShallowCopy(resample.GetOutput())
        return small


def panels(heights, variants):
    """A panel for each variant: its label, and what it does to a stage."""
    result = []
    for label, prepare in variants:
        stage = Stage(heights)
        prepare(stage)
        result.append(Panel(label, stage.picture(), stage.told()))
    return result


def alabaster(stage, floor):
    material = stage.material
    material.UseFloorOn()
    material.SetFloorHeight(-floor)
    material.SetAttenuationToExponential()
    stage.scene.AutomaticExposureOn()


# --------------------------------------------------------------------------------------------------
def measured(subjects):
    stage = Stage(subjects.on_plate("owl"))
    stage.scene.AddSun(315.0, 30.0)
    thickness = stage.layer("Thickness")[..., 0]
    normals = stage.layer("Normals")
    illumination = stage.layer("Illumination")[..., 0]
    heights = array_of(stage.shading.GetInput())[..., 0]
    told = stage.told()
    with np.errstate(divide="ignore", invalid="ignore"):
        logarithm = np.log(np.clip(thickness, 1.0, 1000.0))
    colors = ((normals * 0.5 + 0.5) * 255.0).round().astype(np.uint8)
    return [Panel("heights, white is high", grey(heights), ""), Panel("the layer Normals", colors, ""),
            Panel("the layer Thickness, white is 1000 samples", grey(logarithm), told),
            Panel("the layer Illumination", grey(illumination, 0.0, 1.0), told)]


def height_maps(subjects):
    result = []
    for name, heights in (("an owl, half round", subjects.on_plate("owl")), ("a rosette", subjects.on_plate("rosette"))):
        stage = Stage(heights)
        stage.scene.AddSun(315.0, 35.0)
        result += [Panel(f"{name}: heights", grey(array_of(heights)[..., 0]), ""),
                   Panel("shaded", stage.picture(), stage.told())]
    return result


def direct_light(subjects):
    return panels(subjects.on_plate("owl"),
                  [(f"{altitude} degrees high", lambda s, a=altitude: s.scene.AddSun(315.0, a))
                   for altitude in (70, 40, 20, 8)])


def from_all_around(subjects):
    def sky(stage):
        stage.scene.SetLightsToSkyDome()

    def both(stage):
        stage.scene.SetLightsToSunAndSky(300.0, 25.0)

    def colors(stage):
        environment = rs.vtkReliefEnvironment()
        environment.SetImage(rainbow())
        environment.SetNumberOfSamples(256)
        stage.scene.SetEnvironment(environment)

    return panels(subjects.on_plate("owl"), [("one sun", lambda s: s.scene.AddSun(300.0, 25.0)),
                                             ("a white sky", sky), ("the sun and a clear sky", both),
                                             ("a rainbow around the horizon", colors)])


def specular_ball(subjects):
    def shine(power, lo):
        def prepare(stage):
            stage.scene.AddSun(300.0, 50.0)
            stage.material.SetSpecularCoefficient(0.6)
            stage.material.SetSpecularPower(power)
            stage.material.SetSpecularRange(lo, 1.0)
            stage.material.SetDiffuseColor(0.25, 0.35, 0.8)
        return prepare

    return panels(subjects.ball(), [("power 1", shine(1.0, 0.0)), ("power 8", shine(8.0, 0.0)),
                                    ("power 60", shine(60.0, 0.0)), ("from 0.9 on", shine(1.0, 0.9))])


def backlit_ball(subjects):
    def lit(depth, kf):
        def prepare(stage):
            alabaster(stage, 0.05)
            stage.material.SetDensity(2.0)
            stage.material.SetSubsurfaceDepth(depth)
            stage.material.SetForwardScatterCoefficient(kf)
            stage.material.SetDiffuseColor(1.0, 0.6, 0.3)
            stage.lamp(0.0, 0.0, -0.5)
        return prepare

    return panels(subjects.ball(), [("k_f = 0", lit(0.05, 0.0)), ("k_f = 0.5", lit(0.05, 0.5)),
                                    ("k_f = 1", lit(0.05, 1.0)), ("k_f = 1, four times as deep", lit(0.2, 1.0))])


def lamps(subjects):
    def at(x, y, intensity, z=0.25):
        return lambda stage: stage.lamp(x, y, z, intensity)

    def two(stage):
        stage.lamp(-0.6, 0.5, 0.25, 0.7, (1.0, 0.75, 0.5))
        stage.lamp(0.6, 0.1, 0.25, 0.5, (0.45, 0.65, 1.0))

    return panels(subjects.on_plate("owl"), [("intensity 0.5", at(-0.6, 0.5, 0.5)), ("intensity 1", at(-0.6, 0.5, 1.0)),
                                             ("another place", at(0.6, -0.2, 1.0)), ("two", two)])


def turned_rainbow(subjects):
    def turned(angle):
        def prepare(stage):
            environment = rs.vtkReliefEnvironment()
            environment.SetImage(rainbow())
            environment.SetNumberOfSamples(256)
            environment.SetRotationZ(angle)
            stage.scene.SetEnvironment(environment)
        return prepare

    return panels(subjects.on_plate("owl"), [(f"{angle} degrees", turned(float(angle))) for angle in (0, 90, 180, 270)])


def parts(subjects):
    stage = Stage(subjects.on_plate("owl"))
    stage.scene.AddSun(300.0, 25.0)
    stage.material.SetSpecularCoefficient(0.3)
    stage.material.SetSpecularPower(6.0)
    stage.material.SetBaseColor(0.03, 0.05, 0.1)
    stage.material.SetDiffuseColor(0.9, 0.55, 0.3)
    layers = {name: stage.layer(name) for name in ("Diffuse", "Specular", "Shadow")}
    picture = stage.picture()

    def encoded(linear):
        linear = np.clip(linear, 0.0, 1.0)
        return (255.0 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
                ).round().astype(np.uint8)

    return [Panel("the layer Diffuse", encoded(layers["Diffuse"]), ""),
            Panel("the layer Specular", encoded(layers["Specular"]), ""),
            Panel("the layer Shadow, white is lit", grey(1.0 - layers["Shadow"][..., 0], 0.0, 1.0), ""),
            Panel("with the base, all together", picture, stage.told())]


def base_colors(subjects):
    def base(color):
        def prepare(stage):
            stage.scene.AddSun(300.0, 25.0)
            stage.material.SetBaseColor(*color)
            stage.material.SetDiffuseColor(0.8, 0.7, 0.6)
        return prepare

    return panels(subjects.on_plate("owl"), [("black", base((0.0, 0.0, 0.0))), ("grey", base((0.1, 0.1, 0.1))),
                                             ("blue", base((0.03, 0.06, 0.25))), ("red", base((0.2, 0.02, 0.02)))])


def colors(subjects):
    def three(base, diffuse, specular):
        def prepare(stage):
            stage.scene.AddSun(300.0, 30.0)
            material = stage.material
            material.SetBaseColor(*base)
            material.SetDiffuseColor(*diffuse)
            material.SetSpecularColor(*specular)
            material.SetSpecularCoefficient(0.35)
            material.SetSpecularPower(8.0)
        return prepare

    return panels(subjects.on_plate("owl"), [
        ("terracotta", three((0.05, 0.01, 0.0), (0.85, 0.3, 0.15), (1.0, 0.9, 0.8))),
        ("jade", three((0.0, 0.03, 0.02), (0.15, 0.6, 0.35), (0.9, 1.0, 0.95))),
        ("lapis and gold", three((0.0, 0.0, 0.06), (0.06, 0.12, 0.6), (1.0, 0.75, 0.3))),
        ("porcelain", three((0.12, 0.12, 0.14), (0.8, 0.82, 0.85), (1.0, 1.0, 1.0)))])


def shares_of_highlights(subjects):
    def shine(ks):
        def prepare(stage):
            stage.scene.AddSun(300.0, 35.0)
            stage.material.SetSpecularCoefficient(ks)
            stage.material.SetSpecularPower(5.0)
            stage.material.SetDiffuseColor(0.8, 0.6, 0.4)
        return prepare

    return panels(subjects.on_plate("owl"), [(f"k_s = {ks:g}", shine(ks)) for ks in (0.0, 0.3, 0.6, 1.0)])


def shares_of_scattering(subjects):
    def lit(kf):
        def prepare(stage):
            width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
            alabaster(stage, 0.01 * width)
            stage.material.SetDensity(130.0 / width)
            stage.material.SetSubsurfaceDepth(0.012 * width)
            stage.material.SetForwardScatterCoefficient(kf)
            stage.material.SetDiffuseColor(1.0, 0.55, 0.25)
            stage.lamp(0.1, 0.1, -0.4)
        return prepare

    return panels(subjects.medal(), [(f"k_f = {kf:g}", lit(kf)) for kf in (0.0, 0.33, 0.66, 1.0)])


def falloffs(subjects):
    def shape(lo, hi, power):
        def prepare(stage):
            stage.scene.AddSun(300.0, 40.0)
            material = stage.material
            material.SetSpecularCoefficient(0.7)
            material.SetSpecularRange(lo, hi)
            material.SetSpecularPower(power)
            material.SetDiffuseColor(0.5, 0.35, 0.25)
        return prepare

    return panels(subjects.on_plate("owl"), [("0 to 1", shape(0.0, 1.0, 1.0)), ("0.6 to 0.9", shape(0.6, 0.9, 1.0)),
                                             ("a step at 0.8", shape(0.8, 0.8, 1.0)), ("0 to 1, power 12", shape(0.0, 1.0, 12.0))])


def materials(subjects):
    def skin(stage):
        width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
        material = stage.material
        material.SetSubsurfaceDepth(0.012 * width)
        material.SetBaseColor(0.12, 0.03, 0.02)
        material.SetDiffuseColor(0.95, 0.62, 0.48)
        material.SetSpecularCoefficient(0.12)
        material.SetSpecularPower(6.0)
        stage.scene.AddSun(300.0, 35.0)

    def candle(stage):
        width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
        alabaster(stage, 0.02 * width)
        material = stage.material
        material.SetDensity(40.0 / width)
        material.SetSubsurfaceDepth(0.02 * width)
        material.SetForwardScatterCoefficient(0.5)
        material.SetDiffuseColor(1.0, 0.75, 0.4)
        material.SetSpecularCoefficient(0.05)
        material.SetSpecularPower(12.0)
        stage.lamp(0.0, 0.45, -0.15, 1.0, (1.0, 0.7, 0.35))
        stage.scene.AddSun(300.0, 40.0).SetIntensity(0.1)

    def metal(stage):
        material = stage.material
        width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
        material.SetSubsurfaceDepth(0.0015 * width)
        material.SetBaseColor(0.02, 0.01, 0.0)
        material.SetDiffuseColor(0.55, 0.3, 0.1)
        material.SetSpecularColor(1.0, 0.72, 0.35)
        material.SetSpecularCoefficient(0.55)
        material.SetSpecularPower(4.0)
        stage.scene.AddSun(300.0, 40.0)
        stage.scene.AddSun(120.0, 25.0).SetIntensity(0.25)

    def stone(stage):
        width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
        stage.material.SetSubsurfaceDepth(0.001 * width)
        stage.material.SetDiffuseColor(0.75, 0.72, 0.66)
        stage.scene.AddSun(300.0, 35.0, 4.0)

    return panels(subjects.medal(budget=0.12), [("skin", skin), ("candle wax, a flame behind it", candle),
                                                ("bronze", metal), ("sandstone", stone)])


def styles(subjects):
    def style(depth, ks, samples, strength):
        def prepare(stage):
            width = stage.shading.GetInputDataObject(0, 0).GetDimensions()[0]
            environment = rs.vtkReliefEnvironment()
            environment.SetImage(rainbow(strength))
            environment.SetNumberOfSamples(samples)
            environment.SetRotationZ(45.0)
            stage.scene.SetEnvironment(environment)
            stage.material.SetSubsurfaceDepth(depth * width)
            stage.material.SetSpecularCoefficient(ks)
            stage.material.SetSpecularPower(3.0)
        return prepare

    return panels(subjects.medal(budget=0.15), [("crisp", style(0.001, 0.0, 256, 3.6)), ("soft", style(0.02, 0.0, 256, 3.0)),
                                                ("glossy", style(0.003, 0.6, 256, 6.0)), ("sixteen lights", style(0.003, 0.0, 16, 3.6))])


def by_methods(algorithm, methods, told):
    """A panel for each method of an algorithm that makes heights: its label and name."""
    result = []
    for label, method in methods:
        getattr(algorithm, "SetMethodTo" + method)()
        panel, = panels(algorithm.GetOutputPort(), [(label, lambda stage: stage.scene.AddSun(300.0, 35.0))])
        panel.told = f"`{algorithm.GetClassName()}`: {told}{method}; {panel.told}"
        result.append(panel)
    return result


def relief_methods(subjects):
    owl = subjects.owl()
    squeeze = rs.vtkReliefCompression()
    squeeze.SetInputData(owl)
    squeeze.SetHeightBudget(0.05)
    methods = [("in proportion", "Linear"), ("two scales", "TwoScale"), ("gradient domain", "GradientDomain")]
    return (panels(owl, [("its full depth", lambda stage: stage.scene.AddSun(300.0, 35.0))])
            + by_methods(squeeze, methods, "HeightBudget 0.05, "))


def normal_methods(subjects):
    stage = Stage(subjects.on_plate("owl"))
    stage.scene.AddSun(300.0, 35.0)
    normals = stage.layer("Normals")
    # As a camera measures them, with some noise.
    integration = rs.vtkNormalMapToHeightField()
    integration.SetInputData(image_of(normals + np.random.default_rng(1).normal(0.0, 0.05, normals.shape)))
    integration.SetEncodingToSigned()
    integration.SetGreenToUp()
    methods = [("sums along paths", "PathSums"), ("least squares", "LeastSquares"),
               ("with cliffs", "DiscontinuityPreserving")]
    return [Panel("the figure", stage.picture(), stage.told())] + by_methods(integration, methods, "")


FIGURES = [
    ("measured", "3.1", "What is measured of a height field", measured,
     "Heights, the surface's normals, the length of the ray to the light that lies inside, and the light that arrives."),
    ("height-maps", "3.2, 3.3", "Height maps, and what light makes of them", height_maps,
     "An image of heights, in which nobody sees much, and the same relief in light."),
    ("direct-light", "3.6", "Shade and shadow under one sun", direct_light,
     "Shade and soft shadow are one quantity; low suns throw long shadows, softer the farther they reach."),
    ("from-all-around", "3.8", "Light from all around", from_all_around,
     "Many lights at once: hollows darken under a sky, and a coloured horizon colours what faces it."),
    ("specular-ball", "3.13", "Highlights on a ball", specular_ball,
     "The closer light comes to the mirror image of the view, the brighter; range and power give the spot its size."),
    ("backlit-ball", "3.14", "A ball lit from behind", backlit_ball,
     "A lamp behind a slab with a ball on it: light comes through at the rim, where there is little material, and k_f gathers it about the lamp."),
    ("lamps", "4.4", "Lamps, and how bright they are", lamps,
     "A lamp lies in the picture's own space; its light does not fade with distance, its direction differs from place to place."),
    ("turned-rainbow", "4.5", "A rainbow, turned", turned_rainbow,
     "The horizon's hues turn about the relief, a quarter for each picture."),
    ("parts", "4.6", "Diffuse light, highlights and shadow alone", parts,
     "Layers that add up to the picture, and the cast shadow, which is none of them."),
    ("base-colours", "4.7", "The base colour", base_colors, "What is left where no light arrives."),
    ("colours", "4.10", "Base, diffuse and specular colour", colors, "Three colours make a look."),
    ("highlights", "4.11", "From chalk to mirror: k_s", shares_of_highlights, "Highlights take the place of diffuse light."),
    ("scattering", "4.12", "From wax to glass: k_f, with a lamp behind", shares_of_scattering,
     "A relief of alabaster in front of a lamp: the larger k_f, the more the lamp itself shows through."),
    ("falloffs", "4.14", "The falloff's range and power", falloffs, "Soft, narrow, stepped as in a comic, and sharp."),
    ("materials", "4.15", "Skin, a candle, metal, stone", materials, "One relief, four materials; most of it is the depth t."),
    ("styles", "4.16", "Styles under a rainbow", styles, "The same coloured light in four manners."),
    ("relief-methods", "", "A figure squeezed to a twentieth", relief_methods,
     "What is left of an owl in full round, by three methods."),
    ("normal-methods", "", "Heights from a normal map", normal_methods,
     "The owl's normals, with 5 % noise, and the surfaces that three methods find in them, under the same sun."),
]
