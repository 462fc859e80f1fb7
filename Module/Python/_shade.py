# SPDX-License-Identifier: BSD-3-Clause
"""shade(): a picture of an array of heights by one call."""

from ._keywords import check_names, described, signature
from ._relief import Relief

_HELP = '''Shades an array of heights: light, soft shadow, translucency and highlights.

    picture = reliefshading.shade(heights, spacing=30, sun=(315, 35))
    picture.save("relief.png")

heights is an array of (rows, columns), or (1, rows, columns), or (rows, columns, 1): row 0 is on top,
which is north. Any real type will do; float16, longdouble and what is not in C order or of the
machine's byte order are copied once, others are used where they lie. Of a masked array, what is masked has no
data; neither have NaN and infinite heights.

Returns a ReliefImage, which is an array of (rows, columns, 4), uint8 or float32, shows itself in
notebooks, and has layers, mask, statistics and save().

ValueError: a value is out of its range. TypeError: it is of the wrong type, or there is no such
keyword. MemoryError, and RuntimeError for all else that fails, with VTK's message. Other threads run
meanwhile; Ctrl+C ends it.

Colours are linear RGB, names as CSS has them ("#c08040", too), or a number for a grey. Angles are in
degrees, azimuths clockwise from north. For many pictures of the same heights take a Relief.

Keywords, with unit, range and default:

'''


def shade(heights, **keywords):
    check_names("shade", keywords)
    # Nothing is kept for another picture.
    return Relief(heights, cache_memory_limit=0, **keywords).shade()


shade.__doc__ = _HELP + described()
shade.__signature__ = signature(("heights",))
Relief.shade.__signature__ = signature(("self",), ("spacing", "mask", "nodata"))
