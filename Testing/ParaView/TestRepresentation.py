# SPDX-License-Identifier: BSD-3-Clause
"""The representation Relief shows the filter's picture, and the filter's own output is shown as the
picture it is: a sample in each pixel, compared with the filter's 8-bit numbers."""

from reliefparaview import *

load()
source = heights()
settings = dict(LIGHTS, **cases()["base"])
relief = shade(source, settings)
relief.Output = "8 bit sRGB"
codes = fetch(relief)


def view_of_samples():
    """A view with a pixel for each sample, and a few around."""
    view = pv.CreateView("RenderView")
    view.ViewSize = [SHAPE[1] + 6, SHAPE[0] + 6]
    view.OrientationAxesVisibility = 0
    view.SMProxy.GetClientSideObject().SetUseFXAA(False)  # it smooths
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 0, 1]
    return view


def shown(view, image):
    """The pixels in the middles of samples, and the rows that these are of: samples are half as high as
    they are wide, so every second one has pixels."""
    x0, x1, y0, y1 = image.GetBounds()[:4]
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [(x0 + x1) / 2, (y0 + y1) / 2, 0]
    view.CameraPosition = [(x0 + x1) / 2, (y0 + y1) / 2, 1000]
    view.CameraViewUp = [0, 1, 0]
    step = image.GetSpacing()[0]
    view.CameraParallelScale = (SHAPE[0] + 6) / 2 * step
    pv.Render(view)
    window = view.CaptureWindow(1)
    pixels = vtk_to_numpy(window.GetPointData().GetScalars()).reshape(SHAPE[0] + 6, SHAPE[1] + 6, 3)
    # The row of samples that lies in each row of pixels; the middle of the view is that of the image.
    rows = np.arange(SHAPE[0] + 6) - (SHAPE[0] + 5) / 2
    rows = rows * step / image.GetSpacing()[1] + (SHAPE[0] - 1) / 2
    middle = np.abs(rows - np.round(rows)) < 0.01
    inside = middle & (np.round(rows) >= 0) & (np.round(rows) < SHAPE[0])
    return pixels[inside][:, 3:-3], np.round(rows[inside]).astype(int)


def check_shown(view, image, what, most, share):
    """So large a share of the pixels are the samples' codes, as far as they have data."""
    pixels, rows = shown(view, image)
    wanted = codes[rows]
    opaque = wanted[..., 3] == 255
    off = np.abs(pixels.astype(int) - wanted[..., :3].astype(int)).max(axis=2)[opaque]
    assert opaque.sum() > 500, f"{what}: only {opaque.sum()} samples are seen"
    assert np.mean(off <= most) > share, \
        f"{what}: {np.mean(off > most):.3f} of the pixels are off by more than {most}, up to {off.max()}"
    assert np.abs(np.diff(pixels.astype(int), axis=1)).max() > 20, f"{what}: there is nothing to see"


image = pv.servermanager.Fetch(relief)
view = view_of_samples()
display = pv.Show(relief, view)
assert display.Representation == "Picture", display.Representation
assert display.ColorArrayName[1] in ("", None), display.ColorArrayName
# ParaView draws an image from its first sample's middle to its last one's, and blends them a little.
check_shown(view, image, "the filter's output", 12, 0.8)
pv.Hide(relief, view)

display = pv.Show(source, view)
display.SetRepresentationType("Relief")
display.ReliefUseNoDataValue = 1
display.ReliefNoDataValue = -9999.0
display.ReliefInterpolate = 0
assign(display, settings, "Relief")
check_shown(view, image, "the representation", 3, 0.97)
display.ReliefSunAltitude = 80
changed, _ = shown(view, image)
display.ReliefSunAltitude = settings["SunAltitude"]
check_shown(view, image, "the representation, the sun moved and back", 3, 0.97)
assert not np.array_equal(changed, shown(view, image)[0]), "a moved sun changes nothing"

# Heights of cells lie in the same place, and a colour map tints.
pv.Hide(source, view)
of_cells = pv.Show(heights("cells"), view)
of_cells.SetRepresentationType("Relief")
of_cells.ReliefUseNoDataValue = 1
of_cells.ReliefNoDataValue = -9999.0
of_cells.ReliefInterpolate = 0
assign(of_cells, settings, "Relief")
check_shown(view, image, "heights of cells", 3, 0.97)
of_cells.ReliefTint = 1
pv.ColorBy(of_cells, ("CELLS", "Elevation"))
tinted, _ = shown(view, image)
grey = np.ptp(tinted.astype(int), axis=2).max()
assert grey > 60, f"the colour map tints by {grey} only"
print("passed")
