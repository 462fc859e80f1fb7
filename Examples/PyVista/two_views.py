# SPDX-License-Identifier: BSD-3-Clause
"""A light to be dragged, and the relief in space

At the left a flat relief that is shaded while it is shown, with the sun as a dot on it; at the right the same relief
as a surface. Drag the dot: both follow.
"""

import pathlib

import pyvista as pv
import reliefshading.pyvista as rs

dem = rs.read(pathlib.Path(__file__).parents[1] / "Data" / "jacksboro.tif")
look = dict(sun=(315, 25), height_scale=2, depth=120, cmap="gist_earth")

# %%
# `add_relief` adds heights and no picture: they are shaded on the graphics processor, as many samples as the view shows.

pl = pv.Plotter(shape=(1, 2), window_size=(1000, 450), border=False)
relief = rs.add_relief(pl, dem, **look)

# %%
# `add_drape` adds the surface with the picture upon it. It returns the actor, and the surface, which is a
# `StructuredGrid` with the look's height scale in its points.

pl.subplot(0, 1)
actor, terrain = rs.add_drape(pl, dem, **look)
pl.camera_position = [(17000, -8000, 8500), (15200, 14000, 200), (0, 0, 1)]

# %%
# The dot is read like a compass: the nearer to the middle it is, the higher stands the sun. Whenever it has been moved,
# the surface is shaded anew by the scene of the flat relief.

rs.add_light_widget(pl, relief, callback=lambda: rs.update(terrain, relief.scene))
pl.show()
