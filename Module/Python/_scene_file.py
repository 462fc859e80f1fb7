# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as files."""

import os

from vtkmodules.vtkCommonMisc import vtkErrorCode

from . import vtkReliefScene
from ._errors import listening
from ._keywords import brief, shown


def _file(file_name):
    import reliefshading
    if "vtkReliefSceneFile" not in reliefshading.__all__:
        raise RuntimeError("this build of the package was made without scene files")
    try:
        name = os.fsencode(file_name)
    except TypeError:
        raise TypeError(f"a scene file's name is expected, not {shown(file_name)}") from None
    if not name or b"\0" in name:
        raise ValueError(f"a scene file's name is expected, not {shown(file_name)}")
    file = reliefshading.vtkReliefSceneFile()
    file.SetFileName(name)
    return file


def _call(file, function, content):
    """Calls Read or Write; content is the kind of what is wrong in a file or a scene."""
    with listening(file) as heard:
        function()
    if heard.failed:
        heard.errors = [brief(text, 180) for text in heard.errors]
        codes = (vtkErrorCode.CannotOpenFileError, vtkErrorCode.OutOfDiskSpaceError)
        if file.GetErrorCode() == vtkErrorCode.FileNotFoundError:
            raise heard.error(FileNotFoundError)
        raise heard.error(OSError if file.GetErrorCode() in codes else content)
    heard.warn()


def read_scene(file_name):
    """A vtkReliefScene from a scene file, as write_scene() and the program reliefshade write it.

        picture = reliefshading.shade(heights, scene=reliefshading.read_scene("evening.json"))

    shade(heights, scene="evening.json") does the same. What the file does not name has its default; keys
    that are not known are a ReliefWarning. FileNotFoundError: there is no such file. OSError: it cannot
    be opened. ValueError: it is no scene, or a value is out of its range; the message tells line and key.
    """
    file = _file(file_name)
    _call(file, file.Read, ValueError)
    return file.GetScene()


def write_scene(scene, file_name):
    """Writes a vtkReliefScene, such as relief.scene of a Relief, into a scene file.

    All of it is in the file, to the last bit; an image of an environment by its file's name. The file
    appears whole or not at all. OSError: it cannot be written. ValueError: the scene cannot be named,
    as an environment whose image is an array.
    """
    if not isinstance(scene, vtkReliefScene):
        raise TypeError(f"scene: a vtkReliefScene is expected, not {type(scene).__name__}")
    file = _file(file_name)
    file.SetScene(scene)
    _call(file, file.Write, ValueError)
