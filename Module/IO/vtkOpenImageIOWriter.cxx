// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenImageIOWriter.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include "ImageFileAccess.h"
#include "ImageFileAttributes.h"
#include "ImageFileProxy.h"
#include "TemporaryFile.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkOpenImageIOWriter);

namespace
{
using OIIO::TypeDesc;
using relief::io::Aborted;
using relief::io::AddAttributes;
using relief::io::CheckImage;
using relief::io::Failure;
using relief::io::FileType;
using relief::io::ImageFileProxy;
using relief::io::OneLine;
using relief::io::TemporaryFile;

// Refuses components that OpenImageIO would drop without a word, or not survive.
void CheckComponents(const OIIO::ImageOutput& format, int components)
{
  const std::string name = format.format_name();
  std::string held;
  if (name == "dpx")
  {
    // Its writer says that it takes any number, and ends the program when it gets another.
    held = components == 2 || components > 4 ? "1, 3 or 4" : "";
  }
  else if (name == "webp" || name == "heif")
  {
    // Fewer would crash WebP as it is closed, and HEIF would read behind the rows.
    held = components < 3 || components > 4 ? "3 or 4" : "";
  }
  else if (name == "gif")
  {
    // Its writer takes alpha and makes all of it opaque.
    held = components != 3 ? "3" : "";
  }
  else if (name == "ico")
  {
    // Without alpha its writer runs beyond the rows, and it makes colours of grey.
    held = components != 4 ? "4" : "";
  }
  else if (!format.supports("alpha"))
  {
    held = components == 2 || components == 4 ? "1 or 3" : "";
  }
  else if (!format.supports("nchannels"))
  {
    held = components > 4 ? "up to 4" : "";
  }
  if (!held.empty())
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "the format " + name + " holds " + held +
        " components, as it is written here, and the image has " + std::to_string(components));
  }
  if (name == "iff")
  {
    throw Failure(
      vtkErrorCode::FileFormatError, "the format iff is written in tiles, which is not done here");
  }
  if (name == "null" || name == "term")
  {
    throw Failure(vtkErrorCode::FileFormatError, "the format " + name + " makes no file");
  }
}

// Refuses sizes that a format's writer takes without writing such an image.
void CheckSize(const std::string& format, const OIIO::ImageSpec& spec)
{
  std::string held;
  if (format == "jpeg2000" && std::min(spec.width, spec.height) < 32)
  {
    held = "of at least 32 x 32 samples"; // it halves them five times
  }
  else if (format == "gif" && std::max(spec.width, spec.height) > 65535)
  {
    held = "of up to 65535 x 65535 samples"; // larger ones begin again at 0
  }
  else if (format == "jpeg" && std::max(spec.width, spec.height) > 65500)
  {
    held = "of up to 65500 x 65500 samples"; // its writer would never end
  }
  if (!held.empty())
  {
    throw Failure(vtkErrorCode::FileFormatError,
      "the format " + format + " holds images " + held +
        ", as it is written here, and this one has " + std::to_string(spec.width) + " x " +
        std::to_string(spec.height));
  }
}

// The type that a format stores, if OpenImageIO does not know better.
TypeDesc HeldType(const OIIO::ImageOutput& format)
{
  const std::string name = format.format_name();
  if (name == "ico")
  {
    return TypeDesc::UINT8; // of 16 bits the bytes would be swapped
  }
  if (name == "rla" && !format.spec().format.is_floating_point())
  {
    return TypeDesc::FLOAT; // whole numbers are packed, and some come out as others
  }
  return format.spec().format;
}

void CheckType(const OIIO::ImageOutput& format, TypeDesc wanted, bool automatic)
{
  const TypeDesc chosen = HeldType(format);
  const bool narrowed = automatic && wanted == TypeDesc::DOUBLE && chosen == TypeDesc::FLOAT;
  if (chosen != wanted && !narrowed)
  {
    std::ostringstream text;
    text << "the format " << format.format_name() << " does not hold pixels of type "
         << wanted.c_str() << "; what it would hold instead is " << chosen.c_str()
         << ". Set a PixelType that it holds";
    throw Failure(vtkErrorCode::FileFormatError, text.str());
  }
}

template <typename T>
void ReplaceNaN(T* values, size_t count)
{
  std::replace_if(
    values, values + count, [](T value) { return std::isnan(value); }, T(0));
}

