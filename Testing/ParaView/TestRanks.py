# SPDX-License-Identifier: BSD-3-Clause
"""By several processes: each has its piece of the picture that one process makes, of a source that is
cut up and of a reader's file, of points and of cells. Run as `pvbatch --sym`, where every process runs the
script."""

from paraview.modules.vtkRemotingCore import vtkProcessModule
from reliefparaview import *

load()
module = vtkProcessModule.GetProcessModule()
rank, ranks = module.GetPartitionId(), module.GetNumberOfLocalPartitions()


def piece(proxy):
    proxy.UpdatePipeline()
    image = proxy.GetClientSideObject().GetOutputDataObject(0)
    return image.GetExtent(), (picture_of(image) if image.GetNumberOfPoints() else None)


def check(proxy, name):
    """What one process has made, or this process's piece of it."""
    extent, got = piece(proxy)
    file = os.path.join(FOLDER, name + ".alone")
    if ranks == 1:
        got.tofile(file)
        with open(file + ".shape", "w", encoding="utf-8") as out:
            out.write(" ".join(map(str, (extent[0], extent[2]) + got.shape)))
        return got
    with open(file + ".shape", encoding="utf-8") as shape:
        left, bottom, rows, columns, components = map(int, shape.read().split())
    whole = np.fromfile(file, np.float32).reshape(rows, columns, components)
    x0, x1, y0, y1 = extent[:4]
    assert got.shape[0] * got.shape[1] < rows * columns, f"{name} was not cut up"
    check_equal(got, whole[y0 - bottom:y1 - bottom + 1, x0 - left:x1 - left + 1],
                f"{name}, process {rank} of {ranks}")
    return got


# A file that its reader gives to one process alone.
source = heights()
settings = dict(LIGHTS, **cases()["base"])
got = piece(shade(source, settings))[1]
if got is not None:
    check_equal(got, reference("base"), f"file, process {rank} of {ranks}")
else:
    assert rank > 0, "the first process has nothing of the file"

# A source that is cut up, of points and of cells, whose pieces meet.
wavelet = pv.Wavelet(WholeExtent=[-60, 60, -40, 40, 0, 0])
relief = pv.ReliefShading(Input=wavelet, Output="Float linear", HeightScale=0.15, SunAltitude=15,
                          SunAzimuth=90)
got = check(relief, "points")
of_cells = pv.ReliefShading(Input=pv.PointDatatoCellData(Input=wavelet), Output="Float linear",
                            HeightScale=0.15, SunAltitude=15, SunAzimuth=0)
check(of_cells, "cells")

# Light that has moved, of heights that have not.
relief.SunAzimuth = 50
moved = piece(relief)[1]
relief.SunAzimuth = 90
check_equal(piece(relief)[1], got, "the sun moved and back")
assert not (moved == got).all(), "a moved sun changes nothing"

# A scale that all processes choose alike.
relief.FitHeightScale = 1
check(relief, "fitted")
print("passed" if rank == 0 else "")
