// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefRasterWriter.h"

#include "FileGuard.h"
#include "GeoTiffForm.h"
#include "GeoTiffWriter.h"
#include "PictureBands.h"
#include "RasterFieldData.h"
#include "StagedFile.h"
#include "VtkStep.h"

#include "vtkBMPWriter.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkJPEGWriter.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPNMWriter.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTIFFWriter.h"

#include <string>
#include <vector>

using namespace relief::raster;
using relief::io::Failure;
using relief::io::IsTiff;
using relief::io::LowerExtension;
using relief::io::StagedFile;

vtkStandardNewMacro(vtkReliefRasterWriter);

struct vtkReliefRasterWriter::Internals
{
  std::vector<std::string> CreationOptions;
};

namespace
{
struct Job
{
  vtkAlgorithm* Writer;
  vtkImageData* Image;
  vtkImageData* Reference;
  std::string FileName;
  std::string ArrayName;
  PictureBands Bands;
  GeoTiffForm Form;
};

//------------------------------------------------------------------------------
/// VTK's own writer for a name; null if there is none.
vtkSmartPointer<vtkImageWriter> FindWriter(const std::string& file)
{
  const std::string extension = LowerExtension(file);
  if (IsTiff(file))
  {
    return vtkSmartPointer<vtkTIFFWriter>::New();
  }
  if (extension == ".png")
  {
    return vtkSmartPointer<vtkPNGWriter>::New();
  }
  if (extension == ".jpg" || extension == ".jpeg")
  {
    return vtkSmartPointer<vtkJPEGWriter>::New();
  }
  if (extension == ".bmp")
  {
    return vtkSmartPointer<vtkBMPWriter>::New();
  }
  if (extension == ".pnm")
  {
    return vtkSmartPointer<vtkPNMWriter>::New();
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkDataArray* FindValues(const Job& job)
{
  vtkPointData* data = job.Image->GetPointData();
  vtkDataArray* values =
    job.ArrayName.empty() ? data->GetScalars() : data->GetArray(job.ArrayName.c_str());
  if (!values)
  {
    throw Failure(
      vtkErrorCode::UnknownError, "the input image has no array \"" + job.ArrayName + "\"");
  }
  if (values->GetNumberOfTuples() < job.Image->GetNumberOfPoints())
  {
    throw Failure(vtkErrorCode::UnknownError,
      "the array \"" + job.ArrayName + "\" has fewer values than the input image has points");
  }
  if (values->GetNumberOfComponents() > 4)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      std::to_string(values->GetNumberOfComponents()) + " components; 1 to 4 are written");
  }
  return values;
}

//------------------------------------------------------------------------------
void CheckPicture(vtkDataArray* values, const std::string& file)
{
  const int type = values->GetDataType();
  const bool sixteen = LowerExtension(file) == ".png" || IsTiff(file);
  const bool held = type == VTK_UNSIGNED_CHAR || (type == VTK_UNSIGNED_SHORT && sixteen) ||
    (type == VTK_FLOAT && IsTiff(file));
  if (!held)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      std::string("its format is not written with numbers of the type ") +
        values->GetDataTypeAsString());
  }
  const int components = values->GetNumberOfComponents();
  const std::string extension = LowerExtension(file);
  if (extension != ".png" && !IsTiff(file) && components != 1 && components != 3)
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "its format holds 1 or 3 components, and the image has " + std::to_string(components));
  }
}

//------------------------------------------------------------------------------
void WritePicture(
  const Job& job, vtkDataArray* values, vtkImageWriter* writer, const std::string& name)
{
  CheckPicture(values, job.FileName);
  vtkNew<vtkImageData> picture;
  picture->CopyStructure(job.Image);
  picture->GetPointData()->SetScalars(values);
  writer->SetFileName(name.c_str());
  writer->SetInputData(picture);
  RunVtkStep(writer, [writer] { writer->Write(); });
}

