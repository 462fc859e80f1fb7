// SPDX-License-Identifier: BSD-3-Clause
#ifndef Refusals_h
#define Refusals_h

/// @file
/// How a file is refused. Private to the module.

#include "vtkErrorCode.h"

#include "FileGuard.h"

#include <string>

namespace relief::io
{
[[noreturn]] inline void RefuseFormat(const std::string& reason)
{
  throw Failure(vtkErrorCode::FileFormatError, reason);
}

[[noreturn]] inline void RefuseEnd(const std::string& reason)
{
  throw Failure(vtkErrorCode::PrematureEndOfFileError, reason);
}
}

#endif
