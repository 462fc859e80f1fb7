// SPDX-License-Identifier: BSD-3-Clause
#ifndef TiledRaster_h
#define TiledRaster_h

/// @file
/// Files of heights that do not fit into memory. Not installed.

#include "HeightSupply.h"
#include "RasterFile.h"
#include "UndeclaredNoData.h"

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace relief::raster
{
/// A file whose heights are read window by window, each thread with the file open for itself.
class VTKIORELIEFRASTER_EXPORT TiledRaster : public hosts::HeightSupply
{
public:
  using Opener = std::function<std::unique_ptr<RasterFile>()>;

  /// A file, and how it is opened. Throws a Failure if its format is read as a whole only.
  TiledRaster(const std::string& name, const ReadOptions& options, const Opener& open);
  ~TiledRaster() override;

  /// Masks the heights by another file, of the same size: there is no data where that is 0, or has
  /// none itself. Throws a Failure.
  void SetMask(std::unique_ptr<TiledRaster> mask);

  /// Height = scale * stored value + offset, in place of the file's.
  void SetScaling(double scale, double offset) { this->Scaling = { scale, offset }; }

  /// Who is told of passes over the heights.
  void SetWatcher(const io::StepWatcher& watcher) { this->Watcher = watcher; }

  /// What decoded blocks of all files together may take, in bytes, which GDAL keeps for the next
  /// window.
  static void LimitDecoding(double bytes);

  const RasterHeader& GetHeader() const { return this->Header; }

  /// A warning of what looks like no data and is taken for a height (UndeclaredNoData.h), once the
  /// heights have been surveyed; empty for none.
  const std::string& GetUndeclared() const { return this->Undeclared; }

  /// What tells this state of the heights: the file's names, sizes and dates, how it is read, and a
  /// hash of some of its rows. Of what is no file, as of a server's, the last two alone: of such no
  /// survey is kept.
  const std::string& GetState();

  int GetColumns() const override { return this->Header.Columns; }
  int GetRows() const override { return this->Header.Rows; }
  int GetBytesPerSample() const override;
  Part Read(const Window& window) override;
  void Advance(double share) override;
  bool FindSurvey(double scale, hosts::HeightSurvey& survey) override;
  void KeepSurvey(const hosts::HeightSurvey& survey) override;

private:
  class Lease;
  void ApplyMask(const Window& window, Part& part);
  void NoteEnds(const Window& window, const Raster& part);

  std::string Name;
  ReadOptions Options;
  Opener Open;
  RasterHeader Header;
  std::array<double, 2> Scaling;
  std::unique_ptr<TiledRaster> Mask;
  io::StepWatcher Watcher;
  std::string State;
  bool InFiles = false; // what State is of
  std::string Undeclared;
  std::vector<bool> Noted; // which rows are in Ends, while all are passed over
  ValueEnds Ends;
  std::mutex Mutex;
  std::vector<std::unique_ptr<RasterFile>> Free; // open, and nobody's at the moment
};

/// A Raster whose heights are read as they are needed; Surveys them first, for a scale of heights.
/// Throws a Failure, or what the watcher throws.
VTKIORELIEFRASTER_EXPORT Raster ReadTiled(const std::shared_ptr<TiledRaster>& file, double scale);
}

#endif
