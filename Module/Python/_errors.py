# SPDX-License-Identifier: BSD-3-Clause
"""Errors of VTK's classes as Python's exceptions, and updates during which other threads run."""

import contextlib
import os
import re
import sys
import threading
import warnings

from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from . import _pipeline


class ReliefWarning(UserWarning):
    """What VTK's classes warn of."""


class Heard:
    """What objects of VTK have told while they were listened to."""

    def __init__(self):
        self.errors = []
        self.warnings = []
        self.of_pipeline = []

    @property
    def failed(self):
        return bool(self.errors or self.of_pipeline)

    def warn(self):
        """Passes the warnings on, as those of the line that called the package."""
        level, frame = 1, sys._getframe()
        while frame and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
            level, frame = level + 1, frame.f_back
        for text in self.warnings:
            warnings.warn(text, ReliefWarning, stacklevel=level)

    def error(self, kind=RuntimeError):
        """The first error as an exception: what the pipeline adds says less."""
        text = (self.errors or self.of_pipeline)[0]
        return MemoryError(text) if "not enough memory" in text else kind(text)


def plain(text):
    """The message of an event, without the line of the source and the object's address."""
    text = re.sub(r"\A(ERROR|Warning): In .*?, line \d+\s*", "", text.strip())
    text = re.sub(r"\A\w+ ?\((0x)?[0-9a-fA-F]+\): ?", "", text)
    return text.strip()


@contextlib.contextmanager
def listening(*objects):
    """Hears the errors and warnings of objects of VTK, which then print nothing."""
    heard = Heard()
    observed = []

    def listen(instance, errors):
        def hear(_, event, text):
            (heard.warnings if event == "WarningEvent" else errors).append(plain(text))

        hear.CallDataType = "string0"
        for event in ("ErrorEvent", "WarningEvent"):
            observed.append((instance, instance.AddObserver(event, hear)))

    try:
        for instance in objects:
            if instance is not None:
                executive = instance.IsA("vtkExecutive")
                listen(instance, heard.of_pipeline if executive else heard.errors)
        yield heard
    finally:
        for instance, tag in observed:
            instance.RemoveObserver(tag)


def parts_of(instance):
    """An algorithm, all that it gets its data from, their pipelines, and what they are set by."""
    parts, waiting = [], [instance]
    while waiting:
        one = waiting.pop(0)
        if any(one is part for part in parts):
            continue
        parts.append(one)
        scene = getattr(one, "GetScene", lambda: None)()
        if scene is not None and scene.IsA("vtkReliefScene"):
            parts += [scene, scene.GetMaterial(), scene.GetEnvironment()]
        if one.IsA("vtkAlgorithm"):
            parts.append(one.GetExecutive())
            for port in range(one.GetNumberOfInputPorts()):
                for index in range(one.GetNumberOfInputConnections(port)):
                    waiting.append(one.GetInputAlgorithm(port, index))
    return parts


def update(algorithm):
    """Updates an algorithm of VTK; other threads of Python run meanwhile, and Ctrl+C ends it.

    They do not where a part of the pipeline is written in Python itself. Raises RuntimeError with the
    message of whatever failed, here or before in the pipeline, or MemoryError. Warnings become a
    ReliefWarning. Nothing is printed.
    """
    if not isinstance(algorithm, vtkAlgorithm):
        raise TypeError(f"a vtkAlgorithm is expected, not {type(algorithm).__name__}")
    checked(algorithm, run, algorithm)


def run(algorithm):
    """Update() without the interpreter's lock, where that may be."""
    if has_python(algorithm):
        vtkAlgorithm.GetExecutive(algorithm).Update()
    else:
        _pipeline.update(algorithm)


def write(writer, original=None):
    """Write() of an image writer without the interpreter's lock, where that may be. What is original is
    called where not."""
    if has_python(writer):
        (original or type(writer).Write)(writer)
    else:
        _pipeline.write(writer)


def has_python(algorithm):
    """Whether parts of a pipeline are written in Python: VTK calls those without taking the lock."""
    return any(part is not None and (part.IsA("vtkPythonAlgorithm")
                                     or part.GetClassName().startswith("vtkProgrammable"))
               for part in parts_of(algorithm))


def checked(instance, function, *arguments):
    """Calls a function; raises what it lets an object of VTK, or what that depends on, report."""
    with listening(*parts_of(instance)) as heard:
        result = function(*arguments)
    if heard.failed:
        raise heard.error()
    heard.warn()
    return result


# ------------------------------------------------------------------------------
# Methods of the classes that raise what would be printed.

METHODS = ("Update", "UpdateWholeExtent", "UpdateInformation", "UpdateExtent", "Write", "Read")
_lock = threading.RLock()
_wishes = 0
_replaced = []


class raise_errors:  # noqa: N801  it is used as a function
    """Lets updates and files of the package's classes raise their errors instead of printing them.

        with reliefshading.raise_errors():
            shading.Update()

    From this call on, Update(), UpdateWholeExtent(), UpdateExtent(), UpdateInformation(), Write() and
    Read() of all classes of the package raise a RuntimeError (or MemoryError) with the first error of
    the object or of whatever comes before it in its pipeline; warnings become a ReliefWarning. As a
    context it ends with its block, else with stop(). It holds for all threads, and for objects that
    were made before. To enter it again begins anew. During Update(), and Write() of images, other
    threads run, as with reliefshading.update().
    """

    def __init__(self):
        self._active, self._depth = False, 0
        self._begin()

    def _begin(self):
        global _wishes
        with _lock:
            if self._active:
                return
            self._active = True
            _wishes += 1
            if _wishes == 1:
                for name, module in list(sys.modules.items()):
                    if name.startswith(__package__ + ".vtk"):
                        _let_raise(module)

    def stop(self):
        """Leaves errors to VTK again, unless another raise_errors() is in force."""
        global _wishes
        with _lock:
            if not self._active:
                return
            self._active = False
            _wishes -= 1
            while not _wishes and _replaced:
                _pipeline.set_method(*_replaced.pop())

    def __enter__(self):
        with _lock:
            self._depth += 1
            self._begin()
        return self

    def __exit__(self, *_):
        with _lock:
            self._depth -= 1
            if not self._depth:
                self.stop()


def module_is_loaded(module):
    """Told by the package of each library that is loaded."""
    with _lock:
        if _wishes:
            _let_raise(module)


def _let_raise(module):
    for kind in list(vars(module).values()):
        if isinstance(kind, type) and kind.__module__ == module.__name__:
            for name in METHODS:
                if hasattr(kind, name) and (kind, name) not in [old[:2] for old in _replaced]:
                    _replaced.append((kind, name, vars(kind).get(name)))
                    _pipeline.set_method(kind, name, _raising(kind, name))


def _raising(kind, name):
    original = getattr(kind, name)
    text = original.__doc__ or ""

    def method(self, *arguments):
        if name == "Update" and not arguments:
            return checked(self, run, self)
        if name == "Write" and not arguments and self.IsA("vtkImageWriter"):
            return checked(self, write, self, original)
        return checked(self, original, self, *arguments)

    def of_class(*arguments):
        """What it works on is among its arguments."""
        told = [argument for argument in arguments if isinstance(argument, vtkObject)]
        if not told:
            return original(*arguments)
        return checked(told[0], original, *arguments)

    result = method if text.startswith(name + "(self") else of_class
    result.__name__ = name
    result.__doc__ = text
    return result if result is method else staticmethod(result)
