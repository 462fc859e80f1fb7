// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileTestUtilities_h
#define ImageFileTestUtilities_h

#include "ReliefTestUtilities.h"
#include "vtkTestUtilities.h"

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <fstream>
#include <memory>

/// An empty directory of the test's own in the one given by -T, with a slash at its end.
inline std::string EmptyDirectory(int argc, char* argv[], const std::string& name)
{
  std::unique_ptr<char[]> root(vtkTestUtilities::GetArgOrEnvOrDefault(
    "-T", argc, argv, "VTK_TEMP_DIR", "../../../Testing/Temporary"));
  const std::string directory = std::string(root.get()) + "/" + name;
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  return directory + "/";
}

/// The files of a directory, hidden ones too.
inline int CountFiles(const std::string& directory)
{
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
  {
    count += entry.path().empty() ? 0 : 1;
  }
  return count;
}

inline std::string FileText(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

inline void WriteText(const std::string& name, const std::string& text)
{
  std::ofstream(name, std::ios::binary) << text;
}

/// Writes values, the top row first, with OpenImageIO alone.
template <typename T>
bool WriteFile(const std::string& name, const OIIO::ImageSpec& spec, const std::vector<T>& values)
{
  auto output = OIIO::ImageOutput::create(name);
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  bool written = output && output->open(name, spec) && output->write_image(type, values.data()) &&
    output->close();
  if (output)
  {
    output->geterror();
  }
  return written;
}

/// The values of a file, the top row first, with OpenImageIO alone; empty where it cannot be read.
inline std::vector<float> ReadFile(const std::string& name, OIIO::ImageSpec& spec)
{
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  auto input = OIIO::ImageInput::open(name, &configuration);
  if (!input)
  {
    OIIO::geterror();
    return {};
  }
  spec = input->spec();
  std::vector<float> values(spec.image_pixels() * spec.nchannels);
  return input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, values.data())
    ? values
    : std::vector<float>();
}

#endif
