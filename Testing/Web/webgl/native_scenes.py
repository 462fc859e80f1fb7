# SPDX-License-Identifier: BSD-3-Clause
"""Shades scenes by the filter, for the browser to do the same.

    native_scenes.py FOLDER

Writes scenes.json, which has the scenes, and for each the heights and the linear colours as raw floats, rows
from the top.
"""

import json
import os
import sys

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefSceneFile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..",
                                "Examples", "Python"))
from NumpyShading import from_image, to_image  # noqa: E402

COLUMNS, ROWS = 120, 90


def terrain(seed, columns=COLUMNS, rows=ROWS, roughness=0.55, height=14.0):
    """Hills of all sizes: sums of waves."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:rows, 0:columns].astype(float)
    heights = np.zeros((rows, columns))
    size = 60.0
    for _ in range(6):
        for _ in range(3):
            angle, phase = rng.uniform(0.0, 2.0 * np.pi, 2)
            heights += height * np.sin((np.cos(angle) * x + np.sin(angle) * y) * 2 * np.pi / size + phase)
        size, height = size * 0.55, height * roughness * 0.6
    return heights.astype(np.float32)


def with_holes(heights):
    y, x = np.mgrid[0:heights.shape[0], 0:heights.shape[1]]
    result = heights.copy()
    result[(x - 30) ** 2 + (y - 40) ** 2 < 150] = np.nan
    result[60:70, 80:119] = np.nan
    result[:, 0:2] = np.nan
    result[5, 50] = np.inf
    return result


def steps(heights):
    return (np.round(heights / 4.0) * 4.0).astype(np.float32)


def sun(azimuth=315.0, altitude=35.0, **more):
    return {"kind": "sun", "azimuth": azimuth, "altitude": altitude, **more}


def lamp(x, y, z, **more):
    return {"kind": "point", "position": [x, y, z], **more}


def picture(seed, columns, rows, components, encoded):
    rng = np.random.default_rng(seed)
    coarse = rng.uniform(0.0, 1.0, (rows // 4 + 2, columns // 4 + 2, components))
    texels = np.kron(coarse, np.ones((4, 4, 1)))[:rows, :columns]
    return (texels * 255).astype(np.uint8) if encoded else texels.astype(np.float32)


def scene(name, heights, spacing=1.0, textures=None, **description):
    spacing = spacing if isinstance(spacing, tuple) else (spacing, spacing)
    return {"name": name, "heights": heights, "spacing": spacing, "textures": textures or {}, "scene": {"reliefScene": 1, **description}}


def scenes():
    hills = terrain(1)
    soft = {"subsurfaceDepth": 6.0}
    scatter = {"forwardScatterCoefficient": 0.6, "forwardScatterRange": [-0.6, 0.4]}
    shine = {"specularCoefficient": 0.4, "specularRange": [0.2, 1.0], "specularPower": 3.0}
    floor = {"useFloor": True, "floorHeight": -20.0}
    yield scene("defaults", hills)
    yield scene("low sun, vertical", hills, lights=[sun(200.0, 12.0)], material={"offsetMode": "Vertical", **soft})
    yield scene("normal offset", hills, lights=[sun()], material={"offsetMode": "SurfaceNormal", **soft})
    yield scene("depth 0", hills, lights=[sun(70.0, 30.0)], material={"subsurfaceDepth": 0.0})
    yield scene("exponential", hills, lights=[sun()],
                material={"attenuation": "Exponential", "density": 0.3, **soft})
    yield scene("floor and light from below", hills, lights=[sun(120.0, -40.0), sun(300.0, 20.0)],
                material={**floor, **soft, **scatter})
    yield scene("highlights", hills, lights=[sun(altitude=50.0), sun(90.0, 20.0, intensity=0.5)], material=shine)
    yield scene("highlights only", hills, lights=[sun(altitude=50.0)],
                material={**shine, "specularCoefficient": 1.0, "specularPower": 0.5})
    yield scene("lamp", hills, lights=[lamp(40.0, 50.0, 30.0, color=[1.0, 0.7, 0.4])], material=soft)
    yield scene("lamp, all effects", hills, lights=[lamp(90.0, 20.0, 40.0), sun(intensity=0.4)],
                material={"offsetMode": "SurfaceNormal", **soft, **scatter, **shine})
    yield scene("lamp in the ground and far away", hills,
                lights=[lamp(60.0, 40.0, -5.0), lamp(1e6, 2e6, 1e6, intensity=0.5)], material={**soft, **floor})
    yield scene("combined", hills, response="Combined", lights=[sun(altitude=45.0)])
    yield scene("igor", hills, response="Igor", lights=[sun(), sun(20.0, 60.0, intensity=0.3)])
    yield scene("fixed steps", hills, integrator="FixedStep", numberOfSteps=100, lights=[sun()],
                material={"offsetMode": "Vertical"})
    yield scene("holes", with_holes(hills), lights=[sun(250.0, 20.0), lamp(50.0, 40.0, 60.0)], material=soft)
    yield scene("steps and unequal spacing", steps(hills), (2.0, 0.7), heightScale=0.6, lights=[sun(10.0, 25.0)])
    yield scene("sun's disc", hills, lights=[sun(altitude=25.0, angularDiameter=10.0)], numberOfSunSamples=12)
    sky = {"image": "clearSky", "azimuth": 100.0, "altitude": 30.0, "numberOfSamples": 40, "intensity": 0.2}
    yield scene("environment", hills, environment=sky, lights=[sun(intensity=0.5)],
                material={**soft, **scatter, **shine, "offsetMode": "TangentPlane"})
    yield scene("environment, turned and nearby", hills,
                environment={**sky, "rotationZ": 70.0, "tilt": 20.0, "radius": 90.0, "sampling": "Importance"},
                material={**soft, **scatter})
    yield scene("textures", hills, lights=[sun(intensity=0.8)],
                textures={"base": picture(3, 40, 30, 4, True), "diffuse": picture(4, COLUMNS, ROWS, 3, True),
                          "specular": picture(5, 61, 47, 1, False)},
                material={**shine, "baseColor": [0.02, 0.05, 0.1], "diffuseColor": [0.5, 0.6, 0.7]})
    yield scene("one row", terrain(2, 50, 1), lights=[sun(100.0, 30.0)], material=soft)
    yield scene("turned inside out, in red", terrain(5, 33, 65), heightScale=-1.5,
                lights=[sun(1.0, 15.0, color=[1.0, 0.1, -0.1]), sun(180.0, 5.0)], exposure=1.5,
                material={"subsurfaceDepth": 0.3, "diffuseColor": [0.9, 0.2, 0.1], "baseColor": [0.0, 0.1, 0.0]})
    yield scene("accurate, many lights", terrain(7, 80, 80, 0.7), tolerance=0.0,
                lights=[sun(45.0 * k, 10.0 + 9.0 * k, intensity=0.15) for k in range(9)], material=soft)


def shade(case):
    file = vtkReliefSceneFile()
    if not file.FromText(json.dumps(case["scene"])):
        sys.exit(f"{case['name']}: the scene cannot be read")
    result = vtkImageReliefShading()
    image = to_image(case["heights"], case["spacing"])
    result.SetInputData(image)
    result.SetScene(file.GetScene())
    result.SetOutputScalarTypeToFloat()
    result.SetStretchTextures(True)
    for name, texels in case["textures"].items():
        getattr(result, f"Set{name.capitalize()}TextureData")(to_image(texels))
    result.Update()
    return from_image(result.GetOutput()).astype(np.float32)


def main(folder):
    os.makedirs(folder, exist_ok=True)
    index = []
    for number, case in enumerate(scenes()):
        def write(kind, array):
            name = f"{number:02}-{kind}.raw"
            array.tofile(os.path.join(folder, name))
            return {"file": name, "width": int(array.shape[1]), "height": int(array.shape[0]),
                    "components": int(array.shape[2]) if array.ndim == 3 else 1, "type": str(array.dtype)}
        index.append({
            "name": case["name"], "spacing": case["spacing"], "scene": case["scene"],
            "heights": write("heights", case["heights"]), "colors": write("colors", shade(case)),
            "textures": {name: write(name, texels) for name, texels in case["textures"].items()}})
    with open(os.path.join(folder, "scenes.json"), "w", encoding="utf-8") as file:
        json.dump(index, file, indent=1)
    print(f"{len(index)} scenes in {folder}")


if __name__ == "__main__":
    main(sys.argv[1])
