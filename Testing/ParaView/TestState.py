# SPDX-License-Identifier: BSD-3-Clause
"""What is kept can be made again: by a state file, a state script and a trace, and undone."""

import tempfile

from paraview import smstate, smtrace
from paraview.modules.vtkRemotingServerManager import (
    vtkSMProxyManager, vtkSMUndoStack, vtkSMUndoStackBuilder)
from reliefparaview import *

load()
settings = dict(LIGHTS, **cases()["base"])
wanted = reference("base")


def build():
    view = pv.CreateView("RenderView")
    source = heights()
    # At once: scripts have no Apply, by which ParaView's window tells a trace what has changed.
    whole = shade(source, {})
    named = {name: int(value) if whole.GetProperty(name).SMProperty.IsA("vtkSMIntVectorProperty") and
             isinstance(value, float) else value for name, value in settings.items()}
    pv.Delete(whole)
    relief = pv.ReliefShading(registrationName="relief", Input=source, Output="Float linear",
                              UseNoDataValue=1, NoDataValue=-9999.0, **named)
    pv.Show(relief, view)
    display = pv.Show(source, view)
    display.SetRepresentationType("Relief")
    assign(display, settings, "Relief")
    display.ReliefTint = 1
    pv.Render(view)
    return relief


def check(what, display_too=True):
    relief = pv.FindSource("relief")
    assert relief, f"{what}: there is no filter"
    check_equal(fetch(relief), wanted, what)
    view = pv.GetActiveViewOrCreate("RenderView")
    # Loading a state names readers as their files.
    display = pv.GetDisplayProperties(pv.FindSource("heights") or pv.FindSource("heights.vtk"), view)
    assert display.Representation == "Relief", f"{what}: {display.Representation}"
    assert pv.GetDisplayProperties(relief, view).Representation == "Picture", what
    for name, value in settings.items() if display_too else ():
        held = getattr(display, "Relief" + name)
        number = display.GetProperty("Relief" + name).SMProperty
        held = number.GetElement(0) if isinstance(value, float) else held
        assert held == value or list(held) == value, f"{what}: Relief{name} is {held}, not {value}"
    assert display.ReliefTint == display_too, what


def forget():
    pv.ResetSession()
    load()


with tempfile.TemporaryDirectory() as folder:
    smtrace.start_trace()
    build()
    trace = smtrace.stop_trace()
    check("as built")
    pv.SaveState(os.path.join(folder, "relief.pvsm"))
    script = smstate.get_state()

    forget()
    pv.LoadState(os.path.join(folder, "relief.pvsm"))
    check("from the state file")

    forget()
    exec(compile(script, "script", "exec"), {})
    check("from the state script")

    forget()
    assert "ReliefShading(" in trace, trace[:2000]
    exec(compile(trace, "trace", "exec"), {})
    check("from the trace", False)

# Undone, and done again. States are remembered from when there is a builder.
forget()
stack, builder = vtkSMUndoStack(), vtkSMUndoStackBuilder()
builder.SetUndoStack(stack)
vtkSMProxyManager.GetProxyManager().SetUndoStackBuilder(builder)
relief = build()
manager = vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
builder.Begin("brighter")
relief.SunIntensity = 2.0
builder.EndAndPushToStack()
changed = fetch(relief)
assert not np.array_equal(changed, wanted)
assert stack.CanUndo(), "nothing can be undone"
stack.Undo()
manager.UpdateRegisteredProxies(0)  # as ParaView's window does
check_equal(fetch(relief), wanted, "undone")
stack.Redo()
manager.UpdateRegisteredProxies(0)
check_equal(fetch(relief), changed, "done again")
print("passed")
