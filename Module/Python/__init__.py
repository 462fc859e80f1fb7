# SPDX-License-Identifier: BSD-3-Clause
"""Integrated shading of height fields for VTK.

    from reliefshading import vtkImageReliefShading

All classes of the VTK module are here; see their help() or the headers.
"""

from .vtkReliefShading import *  # noqa: F401,F403
