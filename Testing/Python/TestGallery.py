# SPDX-License-Identifier: BSD-3-Clause
"""The gallery can be made, small, and looks as it did.

    TestGallery.py CARVE RELIEFSHADE FOLDER [--update]

Compares with the baselines in Testing/Data/Baseline/Gallery; --update writes these anew.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkJPEGReader

ROOT = pathlib.Path(__file__).resolve().parents[2]
BASELINES = ROOT / "Testing" / "Data" / "Baseline" / "Gallery"
WIDTH = 64


def read(path):
    reader = vtkJPEGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1).astype(float)


def compare(made, expected):
    """What is wrong with a picture, if anything. Both have been compressed with loss."""
    if made.shape != expected.shape:
        return f"it has the shape {made.shape}, not {expected.shape}"
    difference = np.abs(made - expected)
    beyond = (difference.max(axis=2) > 40).mean()
    if difference.mean() > 2.0 or beyond > 0.005:
        return f"it differs by {difference.mean():.2f} of 255 in the mean, and {beyond:.2%} of it by more than 40"
    return ""


def main():
    carve, reliefshade, folder = sys.argv[1:4]
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, ROOT / "Examples" / "Gallery" / "make_gallery.py", folder, "--width", str(WIDTH),
                    "--carve", carve, "--reliefshade", reliefshade], check=True)
    made = sorted(path.name for path in folder.glob("*.jpg"))
    page = (folder / "Gallery.md").read_text(encoding="utf-8")
    if "--update" in sys.argv:
        BASELINES.mkdir(parents=True, exist_ok=True)
        for name in made:
            shutil.copy(folder / name, BASELINES / name)
        return
    wrong = []
    if made != sorted(path.name for path in BASELINES.glob("*.jpg")):
        wrong.append(f"the pictures are {made}, other than the baselines")
    if sorted(re.findall(r"\]\(([a-z-]+\.jpg)\)", page)) != made:
        wrong.append("the page does not show every picture once")
    # The gallery in the repository is that of these figures, larger.
    kept = ROOT / "Documentation" / "Gallery"
    if sorted(path.name for path in kept.glob("*.jpg")) != made:
        wrong.append(f"{kept} has other pictures: make the gallery anew")
    for name in made:
        if (BASELINES / name).exists():
            reason = compare(read(folder / name), read(BASELINES / name))
            wrong += [f"{name}: {reason}"] if reason else []
    sys.exit("\n".join(wrong) if wrong else 0)


if __name__ == "__main__":
    main()
