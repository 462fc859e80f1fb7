// SPDX-License-Identifier: BSD-3-Clause
#include "Orientation.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace relief::raster
{
namespace
{
class UprightFile : public RasterFile
{
public:
  UprightFile(std::unique_ptr<RasterFile> file, int orientation)
    : File(std::move(file))
    , Orientation(orientation)
  {
    this->Header = this->File->GetHeader();
    this->Turn(this->Header);
  }

  Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) override
  {
    MemoryPlan whole = plan; // the stored heights and mask stay until they are turned
    whole.PerPixel +=
      vtkDataArray::GetDataTypeSize(this->Header.ScalarType) + (this->Header.Masked ? 1.0 : 0.0);
    Raster raster = this->File->Read(whole, watcher);
    this->Turn(raster);
    raster.Heights = TurnUpright(raster.Heights, this->Orientation);
    raster.Mask = raster.Mask ? TurnUpright(raster.Mask, this->Orientation) : nullptr;
    return raster;
  }

private:
  void Turn(RasterHeader& header) const
  {
    if (this->Orientation > 4)
    {
      std::swap(header.Columns, header.Rows);
    }
  }

  std::unique_ptr<RasterFile> File;
  int Orientation;
};
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> TurnUpright(vtkImageData* stored, int orientation)
{
  if (orientation <= 1 || orientation > 8)
  {
    return stored;
  }
  int size[3];
  stored->GetDimensions(size);
  const bool swapped = orientation > 4;
  auto upright = vtkSmartPointer<vtkImageData>::New();
  upright->SetDimensions(swapped ? size[1] : size[0], swapped ? size[0] : size[1], 1);
  upright->SetOrigin(stored->GetOrigin());
  upright->SetSpacing(stored->GetSpacing());
  upright->AllocateScalars(stored->GetScalarType(), stored->GetNumberOfScalarComponents());
  upright->GetPointData()->GetScalars()->SetName(stored->GetPointData()->GetScalars()->GetName());
  const auto pixel =
    static_cast<std::size_t>(stored->GetScalarSize()) * stored->GetNumberOfScalarComponents();
  const auto* from = static_cast<const char*>(stored->GetScalarPointer());
  auto* to = static_cast<char*>(upright->GetScalarPointer());
  int turned[3];
  upright->GetDimensions(turned);
  // Where the pixel at column i, row t from the top, is stored: mirrored along x for the orders
  // that begin at the right or, swapped, at the bottom; along y for those at the bottom or at the
  // right.
  const bool mirrorX = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool mirrorY = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  for (int j = 0; j < turned[1]; ++j)
  {
    const int t = turned[1] - 1 - j;
    for (int i = 0; i < turned[0]; ++i, to += pixel)
    {
      const int a = swapped ? t : i;
      const int b = swapped ? i : t;
      const int x = mirrorX ? size[0] - 1 - a : a;
      const int y = mirrorY ? size[1] - 1 - b : b;
      const auto row = static_cast<std::size_t>(size[1] - 1 - y);
      std::memcpy(to, from + (row * size[0] + x) * pixel, pixel);
    }
  }
  return upright;
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> TurnUpright(std::unique_ptr<RasterFile> file, int orientation)
{
  if (orientation <= 1 || file->GetHeader().Reference.Present)
  {
    return file;
  }
  return std::make_unique<UprightFile>(std::move(file), orientation);
}
}
