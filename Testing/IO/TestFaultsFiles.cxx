// SPDX-License-Identifier: BSD-3-Clause
// Files that go, shrink or find no room while they are read and written: one error, the file that
// was there before, nothing beside it, and the same object does its work afterwards.
#include "vtkErrorCode.h"
#include "vtkOpenEXRLayerWriter.h"
#include "vtkOpenImageIOReader.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"

#include "ImageFileTestUtilities.h"

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

namespace
{
int Failures = 0;

// Three components of noise that compression cannot shrink.
vtkSmartPointer<vtkImageData> Noise(int size, int type)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, 1);
  image->AllocateScalars(type, 3);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  unsigned int state = 1;
  for (vtkIdType at = 0; at < values->GetNumberOfValues(); ++at)
  {
    state = 1664525u * state + 1013904223u;
    values->SetComponent(at / 3, static_cast<int>(at % 3), state >> 24);
  }
  return image;
}

// One way of writing a file: an object, and how it writes under a name.
struct Output
{
  std::string Name;
  vtkObject* Object;
  std::function<unsigned long(const std::string&)> Write; // returns the error code
};

std::vector<Output> MakeOutputs(std::vector<vtkSmartPointer<vtkObject>>& owners)
{
  std::vector<Output> outputs;
  for (const char* name : { "o.png", "o.tif", "o.exr", "o.hdr", "o.jpg", "o.bmp" })
  {
    const std::string extension = std::string(name).substr(2);
    const bool real = extension == "exr" || extension == "hdr";
    vtkNew<vtkOpenImageIOWriter> writer;
    writer->SetInputData(Noise(300, real ? VTK_FLOAT : VTK_UNSIGNED_CHAR));
    vtkOpenImageIOWriter* pointer = writer;
    owners.emplace_back(writer);
    outputs.push_back({ name, pointer,
      [pointer](const std::string& file)
      {
        pointer->SetFileName(file.c_str());
        pointer->Write();
        return pointer->GetErrorCode();
      } });
  }
  vtkNew<vtkOpenEXRLayerWriter> layers;
  layers->SetInputData(Noise(300, VTK_FLOAT));
  vtkOpenEXRLayerWriter* layersPointer = layers;
  owners.emplace_back(layers);
  outputs.push_back({ "layers.exr", layersPointer,
    [layersPointer](const std::string& file)
    {
      layersPointer->SetFileName(file.c_str());
      layersPointer->Write();
      return layersPointer->GetErrorCode();
    } });
  vtkNew<vtkReliefSceneFile> scene;
  for (int k = 0; k < 40; ++k)
  {
    scene->GetScene()->AddSun(9.0 * k, 45.0);
  }
  vtkReliefSceneFile* scenePointer = scene;
  owners.emplace_back(scene);
  outputs.push_back({ "scene.json", scenePointer,
    [scenePointer](const std::string& file)
    {
      scenePointer->SetFileName(file.c_str());
      scenePointer->Write();
      return scenePointer->GetErrorCode();
    } });
  return outputs;
}

// A file that cannot become larger stands for a disk that is full.
class SmallDisk
{
public:
  explicit SmallDisk(unsigned long bytes)
  {
#ifndef _WIN32
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
#endif
  }
  ~SmallDisk()
  {
#ifndef _WIN32
    setrlimit(RLIMIT_FSIZE, &this->Before);
    std::signal(SIGXFSZ, SIG_DFL);
#endif
  }

private:
#ifndef _WIN32
  rlimit Before;
#endif
};

