// SPDX-License-Identifier: BSD-3-Clause
#ifndef SameFile_h
#define SameFile_h

/// @file
/// Which names lead to one file: asked before a file is written, so that none is lost that is still
/// to be read. Not installed.

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace relief::io
{
/// Where a name leads: symbolic links are followed, also those at whose end nothing is yet. Where
/// they go round in circles, one of them comes back.
std::string FollowLinks(const std::string& name);

/// The file on the disk behind a name as GDAL takes them: the archive of "/vsizip/a.zip/b.tif", the
/// container of "NETCDF:a.nc:height". Any other name comes back as it is.
std::string FileBehind(const std::string& name);

/// Where in a name the path of a file begins: behind "/vsizip/", "/vsizip//vsigzip/" and the like.
std::size_t BeginOfPath(const std::string& name);

/// Whether two names, none of them empty, lead to one file, whatever links and spellings they
/// contain; also where there is no file yet.
bool SameFile(const std::string& one, const std::string& other);

/// Finds which of many names lead to one file: what SameFile() says of each two of them, without
/// asking it for every two.
class FileNames
{
public:
  /// Adds a name. Returns the place of one that was added before and leads to the same file, in the
  /// order of adding; nothing if there is none.
  std::optional<std::size_t> Add(const std::string& name);

private:
  std::size_t Count = 0;
  std::vector<std::filesystem::path> Folders; // different ones
  std::map<std::pair<std::size_t, std::filesystem::path>, std::size_t> Places;
  std::vector<std::pair<std::string, std::size_t>> Linked; // of several names on the disk
};

/// Whether `file` is what `input` is read from: the file itself, the archive or container that it
/// lies in, or a file beside it that goes by its name, as world files, headers and .aux.xml do.
bool IsReadFrom(const std::string& input, const std::string& file);
}

#endif
