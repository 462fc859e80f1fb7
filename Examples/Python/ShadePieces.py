# SPDX-License-Identifier: BSD-3-Clause
"""Shades a raster on many processes, each a piece of it, bit for bit as one would.

    mpirun -np 4 python3 ShadePieces.py heights.tif 0 1500 relief.pvti

0 and 1500 are the least and the greatest height, in metres: by them a piece asks for no more of the
raster than its light can touch. The picture is relief.pvti, over a file for each piece.
"""

import sys

from mpi4py import MPI  # begins MPI, which VTK joins, and ends it
from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.vtkIOParallelXML import vtkXMLPImageDataWriter
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController


def main():
    raster, least, greatest, picture = sys.argv[1:]
    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)

    heights = vtkReliefRasterReader()
    heights.SetFileName(raster)
    shading = vtkImageReliefShading()
    shading.SetInputConnection(heights.GetOutputPort())
    shading.SetMaskConnection(heights.GetOutputPort(1))
    shading.SetHeightRange(float(least), float(greatest))
    shading.GetScene().AddSun(315.0, 30.0)

    writer = vtkXMLPImageDataWriter()
    writer.SetInputConnection(shading.GetOutputPort())
    writer.SetNumberOfPieces(controller.GetNumberOfProcesses())
    writer.SetStartPiece(controller.GetLocalProcessId())
    writer.SetEndPiece(controller.GetLocalProcessId())
    writer.SetFileName(picture)
    if not writer.Write():
        MPI.COMM_WORLD.Abort(1)


if __name__ == "__main__":
    main()
