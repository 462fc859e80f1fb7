# SPDX-License-Identifier: BSD-3-Clause
"""Relief shading in QGIS's Processing toolbox, by the program reliefshade."""


def classFactory(iface):
    """What QGIS calls to load the plugin; without a window there is no iface."""
    from .plugin import Plugin

    return Plugin()
