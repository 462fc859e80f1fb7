// SPDX-License-Identifier: BSD-3-Clause
#include "RasterFile.h"

#include "UndeclaredNoData.h"

#include "vtkErrorCode.h"

#include <cmath>
#include <sstream>

namespace relief::raster
{
//------------------------------------------------------------------------------
void CheckSpacing(const RasterHeader& header)
{
  for (const double spacing : header.Spacing)
  {
    if (!(spacing > 0.0) || !std::isfinite(spacing))
    {
      std::ostringstream text;
      text << "its georeference sets samples " << header.Spacing[0] << " x " << header.Spacing[1]
           << " m apart; numbers above 0 are expected";
      throw io::Failure(vtkErrorCode::FileFormatError, text.str());
    }
  }
  CheckAngles(header);
}

//------------------------------------------------------------------------------
Raster RasterFile::ReadWindow(const Window&)
{
  throw io::Failure(vtkErrorCode::FileFormatError, "its format is read as a whole only");
}

//------------------------------------------------------------------------------
Raster ReadStored(RasterFile& file, const ReadOptions& options, const RasterFile::Window& window)
{
  Raster raster = file.ReadWindow(window);
  if (!options.NoDataFromFile)
  {
    raster.NoData = options.NoData;
  }
  MarkNoData(raster);
  return raster;
}

//------------------------------------------------------------------------------
Raster ReadHeights(RasterFile& file, const ReadOptions& options, const MemoryPlan& plan,
  const io::StepWatcher& watcher)
{
  CheckSpacing(file.GetHeader());
  MemoryPlan whole = plan;
  whole.PerPixel += IsScaled(file.GetHeader()) ? sizeof(float) : 0.0;
  Raster raster = file.Read(whole, watcher);
  if (!options.NoDataFromFile)
  {
    raster.NoData = options.NoData;
  }
  MarkNoData(raster);
  if (options.NoDataFromFile || options.NoData)
  {
    WarnOfUndeclaredNoData(raster); // who says that there is none has been told
  }
  ApplyScale(raster);
  return raster;
}

//------------------------------------------------------------------------------
OptionFailure::OptionFailure(
  Choice option, const std::string& reason, const std::vector<std::string>& bands)
  : io::Failure(vtkErrorCode::FileFormatError, reason)
  , Option(option)
  , Bands(bands)
{
}

//------------------------------------------------------------------------------
OptionFailure ManyComponents(const std::vector<std::string>& bands)
{
  const bool colors = bands.size() == 3;
  return { colors ? OptionFailure::Colors : OptionFailure::Band,
    std::to_string(bands.size()) + " components; expected 1 (height), or the choice of " +
      (colors ? "the encoding of heights or of one band" : "one of them as the band of heights"),
    bands };
}

//------------------------------------------------------------------------------
std::vector<std::string> ColorNames(int colors)
{
  return colors == 3 ? std::vector<std::string>{ "red", "green", "blue" }
                     : std::vector<std::string>(colors);
}
}
