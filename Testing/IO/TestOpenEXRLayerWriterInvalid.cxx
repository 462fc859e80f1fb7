// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenEXRLayerWriter: what it refuses; whole files or none.
#include "vtkExecutive.h"
#include "vtkUnsignedCharArray.h"

#include "OpenEXRLayerTestUtilities.h"

#include <algorithm>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

namespace
{
// Writes what is to be refused: one message with the file's name, nothing left behind.
void Refused(
  vtkImageData* image, const std::string& name, unsigned long code, const std::string& text)
{
  const int files = CountFiles(Directory);
  vtkNew<vtkOpenEXRLayerWriter> writer;
  MessageKeeper messages(writer);
  MessageKeeper pipeline(writer->GetExecutive());
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == code);
  CHECK(messages.OneError(EndOfName(name)));
  writer->Write();
  CHECK(messages.OneError(text));
  CHECK(pipeline.Silent());
  CHECK(CountFiles(Directory) == files);
}

vtkSmartPointer<vtkImageData> MakeImage(int type, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(4, 3, 1);
  image->AllocateScalars(type, components);
  image->GetPointData()->GetScalars()->Fill(1.0);
  return image;
}

void TestRefusals()
{
  const std::string name = Directory + "bad.exr";
  const unsigned long format = vtkErrorCode::FileFormatError;
  const unsigned long unknown = vtkErrorCode::UnknownError;
  Refused(MakeImage(VTK_UNSIGNED_CHAR, 4), name, format, "SetOutputScalarTypeToFloat");
  Refused(MakeImage(VTK_FLOAT, 2), name, format, "the scalars have 2 components of type float");
  Refused(MakeImage(VTK_FLOAT, 5), name, format, "5 components");
  Refused(MakeImage(VTK_FLOAT, 4), "", vtkErrorCode::NoFileNameError, "no file name");
  auto withArray = [](vtkAbstractArray* array, const char* arrayName, int components, int tuples)
  {
    auto image = MakeImage(VTK_FLOAT, 4);
    array->SetName(arrayName);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    image->GetPointData()->AddArray(array);
    return image;
  };
  vtkNew<vtkUnsignedCharArray> labels;
  Refused(withArray(labels, "Labels", 1, 12), name, format,
    "the point array \"Labels\" has 1 component of type unsigned char; 1, 3 or 4");
  vtkNew<vtkFloatArray> pairs;
  Refused(withArray(pairs, "Pairs", 2, 12), name, format, "\"Pairs\" has 2 components");
  vtkNew<vtkFloatArray> few;
  Refused(withArray(few, "Few", 3, 11), name, unknown, "\"Few\" has 11 values for 12 points");
  vtkNew<vtkFloatArray> unnamed;
  Refused(withArray(unnamed, nullptr, 3, 12), name, format, "has no name");
  vtkNew<vtkFloatArray> named;
  const std::string longName(300, 'x');
  Refused(withArray(named, longName.c_str(), 3, 12), name, format, "longer than OpenEXR's 255");

  vtkNew<vtkImageData> empty;
  Refused(empty, name, unknown, "empty");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 3, 1);
  Refused(bare, name, unknown, "no scalars");
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(3, 3, 3);
  volume->AllocateScalars(VTK_FLOAT, 4);
  Refused(volume, name, unknown, "3 slices");
  auto flat = MakeImage(VTK_FLOAT, 4);
  flat->SetSpacing(1.0, 0.0, 1.0);
  Refused(flat, name, unknown, "spacing");
  auto narrow = MakeImage(VTK_FLOAT, 4);
  narrow->SetSpacing(1e-9, 1.0, 1.0);
  Refused(narrow, name, format, "aspect ratio");

  auto good = MakeImage(VTK_FLOAT, 4);
  const unsigned long place = vtkErrorCode::CannotOpenFileError;
  Refused(good, Directory + "none/bad.exr", place, "cannot be written");
  std::filesystem::create_directory(Directory + "folder.exr");
  Refused(good, Directory + "folder.exr", place, "not a file");

  vtkNew<vtkOpenEXRLayerWriter> writer;
  MessageKeeper messages(writer);
  writer->SetFileName(name.c_str());
  writer->Write();
  CHECK(messages.OneError("no input") && writer->GetErrorCode() == unknown);
  writer->SetDWACompressionLevel(-1.0);
  CHECK(messages.OneError("SetDWACompressionLevel: -1"));
  writer->SetDWACompressionLevel(NaN);
  CHECK(messages.OneError("SetDWACompressionLevel: nan"));
  CHECK(writer->GetDWACompressionLevel() == 45.0);
  for (const char* reserved : { "", "channels", "tiles", "relief:lights" })
  {
    writer->SetAttribute(reserved, "text");
    CHECK(messages.OneError(std::string("SetAttribute: \"") + reserved + "\""));
    CHECK(writer->GetAttribute(reserved) == nullptr);
  }
  writer->SetAttribute(std::string(256, 'a'), "text");
  CHECK(messages.OneError("1 to 255 characters"));
}

