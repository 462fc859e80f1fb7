// SPDX-License-Identifier: BSD-3-Clause
#include "Verify.h"

#include "AccuracyTable.h"
#include "Failure.h"
#include "MessageLog.h"
#include "Options.h"
#include "TileShading.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkReliefVerification.h"

#include <iostream>

namespace reliefshade
{

//------------------------------------------------------------------------------
std::string verify(
  vtkImageReliefShading* shading, const Options& options, const TileShading* pieces, bool bar)
{
  vtkNew<vtkReliefVerification> verification;
  verification->SetShading(shading);
  verification->SetNumberOfSamples(options.VerifiedSamples);
  verification->SetSeed(options.VerifiedSeed);
  if (pieces)
  {
    verification->SetPieces(pieces->GetPieces(),
      [pieces](const int extent[6]) { return pieces->LoadLayer(extent, "Illumination"); });
  }
  watch(verification, bar, "verifying");
  verification->Update();
  stopIfInterrupted();
  if (hasError())
  {
    throw Failure(options.Input, takeError());
  }

  // Rows are counted from the upper edge, as pictures have them.
  const int* extent = vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0))->GetExtent();
  const std::string place = "column " + std::to_string(verification->GetWorstColumn() - extent[0]) +
    ", row " + std::to_string(extent[3] - verification->GetWorstRow());
  const std::string error = brief(verification->GetLargestError(), 3);
  const std::string promise = brief(verification->GetPromisedError(), 4);
  if (!verification->GetKept())
  {
    throw Failure(options.Input,
      "--verify: the illumination errs by " + error + " at " + place + ", " + promise +
        " is promised; nothing of it was written. This is a mistake of the program: please report "
        "it");
  }
  const vtkTypeInt64 count = verification->GetNumberOfRetracedSamples();
  const vtkTypeInt64 grazing = verification->GetNumberOfGrazingSamples();
  const std::string text = std::to_string(count) + " samples, seed " +
    std::to_string(options.VerifiedSeed) + ": largest error " + error +
    (count > 0 ? " at " + place : "") + ", promised " + promise +
    (grazing > 0 ? "; rounding of the heights explains " + std::to_string(grazing) : "");
  std::cout << "verified: " << (frameCount(options) > 1 ? options.Output + ": " : std::string())
            << text << std::endl;
  return text;
}

}
