// SPDX-License-Identifier: BSD-3-Clause
#include "TileStore.h"

#include "Gdal.h"
#include "GeoTiffWriter.h"
#include "HeightHash.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <cpl_conv.h>
#include <gdal_priv.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <regex>
#include <vector>

namespace fs = std::filesystem;

namespace relief::streaming
{
namespace
{
using raster::GdalErrors;

constexpr const char* HashItem = "RELIEF_HASH";
constexpr const char* NoteItem = "RELIEF_NOTE";

//------------------------------------------------------------------------------
std::string NameOf(const int extent[6])
{
  const auto range = [](int first, int last)
  { return std::to_string(first) + "-" + std::to_string(last); };
  const std::string name = range(extent[0], extent[1]) + "_" + range(extent[2], extent[3]);
  return extent[4] == 0 ? name : name + "_" + std::to_string(extent[4]);
}

bool IsPiece(const std::string& name)
{
  static const std::regex form("-?[0-9]+--?[0-9]+_-?[0-9]+--?[0-9]+(_-?[0-9]+)?");
  return std::regex_match(name, form);
}

/// A piece that is being written, or taken away.
bool IsUnfinished(const std::string& name)
{
  const std::size_t end = name.find('.', 1);
  static const std::regex form("\\.[0-9a-f]{16}\\.tmp");
  return name.size() > 1 && name[0] == '.' && end != std::string::npos &&
    IsPiece(name.substr(1, end - 1)) && std::regex_match(name.substr(end), form);
}

//------------------------------------------------------------------------------
/// The file of an array; what no file's name should have is written as %2F.
std::string FileOf(const std::string& array)
{
  std::string name;
  for (const char c : array)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
      c == '_' || c == '-';
    name += plain
      ? std::string(1, c)
      : std::string("%") + "0123456789ABCDEF"[byte >> 4] + "0123456789ABCDEF"[byte & 15];
  }
  return name + ".tif";
}

//------------------------------------------------------------------------------
/// Removes a folder and the arrays in it. What else somebody has put there stays.
void RemovePiece(const fs::path& folder)
{
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
  {
    if (entry.path().extension() == ".tif")
    {
      fs::remove(entry.path(), ignored);
    }
  }
  fs::remove(folder, ignored);
}

//------------------------------------------------------------------------------
/// A name beside a piece's that nobody else has, on any machine that shares the folder.
fs::path FreeName(const fs::path& folder, const std::string& piece)
{
  std::random_device random;
  const std::uint64_t number = (static_cast<std::uint64_t>(random()) << 32) | random();
  return folder / ("." + piece + "." + HashText(number) + ".tmp");
}

/// Moves a piece out of the way at once, then removes it.
void Discard(const fs::path& folder, const std::string& piece)
{
  const fs::path away = FreeName(folder, piece);
  std::error_code code;
  fs::rename(folder / piece, away, code);
  if (!code)
  {
    RemovePiece(away);
  }
}

//------------------------------------------------------------------------------
/// A piece's folder, under a name of its own until it is whole; gone if it never is.
class UnfinishedPiece
{
public:
  UnfinishedPiece(const fs::path& folder, const std::string& piece)
    : Folder(folder)
    , Piece(piece)
    , Place(FreeName(folder, piece))
  {
    std::error_code code;
    if (!fs::create_directory(this->Place, code))
    {
      throw io::Failure(vtkErrorCode::CannotOpenFileError,
        "cannot be written: " + (code ? code.message() : "its temporary name is taken"));
    }
  }
  ~UnfinishedPiece()
  {
    if (!this->Kept)
    {
      RemovePiece(this->Place);
    }
  }
  UnfinishedPiece(const UnfinishedPiece&) = delete;
  void operator=(const UnfinishedPiece&) = delete;

  const fs::path& Path() const { return this->Place; }

