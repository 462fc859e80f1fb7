# SPDX-License-Identifier: BSD-3-Clause
"""A day of suns

The sun of a date and a place, from the morning to the evening.
"""

import pathlib

import pyvista as pv
import reliefshading.pyvista as rs

dem = rs.read(pathlib.Path(__file__).parents[1] / "Data" / "jacksboro.tif")

# %%
# A part is enough: every dataset of PyVista is taken, also one that a filter has made.

valley = dem.extract_subset((100, 260, 90, 220, 0, 0))

# %%
# `sun_at` is a time with its zone, a longitude and a latitude. `update` shades what `drape` has made anew: what heights cost
# is kept, so that 24 hours over a million samples are a matter of seconds.

HOURS = (8, 9, 12, 15, 18, 19)
pl = pv.Plotter(shape=(2, 3), window_size=(960, 560), border=False)
terrain = rs.drape(valley, height_scale=2, diffuse_color="wheat")
for k, hour in enumerate(HOURS):
    rs.update(terrain, sun_at=(f"2026-09-22T{hour:02}:00-04:00", -84.2, 36.5))
    pl.subplot(k // 3, k % 3)
    pl.background_color = "white"
    # Each view has the picture of its hour: a copy of the surface as it is now.
    pl.add_mesh(terrain.copy(), scalars="Shading", rgb=True, lighting=False)
    pl.add_text(f"{hour}:00", font_size=9, color="black", position=(8, 245))
    pl.camera_position = "xy"
    pl.camera.elevation = -35
    pl.reset_camera()
    pl.camera.zoom(1.35)
pl.show()

# %%
# For a film open one file, `pl.open_gif("day.gif")`, add the surface once and, for each hour, `update` it and call
# `pl.write_frame()`.
