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
