// SPDX-License-Identifier: BSD-3-Clause
#include "PictureOutput.h"

#include "Failure.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "Watch.h"
#ifdef RELIEFRASTER_USE_GDAL
#include "GeoTiffWriter.h"
#endif

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageWriter.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// What to say about an error of the writer.
Failure failureOf(unsigned long error, const OutputFile& file, int type)
{
  const std::string message = file.Reword(takeError());
  switch (error)
  {
    case vtkErrorCode::UnrecognizedFileTypeError:
      return { file.Target(),
        "no format that is written has the extension '" +
          std::filesystem::path(file.Target()).extension().string() + "'" };
    case vtkErrorCode::FileFormatError:
      return { file.Target(),
        type == VTK_FLOAT ? "its format does not hold 32-bit float"
                          : "its format does not hold 8-bit colour",
        RunFailure, Remedy::NumberType };
    default:
      return { file.Target(), message };
  }
}

//------------------------------------------------------------------------------
/// Samples of a shaded image, which is red, green, blue and alpha, as a form has them.
template <class T>
void takeRow(const T* rgba, int columns, const PictureForm& form, T* row)
{
  if (form.Colors == 1 && !form.Alpha)
  {
    for (int i = 0; i < columns; ++i)
    {
      row[i] = rgba[4 * i];
    }
  }
  else
  {
    const int components = form.GetComponents();
    for (int i = 0; i < columns; ++i)
    {
      std::copy_n(rgba + 4 * i, form.Colors, row + components * i);
      if (form.Alpha)
      {
        row[components * i + form.Colors] = rgba[4 * i + 3];
      }
    }
  }
  if (!form.ByValue)
  {
    return;
  }
  constexpr bool isFloat = std::numeric_limits<T>::has_quiet_NaN;
  const T none = isFloat ? std::numeric_limits<T>::quiet_NaN() : T(0);
  for (int i = 0; i < columns; ++i)
  {
    for (int c = 0; c < form.Colors; ++c)
    {
      T& value = row[form.Colors * i + c];
      value = !(rgba[4 * i + 3] > T(0)) ? none : isFloat ? value : std::max(value, T(1));
    }
  }
}

//------------------------------------------------------------------------------
/// A row of a picture, in the form of its file.
void takeRow(
  vtkDataArray* scalars, vtkIdType first, int columns, const PictureForm& form, char* row)
{
  const int components = scalars->GetNumberOfComponents();
  const void* source = scalars->GetVoidPointer(first * components);
  const bool asItIs = components == form.GetComponents() && !form.ByValue;
  if (asItIs)
  {
    std::memcpy(
      row, source, static_cast<std::size_t>(columns) * components * scalars->GetDataTypeSize());
  }
  else if (form.ScalarType == VTK_FLOAT)
  {
    takeRow(static_cast<const float*>(source), columns, form, reinterpret_cast<float*>(row));
  }
  else
  {
    takeRow(static_cast<const unsigned char*>(source), columns, form,
      reinterpret_cast<unsigned char*>(row));
  }
}