struct Job
{
  vtkAlgorithm* Writer;
  vtkImageData* Image;
  std::string FileName;
  int PixelType;
  std::string Compression;
  int Quality;
  bool Staging;
};

void WriteRows(const Job& job, OIIO::ImageOutput& output, const TemporaryFile& file)
{
  vtkDataArray* scalars = job.Image->GetPointData()->GetScalars();
  const TypeDesc type = FileType(scalars->GetDataType());
  const OIIO::ImageSpec& spec = output.spec();
  const size_t rowValues = static_cast<size_t>(spec.width) * scalars->GetNumberOfComponents();
  const size_t rowBytes = rowValues * type.size();
  const auto* image = static_cast<const unsigned char*>(scalars->GetVoidPointer(0));
  // Bands of about 4 MiB of whole compressed blocks, so that OpenImageIO can encode in parallel.
  const int granules = static_cast<int>(std::max<size_t>(1, (size_t(4) << 20) / rowBytes / 64));
  const int bandRows = std::min(granules * 64, spec.height);
  // The spare bytes: HEIF's writer copies rows padded to its own width.
  std::vector<unsigned char> band(rowBytes * bandRows + 256);
  for (int y = 0; y < spec.height; y += bandRows)
  {
    if (job.Writer->GetAbortExecute())
    {
      throw Aborted();
    }
    const int end = std::min(y + bandRows, spec.height);
    for (int row = y; row < end; ++row)
    {
      // The file begins with the top row, the image with the bottom one.
      std::memcpy(band.data() + rowBytes * (row - y),
        image + rowBytes * static_cast<size_t>(spec.height - 1 - row), rowBytes);
    }
    if (!spec.format.is_floating_point() && type == TypeDesc::FLOAT)
    {
      ReplaceNaN(reinterpret_cast<float*>(band.data()), rowValues * (end - y));
    }
    else if (!spec.format.is_floating_point() && type == TypeDesc::DOUBLE)
    {
      ReplaceNaN(reinterpret_cast<double*>(band.data()), rowValues * (end - y));
    }
    if (!output.write_scanlines(y, end, 0, type, band.data()))
    {
      throw Failure(
        vtkErrorCode::OutOfDiskSpaceError, "writing failed: " + file.Reword(output.geterror()));
    }
    job.Writer->UpdateProgress(static_cast<double>(end) / spec.height);
  }
  if (job.Writer->GetAbortExecute())
  {
    throw Aborted();
  }
}

// Some formats' writers take what their readers do not give back, so the header is looked at once
// more, and where OpenImageIO has not written through TemporaryFile, whether all rows have come to
// the disk.
void CheckFile(const TemporaryFile& file, const std::string& format, const OIIO::ImageSpec& written,
  bool checkRows)
{
  // Asked for by its name, since what has come to nothing is not taken for a file of the format.
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input)
  {
    OIIO::geterror(); // The format is written only
    return;
  }
  OIIO::ImageSpec found;
  const bool opened = input->open(file.Name(), found);
  if (opened &&
    (found.width != written.width || found.height != written.height ||
      found.nchannels < written.nchannels || found.format != written.format))
  {
    std::ostringstream text;
    text << "the format " << input->format_name() << " does not hold " << written.nchannels
         << " components of type " << written.format.c_str() << ": it stores " << found.nchannels
         << " of type " << found.format.c_str();
    throw Failure(vtkErrorCode::FileFormatError, text.str());
  }
  bool whole = opened;
  std::vector<unsigned char> row(static_cast<size_t>(found.scanline_bytes()));
  for (int y = found.y; checkRows && whole && y < found.y + found.height; ++y)
  {
    whole = input->read_scanlines(0, 0, y, y + 1, 0, 0, found.nchannels, found.format, row.data());
  }
  const std::string text = input->geterror();
  if (!whole)
  {
    throw Failure(vtkErrorCode::OutOfDiskSpaceError,
      "what was written cannot be read back: " + file.Reword(text));
  }
}

