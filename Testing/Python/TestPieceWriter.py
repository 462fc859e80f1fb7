# SPDX-License-Identifier: BSD-3-Clause
"""Pictures are written piece by piece, bit for bit as at once, by one process and by many, which go on
where they were.

With "kill" or "count" as its first argument, this is one of the processes.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import reliefshading
from reliefshading import (vtkImageReliefShading, vtkReliefPieceWriter, vtkReliefRasterReader,
                           vtkReliefRasterWriter, vtkReliefVerification)
from reliefshading._errors import listening
from vtkmodules.util.vtkConstants import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TERRAIN = os.path.join(ROOT, "Examples", "Data", "jacksboro.tif")
EXAMPLE = os.path.join(ROOT, "Examples", "Python", "ShadePieces.py")

MPIRUN = shutil.which("mpirun")
HAS_MPI = bool(MPIRUN and importlib.util.find_spec("mpi4py"))

ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe")  # Open MPI 5


def run(processes, *command):
    return subprocess.run([MPIRUN, "-np", str(processes), sys.executable, *command],
                          env=ENVIRONMENT, capture_output=True, text=True, timeout=400)


@unittest.skipUnless(HAS_MPI, "mpirun or mpi4py is not installed")
class TestManyProcesses(unittest.TestCase):
    def setUp(self):
        works = subprocess.run([MPIRUN, "-np", "2", "true"], env=ENVIRONMENT, capture_output=True)
        if works.returncode != 0:
            self.skipTest("mpirun starts nothing here")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def whole(self, name, raster=TERRAIN):
        """The file that a run without pieces writes."""
        heights = vtkReliefRasterReader()
        heights.SetFileName(raster)
        shading = vtkImageReliefShading()
        shading.SetInputConnection(heights.GetOutputPort())
        shading.SetMaskConnection(heights.GetMaskOutputPort())
        shading.GetScene().AddSun(315.0, 30.0)
        writer = vtkReliefRasterWriter()
        writer.SetInputConnection(shading.GetOutputPort())
        writer.SetFileName(os.path.join(self.folder.name, name))
        writer.Write()
        with open(os.path.join(self.folder.name, name), "rb") as file:
            return file.read()

    def heights(self):
        """A copy of the terrain, beside which its bounds can be kept."""
        return shutil.copy(TERRAIN, self.folder.name)

    def pieces(self, picture):
        folder = picture + ".parts"
        return sorted(n for n in os.listdir(folder) if n[0].isdigit()) if os.path.isdir(folder) else []

    def test_example(self):
        raster, whole = self.heights(), self.whole("whole.tif")
        for processes in (1, 2, 4):
            picture = os.path.join(self.folder.name, f"relief{processes}.tif")
            done = run(processes, EXAMPLE, raster, picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            # Open MPI may have something to say of the machine's network.
            self.assertNotRegex(done.stderr, "ERR:|ERROR:|Warn:|Traceback")
            with open(picture, "rb") as file:
                self.assertEqual(file.read(), whole, processes)
            self.assertFalse(os.path.exists(picture + ".parts"))

    def test_one_killed(self):
        """Nothing is under the file's name, and the run goes on with another number of processes."""
        raster, picture = self.heights(), os.path.join(self.folder.name, "relief.tif")
        whole = self.whole("whole.tif")
        process = subprocess.Popen(
            [MPIRUN, "-np", "2", sys.executable, os.path.abspath(__file__), "kill", raster, picture],
            env=ENVIRONMENT, stderr=subprocess.PIPE, text=True)
        said = process.communicate(timeout=300)[1]
        self.assertNotEqual(process.returncode, 0)
        self.assertNotIn("Traceback", said)
        self.assertEqual(len(re.findall(r"on\s+signal 9", said)), 1, said)  # mpirun tells it, in lines as it likes
        left = self.pieces(picture)
        self.assertTrue(left)
        self.assertFalse(os.path.exists(picture))
        for processes in (3, 1):
            done = run(processes, os.path.abspath(__file__), "count", raster, picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            shaded, total = map(int, done.stdout.split())
            self.assertEqual(shaded, total - len(left))
            with open(picture, "rb") as file:
                self.assertEqual(file.read(), whole)
            left = []

    def test_changed_settings(self):
        raster, picture = self.heights(), os.path.join(self.folder.name, "relief.tif")
        run(2, os.path.abspath(__file__), "kill", raster, picture)
        self.assertTrue(self.pieces(picture))
        for words, what in ((("lower",), "light"), (("bytes",), "numbers")):
            done = run(2, os.path.abspath(__file__), "count", raster, picture, *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(re.findall("^RuntimeError: ", done.stderr, re.MULTILINE)), 1, done.stderr)
            self.assertEqual(done.stderr.count("Traceback"), 1, done.stderr)
            self.assertIn("another run", done.stderr)
            self.assertIn(what, done.stderr)
        self.assertFalse(os.path.exists(picture))

    def test_one_error(self):
        done = run(3, EXAMPLE, "nowhere.tif", os.path.join(self.folder.name, "o.tif"))
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("Traceback"), 1, done.stderr)
        self.assertIn("does not exist", done.stderr)


