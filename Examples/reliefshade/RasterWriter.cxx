// SPDX-License-Identifier: BSD-3-Clause
#include "RasterWriter.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageExtractComponents.h"
#include "vtkNew.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
bool isTiff(const std::string& file)
{
  const std::string extension = lowerExtension(file);
  return extension == ".tif" || extension == ".tiff";
}

//------------------------------------------------------------------------------
/// Returns the writer's error code; the message is left to be taken.
unsigned long writePicture(const std::string& file, vtkImageData* image, bool dropAlpha)
{
  vtkNew<vtkImageExtractComponents> colours;
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  if (dropAlpha)
  {
    colours->SetInputData(image);
    colours->SetComponents(0, 1, 2);
    writer->SetInputConnection(colours->GetOutputPort());
  }
  watch(writer, false);
  const Silence silence;
  writer->Write();
  return writer->GetErrorCode();
}

//------------------------------------------------------------------------------
/// What to say about an error of the writer, in terms of this program's command line.
std::string reason(unsigned long error, const StagedFile& file, int type)
{
  const std::string message = file.Reword(takeError());
  switch (error)
  {
    case vtkErrorCode::UnrecognizedFileTypeError:
      return "no format that is written has the extension '" +
        std::filesystem::path(file.Target()).extension().string() + "'";
    case vtkErrorCode::FileFormatError:
      return type == VTK_FLOAT ? "its format does not hold 32-bit float; see --type"
                               : "its format does not hold 8-bit colour; see --type";
    default:
      return message;
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string lowerExtension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

//------------------------------------------------------------------------------
int usualScalarType(const std::string& file)
{
  const std::string extension = lowerExtension(file);
  const bool linear = extension == ".exr" || extension == ".hdr" || extension == ".pfm";
  return linear ? VTK_FLOAT : VTK_UNSIGNED_CHAR;
}

//------------------------------------------------------------------------------
RasterWriter::RasterWriter(
  const std::string& file, int scalarType, int components, const GeoReference& reference)
  : File(file)
  , Reference(reference)
{
#ifdef RELIEFSHADE_USE_GDAL
  this->Referenced = reference.Present && isTiff(file);
#endif

  vtkNew<vtkImageData> sample;
  sample->SetDimensions(16, 16, 1);
  sample->AllocateScalars(scalarType, components);
  sample->GetPointData()->GetScalars()->Fill(0.0);
  unsigned long error = writePicture(this->File.Name(), sample, false);
  if (error == vtkErrorCode::FileFormatError && components == 4)
  {
    takeError();
    this->DropAlpha = true;
    error = writePicture(this->File.Name(), sample, true);
  }
  stopIfInterrupted();
  if (error != vtkErrorCode::NoError)
  {
    throw Failure(file, reason(error, this->File, scalarType));
  }
}

//------------------------------------------------------------------------------
void RasterWriter::Write(vtkImageData* image)
{
  if (this->Referenced)
  {
#ifdef RELIEFSHADE_USE_GDAL
    try
    {
      writeGeoTiff(this->File.Name(), image, this->Reference);
    }
    catch (const Failure&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      throw Failure(this->File.Target(), oneLine(error.what()));
    }
#endif
    return;
  }
  const unsigned long error = writePicture(this->File.Name(), image, this->DropAlpha);
  stopIfInterrupted();
  if (error != vtkErrorCode::NoError || hasError())
  {
    throw Failure(this->File.Target(), reason(error, this->File, image->GetScalarType()));
  }
}

}
