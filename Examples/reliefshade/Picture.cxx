// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "Failure.h"
#include "MessageLog.h"
#include "RasterReader.h"

#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"

#include <filesystem>
#include <stdexcept>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// Places an image in the heights' frame, whose origin is their first sample. Throws a
/// std::runtime_error if that is beside them.
void place(Picture& picture, const Raster& raster)
{
  int size[3];
  int heights[3];
  picture.Image->GetDimensions(size);
  raster.Heights->GetDimensions(heights);
  double origin[3] = { 0.0, 0.0, 0.0 };
  double spacing[3] = { 1.0, 1.0, 1.0 };
  if (picture.Reference.Present && raster.Reference.Present)
  {
    const MapGrid grid = mapGrid(picture.Reference, size[1]);
    for (int k = 0; k < 2; ++k)
    {
      const double scale = raster.Spacing[k] / raster.MapStep[k];
      origin[k] = (grid.Origin[k] - raster.MapOrigin[k]) * scale;
      spacing[k] = grid.Step[k] * scale;
      const double begin = origin[k] - 0.5 * spacing[k];
      const double end = begin + size[k] * spacing[k];
      if (end <= 0.0 || begin >= (heights[k] - 1) * raster.Spacing[k])
      {
        throw std::runtime_error("it lies nowhere on the heights");
      }
    }
  }
  else
  {
    for (int k = 0; k < 2; ++k)
    {
      spacing[k] = raster.Spacing[k] * heights[k] / size[k];
      origin[k] = 0.5 * (spacing[k] - raster.Spacing[k]);
    }
  }
  picture.Image->SetExtent(0, size[0] - 1, 0, size[1] - 1, 0, 0);
  picture.Image->SetOrigin(origin);
  picture.Image->SetSpacing(spacing);
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readPicture(
  const std::string& file, MemoryBudget& budget, double copies, double bytesPerPixel)
{
  vtkNew<vtkOpenImageIOReader> reader;
  aboutFile(file, [&] { updateReader(reader, file, MemoryPlan{ budget, copies, bytesPerPixel }); });
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readTexture(
  const std::string& file, const Raster& raster, MemoryBudget& budget)
{
  Picture picture;
  aboutFile(file,
    [&]
    {
      std::error_code code;
      if (std::filesystem::is_directory(file, code))
      {
        throw std::runtime_error("is a directory");
      }
      if (!readReferencedPicture(file, budget, picture))
      {
        picture.Image = readPicture(file, budget);
      }
      if (picture.Reference.Present && raster.Reference.Present &&
        !sameReferenceSystem(picture.Reference.Crs, raster.Reference.Crs))
      {
        throw std::runtime_error("its coordinate reference system is not that of the heights; "
                                 "gdalwarp -t_srs makes a picture that fits");
      }
      place(picture, raster);
    });
  return picture.Image;
}

}
