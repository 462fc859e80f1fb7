// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefPieceWriter.h"

#include "FileGuard.h"
#include "GeoTiffWriter.h"
#include "PiecePlan.h"
#include "RasterFieldData.h"
#include "RunKeys.h"
#include "StagedFile.h"
#include "TileStore.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

using relief::io::Failure;
using relief::io::StagedFile;
using relief::raster::GeoTiffFile;
using relief::streaming::PieceExtent;
using relief::streaming::PiecePlan;
using relief::streaming::TileStore;

vtkStandardNewMacro(vtkReliefPieceWriter);

//------------------------------------------------------------------------------
// A run, from Begin() to Finish().
struct vtkReliefPieceWriter::Internals
{
  explicit Internals(vtkReliefPieceWriter* self)
    : Self(self)
  {
  }

  void Open();
  void Check() const;
  void WriteFiles();
  vtkSmartPointer<vtkImageData> Shade(const PieceExtent& piece) const;
  vtkSmartPointer<vtkImageData> Load(const PieceExtent& piece) const;
  std::string FileOf(const std::string& array) const;

  vtkReliefPieceWriter* Self;
  vtkNew<vtkImageData> Place; // of the whole, without any samples
  relief::raster::GeoReference Reference;
  std::vector<std::string> Arrays;
  PiecePlan Plan;
  std::vector<PieceExtent> Missing; // when the run began
  std::unique_ptr<TileStore> Store;
};

namespace
{
//------------------------------------------------------------------------------
/// A file that is written beside the others.
struct Output
{
  Output(const std::string& file)
    : File(file)
  {
  }
  StagedFile File;
  std::unique_ptr<GeoTiffFile> Rows;
};

//------------------------------------------------------------------------------
/// What a shaded sample takes.
double BytesOf(vtkImageReliefShading* shading, const std::vector<std::string>& arrays)
{
  double bytes = 0.0;
  for (const std::string& array : arrays)
  {
    const bool number = array == "Illumination" || array == "Thickness" || array == "Shadow";
    bytes += array != "Shading"                     ? (number ? 4.0 : 12.0)
      : shading->GetOutputScalarType() == VTK_FLOAT ? 16.0
                                                    : 4.0;
  }
  return bytes;
}

//------------------------------------------------------------------------------
/// Writes an array's rows, which go to the file in its order.
void WriteRows(vtkImageData* band, const std::string& array, bool upward, GeoTiffFile& file)
{
  vtkDataArray* values = band->GetPointData()->GetArray(array.c_str());
  int size[3];
  band->GetDimensions(size);
  const std::ptrdiff_t bytes = static_cast<std::ptrdiff_t>(size[0]) *
    values->GetNumberOfComponents() * values->GetDataTypeSize();
  const char* first = static_cast<const char*>(values->GetVoidPointer(0));
  upward ? file.Write(size[1], first, bytes)
         : file.Write(size[1], first + (size[1] - 1) * bytes, -bytes);
}
}

//------------------------------------------------------------------------------
vtkReliefPieceWriter::vtkReliefPieceWriter()
  : MemoryLimit(relief::io::PhysicalMemory())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(0);
}