class TestOneProcess(unittest.TestCase):
    """What the writer does needs no MPI."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.raster = shutil.copy(TERRAIN, self.folder.name)
        self.picture = os.path.join(self.folder.name, "relief.tif")

    def shading(self, needed=True):
        heights = vtkReliefRasterReader()
        heights.SetFileName(self.raster)
        heights.SetReadAsNeeded(needed)
        shading = vtkImageReliefShading()
        shading.SetInputConnection(heights.GetOutputPort())
        if not needed:  # else what has no data is NaN
            shading.SetMaskConnection(heights.GetMaskOutputPort())
        shading.GetScene().AddSun(300.0, 20.0)
        return shading

    def read(self, name):
        with open(os.path.join(self.folder.name, name), "rb") as file:
            return file.read()

    def test_layers_and_memory(self):
        shading = self.shading(False)
        shading.GenerateIlluminationOn()
        shading.GenerateNormalsOn()
        for name, array in (("w.tif", None), ("w-illumination.tif", "Illumination"), ("w-normals.tif", "Normals")):
            writer = vtkReliefRasterWriter()
            writer.SetInputConnection(shading.GetOutputPort())
            writer.SetFileName(os.path.join(self.folder.name, name))
            writer.SetArrayName(array)
            writer.Write()
        counts = []
        for needed, memory in ((True, None), (True, 6 << 20), (False, None)):
            pieces = self.shading(needed)
            pieces.GenerateIlluminationOn()
            pieces.GenerateNormalsOn()
            counts.append(reliefshading.shade_pieces(pieces, self.picture, memory=memory))
            for layer in ("", "-illumination", "-normals"):
                self.assertEqual(self.read(f"relief{layer}.tif"), self.read(f"w{layer}.tif"), (memory, layer))
            self.assertFalse(os.path.exists(self.picture + ".parts"))
        self.assertGreater(min(counts), 1)

    def test_steps(self):
        writer = vtkReliefPieceWriter()
        writer.SetShading(self.shading())
        writer.SetFileName(self.picture)
        self.assertTrue(writer.Begin() and writer.Shade())
        self.assertEqual(writer.GetNumberOfShadedPieces(), writer.GetNumberOfPieces())
        # A piece that is damaged is told, and shaded again; others are not.
        folder = os.path.join(self.picture + ".parts")
        piece = os.path.join(folder, sorted(n for n in os.listdir(folder) if n[0].isdigit())[1], "Shading.tif")
        with open(piece, "r+b") as file:
            file.seek(os.path.getsize(piece) // 2)
            file.write(b"damage")
        with reliefshading.raise_errors(), self.assertWarnsRegex(reliefshading.ReliefWarning, "shaded again"):
            self.assertEqual(reliefshading.shade_pieces(writer.GetShading(), self.picture + "2.tif"),
                             writer.GetNumberOfPieces())
            with listening(writer) as heard:
                self.assertTrue(writer.Finish())
            heard.warn()
        self.assertEqual(self.read("relief.tif"), self.read("relief.tif2.tif"))

    def test_what_changes_is_told(self):
        def begin(change=lambda shading: None):
            writer = vtkReliefPieceWriter()
            writer.SetShading(self.shading())
            writer.SetFileName(self.picture)
            change(writer.GetShading())
            with listening(writer) as heard:
                return writer, writer.Begin(), "".join(heard.errors)

        writer, good, _ = begin()
        self.assertTrue(good and writer.Shade())
        del writer
        table = vtkLookupTable()
        table.SetRange(200, 1000)
        table.Build()
        image = vtkImageData()
        image.SetDimensions(2, 2, 1)
        image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
        image.GetPointData().GetScalars().Fill(7)
        for what, change in (
                ("light", lambda s: s.GetScene().AddSun(10, 20)),
                ("material", lambda s: s.GetScene().GetMaterial().SetSpecularCoefficient(0.3)),
                ("scene", lambda s: s.GetScene().SetHeightScale(2)),
                ("numbers", lambda s: s.SetOutputScalarTypeToUnsignedChar()),
                ("arrays", lambda s: s.GenerateNormalsOn()),
                ("table", lambda s: s.SetLookupTable(table)),
                ("diffuse", lambda s: s.SetDiffuseTextureData(image)),
                ("textures", lambda s: s.StretchTexturesOn())):
            _, good, said = begin(change)
            self.assertFalse(good, what)
            self.assertIn("another run", said)
            self.assertIn('"' + what, said)
            self.assertLessEqual(len(said), 330)
        writer, good, _ = begin()
        self.assertTrue(good and writer.Shade())
        self.assertEqual(writer.GetNumberOfShadedPieces(), 0)

    def test_verification(self):
        """Of heights that are read as needed the same samples are retraced, with the same results."""
        tables = []
        for needed in (False, True):
            shading = self.shading(needed)
            shading.GenerateIlluminationOn()
            verification = vtkReliefVerification()
            verification.SetShading(shading)
            verification.SetNumberOfSamples(300)
            verification.SetSeed(4)
            reliefshading.update(verification)
            self.assertTrue(verification.GetKept())
            self.assertEqual(verification.GetNumberOfRetracedSamples(), 300)
            table = verification.GetOutput()
            tables.append([[table.GetColumn(c).GetValue(k) for c in range(table.GetNumberOfColumns())]
                           for k in range(table.GetNumberOfRows())])
        self.assertEqual(tables[0], tables[1])

    def test_bad_input(self):
        for file, shading, said in ((None, True, "no file name"), ("a.png", True, "GeoTIFF"),
                                    (self.picture, False, "no shading"),
                                    (os.path.join(self.folder.name, "no", "o.tif"), True, "cannot be made")):
            writer = vtkReliefPieceWriter()
            writer.SetFileName(file)
            writer.SetShading(self.shading() if shading else None)
            with listening(writer) as heard:
                self.assertFalse(writer.Write())
            self.assertEqual(len(heard.errors), 1)
            self.assertIn(said, heard.errors[0])
            self.assertNotEqual(writer.GetErrorCode(), 0)
        with self.assertRaisesRegex(RuntimeError, "MemoryLimit.*give at least"):
            reliefshading.shade_pieces(self.shading(), self.picture, memory=4096)
        with self.assertRaisesRegex(ValueError, "memory: 1000 was given, .* at least 1024"):
            reliefshading.shade_pieces(self.shading(), self.picture, memory=1000)
        writer = vtkReliefPieceWriter()
        with listening(writer) as heard:
            writer.SetProcess(2, 2)
            writer.Shade()
        self.assertEqual(len(heard.errors), 2)
        self.assertEqual(os.listdir(self.folder.name).count("relief.tif.parts"), 0)


def work_on(task, raster, picture, change=None):
    """One of the processes of a run; of "kill" the last is killed when it has shaded some pieces."""
    import signal

    from mpi4py import MPI
    heights = vtkReliefRasterReader()
    heights.SetFileName(raster)
    heights.ReadAsNeededOn()
    shading = vtkImageReliefShading()
    shading.SetInputConnection(heights.GetOutputPort())
    shading.GetScene().AddSun(315.0, 20.0 if change == "lower" else 30.0)
    if change == "bytes":
        shading.SetOutputScalarTypeToUnsignedChar()
    if task == "kill" and MPI.COMM_WORLD.Get_rank() == 1:
        def die(*_):
            if len([n for n in os.listdir(picture + ".parts") if n[0].isdigit()]) > 2:
                os.kill(os.getpid(), signal.SIGKILL)
        shading.AddObserver("EndEvent", die)
    shaded = reliefshading.shade_pieces(shading, picture, MPI.COMM_WORLD, memory=66 << 20)
    sum_ = MPI.COMM_WORLD.allreduce(shaded)
    if task == "count" and MPI.COMM_WORLD.Get_rank() == 0:
        print(sum_, (344 + 63) // 64)


if __name__ == "__main__":
    if len(sys.argv) > 1 and sys.argv[1] in ("kill", "count"):
        work_on(*sys.argv[1:])
    else:
        unittest.main()
