# SPDX-License-Identifier: BSD-3-Clause
"""shade_pieces(): a picture of any size, by one process or by many."""

from ._errors import listening, parts_of


class _Alone:
    """What a communicator of MPI is where there is one process."""

    def Get_rank(self):
        return 0

    def Get_size(self):
        return 1

    def allgather(self, value):
        return [value]


def _together(comm, step):
    """Takes a step that may fail on some processes, and waits for all. Raises what it raised where this
    is the first process on which it did; else SystemExit, since one message is enough."""
    error = None
    try:
        result = step()
    except Exception as failure:  # noqa: BLE001  the others are told before it goes on
        error = failure
    failed = comm.allgather(error is not None)
    if not any(failed):
        return result
    if failed.index(True) == comm.Get_rank():
        raise error
    raise SystemExit(1)


def _checked(writer, step):
    """Takes a step of the writer; raises what it, the shading or the source of the heights report."""
    with listening(writer, *parts_of(writer.GetShading())) as heard:
        good = step()
    if heard.failed or not good:
        raise heard.error() if heard.failed else RuntimeError("the shading has been ended")
    heard.warn()


def shade_pieces(shading, file, comm=None, *, memory=None, cloud_optimized=False, overviews=False):
    """Shades a vtkImageReliefShading piece by piece into a GeoTIFF, by one process or by many.

        heights = vtkReliefRasterReader()
        heights.SetFileName("country.tif")
        heights.ReadAsNeededOn()
        shading = vtkImageReliefShading()
        shading.SetInputConnection(heights.GetOutputPort())
        shade_pieces(shading, "relief.tif", MPI.COMM_WORLD)

    comm is a communicator of mpi4py, whose processes share a file system; None for this process alone.
    Each shades its share of the pieces; the first puts the file together. memory is what each may take,
    in bytes: the machine's, shared out, by default. Each layer that the shading generates gets a file of
    its own, relief-illumination.tif and so on. Bits do not depend on memory and processes.

    Pieces wait in the folder relief.tif.parts. The same call goes on where a run was stopped, with
    any number of processes and the same memory; nothing is under the file's own name until all of it is
    there. What has changed meanwhile is an error: remove the folder to begin anew. See vtkReliefPieceWriter.

    Where something fails, the first process on which it does raises RuntimeError (or MemoryError), and
    all others SystemExit, so that there is one message. Returns how many pieces this process has
    shaded.
    """
    from . import vtkReliefPieceWriter

    if memory is not None and not memory >= 1024:
        raise ValueError(f"memory: {memory!r} was given, a number of bytes of at least 1024 is expected")
    comm = _Alone() if comm is None else comm
    process, processes = comm.Get_rank(), comm.Get_size()
    writer = vtkReliefPieceWriter()
    writer.SetShading(shading)
    writer.SetFileName(str(file))
    writer.SetProcess(process, processes)
    writer.SetMemoryLimit(int(memory) // 1024 if memory is not None
                          else max(writer.GetMemoryLimit() // processes, 1))
    writer.SetCloudOptimized(cloud_optimized)
    writer.SetOverviews(overviews)
    # The first makes the pass over all heights, and keeps what it finds for the others.
    for first in (True, False):
        if (process == 0) == first:
            _together(comm, lambda: _checked(writer, writer.Begin))
        else:
            _together(comm, lambda: None)
    _together(comm, lambda: _checked(writer, writer.Shade))
    shaded = writer.GetNumberOfShadedPieces()
    _together(comm, lambda: _checked(writer, writer.Finish))
    return shaded
