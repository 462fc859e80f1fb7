// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPicture.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include "FileGuard.h"
#include "RadianceHeader.h"
#include "Refusals.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

namespace relief::io
{
namespace
{
/// Throws a Failure unless there is a Radiance picture that can be read. Without OpenImageIO there
/// is no other format with numbers as large as the sun's.
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
    RefuseFormat("its lines do not go from the top, from left to right (-Y +X); turn it upright");
  }
  if (header.Columns <= 0 || header.Rows <= 0)
  {
    RefuseFormat("its header is damaged: it has no size as \"-Y 512 +X 1024\"");
  }
  if (12.0 * header.Columns * header.Rows / 1024.0 > static_cast<double>(PhysicalMemory()))
  {
    RefuseFormat("its header gives " + std::to_string(header.Columns) + " x " +
      std::to_string(header.Rows) + " pixels, which memory cannot hold");
  }
  return header;
}

//------------------------------------------------------------------------------
unsigned char TakeByte(std::istream& stream)
{
  const int byte = stream.get();
  if (!stream)
  {
    RefuseEnd("it ends early");
  }
  return static_cast<unsigned char>(byte);
}

/// One of a line's four components, in runs and in bytes that differ.
void TakeRuns(std::istream& stream, unsigned char* component, int columns)
{
  for (int i = 0; i < columns;)
  {
    const int code = TakeByte(stream);
    const int count = code > 128 ? code - 128 : code;
    if (count == 0 || count > columns - i)
    {
      RefuseFormat("it is damaged: a compressed line is not as long as the others");
    }
    const unsigned char repeated = code > 128 ? TakeByte(stream) : 0;
    for (const int end = i + count; i < end; ++i)
    {
      component[4 * i] = code > 128 ? repeated : TakeByte(stream);
    }
  }
}

/// A line's pixels, of red, green, blue and an exponent.
void TakeLine(std::istream& stream, std::vector<unsigned char>& pixels, int columns)
{
  std::generate_n(pixels.begin(), 4, [&] { return TakeByte(stream); });
  const bool compressed =
    columns >= 8 && columns < 32768 && pixels[0] == 2 && pixels[1] == 2 && pixels[2] < 128;
  if (!compressed)
  {
    std::generate(pixels.begin() + 4, pixels.end(), [&] { return TakeByte(stream); });
    return;
  }
  if (256 * pixels[2] + pixels[3] != columns)
  {
    RefuseFormat("it is damaged: a compressed line is not as long as the others");
  }
  for (int c = 0; c < 4; ++c)
  {
    TakeRuns(stream, pixels.data() + c, columns);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadRadiance(const std::string& fileName)
{
  const RadianceHeader header = CheckedHeader(fileName);
  vtksys::ifstream stream(fileName.c_str(), std::ios::binary);
  stream.seekg(header.Pixels);
  vtkNew<vtkFloatArray> colors;
  colors->SetNumberOfComponents(3);
  if (!colors->Allocate(3 * static_cast<vtkIdType>(header.Columns) * header.Rows))
  {
    throw std::bad_alloc();
  }
  colors->SetNumberOfTuples(static_cast<vtkIdType>(header.Columns) * header.Rows);
  std::vector<unsigned char> pixels(4 * static_cast<std::size_t>(header.Columns));
  for (int row = header.Rows - 1; row >= 0; --row)
  {
    TakeLine(stream, pixels, header.Columns);
    float* color = colors->GetPointer(3 * static_cast<vtkIdType>(header.Columns) * row);
    for (int i = 0; i < header.Columns; ++i, color += 3)
    {
      const unsigned char* pixel = pixels.data() + 4 * static_cast<std::size_t>(i);
      const float unit = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, pixel[3] - 136);
      for (int c = 0; c < 3; ++c)
      {
        const float stored = static_cast<float>(pixel[c]) * unit;
        color[c] = static_cast<float>(stored / header.Exposure[c]);
      }
    }
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(header.Columns, header.Rows, 1);
  image->GetPointData()->SetScalars(colors);
  return vtkSmartPointer<vtkImageData>(image.Get());
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
