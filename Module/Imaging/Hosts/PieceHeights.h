// SPDX-License-Identifier: BSD-3-Clause
#ifndef PieceHeights_h
#define PieceHeights_h

/// @file
/// Heights of which only those come that a piece of the picture depends on. Not installed.

#include "HeightInputs.h"
#include "ImageFrame.h"
#include "RasterBounds.h"
#include "SparseHeights.h"
#include "TileRegions.h"
#include "vtkReliefShadingModule.h" // For export macro

#include "vtkNew.h"
#include "vtkType.h"

#include <cstddef>
#include <memory>
#include <string>
#include <tuple>

namespace relief
{
struct Scene;
}

namespace relief::hosts
{
/// What is known of an image's heights before any have come.
struct WholeHeights
{
  vtkImageData* image = nullptr;  ///< its whole extent and its place; no heights need be in it
  double range[2] = { 0.0, 0.0 }; ///< least and greatest, in the input's own values
  double scale = 1.0;
  bool floats = true;  ///< whether they are stored in single precision
  bool padded = false; ///< as HeightField::Assign() takes it
};

/// A field as large as a whole image that takes memory only where heights have come.
class VTKRELIEFSHADING_EXPORT PartialField
{
public:
  /// Prepares a field without heights, unless the one at hand is of the same. Returns an empty
  /// text, or what is wrong; then there is none.
  std::string Begin(const WholeHeights& whole);

  /// Forgets all heights. Returns as Begin() does.
  std::string Reserve();

  /// What the samples of a piece of the extent depend on, by what is known. Of regions that have
  /// not come yet it is taken for granted that they have no holes, unless Bounds says otherwise.
  TileRegions::Found Find(const Scene& scene, const int piece[6]) const;

  /// Fills regions from inputs that have them. Returns an empty text, or what is wrong with these.
  std::string Fill(const RegionSet& regions, const HeightInputs& inputs);

  /// The samples of some regions as an extent of the image.
  void ExtentOf(const RegionSet::Block& regions, int extent[6]) const;

  void Release();

  const HeightField& GetField() const { return this->Sparse->GetField(); }

  vtkNew<vtkImageData> Image; ///< the whole, without heights
  ImageFrame Frame;
  RasterBounds Bounds;
  std::unique_ptr<SparseHeights> Sparse; ///< none before Begin()

private:
  void Learn(const RegionSet& regions);
  std::string CheckRange(const RegionSet& regions) const;

  WholeHeights Known; // its image is the one above
  double Datum = 0.0;
  bool Reserved = false;
};

/// Brings the heights that a piece of the picture depends on, by the least and the greatest of all,
/// so that the picture is bit for bit that of the whole.
///
/// A host asks by Begin(), has its inputs bring the extent that it tells, and calls Fill(). While
/// NeedsMore() tells of another extent, it has that brought, too: where rays leave the data, at
/// holes and borders, what lies ahead decides how the ground goes on. Then the piece can be shaded.
class VTKRELIEFSHADING_EXPORT PieceHeights
{
public:
  ///@{
  /// Before heights come: a field to convert a scene by, and the extent to ask for.
  std::string Begin(const WholeHeights& whole);
  const PartialField& GetEmpty() const { return this->Empty; }
  void Ask(const Scene& scene, const int piece[6], int extent[6]);
  ///@}

  /// Takes the first heights that have come. `inputs` are checked. Returns an empty text, or what
  /// is wrong.
  std::string FillFirst(const WholeHeights& whole, const HeightInputs& inputs);

  /// Takes further ones.
  std::string FillMore(const HeightInputs& inputs);

  /// Takes inputs, as they are now, for those that the heights came from.
  void Remember(const HeightInputs& inputs) { this->TakenFrom = OriginOf(inputs); }

  /// Whether more must come, and which extent.
  bool NeedsMore(const Scene& scene, const int piece[6], int extent[6]);

  /// The heights that have come.
  const PartialField& GetHeld() const { return this->Held; }

  void Release();

private:
  void AskFor(const RegionSet& missing, std::size_t most, int extent[6]);

  PartialField Empty;
  PartialField Held;
  RegionSet Asked;
  RegionSet Used;          // by the last piece
  std::size_t Portion = 0; // regions in the first extent
  int Guesses = 0;

  // Modification times are never given twice.
  using Origin = std::tuple<void*, vtkMTimeType, vtkMTimeType, void*, void*, bool, double>;
  static Origin OriginOf(const HeightInputs& inputs);
  Origin TakenFrom;
};
}

#endif
