// SPDX-License-Identifier: BSD-3-Clause
#include "ColorTable.h"

#include "ColorTableText.h"
#include "Failure.h"
#include "HeightSummary.h"
#include "MessageLog.h"
#include "PictureOutput.h"
#include "TileShading.h"

#include "vtkDataArray.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// Measured once for all the shares of a table, and not at all for one without.
class HeightShares
{
public:
  explicit HeightShares(const Raster& raster)
    : Heights(raster)
  {
  }

  double At(double share)
  {
    if (isTiled(this->Heights)) // whose ends are known, and of which one at a time is read
    {
      const std::array<double, 2> ends = this->Heights.Ends.value();
      return ends[0] + share * (ends[1] - ends[0]);
    }
    if (!this->Range)
    {
      this->Range =
        relief::hosts::SummarizeHeights(this->Heights.Heights->GetPointData()->GetScalars(),
          this->Heights.Mask ? this->Heights.Mask->GetPointData()->GetScalars() : nullptr,
          this->Heights.NoData.has_value(), this->Heights.NoData.value_or(0.0));
    }
    return this->Range->least + share * (this->Range->greatest - this->Range->least);
  }

private:
  const Raster& Heights;
  std::optional<relief::hosts::HeightSummary> Range;
};

}

namespace reliefshade
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkScalarsToColors> readColorTable(const std::string& file, const Raster& raster)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw Failure(file, "cannot be opened");
  }
  HeightShares shares(raster);
  std::vector<ColorNode> nodes;
  aboutFile(file,
    [&]
    {
      nodes = parseColorTable(stream, lowerExtension(file) == ".cpt",
        [&shares](double share) { return shares.At(share); });
    });
  auto table = vtkSmartPointer<vtkDiscretizableColorTransferFunction>::New();
  vtkNew<vtkPiecewiseFunction> opacity;
  bool transparent = false;
  double last = -std::numeric_limits<double>::infinity();
  for (const ColorNode& node : nodes)
  {
    // A transfer function has one colour for each place.
    last =
      node.Height <= last ? std::nextafter(last, std::numeric_limits<double>::max()) : node.Height;
    table->AddRGBPoint(last, node.Color[0], node.Color[1], node.Color[2]);
    opacity->AddPoint(last, node.Color[3]);
    transparent = transparent || node.Color[3] < 1.0;
  }
  table->DiscretizeOff();
  table->SetScalarOpacityFunction(opacity);
  table->SetEnableOpacityMapping(transparent);
  table->Build();
  return table;
}

}
