// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightUnits_h
#define HeightUnits_h

#include "vtkIOReliefRasterModule.h" // For export macro

#include <optional>
#include <string>

namespace relief::raster
{
/// Metres per unit of length, by the names that files give to it: short and long ones in singular
/// and plural, as UDUNITS, EPSG, Esri and GRIB spell them, in any case, with blanks, underscores,
/// hyphens or brackets, and with a number before them ("0.1 m"). 1 where the text says that there
/// is no unit; empty for a name that is not known.
VTKIORELIEFRASTER_EXPORT std::optional<double> MetersPerHeightUnit(const std::string& name);
}

#endif