//------------------------------------------------------------------------------
void TestWholeFiles()
{
  const std::string directory = Directory + "whole/";
  std::filesystem::create_directory(directory);
  for (bool tiled : { false, true })
  {
    const std::string name = directory + (tiled ? "tiles.exr" : "rows.exr");
    vtkNew<vtkReliefScene> scene;
    auto image = MakeShaded(520, 460, scene);
    vtkNew<vtkOpenEXRLayerWriter> writer;
    MessageKeeper messages(writer);
    writer->SetTiled(tiled);
    writer->SetCompressionToNone();
    writer->SetInputData(image);
    writer->SetFileName(name.c_str());
    WriteText(name, "what was here before");
    const int files = CountFiles(directory);
    auto untouched = [&]
    { return CountFiles(directory) == files && FileText(name) == "what was here before"; };

    // Told to stop on the way.
    ProgressKeeper progress(writer);
    int most = 0;
    progress.AtStep = [&] { most = std::max(most, CountFiles(directory)); };
    progress.StopAbove = 0.0; // the pipeline announces 0 itself
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::UserError && messages.Silent());
    CHECK(most == files + 1 && untouched());
    progress.StopAbove = VTK_DOUBLE_MAX;

#ifndef _WIN32
    // No room on the disk, at once or for the last byte, which belongs to the table of offsets that
    // OpenEXR writes last: a limit on the size of files has the same effect.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const std::string trial = directory + "trial.exr";
    writer->SetFileName(trial.c_str());
    writer->Write();
    const auto size = std::filesystem::file_size(trial);
    std::filesystem::remove(trial);
    writer->SetFileName(name.c_str());
    for (rlim_t room : { rlim_t(1000), rlim_t(size - 1) })
    {
      rlimit limit = before;
      limit.rlim_cur = room;
      setrlimit(RLIMIT_FSIZE, &limit);
      writer->Write();
      setrlimit(RLIMIT_FSIZE, &before);
      CHECK(writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError);
      CHECK(messages.OneError(EndOfName(name) + "writing failed: "));
      CHECK(untouched());
    }
#endif

    // And now the whole.
    progress.Steps.clear();
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
    CHECK(CountFiles(directory) == files);
    CHECK(progress.Rises() && progress.Steps.size() > 2);
    CHECK(!progress.Steps.empty() && progress.Steps.back() == 1.0);
    CompareWithArrays(Layers(name), image);
    const std::string part = directory + "part.exr";
    WriteText(part, FileText(name).substr(0, std::filesystem::file_size(name) / 2));
    CHECK(IsDamaged(part));
    std::filesystem::remove(part);
  }
  const std::string umlaut = directory + "H\xc3\xb6hen \xe5\xb1\xb1.exr";
  vtkNew<vtkOpenEXRLayerWriter> unicode;
  unicode->SetInputData(MakeImage(VTK_FLOAT, 1));
  unicode->SetFileName(umlaut.c_str());
  unicode->Write();
  CHECK(Layers(umlaut)("Y", 3, 2) == 1.0f);
}
}

int TestOpenEXRLayerWriterInvalid(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenEXRLayerWriterInvalid");
  TestRefusals();
  TestWholeFiles();
  return Failures;
}
