// SPDX-License-Identifier: BSD-3-Clause
#ifndef OutputPiece_h
#define OutputPiece_h

/// @file
/// The piece of its output that a filter is asked for, and its inputs for that. Not installed.

#include "HostInputs.h"
#include "PreparedScene.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <functional>
#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkInformation;
class vtkInformationVector;

namespace relief::hosts
{
/// The part of a whole extent that an output is asked for; empty if there is none.
VTKRELIEFSHADING_EXPORT void FindPiece(const int whole[6], vtkInformation* outInfo, int piece[6]);

/// The same before the executive has cut the piece of a number out of the extent, as it does before
/// data are made.
VTKRELIEFSHADING_EXPORT void FindNumberedPiece(
  const int whole[6], vtkInformation* outInfo, int piece[6]);

VTKRELIEFSHADING_EXPORT bool IsEmptyExtent(const int extent[6]);

/// A filter, what is at its ports, and how it reads that.
struct PieceReading
{
  vtkAlgorithm* host;
  vtkInformationVector** inputs;
  std::function<vtkDataArray*(int)> arrays; ///< the array to read at each port
  HostInputs::Reading reading;
  const double* range; ///< the least and the greatest of all heights
};

/// Has inputs bring all that a piece of the output depends on, and prepares it. Once they have
/// something, `convert` makes the scene of it. Returns an empty text, or what is wrong; an abort is
/// nothing wrong.
VTKRELIEFSHADING_EXPORT std::string PreparePiece(HostInputs& inputs, const PreparedScene& scene,
  const PieceReading& from, const int piece[6], const std::function<std::string()>& convert);
}

#endif