  void Keep()
  {
    std::error_code code;
    if (fs::exists(this->Folder / this->Piece, code))
    {
      Discard(this->Folder, this->Piece);
    }
    fs::rename(this->Place, this->Folder / this->Piece, code);
    if (code)
    {
      throw io::Failure(vtkErrorCode::CannotOpenFileError, "cannot be kept: " + code.message());
    }
    this->Kept = true;
  }

private:
  fs::path Folder;
  std::string Piece;
  fs::path Place;
  bool Kept = false;
};

//------------------------------------------------------------------------------
/// The bits of an image's note as a text; empty if it has none.
std::string NoteOf(vtkImageData* piece)
{
  vtkDataArray* note = piece->GetFieldData()->GetArray(TileStore::Note);
  if (!note)
  {
    return std::string();
  }
  const double value = note->GetTuple1(0);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return HashText(bits);
}

void AddNote(const std::string& text, vtkImageData* piece)
{
  const std::uint64_t bits = std::strtoull(text.c_str(), nullptr, 16);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  vtkNew<vtkDoubleArray> note;
  note->SetName(TileStore::Note);
  note->InsertNextValue(value);
  piece->GetFieldData()->AddArray(note);
}

//------------------------------------------------------------------------------
/// Of an array's numbers, of what they are, of where in the image, and of its note.
std::uint64_t HashOf(vtkDataArray* array, const int extent[6], const std::string& note)
{
  std::uint64_t hash = MixHash(static_cast<std::uint64_t>(array->GetDataType()),
    static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  for (int k = 0; k < 6; ++k)
  {
    hash = MixHash(hash, static_cast<std::uint64_t>(extent[k]));
  }
  const auto* bytes = static_cast<const unsigned char*>(array->GetVoidPointer(0));
  const std::size_t size =
    static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
  std::uint64_t word = 0;
  std::size_t at = 0;
  for (; at + sizeof word <= size; at += sizeof word)
  {
    std::memcpy(&word, bytes + at, sizeof word);
    hash = MixHash(hash, word);
  }
  word = 0;
  std::memcpy(&word, bytes + at, size - at);
  hash = MixHash(MixHash(hash, word), size);
  return note.empty() ? hash : MixHash(hash, std::strtoull(note.c_str(), nullptr, 16));
}

//------------------------------------------------------------------------------
std::array<int, 2> SizeOf(const int extent[6])
{
  return { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1 };
}

//------------------------------------------------------------------------------
/// Opens one of these files; throws a Failure where it is none.
raster::DatasetPointer OpenArray(const std::string& file)
{
  const char* const drivers[] = { "GTiff", nullptr };
  const char* const noFilesBeside[] = { nullptr };
  // Straight from the file, not by way of GDAL's cache.
  const CPLConfigOptionSetter direct("GTIFF_DIRECT_IO", "YES", true);
  raster::DatasetPointer dataset(GDALDataset::Open(
    file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, drivers, nullptr, noFilesBeside));
  if (!dataset)
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, GdalErrors::Take("is no TIFF that was written here", file));
  }
  return dataset;
}

//------------------------------------------------------------------------------
/// Reads rows of all bands as they lie in memory.
void ReadRows(GDALDataset* dataset, int first, int rows, void* values, const std::string& file)
{
  const GDALDataType type = dataset->GetRasterBand(1)->GetRasterDataType();
  const int columns = dataset->GetRasterXSize();
  const int bands = dataset->GetRasterCount();
  const GSpacing sample = GDALGetDataTypeSizeBytes(type);
  const CPLErr error = dataset->RasterIO(GF_Read, 0, first, columns, rows, values, columns, rows,
    type, bands, nullptr, bands * sample, bands * sample * columns, sample, nullptr);
  if (error != CE_None || GdalErrors::Any())
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, GdalErrors::Take("its samples cannot be read", file));
  }
}

//------------------------------------------------------------------------------
void WriteArray(
  const std::string& file, vtkDataArray* array, const int extent[6], const std::string& note)
{
  const std::array<int, 2> size = SizeOf(extent);
  const int components = array->GetNumberOfComponents();
  raster::GeoReference reference;
  reference.Metadata[HashItem] = HashText(HashOf(array, extent, note));
  if (!note.empty())
  {
    reference.Metadata[NoteItem] = note;
  }
  raster::GeoTiffForm form;
  form.Compression = raster::GeoTiffForm::None;
  if (array->GetDataType() == VTK_FLOAT)
  {
    // Blocks of nothing else are not stored: of no data that has one pattern of bits alone, so that
    // neither the kinds of NaN nor -0 are lost.
    form.NoData = std::numeric_limits<float>::lowest();
  }
  const std::ptrdiff_t bytes =
    static_cast<std::ptrdiff_t>(size[0]) * components * array->GetDataTypeSize();
  raster::GeoTiffFile tiff(file, size.data(), components, array->GetDataType(), reference, form);
  tiff.Write(size[1], array->GetVoidPointer(0), bytes);
  tiff.Finish(io::StepWatcher());

  // The last row is the file's end: whether it is there is not always told.
  const GdalErrors errors;
  std::vector<char> row(static_cast<std::size_t>(bytes));
  ReadRows(OpenArray(file).get(), size[1] - 1, 1, row.data(), file);
  const char* last = static_cast<const char*>(array->GetVoidPointer(0)) + (size[1] - 1) * bytes;
  if (std::memcmp(row.data(), last, row.size()) != 0)
  {
    throw io::Failure(vtkErrorCode::OutOfDiskSpaceError,
      "cannot be written: its end is missing, perhaps for want of space");
  }
}

