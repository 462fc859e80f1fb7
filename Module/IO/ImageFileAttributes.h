// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFileAttributes_h
#define ImageFileAttributes_h

/// @file
/// What else an image file's header says, as arrays of field data. Private to the module.

#include <OpenImageIO/imageio.h>

class vtkFieldData;

namespace relief::io
{
/// Adds an array for each attribute, the names of the channels ("ChannelNames") and where the data
/// window begins ("DataWindowOrigin").
void AddAttributes(const OIIO::ImageSpec& spec, vtkFieldData* fieldData);

/// Adds an attribute for each array of text or numbers that is no larger than 64 KiB and does not
/// tell how the file that it came from was stored.
void AddAttributes(vtkFieldData* fieldData, OIIO::ImageSpec& spec);
}

#endif
