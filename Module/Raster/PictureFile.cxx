// SPDX-License-Identifier: BSD-3-Clause
#include "Orientation.h"
#include "PictureTags.h"
#include "RasterFile.h"
#include "VtkStep.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Collection.h"
#include "vtkImageReader2Factory.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTIFFReader.h"

#include <algorithm>

namespace relief::raster
{
namespace
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> Component(vtkImageData* picture, int component)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  int size[3];
  picture->GetDimensions(size);
  image->SetDimensions(size); // some readers begin elsewhere than at 0
  vtkDataArray* all = picture->GetPointData()->GetScalars();
  vtkSmartPointer<vtkDataArray> one;
  one.TakeReference(vtkDataArray::CreateDataArray(all->GetDataType()));
  one->SetNumberOfTuples(all->GetNumberOfTuples());
  one->CopyComponent(0, all, component);
  image->GetPointData()->SetScalars(one);
  return image;
}

//------------------------------------------------------------------------------
/// A picture whose reader VTK knows.
class Picture : public RasterFile
{
public:
  Picture(vtkSmartPointer<vtkImageReader2> reader, const ReadOptions& options);
  Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) override;

private:
  vtkSmartPointer<vtkImageReader2> Reader;
  int Components;
  int Band;
};

//------------------------------------------------------------------------------
Picture::Picture(vtkSmartPointer<vtkImageReader2> reader, const ReadOptions& options)
  : Reader(std::move(reader))
  , Band(std::max(options.Band, 1))
{
  RunVtkStep(this->Reader, [this] { this->Reader->UpdateInformation(); });
  this->Components = this->Reader->GetNumberOfScalarComponents();
  const bool alpha = this->Components == 2 || this->Components == 4;
  const int colors = this->Components - (alpha ? 1 : 0);
  if (options.Band > colors)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "it has no band " + std::to_string(options.Band) + ", only " + std::to_string(colors));
  }
  if (options.Band == 0 && colors != 1)
  {
    throw ManyComponents(ColorNames(colors));
  }
  this->Header.Bands = ColorNames(colors);
  const int* extent = this->Reader->GetDataExtent();
  if (extent[5] != extent[4])
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "it has " + std::to_string(extent[5] - extent[4] + 1) + " slices; expected 1");
  }
  this->Header.Columns = extent[1] - extent[0] + 1;
  this->Header.Rows = extent[3] - extent[2] + 1;
  this->Header.ScalarType = this->Reader->GetDataScalarType();
  this->Header.Masked = alpha;
  const char* format = this->Reader->GetDescriptiveName();
  this->Header.Driver = format ? format : "";
}

//------------------------------------------------------------------------------
Raster Picture::Read(const MemoryPlan& plan, const io::StepWatcher& watcher)
{
  Raster raster;
  static_cast<RasterHeader&>(raster) = this->Header;
  const double bytes = vtkDataArray::GetDataTypeSize(raster.ScalarType);
  plan.Claim(
    raster.Columns, raster.Rows, bytes, bytes * this->Components * raster.Columns * raster.Rows);
  io::Advance(watcher, 0.0);
  RunVtkStep(this->Reader, [this] { this->Reader->Update(); });
  io::Advance(watcher, 1.0);
  vtkImageData* picture = this->Reader->GetOutput();
  if (picture->GetNumberOfPoints() <
      static_cast<vtkIdType>(raster.Columns) * static_cast<vtkIdType>(raster.Rows) ||
    !picture->GetPointData()->GetScalars())
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError, "its pixels cannot be read");
  }
  raster.Heights = Component(picture, this->Band - 1);
  if (raster.Masked)
  {
    vtkNew<vtkImageData> alpha;
    alpha->ShallowCopy(Component(picture, this->Components - 1));
    raster.Mask = MakeMask(alpha);
  }
  return raster;
}

//------------------------------------------------------------------------------
/// As vtkImageReader2Factory::CreateImageReader2, but on readers of its own, so that what they say
/// of files that they cannot read is kept from being printed, and that threads do not meet in them.
/// Null if there is none.
vtkSmartPointer<vtkImageReader2> FindReader(const std::string& file)
{
  const auto listed = []
  {
    vtkNew<vtkImageReader2Collection> readers;
    vtkImageReader2Factory::GetRegisteredReaders(readers);
    return vtkSmartPointer<vtkImageReader2Collection>(readers);
  };
  // The first call fills the factory's list.
  static const vtkSmartPointer<vtkImageReader2Collection> first = listed();
  const vtkSmartPointer<vtkImageReader2Collection> readers = listed();
  vtkCollectionSimpleIterator next;
  readers->InitTraversal(next);
  while (vtkImageReader2* known = readers->GetNextImageReader2(next))
  {
    vtkSmartPointer<vtkImageReader2> reader;
    reader.TakeReference(known->NewInstance());
    bool can = false;
    try
    {
      RunVtkStep(reader, [&] { can = reader->CanReadFile(file.c_str()) != 0; });
    }
    catch (const io::Failure&)
    {
      // Why it cannot is of no concern.
    }
    if (can)
    {
      reader.TakeReference(known->NewInstance()); // one without traces of the question
      return reader;
    }
  }
  return nullptr;
}
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> OpenPicture(const std::string& file, const ReadOptions& options)
{
  vtkSmartPointer<vtkImageReader2> reader = FindReader(file);
  if (!reader)
  {
    return nullptr;
  }
  reader->SetFileName(file.c_str());
  if (auto* tiff = vtkTIFFReader::SafeDownCast(reader))
  {
    tiff->SetOrientationType(4); // else it turns the picture over
  }
  // A reader of OpenImageIO's turns pictures itself.
  const bool upright = reader->IsA("vtkOpenImageIOReader") != 0;
  return TurnUpright(std::make_unique<Picture>(std::move(reader), options),
    upright ? 1 : FindOrientation(BytesOf(file)));
}
}
