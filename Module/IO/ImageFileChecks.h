// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileChecks_h
#define ImageFileChecks_h

#include "vtkType.h" // For vtkTypeInt64

#include <string>

namespace relief::io
{

/// Looks for sizes in the header of an OpenEXR, PNG or GIF file for which a decoder would take
/// memory as it opens the file, before anybody can ask it how large the picture is: parts of a
/// header that would reach beyond the file's end, and a canvas beyond the limit (in kibibytes, 0
/// for none). Throws a Failure, FileFormatError or PrematureEndOfFileError. Files of any other
/// content pass.
void CheckHeader(const std::string& fileName, vtkTypeInt64 limit);

}

#endif