//------------------------------------------------------------------------------
/// Throws a Failure where anything is not as it was written.
vtkSmartPointer<vtkDataArray> ReadArray(
  const std::string& file, const int extent[6], std::string& note)
{
  const GdalErrors errors;
  const raster::DatasetPointer dataset = OpenArray(file);
  const auto wrong = [](const char* what)
  { return io::Failure(vtkErrorCode::FileFormatError, what); };
  const std::array<int, 2> size = SizeOf(extent);
  const int components = dataset->GetRasterCount();
  if (dataset->GetRasterXSize() != size[0] || dataset->GetRasterYSize() != size[1] ||
    components < 1)
  {
    throw wrong("its size is another");
  }
  const GDALDataType type = dataset->GetRasterBand(1)->GetRasterDataType();
  if (type != GDT_Byte && type != GDT_Float32)
  {
    throw wrong("its type of numbers is another");
  }
  // Before memory is taken, of which a damaged header may want any amount.
  std::error_code code;
  const double bytes = 1.0 * size[0] * size[1] * components * GDALGetDataTypeSizeBytes(type);
  if (bytes > static_cast<double>(fs::file_size(file, code)) || code)
  {
    throw wrong("its end is missing");
  }
  vtkSmartPointer<vtkDataArray> array;
  if (type == GDT_Byte)
  {
    array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  }
  else
  {
    array = vtkSmartPointer<vtkFloatArray>::New();
  }
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(size[0]) * size[1]);
  ReadRows(dataset.get(), 0, size[1], array->GetVoidPointer(0), file);
  const char* hash = dataset->GetMetadataItem(HashItem);
  const char* noted = dataset->GetMetadataItem(NoteItem);
  note = noted ? noted : "";
  if (!hash || hash != HashText(HashOf(array, extent, note)))
  {
    throw wrong("its samples are not those that were written");
  }
  return array;
}

//------------------------------------------------------------------------------
/// What is wrong with a piece, for whoever reads it with the folder's name.
std::string About(const fs::path& folder, const std::string& piece, const std::string& reason)
{
  return io::Shortened((folder / piece).string(), io::LongestName) + ": " + reason;
}
}

//------------------------------------------------------------------------------
TileStore::TileStore(const std::string& folder, const std::string& key, RunFolder::Part part)
  : Folder(folder, key, part)
{
  if (this->Folder.IsFirst())
  {
    std::error_code code;
    std::vector<fs::path> unfinished;
    for (const auto& entry : fs::directory_iterator(this->Folder.Path(), code))
    {
      if (IsUnfinished(entry.path().filename().string()))
      {
        unfinished.push_back(entry.path());
      }
    }
    for (const fs::path& piece : unfinished)
    {
      RemovePiece(piece);
    }
  }
}

//------------------------------------------------------------------------------
bool TileStore::Has(const int extent[6]) const
{
  std::error_code ignored;
  return fs::is_directory(this->Folder.Path() / NameOf(extent), ignored);
}

//------------------------------------------------------------------------------
void TileStore::Save(vtkImageData* piece) const
{
  int extent[6];
  piece->GetExtent(extent);
  const std::string name = NameOf(extent);
  try
  {
    io::CheckImage(name, piece, false);
    UnfinishedPiece unfinished(this->Folder.Path(), name);
    vtkPointData* data = piece->GetPointData();
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* array = data->GetArray(k);
      if (!array ||
        (array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_UNSIGNED_CHAR))
      {
        throw io::Failure(vtkErrorCode::UnknownError,
          "cannot be written: an array of it has numbers of neither float nor unsigned char");
      }
      const char* arrayName = array->GetName();
      WriteArray((unfinished.Path() / FileOf(arrayName ? arrayName : "")).string(), array, extent,
        NoteOf(piece));
    }
    unfinished.Keep();
  }
  catch (const io::Failure& failure)
  {
    throw io::Failure(failure.Code, About(this->Folder.Path(), name, failure.what()));
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> TileStore::Load(
  const int extent[6], const std::vector<std::string>& arrays) const
{
  const std::string name = NameOf(extent);
  auto piece = vtkSmartPointer<vtkImageData>::New();
  piece->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  try
  {
    std::string note;
    for (const std::string& arrayName : arrays)
    {
      const vtkSmartPointer<vtkDataArray> array =
        ReadArray((this->Folder.Path() / name / FileOf(arrayName)).string(), extent, note);
      array->SetName(arrayName.empty() ? nullptr : arrayName.c_str());
      if (piece->GetPointData()->GetNumberOfArrays() == 0)
      {
        piece->GetPointData()->SetScalars(array);
      }
      else
      {
        piece->GetPointData()->AddArray(array);
      }
    }
    if (!note.empty())
    {
      AddNote(note, piece);
    }
  }
  catch (const io::Failure& failure)
  {
    Discard(this->Folder.Path(), name);
    throw TileDamaged(
      failure.Code, About(this->Folder.Path(), name, std::string("is damaged: ") + failure.what()));
  }
  return piece;
}

//------------------------------------------------------------------------------
void TileStore::Remove()
{
  std::error_code ignored;
  std::vector<fs::path> pieces;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(this->Folder.Path(), ignored))
  {
    const std::string name = entry.path().filename().string();
    if (IsPiece(name) || IsUnfinished(name))
    {
      pieces.push_back(entry.path());
    }
    else if (RunFolder::UnfinishedOf(name) == RunFolder::KeyName)
    {
      files.push_back(entry.path());
    }
  }
  for (const fs::path& piece : pieces)
  {
    RemovePiece(piece);
  }
  for (const fs::path& file : files)
  {
    fs::remove(file, ignored);
  }
  this->Folder.Remove();
}
}
