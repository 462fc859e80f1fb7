// SPDX-License-Identifier: BSD-3-Clause
#include "OutputPiece.h"

#include "vtkReliefAbort.h"

#include "vtkExtentTranslator.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace relief::hosts
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
void FindPiece(const int whole[6], vtkInformation* outInfo, int piece[6])
{
  outInfo->Get(Pipeline::UPDATE_EXTENT(), piece);
  for (int axis = 0; axis < 3; ++axis)
  {
    piece[2 * axis] = std::max(piece[2 * axis], whole[2 * axis]);
    piece[2 * axis + 1] = std::min(piece[2 * axis + 1], whole[2 * axis + 1]);
  }
}

//------------------------------------------------------------------------------
void FindNumberedPiece(const int whole[6], vtkInformation* outInfo, int piece[6])
{
  FindPiece(whole, outInfo, piece);
  const int pieces = outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    const int mode = outInfo->Has(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      ? outInfo->Get(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      : vtkExtentTranslator::BLOCK_MODE;
    int all[6];
    std::copy_n(piece, 6, all);
    vtkNew<vtkExtentTranslator> translator;
    translator->PieceToExtentThreadSafe(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), all, piece, mode, 0);
  }
}

//------------------------------------------------------------------------------
bool IsEmptyExtent(const int extent[6])
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

//------------------------------------------------------------------------------
std::string PreparePiece(HostInputs& inputs, const PreparedScene& scene, const PieceReading& from,
  const int piece[6], const std::function<std::string()>& convert)
{
  std::string wrong = inputs.UpdatePiece(from.inputs, from.arrays, from.reading, from.range, piece);
  if (wrong.empty())
  {
    wrong = convert();
  }
  int first[6];
  from.inputs[0]->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT(), first);
  bool further = false;
  int extent[6];
  while (wrong.empty() && inputs.MissesOfPiece(scene.Get(), piece, extent))
  {
    if (vtkReliefIsAborted(from.host))
    {
      return std::string();
    }
    further = true;
    wrong = inputs.UpdatePieceFurther(from.host, extent, from.inputs, from.arrays, from.reading);
  }
  if (further && wrong.empty())
  {
    wrong = inputs.RestorePiece(from.host, first, from.inputs, from.arrays, from.reading);
  }
  return wrong;
}
}
