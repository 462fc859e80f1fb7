# SPDX-License-Identifier: BSD-3-Clause
"""Processes of MPI shade pieces of one picture, which are bit for bit those of one process.

With a folder as its argument, this is one of the processes.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

MPIRUN = shutil.which("mpirun")
HAS_MPI = bool(MPIRUN and importlib.util.find_spec("mpi4py")
               and importlib.util.find_spec("vtkmodules.vtkParallelMPI"))

SIZE = 900
GHOSTS = 2
RANGE = 8.0, 35.0


class Heights(VTKPythonAlgorithmBase):
    """Hills with a lake, of which only what is asked for is made."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.largest = 0

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        info.Set(Pipeline.WHOLE_EXTENT(), (0, SIZE - 1, 0, SIZE - 1, 0, 0), 6)
        info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        extent = [0] * 6
        info.Get(Pipeline.UPDATE_EXTENT(), extent)
        x, y = np.meshgrid(np.arange(extent[0], extent[1] + 1), np.arange(extent[2], extent[3] + 1))
        heights = np.floor(20.0 + 12.0 * np.sin(x / 17.0) * np.cos(y / 11.0)
                           + (x * 7 + y * 13) % 5).astype(np.float32)
        heights[np.hypot(x - 440.0, y - 460.0) < 25.0] = np.nan
        self.largest = max(self.largest, heights.size)
        image = self.GetOutputData(outputs, 0)
        image.SetExtent(extent)
        image.GetPointData().SetScalars(numpy_to_vtk(heights.ravel(), deep=True))
        return 1


def shade(source):
    shading = vtkImageReliefShading()
    shading.SetInputConnection(source.GetOutputPort())
    shading.GenerateIlluminationOn()
    shading.GenerateNormalsOn()
    shading.GetScene().AddSun(315.0, 40.0)
    return shading


def arrays(image):
    extent = image.GetExtent()
    shape = (extent[3] - extent[2] + 1, extent[1] - extent[0] + 1, -1)
    data = image.GetPointData()
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)).reshape(shape)
            for k in range(data.GetNumberOfArrays())}


def work(folder):
    """What one of the processes does."""
    from mpi4py import MPI  # noqa: F401 begins MPI
    from vtkmodules.vtkParallelMPI import vtkMPIController
    controller = vtkMPIController()
    controller.Initialize()
    process = controller.GetLocalProcessId()
    source = Heights()
    shading = shade(source)
    shading.SetHeightRange(*RANGE)
    shading.UpdatePiece(process, controller.GetNumberOfProcesses(), GHOSTS)
    picture = shading.GetOutput()
    np.savez(os.path.join(folder, f"piece{process}.npz"), extent=picture.GetExtent(),
             largest=source.largest, **arrays(picture))
    controller.Barrier()


ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe")  # Open MPI 5


def run(processes, *command):
    return subprocess.run([MPIRUN, "-np", str(processes), sys.executable, *command],
                          env=ENVIRONMENT, capture_output=True, text=True, timeout=400)


@unittest.skipUnless(HAS_MPI, "mpirun, mpi4py or VTK's MPI is not installed")
class TestPieces(unittest.TestCase):
    def setUp(self):
        works = subprocess.run([MPIRUN, "-np", "2", "true"], env=ENVIRONMENT, capture_output=True)
        if works.returncode != 0:
            self.skipTest("mpirun starts nothing here")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_ghosts(self):
        shading = shade(Heights())
        shading.Update()
        whole = arrays(shading.GetOutput())
        self.assertEqual(shading.GetInput().GetScalarRange(), RANGE)
        for processes in (1, 2, 4):
            done = run(processes, os.path.abspath(__file__), self.folder.name)
            self.assertEqual(done.returncode, 0, done.stderr)
            seen = np.zeros((SIZE, SIZE), int)
            for process in range(processes):
                piece = np.load(os.path.join(self.folder.name, f"piece{process}.npz"))
                e = piece["extent"]
                part = np.s_[e[2]:e[3] + 1, e[0]:e[1] + 1]
                seen[part] += 1
                for name, values in whole.items():
                    self.assertEqual(piece[name].tobytes(), values[part].tobytes(), name)
                if processes == 4:
                    # A quarter with its shadows, not all.
                    self.assertLess(piece["largest"], 0.6 * SIZE * SIZE)
            self.assertTrue((seen > 0).all())
            self.assertGreater((seen > 1).sum(), 2 * GHOSTS * SIZE - 1 if processes > 1 else -1)


if __name__ == "__main__":
    if len(sys.argv) == 2 and os.path.isdir(sys.argv[1]):
        work(sys.argv[1])
    else:
        unittest.main()
