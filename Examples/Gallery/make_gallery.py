# SPDX-License-Identifier: BSD-3-Clause
"""Renders the gallery: a picture for each figure, and a page that says how each was made.

    make_gallery.py FOLDER [--width SAMPLES] [--carve PROGRAM] [--reliefshade PROGRAM] [--only NAME ...]

Carves the sculptures first (Examples/Gallery/carve.cxx), then writes FOLDER/NAME.jpg for each figure and
FOLDER/Gallery.md. A figure is a row of pictures, each SAMPLES wide.
"""

import argparse
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from reliefshading import vtkOpenImageIOReader

import commands
import figures
from stage import array_of, side_by_side, write

TERRAIN = pathlib.Path(__file__).resolve().parents[1] / "Data" / "jacksboro.tif"
INTRODUCTION = """# Gallery

What the model does, in the order of the figures of F. N. Pramananda Perumal's thesis, with shapes of our own: an owl and a rosette
that are [carved by a program](../../Examples/Gallery/Sculpture.cxx), a ball, and the mountains of `Examples/Data`. Below each picture is what
differs from a new `vtkReliefScene`, by the names of [scene files](../SceneFile.md). One command makes all of it:

```console
cmake --build build --target gallery
```

"""


def parse_arguments():
    parser = argparse.ArgumentParser(description="Render the gallery.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--width", type=int, default=280, help="of each picture, in samples; default: 280")
    parser.add_argument("--carve", default="build/bin/carve", help="default: build/bin/carve")
    parser.add_argument("--reliefshade", default="build/bin/reliefshade", help="default: build/bin/reliefshade")
    parser.add_argument("--only", nargs="*", help="figures to make; others and the page are left alone")
    return parser.parse_args()


def find_program(name):
    path = shutil.which(name)
    if not path:
        raise SystemExit(f"the program {name} was not found: build it, or say where it is")
    return str(pathlib.Path(path).resolve())


def carve(program, size, folder):
    for name in ("owl", "rosette"):
        for kind in ("tif", "ply"):
            subprocess.run([program, name, str(size), str(folder / f"{name}.{kind}")], check=True)


def run_command(arguments, shade, folder, words):
    """The picture that a command of the gallery makes, row 0 at the bottom."""
    subprocess.run([shade, *words, "--quiet"], cwd=folder, check=True)
    reader = vtkOpenImageIOReader()
    reader.SetFileName(str(folder / words[1]))
    reader.Update()
    picture = array_of(reader.GetOutput())
    if picture.shape[2] in (2, 4):
        alpha = picture[..., -1:] / 255.0
        picture = (picture[..., :-1] * alpha + 255.0 * (1.0 - alpha)).round().astype(np.uint8)
    picture = np.repeat(picture, 3, axis=2) if picture.shape[2] == 1 else picture
    # A raster of the repository has its own size: every other sample is enough.
    step = max(1, picture.shape[1] // (2 * arguments.width))
    return picture[::step, ::step]


def figure_text(name, title, number, about, panels):
    lines = [f"## {title}\n", (f"After figure {number}. " if number else "") + f"{about}\n", f"![{title}]({name}.jpg)\n",
             "| picture | what it was made with |", "| --- | --- |"]
    lines += [f"| {panel.label} | {panel.told} |" for panel in panels]
    return "\n".join(lines) + "\n\n"


def page_text(page, pictures):
    lines = [f"## {page.title}\n", page.about + "\n"]
    for name, label, words in pictures:
        lines += [f"**{label}**\n", f"![{label}]({name}.jpg)\n",
                  "```console", "reliefshade " + shlex.join(words), "```\n"]
    return "\n".join(lines) + "\n"


def main():
    arguments = parse_arguments()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    wanted = set(arguments.only or [])
    text = INTRODUCTION
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        carve(find_program(arguments.carve), arguments.width, scratch)
        subjects = figures.Subjects(arguments.width, scratch, TERRAIN)
        for name, number, title, make, about in figures.FIGURES:
            if wanted and name not in wanted:
                continue
            panels = make(subjects)
            write(side_by_side([panel.picture for panel in panels]), arguments.folder / f"{name}.jpg")
            text += figure_text(name, title, number, about, panels)
        shade = find_program(arguments.reliefshade)
        commands.prepare(scratch, TERRAIN)
        for page in commands.PAGES:
            made = []
            for name, label, words in page.pictures:
                if wanted and name not in wanted:
                    continue
                write(run_command(arguments, shade, scratch, words), arguments.folder / f"{name}.jpg")
                made.append((name, label, words))
            text += page_text(page, made)
    if not wanted:
        (arguments.folder / "Gallery.md").write_text(text.rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
