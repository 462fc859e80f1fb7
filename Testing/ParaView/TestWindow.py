# SPDX-License-Identifier: BSD-3-Clause
"""In ParaView's window: Apply shows the filter's picture as it is, and undo takes a change back.

    TestWindow.py PLUGIN FOLDER PARAVIEW

starts PARAVIEW with this file as its script and TestWindow.xml as what a user does, and reads what the
script has noted of each picture."""

import json
import os
import subprocess
import sys


def note(plugin, folder, notes):
    """Within ParaView: opens heights, and notes after every picture how they are shown."""
    import paraview.simple as pv

    pv.LoadPlugin(plugin, remote=False, ns=pv.__dict__)
    source = pv.LegacyVTKReader(registrationName="heights", FileNames=[os.path.join(folder, "heights.vtk")])
    view = pv.GetActiveViewOrCreate("RenderView")
    pv.Show(source, view)
    pv.ResetCamera(view)
    pv.SetActiveSource(source)

    def tell(*_):
        relief = pv.FindSource("ReliefShading1")
        shown = [r for r in view.Representations if hasattr(r, "Input") and r.Input == relief]
        if relief and shown:
            bars = [r for r in view.Representations if type(r).__name__ == "ScalarBarWidgetRepresentation" and
                    r.Visibility]
            kind = shown[0].GetProperty("Representation").SMProperty.GetElement(0)
            by = shown[0].GetProperty("ColorArrayName").SMProperty.GetElement(4)
            depth = relief.GetProperty("AutomaticSubsurfaceDepth").SMProperty.GetElement(0)
            with open(notes, "a", encoding="utf-8") as out:
                out.write(json.dumps({"as": kind, "by": by, "bars": len(bars), "depth": depth}) + "\n")

    view.SMProxy.AddObserver("EndEvent", tell)


def main(plugin, folder, paraview):
    notes = os.path.join(folder, "window.txt")
    if os.path.exists(notes):
        os.remove(notes)
    script = os.path.join(folder, "window.py")
    with open(script, "w", encoding="utf-8") as out:
        out.write(f"import sys\nsys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})\n"
                  f"import TestWindow\nTestWindow.note({plugin!r}, {folder!r}, {notes!r})\n")
    events = os.path.splitext(os.path.abspath(__file__))[0] + ".xml"
    environment = {name: value for name, value in os.environ.items() if name != "QT_QPA_PLATFORM"}
    done = subprocess.run([paraview, "--dr", f"--script={script}", f"--test-script={events}", "--exit"],
                          env=environment, capture_output=True, text=True, timeout=90)
    assert os.path.exists(notes), f"nothing was shown:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    with open(notes, encoding="utf-8") as lines:
        told = [json.loads(line) for line in lines]
    assert told, f"nothing was told:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    assert all(line["as"] == "Picture" and not line["by"] and line["bars"] == 0 for line in told), told
    assert told[0]["depth"] == 1 and told[-1]["depth"] == 1 and any(line["depth"] == 0 for line in told), told
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:4])
