// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFile.h"

#include "Failure.h"
#include "ImageFormats.h"
#include "MeshHeights.h"
#include "MessageLog.h"
#include "RasterFile.h"
#include "SameFile.h"
#include "TemporaryFile.h"

#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
[[noreturn]] void refuse(const NamedFile& output, const NamedFile& other, bool whole)
{
  const bool named = other.Name == output.Name;
  throw Failure(output.Name,
    output.Role + " would replace " + (whole ? "" : "a file of ") +
      (named ? other.Role : other.Name + ", which is " + other.Role) + "; choose another name",
    UsageFailure);
}

//------------------------------------------------------------------------------
/// The files that an input is read from, as far as its format tells.
std::vector<std::string> filesOf(const std::string& input)
{
  return isMesh(input) ? imageFormats().FilesBesideMesh(input) : relief::raster::FilesOf(input);
}

//------------------------------------------------------------------------------
void checkInput(const NamedFile& input, const std::vector<NamedFile>& outputs)
{
  // Found when there is something to lose: files are opened for it.
  std::optional<std::vector<std::string>> files;
  for (const NamedFile& output : outputs)
  {
    if (relief::io::IsReadFrom(input.Name, output.Name))
    {
      refuse(output, input, relief::io::SameFile(input.Name, output.Name));
    }
    std::error_code code;
    if (std::filesystem::exists(output.Name, code))
    {
      files = files ? files : filesOf(input.Name);
      for (const std::string& file : *files)
      {
        if (relief::io::SameFile(relief::io::FileBehind(file), output.Name))
        {
          refuse(output, input, false);
        }
      }
    }
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void keepApart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs)
{
  for (const NamedFile& input : inputs)
  {
    checkInput(input, outputs);
  }
  relief::io::FileNames names;
  for (const NamedFile& output : outputs)
  {
    if (const auto other = names.Add(output.Name))
    {
      refuse(output, outputs[*other], true);
    }
  }
}

//------------------------------------------------------------------------------
OutputFile::OutputFile(const std::string& target)
{
  aboutFile(target, [&] { this->Staged = std::make_unique<relief::io::StagedFile>(target); });
}

//------------------------------------------------------------------------------
std::string OutputFile::Reword(const std::string& text) const
{
  std::string result = withoutName(this->Staged->Reword(text), this->Target());
  // The name of a long path has lost its middle on the way, and is known by its ending.
  const std::string ending = ".tmp" + std::filesystem::path(this->Target()).extension().string();
  for (std::size_t end = result.find(ending); end != std::string::npos;)
  {
    std::size_t behind = end + ending.size();
    const std::size_t begin = result.find_last_of(" \"", end) + 1;
    if (result.find("...", begin) < end)
    {
      result.replace(begin, behind - begin, this->Target());
      behind = begin + this->Target().size();
    }
    end = result.find(ending, behind);
  }
  return result;
}

//------------------------------------------------------------------------------
void OutputFile::Try(const std::function<void()>& step) const
{
  aboutFile(this->Target(),
    [&]
    {
      try
      {
        step();
      }
      catch (const relief::io::Failure& failure)
      {
        throw relief::io::Failure(failure.Code, this->Reword(failure.what()));
      }
    });
}

//------------------------------------------------------------------------------
void OutputFile::WriteText(const std::string& text) const
{
  aboutFile(this->Target(),
    [&]
    {
      relief::io::TemporaryFile stream(this->Name(), false);
      stream.Write(text.data(), text.size());
      if (const int error = stream.Finish())
      {
        throw std::runtime_error("cannot be written: " + std::string(std::strerror(error)));
      }
      stream.Keep();
    });
}

//------------------------------------------------------------------------------
void OutputFile::KeepAll(const std::vector<OutputFile*>& files)
{
  std::vector<relief::io::StagedFile*> staged;
  staged.reserve(files.size());
  for (OutputFile* file : files)
  {
    staged.push_back(file->Staged.get());
  }
  std::string reason;
  if (const auto* failed = relief::io::StagedFile::KeepAll(staged, reason))
  {
    throw Failure(failed->Target(), reason);
  }
}

}
