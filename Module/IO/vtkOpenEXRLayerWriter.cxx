// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRLayerWriter.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"

#include "FileGuard.h"
#include "LayerFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

vtkStandardNewMacro(vtkOpenEXRLayerWriter);

void vtkOpenEXRLayerWriter::SetDWACompressionLevel(double value)
{
  relief::SetNumber(this, this->DWACompressionLevel, value, value >= 0.0,
    "a finite number of at least 0", "DWACompressionLevel");
}

namespace
{
using relief::io::LayerFile;
using relief::io::LayerForm;

const size_t LongestName = 255; // OpenEXR cuts off what is longer
}

//------------------------------------------------------------------------------
vtkOpenEXRLayerWriter::vtkOpenEXRLayerWriter() = default;

//------------------------------------------------------------------------------
vtkOpenEXRLayerWriter::~vtkOpenEXRLayerWriter() = default;

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetScene(vtkReliefScene* scene)
{
  if (this->Scene != scene)
  {
    this->Scene = scene;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkOpenEXRLayerWriter::GetScene()
{
  return this->Scene;
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetNoDataValue(double value)
{
  if (std::isinf(value))
  {
    vtkErrorMacro("SetNoDataValue: " << value << " was given, a finite number or NaN is expected; "
                                     << this->NoDataValue << " is kept.");
    return;
  }
  if (this->NoDataValue != value && !(std::isnan(this->NoDataValue) && std::isnan(value)))
  {
    this->NoDataValue = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::SetAttribute(const std::string& name, const char* text)
{
  // What OpenEXR itself writes or reads the file by; under these names a text would break it.
  static const std::set<std::string> structure = { "channels", "chromaticities", "chunkCount",
    "compression", "dataWindow", "deepImageState", "displayWindow", "dwaCompressionLevel", "envmap",
    "lineOrder", "multiView", "name", "pixelAspectRatio", "preview", "screenWindowCenter",
    "screenWindowWidth", "tiles", "type", "version", "view" };
  if (name.empty() || name.size() > LongestName || structure.count(name) ||
    name.compare(0, 7, "relief:") == 0)
  {
    vtkErrorMacro("SetAttribute: \""
      << name << "\" was given, a name of 1 to " << LongestName
      << " characters is expected that neither begins with \"relief:\" nor describes the file's "
         "structure; nothing is set.");
    return;
  }
  const char* old = this->GetAttribute(name);
  if (!text && old)
  {
    this->Attributes.erase(name);
    this->Modified();
  }
  else if (text && (!old || std::strcmp(text, old) != 0))
  {
    this->Attributes[name] = text;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkOpenEXRLayerWriter::GetAttribute(const std::string& name)
{
  const auto found = this->Attributes.find(name);
  return found == this->Attributes.end() ? nullptr : found->second.c_str();
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::RemoveAllAttributes()
{
  if (!this->Attributes.empty())
  {
    this->Attributes.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkOpenEXRLayerWriter::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Scene ? std::max(time, this->Scene->GetMTime()) : time;
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  static const char* const compressions[] = { "None", "ZIPS", "ZIP", "PIZ", "DWAA" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene:" << (this->Scene ? "\n" : " (none)\n");
  if (this->Scene)
  {
    this->Scene->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "PixelType: " << (this->PixelType == Half ? "Half" : "Float") << "\n";
  os << indent << "Compression: " << compressions[this->Compression] << "\n";
  os << indent << "DWACompressionLevel: " << this->DWACompressionLevel << "\n";
  os << indent << "Tiled: " << (this->Tiled ? "On" : "Off") << "\n";
  os << indent << "TileSize: " << this->TileSize << "\n";
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  os << indent << "Staging: " << (this->Staging ? "On" : "Off") << "\n";
  os << indent << "Attributes:\n";
  for (const auto& attribute : this->Attributes)
  {
    os << indent.GetNextIndent() << attribute.first << ": " << attribute.second << "\n";
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRLayerWriter::Write()
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
int vtkOpenEXRLayerWriter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* vtkNotUsed(outputVector))
{
  const std::string name = this->FileName ? this->FileName : "";
  vtkImageData* image = vtkImageData::GetData(inputVector[0], 0);
  vtkIdType clamped = 0;
  this->ErrorCode = relief::io::GuardWriting(this, name,
    [&]
    {
      relief::io::CheckImage(name, image);
      LayerForm form;
      form.Half = this->PixelType == Half;
      form.Compression = this->Compression;
      form.DWALevel = this->DWACompressionLevel;
      form.TileSize = this->Tiled ? this->TileSize : 0;
      form.NoData = this->NoDataValue;
      form.Scene = this->Scene;
      form.Attributes = this->Attributes;
      LayerFile file(name, this->Staging, image, form);
      file.Write(image,
        [this](double share)
        {
          this->UpdateProgress(share);
          return !this->GetAbortExecute();
        });
      file.Finish();
      clamped = file.GetNumberOfClamped();
    });
  if (clamped > 0)
  {
    vtkWarningMacro(<< clamped << " values are too large for the numbers in \"" << name
                    << "\" and became the largest that these hold"
                    << (this->PixelType == Half ? ", 65504; SetPixelTypeToFloat holds more."
                                                : "."));
  }
  // Success in any case: the pipeline would add an error of its own that says nothing more.
  return 1;
}
