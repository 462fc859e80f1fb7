// SPDX-License-Identifier: BSD-3-Clause
#ifndef Saving_h
#define Saving_h

#include "LongTask.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkReliefScene;

namespace reliefviewer
{

struct Field;

using SaveField = void(
  const std::string& file, const Field& field, vtkReliefScene* scene, const Progress& progress);

/// Shades the whole field as reliefshade does and writes the picture. Throws a Failure that names
/// the file.
SaveField savePicture;

/// The same for one OpenEXR file of linear colour and all layers.
SaveField saveLayers;

}

#endif
