# SPDX-License-Identifier: BSD-3-Clause
"""Tints and layers

Colours by height, and what a picture is made of: light and normals as arrays beside it.
"""

import pathlib

import numpy as np
import pyvista as pv
import reliefshading.pyvista as rs

dem = rs.read(pathlib.Path(__file__).parents[1] / "Data" / "jacksboro.tif")

# %%
# `cmap` is what PyVista takes: a name, a colormap of Matplotlib or a `pv.LookupTable`. The tint is the relief's own
# colour, which the light falls on, so that it never looks painted over.
#
# Layers come as arrays of the same dataset: the light that arrives, from 0 to 1, and unit normals.

shaded = rs.shade(dem, preset="sun-and-sky", sun=(315, 35), height_scale=2, depth=60, cmap="gist_earth",
                  layers=("illumination", "normals"))
print(shaded.array_names)

# %%
# Such arrays are data: show them as any scalars, or reckon with them. Slopes are in the normals.

shaded["Slope"] = np.degrees(np.arccos(np.clip(shaded["Normals"][:, 2], -1, 1)))
shaded["Directions"] = np.uint8(127.5 + 127.5 * shaded["Normals"])

pl = pv.Plotter(shape=(2, 2), window_size=(900, 780), border=False)
BAR = dict(title="", color="black", n_labels=3, vertical=True, position_x=0.87, position_y=0.1, height=0.5)
for k, (title, keywords) in enumerate((
        ("tinted by height", dict(scalars="Shading", rgb=True)),
        ("the light that arrives", dict(scalars="Illumination", cmap="gray", clim=(0, 1), show_scalar_bar=False)),
        ("normals", dict(scalars="Directions", rgb=True)),
        ("slope in degrees", dict(scalars="Slope", cmap="magma", clim=(0, 60), scalar_bar_args=BAR)))):
    pl.subplot(k // 2, k % 2)
    pl.background_color = "white"
    pl.add_mesh(shaded.copy(), lighting=False, **keywords)
    pl.add_text(title, font_size=9, color="black", position=(8, 365))
    pl.enable_parallel_projection()
    pl.view_xy()
    pl.camera.zoom(1.15)
pl.show()