OIIO::ImageSpec FileSpec(const Job& job, const std::string& format)
{
  vtkDataArray* scalars = job.Image->GetPointData()->GetScalars();
  TypeDesc type = FileType(scalars->GetDataType());
  if (format == "rla" && type == TypeDesc::DOUBLE)
  {
    type = TypeDesc::FLOAT; // its writer takes double, and nobody reads that
  }
  const TypeDesc types[] = { type, TypeDesc::UINT8, TypeDesc::UINT16, TypeDesc::HALF,
    TypeDesc::FLOAT };
  int dimensions[3];
  job.Image->GetDimensions(dimensions);
  OIIO::ImageSpec spec(
    dimensions[0], dimensions[1], scalars->GetNumberOfComponents(), types[job.PixelType]);
  AddAttributes(job.Image->GetFieldData(), spec);
  // Without it colours would be divided by alpha. OpenEXR has no such thing and stores what it
  // gets.
  if (format != "openexr")
  {
    spec.attribute("oiio:UnassociatedAlpha", 1);
  }
  if (!job.Compression.empty())
  {
    spec.attribute("compression", job.Compression);
  }
  static const std::set<std::string> lossy = { "jpeg", "webp", "heif" };
  if (lossy.count(format) || job.Compression == "jpeg")
  {
    spec.attribute("CompressionQuality", job.Quality);
  }
  return spec;
}

void CheckScalarType(vtkDataArray* scalars)
{
  if (FileType(scalars->GetDataType()) == TypeDesc::UNKNOWN)
  {
    throw Failure(vtkErrorCode::UnknownError,
      std::string("the input image has scalars of the type ") + scalars->GetDataTypeAsString());
  }
}

void WriteWholeFile(const Job& job)
{
  CheckImage(job.FileName, job.Image);
  CheckScalarType(job.Image->GetPointData()->GetScalars());
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(job.FileName);
  if (!output)
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError, OneLine(OIIO::geterror()));
  }
  const OIIO::ImageSpec spec = FileSpec(job, output->format_name());
  CheckComponents(*output, spec.nchannels);
  CheckSize(output->format_name(), spec);

  // In this order: the format's writer must go before the file, for its destructor may write.
  TemporaryFile file(job.FileName, job.Staging);
  ImageFileProxy proxy(file);
  const std::unique_ptr<OIIO::ImageOutput> format = std::move(output);
  const bool checked = format->supports("ioproxy") && format->set_ioproxy(&proxy);
  if (!checked)
  {
    file.Finish();
  }
  if (!format->open(file.Name(), spec))
  {
    throw Failure(vtkErrorCode::FileFormatError, file.Reword(format->geterror()));
  }
  CheckType(*format, spec.format, job.PixelType == vtkOpenImageIOWriter::Automatic);
  WriteRows(job, *format, file);
  // Its text alone is no failure: TIFF leaves one behind files that are whole.
  const bool closed = format->close();
  const std::string text = format->geterror();
  if (!closed)
  {
    throw Failure(vtkErrorCode::OutOfDiskSpaceError, "writing failed: " + file.Reword(text));
  }
  if (const int error = file.Finish())
  {
    throw Failure(
      vtkErrorCode::OutOfDiskSpaceError, std::string("writing failed: ") + std::strerror(error));
  }
  CheckFile(file, format->format_name(), format->spec(), !checked);
  file.Keep();
}
}

//------------------------------------------------------------------------------
vtkOpenImageIOWriter::vtkOpenImageIOWriter() = default;

//------------------------------------------------------------------------------
vtkOpenImageIOWriter::~vtkOpenImageIOWriter()
{
  this->SetCompression(nullptr);
}

//------------------------------------------------------------------------------
void vtkOpenImageIOWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  static const char* const types[] = { "Automatic", "UnsignedChar", "UnsignedShort", "Half",
    "Float" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PixelType: " << types[this->PixelType] << "\n";
  os << indent << "Compression: " << (this->Compression ? this->Compression : "(none)") << "\n";
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Staging: " << (this->Staging ? "On" : "Off") << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenImageIOWriter::Write()
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
int vtkOpenImageIOWriter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  const Job job{ this, vtkImageData::GetData(inputVector[0], 0),
    this->FileName ? this->FileName : "", this->PixelType,
    this->Compression ? this->Compression : "", this->Quality, this->Staging };
  this->ErrorCode = relief::io::GuardWriting(this, job.FileName, [&] { WriteWholeFile(job); });
  // Success in any case: the pipeline would add an error of its own that says nothing more.
  return 1;
}
