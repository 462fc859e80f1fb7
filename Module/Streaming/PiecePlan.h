// SPDX-License-Identifier: BSD-3-Clause
#ifndef PiecePlan_h
#define PiecePlan_h

/// @file
/// Into which pieces a picture is cut that does not fit into memory, and who shades them. Not
/// installed.

#include "vtkIOReliefStreamingModule.h" // For export macro
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkImageData;
class vtkImageReliefShading;

namespace relief::streaming
{
using PieceExtent = std::array<int, 6>;

/// What is known of all heights takes, for a sample.
constexpr double BoundsBytes = 0.007;

/// The pieces of a picture: bands of rows, as high as fit into memory; where the lowest does not,
/// bands are cut across.
class VTKIORELIEFSTREAMING_EXPORT PiecePlan
{
public:
  PiecePlan() = default;

  /// Cuts the picture of this extent so that no piece takes more than `memory`, in bytes, of which
  /// a part is for the program itself. `sampleBytes` is what a shaded sample takes; a piece is
  /// shaded while the one before is saved.
  PiecePlan(vtkImageReliefShading* shading, const int extent[6], double memory, double sampleBytes);

  /// Whether that could be done; else the pieces are the least there are.
  bool Fits() const { return this->Fit; }

  /// What pieces may take of the memory, in bytes, and what memory pieces of so many bytes want.
  double GetRoom() const { return this->Room; }
  double MemoryFor(double bytes) const;

  /// What the largest of the pieces takes.
  double FindLargest(vtkImageReliefShading* shading, double sampleBytes) const;

  ///@{
  /// Columns and rows of a piece; those at the border have fewer.
  int GetColumns() const { return this->Columns; }
  int GetRows() const { return this->Rows; }
  ///@}

  /// Band by band, from the lower ones on.
  const std::vector<PieceExtent>& GetPieces() const { return this->Pieces; }

  int GetNumberOfBands() const;

  /// A band of all columns with these arrays, the first being its scalars, put together of its
  /// pieces. What `load` throws comes out.
  vtkSmartPointer<vtkImageData> LoadBand(int band, const std::vector<std::string>& arrays,
    const std::function<vtkSmartPointer<vtkImageData>(const PieceExtent&)>& load) const;

private:
  std::vector<PieceExtent> Cut() const;

  PieceExtent Whole{ 0, -1, 0, -1, 0, -1 };
  int Columns = 0;
  int Rows = 0;
  double Room = 0.0;
  bool Fit = false;
  std::vector<PieceExtent> Pieces;
};

/// Those of the pieces that are one process's of several: neighbours, which have heights in common,
/// of about as much work as the others'.
VTKIORELIEFSTREAMING_EXPORT std::vector<PieceExtent> ShareOf(vtkImageReliefShading* shading,
  const std::vector<PieceExtent>& pieces, int process, int processes);

/// The names of a shading's arrays: its picture, and the layers that it generates.
VTKIORELIEFSTREAMING_EXPORT std::vector<std::string> ArraysOf(vtkImageReliefShading* shading);
}

#endif
