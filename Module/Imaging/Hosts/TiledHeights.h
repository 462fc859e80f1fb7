// SPDX-License-Identifier: BSD-3-Clause
#ifndef TiledHeights_h
#define TiledHeights_h

/// @file
/// The heights of an image that does not fit into memory. Not installed.

#include "HeightOutline.h"
#include "HeightSupply.h"
#include "Scene.h"
#include "SparseHeights.h"
#include "TileRegions.h"

#include "vtkGenericDataArray.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkScalarsToColors;

namespace relief::hosts
{
struct HeightInputs;

/// Heights that are read as they are needed: the filter shades any part of an image that has them
/// from those that this part depends on, and from bounds of the others. The result is bit for bit
/// that of the whole. For all others it is an array of heights that is slow to look at, every value
/// being read from its file. What throws throws what the supply does, or a std::bad_alloc.
class VTKRELIEFSHADING_EXPORT TiledHeights : public vtkGenericDataArray<TiledHeights, float>
{
  using Generic = vtkGenericDataArray<TiledHeights, float>;

public:
  static TiledHeights* New();
  vtkTypeMacro(TiledHeights, Generic);

  void SetSupply(std::shared_ptr<HeightSupply> supply);
  HeightSupply& GetSupply() const { return *this->Supply; }

  /// What a pass over the heights finds, with their bounds by this scale. The pass is made unless
  /// it has been, in an earlier run perhaps.
  const HeightSurvey& Survey(double scale);

  /// The same with whatever scale there is.
  const HeightSurvey& Survey() { return this->Survey(this->Found ? this->Found->scale : 1.0); }

  /// As relief::FitHeightScale(), for samples at these distances; reads a part of the heights.
  double FitScale(const double spacing[2]);

  /// Prepares a field whose heights have this scale, unless that has been done. Returns an empty
  /// text, or what is wrong.
  std::string Prepare(double scale, const double spacing[2], bool padded);

  /// What has been prepared.
  const HeightField& GetField() const { return this->Sparse->GetField(); }

  /// What the heights that a window depends on may take, in bytes, and what is done where they
  /// would take more: the farthest are left out, so that they are known by their bounds only, or a
  /// std::runtime_error is thrown.
  struct Limit
  {
    double bytes = std::numeric_limits<double>::infinity();
    bool leavesOut = false;
  };

  /// Fills the field where samples in any of some windows depend on it for a scene, which is
  /// another when its version is, and forgets it elsewhere. What is left out depends on all of
  /// these, on nothing that was filled before. Returns what is known of it, until the next call;
  /// null where nothing is left out.
  const HeightOutline* Provide(const Scene& scene, std::uint64_t version,
    const std::vector<HeightSupply::Window>& windows, const Limit& limit);

  /// How many regions the last call has left out that rays may meet.
  std::size_t GetNumberLeftOut() const { return this->LeftOut; }

  /// About how many bytes of memory Provide() would take for a window, and how many samples it
  /// would have to look at if nothing were left out. More bytes than the limit has mean that it
  /// would throw.
  struct Needs
  {
    double bytes = 0.0;
    double samples = 0.0;
  };
  Needs Estimate(const Scene& scene, std::uint64_t version, const HeightSupply::Window& window,
    const Limit& limit);

  /// The colours that a table gives to heights, 4 bytes a sample, in rows: of the windows that are
  /// provided from now on. Null takes the table away.
  const unsigned char* UseTable(vtkScalarsToColors* table);

  ///@{
  /// What vtkGenericDataArray asks for. A value that cannot be read is NaN, and none can be set.
  ValueType GetValue(vtkIdType at) const;
  void SetValue(vtkIdType, ValueType) {}
  void GetTypedTuple(vtkIdType at, ValueType* tuple) const { *tuple = this->GetValue(at); }
  void SetTypedTuple(vtkIdType, const ValueType*) {}
  ValueType GetTypedComponent(vtkIdType at, int) const { return this->GetValue(at); }
  void SetTypedComponent(vtkIdType, int, ValueType) {}
  ///@}

  void* GetVoidPointer(vtkIdType at) override;

protected:
  TiledHeights();
  ~TiledHeights() override;

private:
  friend Generic;

  TiledHeights(const TiledHeights&) = delete;
  void operator=(const TiledHeights&) = delete;

  bool AllocateTuples(vtkIdType) { return false; }
  bool ReallocateTuples(vtkIdType) { return false; }

  // What is made for a scale, spacing and padding.
  struct Preparation
  {
    double scale;
    double spacing[2];
    bool padded;
  };

  std::unique_ptr<HeightSurvey> MakeSurvey(double scale, double datum) const;
  const TileRegions& RegionsFor(const Scene& scene, std::uint64_t version);
  TileRegions::Found FindAll(const std::vector<HeightSupply::Window>& windows) const;
  double BytesOf(const TileRegions::Found& found) const;
  double BytesOfColors(const HeightSupply::Window& window) const;
  void LeaveOut(const std::vector<HeightSupply::Window>& windows, double bytes,
    TileRegions::Found& found) const;
  RegionSet FindWhole(
    const std::vector<HeightSupply::Window>& windows, const TileRegions::Found& filled) const;
  void Fill(const RegionSet& regions);
  void Color(const HeightSupply::Window& window);

  std::shared_ptr<HeightSupply> Supply;
  std::unique_ptr<HeightSurvey> Found;
  std::unique_ptr<SparseHeights> Sparse;
  std::optional<Preparation> Prepared;
  std::unique_ptr<TileRegions> Regions;
  std::uint64_t RegionsVersion = 0;
  std::optional<HeightOutline> Outline; // of the last windows, where any is left out
  std::size_t LeftOut = 0;
  vtkSmartPointer<vtkScalarsToColors> Table;
  RawArray<unsigned char> Colors;
  std::vector<float> Copy; // for GetVoidPointer
};

/// Heights of a window with a scale, to be read.
VTKRELIEFSHADING_EXPORT HeightInputs InputsOf(const HeightSupply::Part& part, double scale);

/// The heights of inputs, if they are such; null where they are others.
VTKRELIEFSHADING_EXPORT TiledHeights* FindTiled(const HeightInputs& inputs);
}

#endif
