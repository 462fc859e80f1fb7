// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileAccess_h
#define ImageFileAccess_h

/// @file
/// What the readers and writers of image files share. Private to the module.

#include "FileGuard.h"

#include <OpenImageIO/typedesc.h>

#include <string>

namespace relief::io
{
/// The type of VTK that holds numbers of a type of OpenImageIO, half as float; VTK_VOID where there
/// is none.
int VTKType(OIIO::TypeDesc type);

/// OpenImageIO's name for a type of VTK; UNKNOWN where there is none.
OIIO::TypeDesc FileType(int vtkType);
}

#endif
