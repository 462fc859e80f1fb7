// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureChoice_h
#define PictureChoice_h

#include "PictureForm.h"

#include <string>

namespace reliefshade
{

struct Options;

/// What gives the picture colour, as a scene does, or what lies over it.
std::string colorOf(const Options& options);

/// What OUTPUT holds of a shaded image; `lacksData`: of some samples there are no data.
PictureForm formOfOutput(const Options& options, bool lacksData);

/// What the file of a layer of so many components holds.
PictureForm formOfLayer(const Options& options, int components);

/// What the picture of the shadow holds.
PictureForm formOfMask(const Options& options, bool lacksData);

/// VTK_FLOAT or VTK_UNSIGNED_CHAR, as the options say or the format has it usually.
int outputType(const Options& options);

}

#endif
