// SPDX-License-Identifier: BSD-3-Clause

// The library that ImageFormats.cxx loads, or that is linked where libraries are static.

#include "LoadedFormats.h"

#include "DrawingPicture.h"
#include "LayerFile.h"
#include "TiledPicture.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkReliefMeshReader.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"

#include <utility>

namespace
{

class TiledRows : public reliefshade::PictureRows
{
public:
  TiledRows(const std::string& file, const int size[2], int components)
    : Picture(file, size, components)
  {
  }
  void Write(int rows, const void* first, std::ptrdiff_t bytes) override
  {
    this->Picture.Write(rows, first, bytes);
  }
  void Finish() override { this->Picture.Finish(); }

private:
  relief::io::TiledPicture Picture;
};

class LayersInRows : public reliefshade::LayerRows
{
public:
  LayersInRows(const std::string& file, vtkImageData* place, const relief::io::LayerForm& form,
    std::function<bool()> goOn)
    : File(file, false, place, form)
    , GoOn(std::move(goOn))
  {
  }
  void Write(vtkImageData* part) override
  {
    this->File.Write(part, [this](double) { return this->GoOn(); });
  }
  void Finish() override { this->File.Finish(); }

private:
  relief::io::LayerFile File;
  std::function<bool()> GoOn;
};

class LoadedFormats : public reliefshade::ImageFormats
{
public:
  vtkSmartPointer<vtkImageReader2> NewReader(Alpha alpha) const override
  {
    auto reader = vtkSmartPointer<vtkOpenImageIOReader>::New();
    reader->SetAlphaAsMask(alpha == Alpha::Mask);
    reader->SetStraightAlpha(alpha == Alpha::Straight);
    return reader;
  }

  void Choose(
    vtkImageReader2* reader, const std::string& part, const std::string& channel) const override
  {
    auto* chosen = vtkOpenImageIOReader::SafeDownCast(reader);
    const bool number = !part.empty() && part.size() < 7 &&
      part.find_first_not_of("0123456789") == std::string::npos && std::stoi(part) > 0;
    chosen->SetSubimage(number ? std::stoi(part) - 1 : 0);
    chosen->SetSubimageName(number || part.empty() ? nullptr : part.c_str());
    chosen->SetChannelName(channel.empty() ? nullptr : channel.c_str());
  }

  std::vector<std::string> ChannelNames(vtkImageReader2* reader) const override
  {
    auto* known = vtkOpenImageIOReader::SafeDownCast(reader);
    const int count = known->GetNumberOfFileChannels();
    std::vector<std::string> names(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c)
    {
      names[static_cast<std::size_t>(c)] = known->GetFileChannelName(c);
    }
    return names;
  }

  void SetMemoryLimit(vtkImageReader2* reader, vtkTypeInt64 limit) const override
  {
    vtkOpenImageIOReader::SafeDownCast(reader)->SetMemoryLimit(limit);
  }

  vtkSmartPointer<vtkPolyDataAlgorithm> NewMeshReader(const std::string& file) const override
  {
    auto reader = vtkSmartPointer<vtkReliefMeshReader>::New();
    reader->SetFileName(file.c_str());
    return reader;
  }

  std::vector<std::string> FilesBesideMesh(const std::string& file) const override
  {
    return vtkReliefMeshReader::GetFilesBeside(file);
  }

  vtkSmartPointer<vtkImageWriter> NewWriter() const override
  {
    auto writer = vtkSmartPointer<vtkOpenImageIOWriter>::New();
    writer->StagingOff();
    return writer;
  }

  std::unique_ptr<reliefshade::PictureRows> NewTiledPicture(
    const std::string& file, const int size[2], int components) const override
  {
    return std::make_unique<TiledRows>(file, size, components);
  }

  std::unique_ptr<reliefshade::LayerRows> NewLayerRows(const std::string& file, vtkImageData* place,
    vtkReliefScene* scene, const std::map<std::string, std::string>& attributes, bool tiled,
    const std::function<bool()>& goOn) const override
  {
    relief::io::LayerForm form;
    form.TileSize = tiled ? 64 : 0;
    form.Scene = scene;
    form.Attributes = attributes;
    return std::make_unique<LayersInRows>(file, place, form, goOn);
  }

  vtkSmartPointer<vtkImageData> Paint(const reliefshade::Drawing& drawing) const override
  {
    return reliefshade::paint(drawing);
  }

  bool ReadScene(const std::string& file, vtkReliefScene* scene, bool& scaled,
    std::string& reason) const override
  {
    vtkNew<vtkReliefSceneFile> reader;
    reader->SetFileName(file.c_str());
    reader->SetScene(scene);
    const bool read = reader->Read();
    scaled = reader->GetNamesHeightScale();
    reason = reader->GetErrorReason();
    return read;
  }

  std::string SceneText(
    const std::string& file, vtkReliefScene* scene, std::string& reason) const override
  {
    vtkNew<vtkReliefSceneFile> writer;
    writer->SetFileName(file.c_str());
    writer->SetScene(scene);
    const std::string text = writer->ToText();
    reason = writer->GetErrorReason();
    return text;
  }
};

}

//------------------------------------------------------------------------------
const reliefshade::ImageFormats* reliefshadeImageFormats()
{
  static const LoadedFormats formats;
  return &formats;
}
