// SPDX-License-Identifier: BSD-3-Clause
#include "SameFile.h"

#include "FileGuard.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <system_error>

namespace fs = std::filesystem;

namespace relief::io
{
using vtksys::SystemTools;

namespace
{
/// Longer ones are not names of files.
constexpr std::size_t LongestPath = 4096;

bool IsFile(const std::string& name)
{
  std::error_code code;
  return fs::is_regular_file(name, code);
}

/// The folder that a name lies in, without links, as far as there is one.
fs::path FolderOf(const fs::path& name)
{
  std::error_code code;
  const fs::path folder = fs::absolute(name, code).parent_path();
  const fs::path plain = fs::weakly_canonical(folder, code);
  return code ? folder.lexically_normal() : plain;
}

bool SameFolder(const fs::path& one, const fs::path& other)
{
  std::error_code code;
  return one == other || fs::equivalent(one, other, code);
}

//------------------------------------------------------------------------------
/// A picture of Radiance has the extension of ESRI's and ENVI's headers.
bool IsRadiancePicture(const fs::path& file)
{
  vtksys::ifstream stream(file.string().c_str(), std::ios::binary);
  return stream.get() == '#' && stream.get() == '?';
}

/// Whether a file's name makes it a part of another one in the same folder.
bool GoesByName(const fs::path& file, const fs::path& input)
{
  const std::string name = SystemTools::LowerCase(file.filename().string());
  const std::string whole = SystemTools::LowerCase(input.filename().string());
  const std::string stem = SystemTools::LowerCase(input.stem().string());
  const std::string extension = LowerExtension(whole);
  const auto any = [&name](const std::string& beginning, std::initializer_list<const char*> endings)
  {
    return std::any_of(endings.begin(), endings.end(),
      [&](const char* ending) { return name == beginning + ending; });
  };
  if (any(whole, { ".hdr" }) || any(stem, { ".hdr" }))
  {
    return !IsRadiancePicture(file);
  }
  // World files: .tfw or .tifw of .tif.
  const std::string world =
    extension.size() > 2 ? std::string{ '.', extension[1], extension.back(), 'w' } : ".w";
  return any(whole, { ".aux.xml", ".ovr", ".msk", ".prj" }) || name == stem + world ||
    name == whole + "w" ||
    any(
      stem, { ".aux", ".aux.xml", ".blw", ".clr", ".ige", ".ovr", ".prj", ".rrd", ".stx", ".wld" });
}
}

//------------------------------------------------------------------------------
std::string FollowLinks(const std::string& name)
{
  fs::path path(name);
  std::error_code code;
  for (int links = 0; links < 40 && fs::is_symlink(path, code); ++links) // as many as Linux follows
  {
    const fs::path target = fs::read_symlink(path, code);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path.string();
}

//------------------------------------------------------------------------------
std::size_t BeginOfPath(const std::string& name)
{
  std::error_code code;
  std::size_t begin = 0;
  while (name.compare(begin, 4, "/vsi") == 0 || (begin > 0 && name.compare(begin, 3, "vsi") == 0))
  {
    const std::size_t end = name.find('/', begin + 1);
    if (end == std::string::npos || fs::exists(name.substr(begin, end - begin), code))
    {
      break;
    }
    begin = end + 1;
  }
  return begin;
}

//------------------------------------------------------------------------------
std::string FileBehind(const std::string& name)
{
  const std::string inner = name.substr(BeginOfPath(name));
  if (inner.size() > LongestPath || IsFile(name) ||
    (inner.size() == name.size() && name.find(':') == std::string::npos))
  {
    return name;
  }
  // The longest stretch between two marks that is a file.
  const std::string marks = "/:\"{},?";
  std::size_t begin = 0;
  for (int starts = 0; starts < 64; ++starts) // no such name has more
  {
    for (std::size_t end = inner.size(); end != std::string::npos && end > begin;
         end = inner.find_last_of(marks, end - 1))
    {
      const std::string stretch = inner.substr(begin, end - begin);
      if (IsFile(stretch))
      {
        return stretch;
      }
    }
    begin = inner.find_first_of(":\"{,", begin);
    if (begin == std::string::npos)
    {
      break;
    }
    ++begin;
    begin += inner.compare(begin, 2, "//") == 0 ? 2 : 0; // of "vrt://a.tif?bands=1"
  }
  return name;
}

//------------------------------------------------------------------------------
bool SameFile(const std::string& one, const std::string& other)
{
  std::error_code code;
  if (one == other || fs::equivalent(one, other, code)) // hard links among them
  {
    return true;
  }
  const fs::path first = FollowLinks(one);
  const fs::path second = FollowLinks(other);
  return first.filename() == second.filename() && SameFolder(FolderOf(first), FolderOf(second));
}

//------------------------------------------------------------------------------
std::optional<std::size_t> FileNames::Add(const std::string& name)
{
  const std::size_t own = this->Count++;
  const fs::path path = FollowLinks(name);
  const fs::path folder = FolderOf(path);
  const auto known = std::find_if(this->Folders.begin(), this->Folders.end(),
    [&folder](const fs::path& other) { return SameFolder(folder, other); });
  const auto place = static_cast<std::size_t>(known - this->Folders.begin());
  if (known == this->Folders.end())
  {
    this->Folders.push_back(folder);
  }
  const auto [found, isNew] = this->Places.emplace(std::make_pair(place, path.filename()), own);
  if (!isNew)
  {
    return found->second;
  }
  std::error_code code;
  if (fs::hard_link_count(path, code) > 1 && !code)
  {
    for (const auto& [other, at] : this->Linked)
    {
      if (fs::equivalent(path, other, code))
      {
        return at;
      }
    }
    this->Linked.emplace_back(path.string(), own);
  }
  return std::nullopt;
}

//------------------------------------------------------------------------------
bool IsReadFrom(const std::string& input, const std::string& file)
{
  const std::string source = FileBehind(input);
  if (SameFile(source, file))
  {
    return true;
  }
  // Readers look beside the name that they get, which may be a link.
  const fs::path target = FollowLinks(file);
  return IsFile(target.string()) && SameFolder(FolderOf(source), FolderOf(target)) &&
    GoesByName(target, source);
}
}