//------------------------------------------------------------------------------
std::size_t bytesPerSample(const PictureForm& form)
{
  const int number = form.ScalarType == VTK_FLOAT ? 4 : 1;
  return static_cast<std::size_t>(form.GetComponents()) * number;
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
unsigned long writePicture(const std::string& file, vtkImageData* image)
{
  const vtkSmartPointer<vtkImageWriter> writer = imageFormats().NewWriter();
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  watch(writer, false);
  const Silence silence;
  writer->Write();
  return writer->GetErrorCode();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> packPicture(vtkImageData* part, const PictureForm& form)
{
  vtkDataArray* scalars = part->GetPointData()->GetScalars();
  if (form.ByValue || scalars->GetNumberOfComponents() == form.GetComponents())
  {
    return part;
  }
  const auto packed = vtkSmartPointer<vtkDataArray>::Take(scalars->NewInstance());
  packed->SetName(scalars->GetName());
  packed->SetNumberOfComponents(form.GetComponents());
  packed->SetNumberOfTuples(scalars->GetNumberOfTuples());
  const int columns = part->GetDimensions()[0];
  const vtkIdType rows = part->GetDimensions()[1];
  for (vtkIdType j = 0; j < rows; ++j)
  {
    takeRow(scalars, j * columns, columns, form,
      static_cast<char*>(packed->GetVoidPointer(j * columns * form.GetComponents())));
  }
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->ShallowCopy(part);
  result->GetPointData()->SetScalars(packed);
  return result;
}

//------------------------------------------------------------------------------
std::string lowerExtension(const std::string& file)
{
  return relief::io::LowerExtension(file);
}

//------------------------------------------------------------------------------
int usualScalarType(const std::string& file)
{
  const std::string extension = lowerExtension(file);
  const bool linear = extension == ".exr" || extension == ".hdr" || extension == ".pfm";
  return linear ? VTK_FLOAT : VTK_UNSIGNED_CHAR;
}

//------------------------------------------------------------------------------
bool isGeoTiff(const std::string& file)
{
#ifdef RELIEFRASTER_USE_GDAL
  return relief::io::IsTiff(file);
#else
  (void)file;
  return false;
#endif
}

//------------------------------------------------------------------------------
PictureOutput::PictureOutput(
  const std::string& file, const PictureForm& form, const GeoReference& reference, bool streamed)
  : File(file)
  , Form(form)
  , Reference(reference)
  , Tiff(isGeoTiff(file))
  , Referenced(this->Tiff && reference.Present)
  , Streamed(streamed && lowerExtension(file) == ".exr" && form.ScalarType == VTK_FLOAT)
{
  if (!this->Tiff)
  {
    this->TryFormat();
    return;
  }
#ifdef RELIEFRASTER_USE_GDAL
  // It takes any picture: what is left to find out is whether its place does, and GDAL the options.
  if (this->Form.ByValue && this->Form.ScalarType != VTK_FLOAT)
  {
    this->Form.Tiff.NoData = 0.0;
  }
  aboutFile(file, [this] { relief::io::CheckPlace(this->File.Name()); });
  this->File.Try([this] { relief::raster::CheckForm(this->Form.Tiff); });
#endif
}

//------------------------------------------------------------------------------
// GDAL's file is closed before the name that it has goes.
PictureOutput::~PictureOutput() = default;

//------------------------------------------------------------------------------
/// Finds out what the format has of the form.
void PictureOutput::TryFormat()
{
  // Rather colours that are none than a picture that does not tell where there is no data.
  const PictureForm& wanted = this->Form;
  std::vector<std::pair<int, bool>> forms{ { wanted.Colors, wanted.Alpha } };
  for (const std::pair<int, bool>& other :
    { std::pair<int, bool>{ 3, wanted.Alpha }, { wanted.Colors, false }, { 3, false } })
  {
    if (std::find(forms.begin(), forms.end(), other) == forms.end())
    {
      forms.push_back(other);
    }
  }
  unsigned long error = vtkErrorCode::NoError;
  for (const auto& [colors, alpha] : forms)
  {
    takeError();
    this->Form.Colors = colors;
    this->Form.Alpha = alpha;
    vtkNew<vtkImageData> sample;
    sample->SetDimensions(16, 16, 1);
    sample->AllocateScalars(this->Form.ScalarType, this->Form.GetComponents());
    sample->GetPointData()->GetScalars()->Fill(0.0);
    error = writePicture(this->File.Name(), sample);
    if (error != vtkErrorCode::FileFormatError)
    {
      break;
    }
  }
  stopIfInterrupted();
  if (error != vtkErrorCode::NoError)
  {
    throw failureOf(error, this->File, this->Form.ScalarType);
  }
}

//------------------------------------------------------------------------------
double PictureOutput::GetBytesPerSample() const
{
  return this->Tiff || this->Streamed ? 0.0 : static_cast<double>(bytesPerSample(this->Form));
}

//------------------------------------------------------------------------------
void PictureOutput::Begin(const int size[2])
{
  std::copy_n(size, 2, this->Size);
  if (this->Streamed)
  {
    aboutFile(this->File.Target(),
      [this]
      {
        this->Tiles =
          imageFormats().NewTiledPicture(this->File.Name(), this->Size, this->Form.GetComponents());
      });
  }
#ifdef RELIEFRASTER_USE_GDAL
  if (this->Tiff)
  {
    this->File.Try(
      [this]
      {
        this->Rows = std::make_unique<relief::raster::GeoTiffFile>(this->File.Name(), this->Size,
          this->Form.GetComponents(), this->Form.ScalarType, this->Reference, this->Form.Tiff);
      });
  }
#endif
}

//------------------------------------------------------------------------------
/// Makes the picture that is put together of parts, or takes the part that is all of it.
void PictureOutput::BeginWhole(vtkImageData* part)
{
  vtkDataArray* scalars = part->GetPointData()->GetScalars();
  this->Whole = vtkSmartPointer<vtkImageData>::New();
  this->Whole->SetDimensions(this->Size[0], this->Size[1], 1);
  if (scalars->GetNumberOfComponents() == this->Form.GetComponents() && !this->Form.ByValue &&
    part->GetDimensions()[1] == this->Size[1])
  {
    this->Whole->GetPointData()->SetScalars(scalars);
    return;
  }
  aboutFile(this->File.Target(),
    [this] { this->Whole->AllocateScalars(this->Form.ScalarType, this->Form.GetComponents()); });
}

//------------------------------------------------------------------------------
void PictureOutput::WriteRows(vtkImageData* part)
{
  const int* extent = part->GetExtent();
  const int rows = extent[3] - extent[2] + 1;
  vtkDataArray* scalars = part->GetPointData()->GetScalars();
  const std::size_t bytes = bytesPerSample(this->Form) * this->Size[0];
  if (!this->Tiff && !this->Streamed)
  {
    if (!this->Whole)
    {
      this->BeginWhole(part);
    }
    vtkDataArray* all = this->Whole->GetPointData()->GetScalars();
    for (int j = 0; j < rows && all != scalars; ++j)
    {
      char* row = static_cast<char*>(all->GetVoidPointer(0)) + (extent[2] + j) * bytes;
      takeRow(scalars, vtkIdType(j) * this->Size[0], this->Size[0], this->Form, row);
    }
    return;
  }
  this->Buffer.resize(bytes * static_cast<std::size_t>(rows));
  for (int k = 0; k < rows; ++k)
  {
    const int j = this->IsUpward() ? k : rows - 1 - k;
    takeRow(scalars, vtkIdType(j) * this->Size[0], this->Size[0], this->Form,
      this->Buffer.data() + static_cast<std::size_t>(k) * bytes);
  }
  if (this->Streamed)
  {
    aboutFile(this->File.Target(),
      [&] { this->Tiles->Write(rows, this->Buffer.data(), static_cast<std::ptrdiff_t>(bytes)); });
    return;
  }
#ifdef RELIEFRASTER_USE_GDAL
  this->File.Try(
    [&]
    {
      this->Rows->Write(rows, this->Buffer.data(), static_cast<std::ptrdiff_t>(bytes),
        [](double) { return !interrupted(); });
    });
#endif
}

//------------------------------------------------------------------------------
void PictureOutput::Finish(bool bar)
{
  if (this->Streamed)
  {
    aboutFile(this->File.Target(), [this] { this->Tiles->Finish(); });
    this->Tiles.reset();
    return;
  }
#ifdef RELIEFRASTER_USE_GDAL
  if (this->Tiff)
  {
    const auto watch = [bar](double share)
    {
      showProgress(bar, "finishing", share);
      return !interrupted();
    };
    this->File.Try([&] { this->Rows->Finish(watch); });
    this->Rows.reset();
    return;
  }
#endif
  const unsigned long error = writePicture(this->File.Name(), this->Whole);
  this->Whole = nullptr;
  stopIfInterrupted();
  if (error != vtkErrorCode::NoError || hasError())
  {
    throw failureOf(error, this->File, this->Form.ScalarType);
  }
}

//------------------------------------------------------------------------------
void PictureOutput::Write(vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  this->Begin(size);
  this->WriteRows(image);
  this->Finish();
}

}
