// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunKeys_h
#define RunKeys_h

/// @file
/// What tells a run from another: its pieces are not to be those of a run with other settings. Not
/// installed.

#include "vtkIOReliefStreamingModule.h" // For export macro

#include <string>

class vtkImageReliefShading;
class vtkReliefScene;

namespace relief::streaming
{
/// A scene with its material, lights and environment, but for the environment's image: every
/// parameter with all of its digits, a line for each of them.
VTKIORELIEFSTREAMING_EXPORT std::string KeyOfScene(vtkReliefScene* scene);

/// All that a shading's picture and layers depend on, by what they are in memory: heights, place,
/// scene, images, colour table, what is made of them. Updates the shading's inputs. Empty where
/// their heights cannot be read, which is reported.
VTKIORELIEFSTREAMING_EXPORT std::string KeyOfShading(vtkImageReliefShading* shading);
}

#endif