void TestWriters(const std::string& directory)
{
  std::vector<vtkSmartPointer<vtkObject>> owners;
  for (const Output& output : MakeOutputs(owners))
  {
    std::cout << "  " << output.Name << std::endl;
    const std::string folder = directory + output.Name + ".folder/";
    std::filesystem::create_directories(folder);
    const std::string name = folder + output.Name;
    WriteText(name, "before");
    MessageKeeper messages(output.Object);

#ifndef _WIN32
    // Room for nothing, for the beginning, and for all but the end.
    CHECK(output.Write(name) == vtkErrorCode::NoError);
    const auto whole = static_cast<unsigned long>(std::filesystem::file_size(name));
    WriteText(name, "before");
    for (const unsigned long room : { 0ul, 1000ul, whole / 2, whole - 1 })
    {
      unsigned long code;
      {
        const SmallDisk disk(room);
        code = output.Write(name);
      }
      CHECK(code == vtkErrorCode::OutOfDiskSpaceError || code == vtkErrorCode::FileFormatError);
      CHECK(messages.OneError(EndOfName(name)));
      CHECK(FileText(name) == "before" && CountFiles(folder) == 1);
    }
#endif

    // A place below a file, and one in no folder.
    CHECK(output.Write(name + "/" + output.Name) == vtkErrorCode::CannotOpenFileError);
    CHECK(messages.OneError("Cannot write"));
    CHECK(output.Write(folder + "none/" + output.Name) == vtkErrorCode::CannotOpenFileError);
    CHECK(messages.OneError("Cannot write"));
    CHECK(FileText(name) == "before" && CountFiles(folder) == 1);

    // An observer stops it half way.
    if (auto algorithm = vtkAlgorithm::SafeDownCast(output.Object))
    {
      ProgressKeeper progress(algorithm);
      progress.StopAbove = 0.0;
      CHECK(output.Write(name) == vtkErrorCode::UserError);
      CHECK(messages.Silent());
      CHECK(FileText(name) == "before" && CountFiles(folder) == 1);
      algorithm->AbortExecuteOff();
    }

    CHECK(output.Write(name) == vtkErrorCode::NoError);
    CHECK(messages.Silent() && FileText(name) != "before" && CountFiles(folder) == 1);
  }
}

void TestReaders(const std::string& directory)
{
  for (const char* extension : { "png", "tif", "exr", "hdr", "bmp" })
  {
    const std::string name = directory + "input." + extension;
    std::cout << "  input." << extension << std::endl;
    const bool real = std::string(extension) == "exr" || std::string(extension) == "hdr";
    vtkNew<vtkOpenImageIOWriter> writer;
    writer->SetInputData(Noise(1500, real ? VTK_FLOAT : VTK_UNSIGNED_CHAR));
    writer->SetFileName(name.c_str());
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::NoError);
    const std::string whole = FileText(name);
    const std::string part = whole.substr(0, whole.size() / 3);

    vtkNew<vtkOpenImageIOReader> reader;
    MessageKeeper messages(reader);
    auto prepare = [&]
    {
      WriteText(name, whole);
      reader->SetFileName(name.c_str());
      reader->Modified();
    };
    auto refused = [&](const std::string& text)
    {
      reader->Update();
      CHECK(reader->GetErrorCode() != vtkErrorCode::NoError);
      CHECK(messages.OneError(text));
      CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
      CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);
    };

    // Between its header and its pixels the file goes, or shrinks.
    prepare();
    reader->UpdateInformation();
    std::filesystem::remove(name);
    refused("does not exist");
    prepare();
    reader->UpdateInformation();
    WriteText(name, part);
    refused("end early or are damaged");

    // It shrinks while it is read.
    prepare();
    {
      ProgressKeeper progress(reader);
      progress.AtStep = [&] { std::filesystem::resize_file(name, part.size()); };
      refused("end early or are damaged");
    }

    // An observer stops it.
    prepare();
    {
      ProgressKeeper progress(reader);
      progress.StopAbove = 0.0;
      reader->Update();
      CHECK(reader->GetErrorCode() == vtkErrorCode::UserError && messages.Silent());
      CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
      reader->AbortExecuteOff();
    }

    prepare();
    reader->Update();
    CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 1500 * 1500);
  }
}
}

int TestFaultsFiles(int argc, char* argv[])
{
  const std::string directory = EmptyDirectory(argc, argv, "TestFaultsFiles");
  TestWriters(directory);
  TestReaders(directory);
  return Failures;
}
