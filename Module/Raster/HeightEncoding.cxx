// SPDX-License-Identifier: BSD-3-Clause
#include "HeightEncoding.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace relief::raster
{
namespace
{
/// In metres.
float HeightOf(HeightEncoding encoding, unsigned int code)
{
  // One rounding: a tenth is no number of two's powers.
  return static_cast<float>(
    encoding == HeightEncoding::Terrarium ? code / 256.0 - 32768.0 : code / 10.0 - 10000.0);
}

using Bands = std::array<std::unique_ptr<RasterFile>, 3>;

//------------------------------------------------------------------------------
class EncodedFile : public RasterFile
{
public:
  EncodedFile(Bands bands, HeightEncoding encoding)
    : Colors(std::move(bands))
    , Encoding(encoding)
  {
    this->Header = this->Colors[0]->GetHeader();
    MakeHeader(this->Header);
  }

  Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) override;
  bool HasWindows() const override
  {
    return std::all_of(this->Colors.begin(), this->Colors.end(),
      [](const std::unique_ptr<RasterFile>& band) { return band->HasWindows(); });
  }
  Raster ReadWindow(const Window& window) override;
  double GetReadingBytes() const override
  {
    const double samples = 1.0 * this->Header.Columns * this->Header.Rows;
    return samples * (sizeof(unsigned int) + this->Colors.size());
  }

private:
  using ReadBand = std::function<Raster(std::size_t band)>;
  Raster Decode(const ReadBand& read) const;

  static void MakeHeader(RasterHeader& header)
  {
    header.ScalarType = VTK_FLOAT;
    header.NoData.reset();
    header.Scale = 1.0;
    header.Offset = 0.0;
    header.HeightUnit = 1.0;
  }

  Bands Colors;
  HeightEncoding Encoding;
};

//------------------------------------------------------------------------------
Raster EncodedFile::Decode(const ReadBand& read) const
{
  vtkNew<vtkUnsignedIntArray> codes;
  Raster raster;
  for (std::size_t k = 0; k < this->Colors.size(); ++k)
  {
    const Raster band = read(k);
    if (band.Heights->GetScalarType() != VTK_UNSIGNED_CHAR)
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        std::string("its bands are of the type ") + band.Heights->GetScalarTypeAsString() +
          "; heights in three bytes have bytes");
    }
    const auto* bytes = static_cast<const unsigned char*>(band.Heights->GetScalarPointer());
    if (k == 0)
    {
      raster = band;
      MakeHeader(raster);
      codes->SetNumberOfValues(band.Heights->GetNumberOfPoints());
      std::fill_n(codes->GetPointer(0), codes->GetNumberOfValues(), 0);
    }
    unsigned int* values = codes->GetPointer(0);
    for (vtkIdType i = 0; i < codes->GetNumberOfValues(); ++i)
    {
      values[i] = values[i] << 8 | bytes[i];
    }
  }
  // Three bytes are one whole number, of the smallest steps that the encoding has.
  vtkNew<vtkFloatArray> heights;
  heights->SetNumberOfValues(codes->GetNumberOfValues());
  for (vtkIdType i = 0; i < codes->GetNumberOfValues(); ++i)
  {
    heights->SetValue(i, HeightOf(this->Encoding, codes->GetValue(i)));
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(raster.Heights);
  image->GetPointData()->SetScalars(heights);
  raster.Heights = image;
  return raster;
}

//------------------------------------------------------------------------------
Raster EncodedFile::Read(const MemoryPlan& plan, const io::StepWatcher& watcher)
{
  return this->Decode(
    [&](std::size_t k)
    {
      // The codes and the heights come with the first band, with all that the caller makes of them.
      MemoryPlan whole{ plan.Budget };
      whole.PerPixel =
        k == 0 ? plan.PerPixel + plan.Copies * sizeof(float) + sizeof(unsigned int) : 0.0;
      return this->Colors[k]->Read(whole,
        [&watcher, k](double share)
        { return !watcher || watcher((static_cast<double>(k) + share) / 3.0); });
    });
}

//------------------------------------------------------------------------------
Raster EncodedFile::ReadWindow(const Window& window)
{
  return this->Decode([&](std::size_t k) { return this->Colors[k]->ReadWindow(window); });
}
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> OpenEncoded(const ReadOptions& options, const OpenFile& open)
{
  if (options.Encoding == HeightEncoding::None)
  {
    return open(options);
  }
  Bands bands;
  for (std::size_t k = 0; k < bands.size(); ++k)
  {
    ReadOptions band = options;
    band.Band = static_cast<int>(k) + 1;
    try
    {
      bands[k] = open(band);
    }
    catch (const io::Failure& failure)
    {
      if (k == 0)
      {
        throw;
      }
      throw io::Failure(failure.Code,
        "heights in three bytes have red, green and blue, and " + std::string(failure.what()));
    }
    if (!bands[k])
    {
      return nullptr;
    }
  }
  return std::make_unique<EncodedFile>(std::move(bands), options.Encoding);
}
}
