# SPDX-License-Identifier: BSD-3-Clause
"""Runs an example that writes a picture and compares it with its baseline.

    RunExample.py --baseline BASELINE.png --output PICTURE.png -- COMMAND...

The picture's name is appended to the command. On failure the picture is kept and its difference
from the baseline stands beside it.
"""

import argparse
import os
import subprocess
import sys

from vtkmodules.vtkImagingCore import vtkImageDifference, vtkImageExtractComponents
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
    parser.add_argument("command", nargs="+")
    arguments = parser.parse_args()

    os.makedirs(os.path.dirname(os.path.abspath(arguments.output)), exist_ok=True)
    # A picture of an earlier run must not pass for this one's.
    if os.path.exists(arguments.output):
        os.remove(arguments.output)
    command = subprocess.run(arguments.command + [arguments.output])
    if command.returncode != 0:
        sys.exit(f"{arguments.command[0]} ended with status {command.returncode}")

    picture, baseline = read(arguments.output), read(arguments.baseline)
    if picture.GetDimensions() != baseline.GetDimensions():
        sys.exit(f"The picture is {picture.GetDimensions()[:2]} pixels, "
                 f"the baseline {baseline.GetDimensions()[:2]}")
    difference = vtkImageDifference()
    difference.SetInputData(picture)
    difference.SetImageData(baseline)
    difference.SetThreshold(CHANNEL_THRESHOLD)
    difference.AllowShiftOff()
    difference.AveragingOff()
    difference.Update()
    error = difference.GetThresholdedError()
    print(f"Difference from the baseline: {error:.2f}, {difference.GetError():.2f} in all")
    if error > PICTURE_THRESHOLD:
        writer = vtkPNGWriter()
        writer.SetInputConnection(difference.GetOutputPort())
        writer.SetFileName(os.path.splitext(arguments.output)[0] + ".diff.png")
        writer.Write()
        sys.exit(f"More than {PICTURE_THRESHOLD}, see {writer.GetFileName()}")


if __name__ == "__main__":
    main()
