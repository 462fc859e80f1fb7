# SPDX-License-Identifier: BSD-3-Clause
"""Failed updates and files raise, other threads run during an update, and Ctrl+C ends it."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import reliefshading
from reliefshading import Relief, ReliefWarning, raise_errors, update, vtkImageReliefShading
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersProgrammable import vtkProgrammableFilter
from vtkmodules.vtkRenderingCore import vtkLight


def image(rows=20, columns=30, components=1):
    result = vtkImageData()
    result.SetDimensions(columns, rows, 1)
    values = np.sin(np.arange(rows * columns * components, dtype=np.float32)).reshape(-1, components)
    result.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    return result


def shading_of(data):
    shading = vtkImageReliefShading()
    shading.SetInputData(data)
    return shading


def long_work():
    """A picture that takes a while: many suns that stand low."""
    shading = shading_of(image(400, 400))
    for azimuth in range(0, 360, 10):
        shading.GetScene().AddSun(azimuth, 2.0)
    return shading


class Source(VTKPythonAlgorithmBase):
    """A source that is written in Python."""

    def __init__(self, components=1):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkImageData")
        self.components = components

    def RequestInformation(self, _, __, outputs):
        outputs.GetInformationObject(0).Set(
            vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), (0, 29, 0, 19, 0, 0), 6)
        return 1

    def RequestData(self, _, __, outputs):
        vtkImageData.GetData(outputs, 0).ShallowCopy(image(components=self.components))
        return 1


class TestErrors(unittest.TestCase):
    def test_update(self):
        shading = shading_of(image())
        update(shading)
        self.assertEqual(shading.GetOutput().GetNumberOfPoints(), 600)
        with self.assertRaisesRegex(RuntimeError, r"\Athe height image has 2 components, 1 is expected"):
            update(shading_of(image(components=2)))
        with self.assertRaisesRegex(RuntimeError, "no scalars"):
            empty = vtkImageData()
            empty.SetDimensions(3, 3, 1)
            update(shading_of(empty))
        with self.assertRaises(RuntimeError):
            update(vtkImageReliefShading())
        with self.assertRaises(TypeError):
            update(vtkLight())
        with self.assertRaises(TypeError):
            update(3)
        with self.assertWarnsRegex(ReliefWarning, "No sample has data"):
            nothing = image()
            nothing.GetPointData().GetScalars().Fill(float("nan"))
            update(shading_of(nothing))

    def test_an_error_before_in_the_pipeline(self):
        last = shading_of(image())
        before = shading_of(image(components=2))
        last.SetMaskConnection(before.GetOutputPort())
        with self.assertRaisesRegex(RuntimeError, "2 components"):
            update(last)

    def test_sources_in_python(self):
        """Which run only with the interpreter's lock."""
        programmable = vtkProgrammableFilter()
        programmable.SetInputData(image())
        programmable.SetExecuteMethod(
            lambda: programmable.GetOutput().ShallowCopy(programmable.GetInput()))
        for source in (Source(), programmable):
            shading = vtkImageReliefShading()
            shading.SetInputConnection(source.GetOutputPort())
            update(shading)
            self.assertEqual(shading.GetOutput().GetNumberOfPoints(), 600)
            with raise_errors():
                source.Modified()
                shading.Update()
        shading.SetInputConnection((source := Source(2)).GetOutputPort())
        with self.assertRaisesRegex(RuntimeError, "2 components"):
            update(shading)

    def test_observers_of_others_stay(self):
        shading, heard = shading_of(image(components=2)), []
        shading.AddObserver("ErrorEvent", lambda *_: heard.append(1))
        with self.assertRaises(RuntimeError):
            update(shading)
        self.assertEqual(len(heard), 1)
        shading.Modified()
        shading.Update()
        self.assertEqual(len(heard), 2)

    def test_raise_errors(self):
        shading = shading_of(image(components=2))
        shading.AddObserver("ErrorEvent", lambda *_: None)  # keeps it quiet
        shading.Update()
        with raise_errors():
            shading.Modified()
            for name in ("Update", "UpdateWholeExtent"):
                with self.assertRaisesRegex(RuntimeError, "2 components"):
                    shading.Modified()
                    getattr(shading, name)()
            with self.assertRaisesRegex(RuntimeError, "2 components"):
                shading.Modified()
                shading.UpdateExtent((0, 3, 0, 3, 0, 0))
            shading_of(image()).Update()
        shading.Modified()
        shading.Update()

    def test_raise_errors_until_it_is_stopped(self):
        shading = shading_of(image(components=2))
        shading.AddObserver("ErrorEvent", lambda *_: None)
        original = vtkImageReliefShading.Update.__doc__
        outer = raise_errors()
        with raise_errors():
            self.assertEqual(vtkImageReliefShading.Update.__doc__, original)
        with self.assertRaises(RuntimeError):
            shading.Update()
        outer.stop()
        outer.stop()
        shading.Modified()
        shading.Update()

    def test_raise_errors_again(self):
        shading = shading_of(image(components=2))
        shading.AddObserver("ErrorEvent", lambda *_: None)

        def raises():
            shading.Modified()
            try:
                shading.Update()
            except RuntimeError:
                return True
            return False

        errors = raise_errors()
        errors.stop()
        for _ in range(3):
            self.assertFalse(raises())
            with errors as entered:
                self.assertIs(entered, errors)
                self.assertTrue(raises())
                with errors:
                    self.assertTrue(raises())
                self.assertTrue(raises())
        self.assertFalse(raises())
        with errors:
            errors.stop()
            self.assertFalse(raises())
        self.assertFalse(raises())

    def test_raise_errors_in_classes_that_are_loaded_later(self):
        program = """if True:
            import reliefshading
            reliefshading.raise_errors()
            from reliefshading import vtkReliefStepSmoothing
            try:
                vtkReliefStepSmoothing().Update()
            except RuntimeError:
                print("raised")
        """
        result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.stdout, result.stderr), ("raised\n", ""))

    @unittest.skipUnless("vtkOpenImageIOWriter" in reliefshading.__all__, "no files in this build")
    def test_raise_errors_of_files(self):
        from reliefshading import vtkOpenImageIOReader, vtkOpenImageIOWriter, vtkReliefSceneFile
        with tempfile.TemporaryDirectory() as folder, raise_errors():
            name = os.path.join(folder, "heights.tif")
            writer = vtkOpenImageIOWriter()
            writer.SetInputData(image())
            writer.SetFileName(name)
            writer.Write()
            self.assertTrue(os.path.exists(name))
            writer.SetFileName(os.path.join(folder, "none", "heights.tif"))
            with self.assertRaisesRegex(RuntimeError, "none"):
                writer.Write()
            reader = vtkOpenImageIOReader()
            reader.SetFileName(os.path.join(folder, "missing.tif"))
            with self.assertRaisesRegex(RuntimeError, "missing.tif"):
                reader.Update()
            environment = reliefshading.vtkReliefEnvironment()
            with self.assertRaisesRegex(RuntimeError, "missing.exr"):
                reliefshading.vtkReliefEnvironmentImage.Read(
                    environment, os.path.join(folder, "missing.exr"))
            scene = vtkReliefSceneFile()
            scene.SetFileName(os.path.join(folder, "missing.json"))
            with self.assertRaisesRegex(RuntimeError, "missing.json"):
                scene.Read()


