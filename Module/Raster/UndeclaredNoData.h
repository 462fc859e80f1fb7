// SPDX-License-Identifier: BSD-3-Clause
#ifndef UndeclaredNoData_h
#define UndeclaredNoData_h

#include "Raster.h"

namespace relief::raster
{
/// Warns if heights, in the file's values and after MarkNoData, look as if they held a value that
/// means no data and that nobody declared: the lowest or the highest one, several times, far from
/// all others, and one that is used so.
VTKIORELIEFRASTER_EXPORT void WarnOfUndeclaredNoData(Raster& raster);
}

#endif
