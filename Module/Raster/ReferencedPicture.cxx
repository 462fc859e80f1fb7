// SPDX-License-Identifier: BSD-3-Clause
#include "ReferencedPicture.h"

#include "vtkErrorCode.h"

namespace relief::raster
{
//------------------------------------------------------------------------------
void PlacePicture(const RasterHeader& heights, const ReferencedPicture& picture)
{
  int size[3];
  picture.Image->GetDimensions(size);
  const int samples[2] = { heights.Columns, heights.Rows };
  double origin[3] = { 0.0, 0.0, 0.0 };
  double spacing[3] = { 1.0, 1.0, 1.0 };
  std::array<double, 2> direction = heights.Direction;
  if (picture.Reference.Present && heights.Reference.Present)
  {
    if (!SameReferenceSystem(picture.Reference.Crs, heights.Reference.Crs))
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "its coordinate reference system is not that of the heights; gdalwarp -t_srs makes a "
        "picture that fits");
    }
    RasterHeader place;
    place.Columns = size[0];
    place.Rows = size[1];
    place.Reference = picture.Reference;
    place.MetersPerUnit = heights.MetersPerUnit;
    PlaceOnMap(place);
    CheckAngles(place);
    direction = place.Direction;
    for (int k = 0; k < 2; ++k)
    {
      origin[k] = (place.MapOrigin[k] - heights.MapOrigin[k]) * heights.MetersPerUnit[k];
      spacing[k] = place.Spacing[k];
      const double begin = origin[k] - 0.5 * spacing[k];
      const double end = begin + size[k] * spacing[k];
      // Of turned ones the shading tells it.
      if (!place.IsTurned() && !heights.IsTurned() &&
        (end <= 0.0 || begin >= (samples[k] - 1) * heights.Spacing[k]))
      {
        throw io::Failure(vtkErrorCode::FileFormatError, "it lies nowhere on the heights");
      }
    }
  }
  else
  {
    double edge[2];
    for (int k = 0; k < 2; ++k)
    {
      spacing[k] = heights.Spacing[k] * samples[k] / size[k];
      edge[k] = 0.5 * (spacing[k] - heights.Spacing[k]);
    }
    origin[0] = edge[0] * direction[0] - edge[1] * direction[1];
    origin[1] = edge[0] * direction[1] + edge[1] * direction[0];
  }
  picture.Image->SetExtent(0, size[0] - 1, 0, size[1] - 1, 0, 0);
  picture.Image->SetOrigin(origin);
  picture.Image->SetSpacing(spacing);
  picture.Image->SetDirectionMatrix(DirectionMatrix(direction).data());
}
}