def longest_wait(work):
    """The longest time that another thread had to wait during some work, as a share of the work's."""
    times, ended = [], threading.Event()

    def tick():
        while not ended.is_set():
            times.append(time.perf_counter())
            time.sleep(0.001)  # takes the interpreter's lock again

    thread = threading.Thread(target=tick)
    thread.start()
    while len(times) < 3:
        time.sleep(0.001)
    begin = time.perf_counter()
    work()
    end = time.perf_counter()
    ended.set()
    thread.join()
    times = [begin, *(at for at in times if begin < at < end), end]
    return max(b - a for a, b in zip(times, times[1:])) / (end - begin)


class TestThreads(unittest.TestCase):
    def test_other_threads_run(self):
        """A thread that waits for the update's begin gets on before its end."""
        started, seen, at_end = threading.Event(), threading.Event(), []

        def other():
            if started.wait(60):
                for _ in range(20):
                    time.sleep(0.001)  # takes the interpreter's lock again
                seen.set()

        thread = threading.Thread(target=other)
        thread.start()
        shading = long_work()
        shading.AddObserver("StartEvent", lambda *_: started.set())
        shading.AddObserver("EndEvent", lambda *_: at_end.append(seen.is_set()))
        update(shading)
        thread.join()
        self.assertEqual(at_end, [True])

    def test_other_threads_run_while_files_are_written(self):
        noise = np.random.default_rng(3).normal(size=(1500, 1500))
        picture = reliefshading.shade(noise, layers="normals")
        with tempfile.TemporaryDirectory() as folder:
            for extension in ("png", "tif"):
                name = os.path.join(folder, "picture." + extension)
                with self.subTest(extension):
                    self.assertLess(longest_wait(lambda name=name: picture.save(name)), 0.5)
                    self.assertGreater(os.path.getsize(name), 1e6)
            if "vtkOpenImageIOWriter" not in reliefshading.__all__:
                return
            for kind in ("vtkOpenImageIOWriter", "vtkOpenEXRLayerWriter", "vtkReliefRasterWriter"):
                if kind not in reliefshading.__all__:
                    continue
                shading = vtkImageReliefShading()
                shading.SetInputData(image(1500, 1500))
                shading.Update()
                writer = getattr(reliefshading, kind)()
                writer.SetInputData(shading.GetOutput())
                name = os.path.join(folder, "written." + ("tif" if "Raster" in kind else "exr"))
                writer.SetFileName(name)
                with self.subTest(kind), raise_errors():
                    self.assertLess(longest_wait(writer.Write), 0.5)
                    self.assertGreater(os.path.getsize(name), 1e6)

    def test_other_threads_run_while_a_height_scale_is_found(self):
        heights = reliefshading.Relief(np.random.default_rng(3).normal(size=(3000, 3000))).filter.GetInput()
        scene, fits = reliefshading.vtkReliefScene(), []
        self.assertLess(longest_wait(lambda: fits.append(
            reliefshading._errors._pipeline.fit_height_scale(scene, heights))), 0.5)
        self.assertEqual(fits, [scene.GetHeightScale()])
        self.assertEqual(fits, [reliefshading.vtkReliefScene().FitHeightScale(heights)])

    @unittest.skipUnless("vtkOpenImageIOWriter" in reliefshading.__all__, "no files in this build")
    def test_a_writer_after_python(self):
        """Where a part of the pipeline is written in Python, the lock stays."""
        source = Source(3)
        writer = reliefshading.vtkOpenImageIOWriter()
        writer.SetInputConnection(source.GetOutputPort())
        with tempfile.TemporaryDirectory() as folder, raise_errors():
            writer.SetFileName(os.path.join(folder, "made.exr"))
            writer.Write()
            self.assertTrue(os.path.exists(writer.GetFileName()))
            with self.assertRaisesRegex(RuntimeError, "none"):
                writer.SetFileName(os.path.join(folder, "none", "made.exr"))
                writer.Write()

    @unittest.skipUnless("vtkOpenImageIOWriter" in reliefshading.__all__, "no files in this build")
    def test_ctrl_c_ends_writing(self):
        """What was there stays."""
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        picture = reliefshading.shade(np.random.default_rng(3).normal(size=(3000, 3000)), dtype="float32")
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "picture.exr")
            reliefshading.shade(np.zeros((3, 4)), dtype="float32").save(name)
            with open(name, "rb") as file:
                before = file.read()
            thread = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            thread.start()
            with self.assertRaises(KeyboardInterrupt):
                picture.save(name)
            thread.join()
            with open(name, "rb") as file:
                self.assertEqual(file.read(), before)
            self.assertEqual(os.listdir(folder), ["picture.exr"])

    def test_pictures_in_threads(self):
        heights = np.sin(np.arange(20000.0)).reshape(100, 200)
        expected = [reliefshading.shade(heights, sun=(k, 40)).image for k in range(8)]
        shared = Relief(heights)
        for shade in (lambda k: reliefshading.shade(heights, sun=(k, 40)),
                      lambda k: shared.shade(sun=(k, 40))):
            got = {}
            threads = [threading.Thread(target=lambda k=k: got.setdefault(k, shade(k).image))
                       for k in range(8)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            for k in range(8):
                np.testing.assert_array_equal(got[k], expected[k])

    def test_ctrl_c(self):
        # A process that was started in the background of a shell ignores the signal.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        started = threading.Event()

        def press():
            if started.wait(60):
                os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=press)
        thread.start()
        shading = long_work()
        shading.AddObserver("StartEvent", lambda *_: started.set())
        with self.assertRaises(KeyboardInterrupt):
            update(shading)
        thread.join()
        self.assertEqual(shading.GetOutput().GetNumberOfPoints(), 0)
        # The next one begins anew.
        shading.GetScene().RemoveAllLights()
        update(shading)
        self.assertEqual(shading.GetOutput().GetNumberOfPoints(), 160000)


if __name__ == "__main__":
    unittest.main()
