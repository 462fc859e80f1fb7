# SPDX-License-Identifier: BSD-3-Clause
"""Runs the examples of this folder and makes a page of them, with what they print and show.

    make_page.py FOLDER [--only NAME ...]

Writes FOLDER/PyVista.md and FOLDER/NAME.jpg. An example is a text of three parts: a title and what it is about, in
the docstring; code; and comments that begin with a line "# %%", which are prose.
"""

import argparse
import contextlib
import io
import pathlib
import re
import sys

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkJPEGWriter

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = ("flat_picture", "two_views", "day_of_suns", "tint_and_layers", "filters")
INTRODUCTION = """# Gallery of PyVista

Reliefs in [PyVista](https://pyvista.org), by `reliefshading.pyvista`; [In Python](../Python.md#pyvista) is its reference. Each of these
is a script of [Examples/PyVista](../../Examples/PyVista) that opens a window when you run it. One command makes this page of them:

```console
cmake --build build --target pyvista-gallery
```

"""


def write(picture, path):
    """An array of (rows, columns, 3), the first row on top, as a JPEG file."""
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(np.ascontiguousarray(picture[::-1]).reshape(-1, picture.shape[2]), deep=True))
    writer = vtkJPEGWriter()
    writer.SetQuality(85)
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.Write()
    if writer.GetErrorCode():
        sys.exit(f"{path} cannot be written")


def run(path):
    """What a script prints, and the picture that it shows."""
    pictures, printed = [], io.StringIO()
    original = pv.Plotter.show

    def show(plotter, *_, **__):
        original(plotter, auto_close=False, interactive=False)
        pictures.append(plotter.screenshot(return_img=True)[..., :3])
        plotter.close()

    pv.OFF_SCREEN, off_screen = True, pv.OFF_SCREEN
    pv.Plotter.show = show
    try:
        with contextlib.redirect_stdout(printed):
            exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"),
                 {"__name__": "__main__", "__file__": str(path)})
    finally:
        pv.Plotter.show, pv.OFF_SCREEN = original, off_screen
    if len(pictures) != 1:
        sys.exit(f"{path.name} shows {len(pictures)} pictures, one is expected")
    return printed.getvalue(), pictures[0]


def text_of(path, printed):
    """The part of the page that a script makes."""
    source = path.read_text(encoding="utf-8")
    title, about, rest = re.fullmatch(r'(?s).*?"""(.*?)\n\n(.*?)\n"""\n(.*)', source).groups()
    # The picture comes before the code, as what one is to see.
    text = [f"## {title}", about, f"![{title}]({path.stem}.jpg)"]
    for part in re.split(r"(?m)^# %%\n", rest):
        comments = re.match(r"(?:#.*\n)*", part).group(0)
        prose = re.sub(r"(?m)^# ?", "", comments).strip()
        code = part[len(comments):].strip()
        text += [prose] if prose else []
        if code:
            text.append(f"<!-- not run: Testing/Python/TestPyVista.py runs the script -->\n```python\n{code}\n```")
    if printed:
        text.append(f"It prints\n\n```text\n{printed.strip()}\n```")
    text.append(f"The script is [{path.name}](../../Examples/PyVista/{path.name}).")
    return "\n\n".join(text) + "\n"


def main():
    parser = argparse.ArgumentParser(description="Make the gallery of PyVista.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", nargs="*", help="examples to run; others and the page are left alone")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    parts = []
    for name in arguments.only or EXAMPLES:
        path = HERE / f"{name}.py"
        printed, picture = run(path)
        write(picture, arguments.folder / f"{name}.jpg")
        parts.append(text_of(path, printed))
    if not arguments.only:
        (arguments.folder / "PyVista.md").write_text(INTRODUCTION + "\n".join(parts), encoding="utf-8")


if __name__ == "__main__":
    main()
