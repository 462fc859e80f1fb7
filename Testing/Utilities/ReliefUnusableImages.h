// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefUnusableImages_h
#define ReliefUnusableImages_h

#include "ReliefTestUtilities.h"

#include <string>
#include <utility>
#include <vector>

/// Images that neither heights nor textures can be, of `components` a sample where it is not their
/// number that is wrong, and what the message says of each, `what` naming the input.
inline std::vector<std::pair<vtkSmartPointer<vtkImageData>, std::string>> UnusableImages(
  const std::string& what, int components)
{
  auto image = [](int slices, int type, int count)
  {
    auto made = vtkSmartPointer<vtkImageData>::New();
    made->SetDimensions(4, 4, slices);
    if (count > 0)
    {
      made->AllocateScalars(type, count);
    }
    return made;
  };
  auto flat = image(1, VTK_FLOAT, components);
  flat->GetPointData()->GetScalars()->Fill(0.0);
  flat->SetSpacing(0.0, 1.0, 1.0);
  return { { vtkSmartPointer<vtkImageData>::New(), "the " + what + " image is empty" },
    { image(1, VTK_FLOAT, 0), "the " + what + " image has no scalars" },
    { image(4, VTK_FLOAT, components), "the " + what + " image has 4 slices" },
    { image(1, VTK_BIT, components), "the " + what + " scalars are bits" },
    { image(1, VTK_FLOAT, 5), "the " + what + " image has 5 components" },
    { flat, "the spacing is (0, 1)" } };
}

#endif
