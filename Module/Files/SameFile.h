// SPDX-License-Identifier: BSD-3-Clause
#ifndef SameFile_h
#define SameFile_h

/// @file
/// Which names lead to one file: asked before a file is written, so that none is lost that is still
/// to be read. Not installed.

#include <string>

namespace relief::io
{
/// Where a name leads: symbolic links are followed, also those at whose end nothing is yet. Where
/// they go round in circles, one of them comes back.
std::string FollowLinks(const std::string& name);

/// The file on the disk behind a name as GDAL takes them: the archive of "/vsizip/a.zip/b.tif", the
/// container of "NETCDF:a.nc:height". Any other name comes back as it is.
std::string FileBehind(const std::string& name);

/// Whether two names, none of them empty, lead to one file, whatever links and spellings they
/// contain; also where there is no file yet.
bool SameFile(const std::string& one, const std::string& other);

/// Whether `file` is what `input` is read from: the file itself, the archive or container that it
/// lies in, or a file beside it that goes by its name, as world files, headers and .aux.xml do.
bool IsReadFrom(const std::string& input, const std::string& file);
}

#endif
