# SPDX-License-Identifier: BSD-3-Clause
"""Shades a raster of any size on many processes, bit for bit as one would.

    mpirun -np 4 python3 ShadePieces.py heights.tif relief.tif

Where it was stopped, the same command goes on.
"""

import sys

from mpi4py import MPI
from reliefshading import shade_pieces, vtkImageReliefShading, vtkReliefRasterReader

heights = vtkReliefRasterReader()
heights.SetFileName(sys.argv[1])
heights.ReadAsNeededOn()
shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
shading.GetScene().AddSun(315.0, 30.0)
shade_pieces(shading, sys.argv[2], MPI.COMM_WORLD)
