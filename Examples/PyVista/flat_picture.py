# SPDX-License-Identifier: BSD-3-Clause
"""A flat picture

Heights in, a picture out: soft shadows of every length, and stone that lets some light through.
"""

import pathlib

import pyvista as pv
import reliefshading.pyvista as rs

# %%
# `read` gives an `ImageData` with the north up and its spacing in metres, as the file's place on the map tells it. Any
# `ImageData` will do instead, and so will a `StructuredGrid` or a `RectilinearGrid` of equal steps.

dem = rs.read(pathlib.Path(__file__).parents[1] / "Data" / "jacksboro.tif")
print("%d x %d samples, %.1f m by %.1f m" % (*dem.dimensions[:2], *dem.spacing[:2]))

# %%
# The *look* is any keywords of `reliefshading.shade()`, whose `help()` tells them with unit, range and default. A low sun in
# the north-west, heights doubled, and a depth: light gets as far as that into the ground, which softens small ridges.

look = dict(sun=(315, 25), height_scale=2, depth=120)
shaded = rs.shade(dem, **look)
print(shaded.active_scalars_name, shaded["Shading"].dtype, shaded["Shading"].shape)

# %%
# `shaded` is a dataset like the heights, with colours that are ready to be seen. So the plotter must not light them again.

pl = pv.Plotter(window_size=(560, 592))
pl.add_mesh(shaded, scalars="Shading", rgb=True, lighting=False)
pl.enable_parallel_projection()
pl.view_xy()
pl.camera.parallel_scale = (shaded.bounds[3] - shaded.bounds[2]) / 2
pl.show()