//------------------------------------------------------------------------------
vtkReliefPieceWriter::~vtkReliefPieceWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::SetShading(vtkImageReliefShading* shading)
{
  if (this->Shading != shading)
  {
    this->Shading = shading;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageReliefShading* vtkReliefPieceWriter::GetShading()
{
  return this->Shading;
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::SetProcess(int process, int processes)
{
  if (process < 0 || process >= processes)
  {
    vtkErrorMacro("SetProcess: " << process << " of " << processes
                                 << " was given, one from 0 and below their number is expected; "
                                 << this->Process << " of " << this->NumberOfProcesses
                                 << " is kept.");
    return;
  }
  if (this->Process != process || this->NumberOfProcesses != processes)
  {
    this->Process = process;
    this->NumberOfProcesses = processes;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkReliefPieceWriter::GetNumberOfPieces()
{
  return this->Internal ? static_cast<int>(this->Internal->Plan.GetPieces().size()) : 0;
}

//------------------------------------------------------------------------------
/// Ends a step that is to be ended.
void vtkReliefPieceWriter::GoOn(double share)
{
  this->UpdateProgress(share);
  if (this->GetAbortExecute())
  {
    throw relief::io::Aborted();
  }
}

//------------------------------------------------------------------------------
/// Takes a step; where it fails, the run is over.
bool vtkReliefPieceWriter::Try(const std::function<void()>& step)
{
  if (this->GetAbortExecute())
  {
    this->SetAbortExecute(0); // it was about another step
  }
  // Assigned, not set: SetErrorCode would mark the writer as modified.
  this->ErrorCode = relief::io::GuardWriting(this, this->FileName ? this->FileName : "", step);
  if (this->ErrorCode != vtkErrorCode::NoError)
  {
    this->Internal.reset();
  }
  return this->ErrorCode == vtkErrorCode::NoError;
}

//------------------------------------------------------------------------------
std::string vtkReliefPieceWriter::Internals::FileOf(const std::string& array) const
{
  if (array == this->Arrays.front())
  {
    return this->Self->FileName;
  }
  std::string layer = array;
  layer[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(layer[0])));
  std::filesystem::path file(this->Self->FileName);
  return file.replace_filename(file.stem().string() + "-" + layer + file.extension().string())
    .string();
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::Internals::Check() const
{
  if (!this->Self->FileName || !*this->Self->FileName)
  {
    throw Failure(vtkErrorCode::NoFileNameError, "no file name is set");
  }
  if (!relief::io::IsTiff(this->Self->FileName))
  {
    throw Failure(vtkErrorCode::UnrecognizedFileTypeError,
      "pieces are put together as GeoTIFF; a name that ends in .tif is expected");
  }
  if (!this->Self->Shading)
  {
    throw Failure(vtkErrorCode::UnknownError, "there is no shading; SetShading() gives it");
  }
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::Internals::Open()
{
  this->Check();
  vtkImageReliefShading* shading = this->Self->Shading;
  const std::string key = relief::streaming::KeyOfShading(shading);
  if (key.empty())
  {
    throw relief::io::Aborted(); // it has been reported
  }
  auto* heights = vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0));
  this->Place->CopyStructure(heights);
  this->Reference = relief::raster::FindReference(heights->GetFieldData(), this->Place);
  this->Arrays = relief::streaming::ArraysOf(shading);
  this->Plan = PiecePlan(shading, this->Place->GetExtent(),
    1024.0 * static_cast<double>(this->Self->MemoryLimit), BytesOf(shading, this->Arrays));
  if (!this->Plan.Fits())
  {
    const double wanted =
      this->Plan.MemoryFor(this->Plan.FindLargest(shading, BytesOf(shading, this->Arrays)));
    throw Failure(vtkErrorCode::UnknownError,
      "MemoryLimit: the least piece, " + std::to_string(this->Plan.GetColumns()) + " x " +
        std::to_string(this->Plan.GetRows()) + " samples, takes more; give at least " +
        std::to_string(static_cast<long long>(std::ceil(wanted / 1024.0))) + " KiB");
  }
  using relief::streaming::RunFolder;
  this->Store = std::make_unique<TileStore>(std::string(this->Self->FileName) + ".parts",
    key + "pieces: " + std::to_string(this->Plan.GetColumns()) + " x " +
      std::to_string(this->Plan.GetRows()) + "\n",
    this->Self->Process == 0 ? RunFolder::Alone : RunFolder::Joined);
  for (const PieceExtent& piece : this->Plan.GetPieces())
  {
    if (!this->Store->Has(piece.data()))
    {
      this->Missing.push_back(piece);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkReliefPieceWriter::Begin()
{
  this->NumberOfShadedPieces = 0;
  this->Internal = std::make_unique<Internals>(this);
  return this->Try([this] { this->Internal->Open(); });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> vtkReliefPieceWriter::Internals::Shade(const PieceExtent& piece) const
{
  vtkImageReliefShading* shading = this->Self->Shading;
  shading->UpdateExtent(piece.data());
  vtkImageData* shaded = shading->GetOutput();
  if (!std::equal(piece.begin(), piece.end(), shaded->GetExtent()) ||
    !shaded->GetPointData()->GetScalars())
  {
    throw relief::io::Aborted(); // it has been reported
  }
  return shaded;
}

//------------------------------------------------------------------------------
bool vtkReliefPieceWriter::Shade()
{
  return this->Try(
    [this]
    {
      if (!this->Internal)
      {
        throw Failure(vtkErrorCode::UnknownError, "Shade() comes after Begin()");
      }
      const Internals& run = *this->Internal;
      const std::vector<PieceExtent> share = relief::streaming::ShareOf(
        this->Shading, run.Missing, this->Process, this->NumberOfProcesses);
      this->NumberOfShadedPieces = 0;
      this->GoOn(0.0);
      for (const PieceExtent& piece : share)
      {
        run.Store->Save(run.Shade(piece));
        ++this->NumberOfShadedPieces;
        this->GoOn(
          static_cast<double>(this->NumberOfShadedPieces) / static_cast<double>(share.size()));
      }
    });
}

//------------------------------------------------------------------------------
/// A piece from the disk. One that is damaged is shaded again.
vtkSmartPointer<vtkImageData> vtkReliefPieceWriter::Internals::Load(const PieceExtent& piece) const
{
  try
  {
    return this->Store->Load(piece.data(), this->Arrays);
  }
  catch (const relief::streaming::TileDamaged& damage)
  {
    vtkWarningWithObjectMacro(this->Self, << damage.what() << "; it is shaded again.");
  }
  const vtkSmartPointer<vtkImageData> again = this->Shade(piece);
  this->Store->Save(again);
  return again;
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::Internals::WriteFiles()
{
  relief::raster::GeoTiffForm form;
  form.CloudOptimized = this->Self->CloudOptimized;
  form.Overviews = this->Self->Overviews;
  const bool upward = this->Reference.Present && this->Reference.SouthUp;
  const int* size = this->Place->GetDimensions();
  const relief::io::StepWatcher goOn = [this](double) { return !this->Self->GetAbortExecute(); };
  std::vector<std::unique_ptr<Output>> outputs;
  for (const std::string& array : this->Arrays)
  {
    relief::streaming::RunFolder::RemoveUnfinished(this->FileOf(array));
    outputs.push_back(std::make_unique<Output>(this->FileOf(array)));
  }
  const int bands = this->Plan.GetNumberOfBands();
  for (int k = 0; k < bands; ++k)
  {
    const vtkSmartPointer<vtkImageData> band = this->Plan.LoadBand(upward ? k : bands - 1 - k,
      this->Arrays, [this](const PieceExtent& piece) { return this->Load(piece); });
    for (std::size_t a = 0; a < outputs.size(); ++a)
    {
      Output& output = *outputs[a];
      vtkDataArray* values = band->GetPointData()->GetArray(this->Arrays[a].c_str());
      if (!output.Rows)
      {
        output.Rows = std::make_unique<GeoTiffFile>(output.File.Name(), size,
          values->GetNumberOfComponents(), values->GetDataType(), this->Reference, form);
      }
      WriteRows(band, this->Arrays[a], upward, *output.Rows);
    }
    this->Self->GoOn((k + 1.0) / (bands + 1.0));
  }
  std::vector<StagedFile*> staged;
  for (const std::unique_ptr<Output>& output : outputs)
  {
    output->Rows->Finish(goOn);
    output->Rows.reset();
    staged.push_back(&output->File);
  }
  std::string reason;
  if (const StagedFile* failed = StagedFile::KeepAll(staged, reason))
  {
    throw Failure(vtkErrorCode::CannotOpenFileError, failed->Target() + ": " + reason);
  }
  this->Self->UpdateProgress(1.0);
}

//------------------------------------------------------------------------------
bool vtkReliefPieceWriter::Finish()
{
  const bool done = this->Try(
    [this]
    {
      if (!this->Internal)
      {
        throw Failure(vtkErrorCode::UnknownError, "Finish() comes after Begin() and Shade()");
      }
      if (this->Process == 0)
      {
        this->Internal->WriteFiles();
        this->Internal->Store->Remove();
      }
    });
  this->Internal.reset();
  return done;
}

//------------------------------------------------------------------------------
bool vtkReliefPieceWriter::Write()
{
  if (this->NumberOfProcesses > 1)
  {
    return this->Try(
      []
      {
        throw Failure(vtkErrorCode::UnknownError,
          "Write() is of one process; several take Begin(), Shade() and Finish()");
      });
  }
  return this->Begin() && this->Shade() && this->Finish();
}

//------------------------------------------------------------------------------
void vtkReliefPieceWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shading: " << this->Shading << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Process: " << this->Process << " of " << this->NumberOfProcesses << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
  os << indent << "CloudOptimized: " << (this->CloudOptimized ? "On\n" : "Off\n");
  os << indent << "Overviews: " << (this->Overviews ? "On\n" : "Off\n");
  os << indent << "NumberOfShadedPieces: " << this->NumberOfShadedPieces << "\n";
}
