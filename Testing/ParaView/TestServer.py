# SPDX-License-Identifier: BSD-3-Clause
"""A client and a server: the numbers are the same, and so is what is drawn here and there."""

import re
import subprocess

from reliefparaview import *

SERVER = sys.argv[3]
good = False
server = subprocess.Popen([SERVER, "--force-offscreen-rendering", "--server-port=0"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
try:
    port = None
    for line in server.stdout:
        found = re.search(r"Accepting connection.*:(\d+)", line)
        if found:
            port = int(found.group(1))
            break
    assert port, "the server told no port"
    pv.Connect("localhost", port)
    load(remote=True)
    settings = dict(LIGHTS, **cases()["base"])
    source = heights()
    relief = shade(source, settings)
    check_equal(fetch(relief), reference("base"), "by a server")

    view = pv.CreateView("RenderView")
    view.ViewSize = [300, 240]
    view.OrientationAxesVisibility = 0
    display = pv.Show(source, view)
    display.SetRepresentationType("Relief")
    display.ReliefUseNoDataValue = 1
    display.ReliefNoDataValue = -9999.0
    assign(display, settings, "Relief")
    pv.Render(view)
    pv.ResetCamera(view)
    pictures = []
    for threshold in (1e9, 0):
        view.RemoteRenderThreshold = threshold
        pv.Render(view)
        remote = view.SMProxy.GetClientSideObject().GetUseDistributedRenderingForRender()
        assert remote == (threshold == 0), f"drawn on the server: {remote}, threshold {threshold}"
        window = view.CaptureWindow(1)
        pictures.append(vtk_to_numpy(window.GetPointData().GetScalars()).astype(int))
    assert pictures[0].std() > 20, "there is nothing to see"
    off = np.abs(pictures[0] - pictures[1]).max()
    assert off <= 2, f"client and server draw it differently, by {off}"
    good = True
finally:
    server.kill()
    print(server.communicate()[0][-3000:], flush=True)
    if good:
        # A client that has lost its server says so at every step on its way out.
        os.write(1, b"\npassed\n")
        os._exit(0)
