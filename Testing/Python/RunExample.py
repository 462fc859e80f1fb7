# SPDX-License-Identifier: BSD-3-Clause
"""Runs an example that writes a picture and compares it with its baseline.

    RunExample.py --baseline BASELINE.png --output PICTURE.png [--cells COLUMNSxROWS] -- COMMAND...

With --cells the picture is a page of several, numbered from 0 at the top left, and each that differs is told.
The picture's name is appended to the command. On failure the picture is kept and its difference
from the baseline stands beside it.
"""

import argparse
import glob
import os
import subprocess
import sys

from vtkmodules.vtkImagingCore import (vtkImageClip, vtkImageDifference,
                                       vtkImageExtractComponents)
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

# vtkTesting lets a channel differ by 16 of 255 before it counts, which hides a sun that has moved
# by five degrees. This still forgives the tolerance of the illumination and what renderers do
# differently along edges.
CHANNEL_THRESHOLD = 6
# What exceeds it, summed over the picture; a texture that is half a texel off gives 280.
PICTURE_THRESHOLD = 100.0


def read(file_name):
    if not os.path.exists(file_name):
        sys.exit(f"{file_name} does not exist")
    reader = vtkPNGReader()
    reader.SetFileName(file_name)
    colors = vtkImageExtractComponents()  # without alpha, if there is any
    colors.SetInputConnection(reader.GetOutputPort())
    colors.SetComponents(0, 1, 2)
    colors.Update()
    return colors.GetOutput()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--baseline", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--cells", default="1x1")
    parser.add_argument("command", nargs="+")
    arguments = parser.parse_args()

    os.makedirs(os.path.dirname(os.path.abspath(arguments.output)), exist_ok=True)
    # A picture of an earlier run must not pass for this one's.
    if os.path.exists(arguments.output):
        os.remove(arguments.output)
    command = subprocess.run(arguments.command + [arguments.output])
    if command.returncode != 0:
        sys.exit(f"{arguments.command[0]} ended with status {command.returncode}")

    # What another renderer draws lies beside the baseline: NAME_1.png, NAME_2.png and so on.
    name, extension = os.path.splitext(arguments.baseline)
    others = sorted(glob.glob(f"{glob.escape(name)}_[0-9]{extension}"))
    for number, baseline in enumerate([arguments.baseline] + others):
        if compare(arguments, baseline, number == len(others)):
            break


def cells(dimensions, columns, rows):
    """The extents of a page's pictures, from the top left; images begin at the bottom."""
    width, height = dimensions[0] // columns, dimensions[1] // rows
    for row in range(rows):
        for column in range(columns):
            bottom = (rows - 1 - row) * height
            yield (column * width, (column + 1) * width - 1, bottom, bottom + height - 1, 0, 0)


def difference_of(picture, baseline):
    difference = vtkImageDifference()
    difference.SetInputData(picture)
    difference.SetImageData(baseline)
    difference.SetThreshold(CHANNEL_THRESHOLD)
    difference.AllowShiftOff()
    difference.AveragingOff()
    difference.Update()
    return difference


def part(picture, extent):
    clip = vtkImageClip()
    clip.SetInputData(picture)
    clip.SetOutputWholeExtent(extent)
    clip.ClipDataOn()
    clip.Update()
    return clip.GetOutput()


def compare(arguments, file_name, last):
    picture, baseline = read(arguments.output), read(file_name)
    if picture.GetDimensions() != baseline.GetDimensions():
        sys.exit(f"The picture is {picture.GetDimensions()[:2]} pixels, "
                 f"the baseline {baseline.GetDimensions()[:2]}")
    difference = difference_of(picture, baseline)
    error = difference.GetThresholdedError()
    print(f"Difference from the baseline: {error:.2f}, {difference.GetError():.2f} in all")
    if error > PICTURE_THRESHOLD:
        columns, rows = map(int, arguments.cells.split("x"))
        for number, extent in enumerate(cells(picture.GetDimensions(), columns, rows)):
            share = difference_of(part(picture, extent), part(baseline, extent)).GetThresholdedError()
            if share > 0.0:
                print(f"Difference in picture {number}: {share:.2f}")
    if error > PICTURE_THRESHOLD and last:
        writer = vtkPNGWriter()
        writer.SetInputConnection(difference.GetOutputPort())
        writer.SetFileName(os.path.splitext(arguments.output)[0] + ".diff.png")
        writer.Write()
        sys.exit(f"More than {PICTURE_THRESHOLD}, see {writer.GetFileName()}")
    return error <= PICTURE_THRESHOLD


if __name__ == "__main__":
    main()
