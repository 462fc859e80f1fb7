// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPicture.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkHDRReader.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include "FileGuard.h"
#include "RadianceHeader.h"

#include <vtksys/SystemTools.hxx>

#include <array>

namespace relief::io
{
namespace
{
/// Throws a Failure unless there is a Radiance picture whose upper row comes first. Without
/// OpenImageIO there is no other format with numbers as large as the sun's.
RadianceHeader CheckedHeader(const std::string& fileName)
{
  if (!vtksys::SystemTools::PathExists(fileName))
  {
    throw Failure(vtkErrorCode::FileNotFoundError, "the file does not exist");
  }
  if (vtksys::SystemTools::FileIsDirectory(fileName))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, "it is a folder");
  }
  if (!IsRadiance(fileName))
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError,
      "it is no Radiance picture (.hdr), and this build, without OpenImageIO, reads no other");
  }
  const RadianceHeader header = ReadRadianceHeader(fileName);
  if (header.Orientation != 1)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its rows do not go from the top and from the left, -Y and +X; turn it upright");
  }
  return header;
}

//------------------------------------------------------------------------------
void CheckMemory(vtkHDRReader* reader)
{
  const int* extent = reader->GetDataExtent();
  const double bytes =
    3.0 * sizeof(float) * (extent[1] - extent[0] + 1.0) * (extent[3] - extent[2] + 1.0);
  if (bytes / 1024.0 > static_cast<double>(PhysicalMemory()))
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its header gives " + std::to_string(extent[1] - extent[0] + 1) + " x " +
        std::to_string(extent[3] - extent[2] + 1) + " pixels, which memory cannot hold");
  }
}

//------------------------------------------------------------------------------
/// The stored numbers by what they are to be divided by.
void Divide(vtkImageData* image, const std::array<double, 3>& exposure)
{
  auto* colors = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (!colors || colors->GetNumberOfComponents() != 3)
  {
    throw Failure(vtkErrorCode::FileFormatError, "it has no colors");
  }
  float* color = colors->GetPointer(0);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i, color += 3)
  {
    for (int c = 0; c < 3; ++c)
    {
      color[c] = static_cast<float>(color[c] / exposure[c]);
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadRadiance(const std::string& fileName)
{
  const RadianceHeader header = CheckedHeader(fileName);
  bool failed = false;
  vtkNew<vtkCallbackCommand> listener; // whoever asks reports it, in his own name
  listener->SetClientData(&failed);
  listener->SetCallback(
    [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  vtkNew<vtkHDRReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetFileName(fileName.c_str());
  reader->UpdateInformation();
  if (!failed)
  {
    CheckMemory(reader);
    reader->Update();
  }
  if (failed || reader->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw Failure(vtkErrorCode::FileFormatError, "it is damaged or ends too early");
  }
  Divide(reader->GetOutput(), header.Exposure);
  return reader->GetOutput();
}
}

//------------------------------------------------------------------------------
EnvironmentPicture ReadEnvironmentPicture(const std::string& fileName)
{
  EnvironmentPicture picture;
  Guard([&] { picture.Image = ReadRadiance(fileName); }, picture.Reason);
  return picture;
}
}
