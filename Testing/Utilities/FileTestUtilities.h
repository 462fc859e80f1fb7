// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileTestUtilities_h
#define FileTestUtilities_h

#include "ReliefTestUtilities.h"
#include "vtkTestUtilities.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

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

/// How a file's name ends in a message, up to the reason: long ones come without their middle.
inline std::string EndOfName(const std::string& name)
{
  constexpr std::size_t kept = 30;
  return (name.size() > kept ? name.substr(name.size() - kept) : "\"" + name) + "\": ";
}

inline void WriteText(const std::string& name, const std::string& text)
{
  std::ofstream(name, std::ios::binary) << text;
}

#endif
