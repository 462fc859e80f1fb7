# SPDX-License-Identifier: BSD-3-Clause
"""Filters after the light

A shaded surface is a dataset like any other: clip it, contour it, cut it. The colours come along, and nothing is
lit twice.
"""

import pathlib

import pyvista as pv
import reliefshading.pyvista as rs

dem = rs.read(pathlib.Path(__file__).parents[1] / "Data" / "jacksboro.tif")
terrain = rs.drape(dem, sun=(300, 30), height_scale=2, depth=80, cmap="terrain", clim=(150, 1100))

# %%
# `clip_box` takes a corner out; `Shading` and `Heights` stay with the points. Contour lines go by the heights as they were
# read, in metres, while the points that they run through have the height scale.

block = terrain.clip_box((15000, 40000, -1, 13000, -1e4, 1e4), invert=True)
lines = block.contour(list(range(200, 1100, 100)), scalars="Heights")
print(block["Shading"].shape == (block.n_points, 4), lines.n_points > 0)

# %%
# `threshold` gives what lies above 700 m; the rest is there as contour lines alone.

summits = terrain.threshold(700.0, scalars="Heights")
plan = terrain.contour(list(range(200, 700, 50)), scalars="Heights")

# %%
# Lines are lifted a little, so that the surface does not hide them.

pl = pv.Plotter(shape=(1, 2), window_size=(1000, 430), border=False)
for k, (mesh, contours) in enumerate(((block, lines), (summits, plan))):
    pl.subplot(0, k)
    pl.background_color = "white"
    pl.add_mesh(mesh, scalars="Shading", rgb=True, lighting=False)
    pl.add_mesh(contours.translate((0, 0, 40)), color="black", line_width=1, opacity=0.6, lighting=False)
    pl.camera_position = [(24000, -26000, 31000), (15500, 14200, 0), (0, 0, 1)]
    pl.camera.zoom(1.25)
pl.show()