//------------------------------------------------------------------------------
void WriteWholeFile(const Job& job)
{
  relief::io::CheckImage(job.FileName, job.Image, job.ArrayName.empty());
  const vtkSmartPointer<vtkDataArray> values = ChooseBands(FindValues(job), job.Bands);
  const vtkSmartPointer<vtkImageWriter> writer = FindWriter(job.FileName);
  if (!writer)
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError,
      "no format that is written here has this extension; vtkOpenImageIOWriter writes more of "
      "them");
  }
  const auto goOn = [&job](double share)
  {
    job.Writer->UpdateProgress(share);
    return !job.Writer->GetAbortExecute();
  };
  GeoReference reference;
  if (job.Reference && job.Reference->GetNumberOfPoints() < 1)
  {
    throw Failure(vtkErrorCode::UnknownError,
      "the image that is to tell its place is empty: was its file read?");
  }
  if (IsTiff(job.FileName))
  {
    vtkImageData* told = job.Reference ? job.Reference : job.Image;
    reference = FindReference(told->GetFieldData(), job.Image);
  }
  StagedFile file(job.FileName);
  relief::io::Advance(goOn, 0.0);
#ifdef RELIEFRASTER_USE_GDAL
  const bool byGdal = IsTiff(job.FileName);
#else
  const bool byGdal = false;
  if (reference.Present)
  {
    vtkWarningWithObjectMacro(job.Writer,
      "\"" << job.FileName << "\" has no place on the map: this was built without GDAL.");
  }
#endif
  try
  {
    if (byGdal)
    {
      WriteGeoTiff(file.Name(), job.Image, values, reference, job.Form, goOn);
    }
    else
    {
      WritePicture(job, values, writer, file.Name());
    }
  }
  catch (const Failure& failure)
  {
    throw Failure(failure.Code, file.Reword(failure.what()));
  }
  relief::io::Advance(goOn, 1.0);
  file.Keep();
}
}

//------------------------------------------------------------------------------
vtkReliefRasterWriter::vtkReliefRasterWriter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkReliefRasterWriter::~vtkReliefRasterWriter()
{
  this->SetArrayName(nullptr);
}

//------------------------------------------------------------------------------
void vtkReliefRasterWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << (this->ArrayName ? this->ArrayName : "(none)") << "\n";
  os << indent << "Bands: " << this->Bands << "\n";
  os << indent << "Compression: " << this->Compression << "\n";
  os << indent << "CloudOptimized: " << (this->CloudOptimized ? "On\n" : "Off\n");
  os << indent << "Overviews: " << (this->Overviews ? "On\n" : "Off\n");
  os << indent << "CreationOptions:";
  for (const std::string& option : this->Internal->CreationOptions)
  {
    os << " " << option;
  }
  os << (this->Internal->CreationOptions.empty() ? " (none)\n" : "\n");
}

//------------------------------------------------------------------------------
void vtkReliefRasterWriter::AddCreationOption(const char* option)
{
  if (option)
  {
    this->Internal->CreationOptions.emplace_back(option);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefRasterWriter::ClearCreationOptions()
{
  if (!this->Internal->CreationOptions.empty())
  {
    this->Internal->CreationOptions.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkReliefRasterWriter::GetNumberOfCreationOptions()
{
  return static_cast<int>(this->Internal->CreationOptions.size());
}

//------------------------------------------------------------------------------
const char* vtkReliefRasterWriter::GetCreationOption(int index)
{
  const bool there = index >= 0 && index < this->GetNumberOfCreationOptions();
  return there ? this->Internal->CreationOptions[static_cast<std::size_t>(index)].c_str() : nullptr;
}

//------------------------------------------------------------------------------
int vtkReliefRasterWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefRasterWriter::Write()
{
  // Stands if the pipeline stops before it comes to this writer.
  this->ErrorCode = vtkErrorCode::UnknownError;
  if (relief::io::HasInput(this, this->FileName))
  {
    this->Modified();
    this->UpdateWholeExtent();
  }
}

//------------------------------------------------------------------------------
int vtkReliefRasterWriter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  GeoTiffForm form;
  form.Compression = static_cast<GeoTiffForm::Compressions>(this->Compression);
  form.CloudOptimized = this->CloudOptimized;
  form.Overviews = this->Overviews;
  form.CreationOptions = this->Internal->CreationOptions;
  const Job job{ this, vtkImageData::GetData(inputVector[0], 0),
    inputVector[1]->GetNumberOfInformationObjects() > 0 ? vtkImageData::GetData(inputVector[1], 0)
                                                        : nullptr,
    this->FileName ? this->FileName : "", this->ArrayName ? this->ArrayName : "",
    static_cast<PictureBands>(this->Bands), form };
  this->ErrorCode = relief::io::GuardWriting(this, job.FileName, [&] { WriteWholeFile(job); });
  // Success in any case: the pipeline would add an error of its own that says nothing more.
  return 1;
}
