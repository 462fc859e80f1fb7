// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightField_h
#define HeightField_h

#include "HeightView.h"
#include "HeightWindows.h"
#include "ParallelFor.h"
#include "RawArray.h"
#include "SlidingBounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

namespace relief
{

/// A value that means no data in the type of the samples, in which files store it and in which it
/// is compared; nothing if no sample can have it.
template <class T>
std::optional<T> NoDataOf(double value)
{
  if constexpr (std::is_integral_v<T>)
  {
    // One more than the greatest value is a power of 2, while that itself may be no double.
    constexpr T half = std::numeric_limits<T>::max() / 2 + 1;
    constexpr double end = 2.0 * static_cast<double>(half);
    const bool taken = std::floor(value) == value &&
      value >= static_cast<double>(std::numeric_limits<T>::lowest()) && value < end;
    return taken ? std::optional<T>(static_cast<T>(value)) : std::nullopt;
  }
  else
  {
    // The largest float is often written with so few digits that it reads a little larger. False
    // for NaN.
    constexpr double largest = std::numeric_limits<T>::max();
    const bool taken = std::abs(value) / (1.0 + 2e-8) <= largest;
    return taken ? std::optional<T>(static_cast<T>(std::clamp(value, -largest, largest)))
                 : std::nullopt;
  }
}

/// A caller's heights, of any numeric type, and how they become lengths.
template <class T>
struct HeightSource
{
  const T* data = nullptr;
  std::ptrdiff_t stepX = 1;
  std::ptrdiff_t stepY = 0;
  /// NaN to either side of every row, and a row of it behind the last one with the same margins:
  /// with HeightField::Padding of them float heights need no copy to be padded.
  int margin = 0;
  int columns = 0;
  int rows = 0;
  double spacingX = 1.0;
  double spacingY = 1.0;
  double scale = 1.0;
  bool hasNoData = false;
  double noData = 0.0;
  /// Tells whether a sample has data, beside what its value tells; none means that all have.
  std::function<bool(int i, int j)> hasData;
};

/// The heights that a scene is shaded with, prepared once: float samples, NaN without data, and
/// their bounds. Float heights that need no change are used where they are and must outlive this
/// object; others are copied, which takes 4 bytes a sample. The bounds take 1, or 4 where the field
/// is padded.
class HeightField
{
public:
  /// Prepares a field. Returns an empty text, or what is wrong with the heights. With `padded` it
  /// is a copy unless the source has the margins.
  template <class T>
  std::string Assign(
    const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded = false);

  static constexpr int Padding = 32;

  /// What heights are lowered by before they become float lengths: their middle where they lie so
  /// high above 0, or so far below it, that float would lose the relief; else 0. `lo` and `hi` are
  /// the least and the greatest as lengths, in double; `floats` says that the samples themselves
  /// are float, which have no more digits to keep.
  static double FindDatum(double lo, double hi, bool floats);

  /// Says what is wrong with heights above the datum of this range; empty if nothing is, or if
  /// there are none (hi < lo).
  static std::string CheckRange(double lo, double hi);

  /// The row that stands for all rows outside a padded field, from x = 0; null without padding.
  const float* GetMissingRow() const { return this->MissingRow; }

  const MinMaxPyramid& GetPyramid() const { return this->Pyramid; }

  ///@{
  /// What the rays of a padded field skip by beside the pyramid, without padding empty: windows for
  /// a few rays, and the bounds of squares for many. From any cell on, these cover GetReach()
  /// cells.
  static constexpr int NumberOfSquares = 3;
  const HeightWindows& GetWindows() const { return this->Windows; }
  const SlidingBounds& GetSquares(int size) const { return this->Squares[size]; }
  static constexpr int GetReach(int size)
  {
    return SlidingBounds::Reach(size, GetNumberOfBlocks(size));
  }
  ///@}

  /// A number that no other field, and no other state of this one, has.
  std::uint64_t GetVersion() const { return this->Version; }

  /// Whether the caller's own samples are used, which then must stay.
  bool IsInPlace() const { return this->Copy.empty(); }

  const Field<float>& GetField() const { return this->Prepared; }

  /// Heights in the field are lower than the caller's by this length: where the relief is small
  /// beside its height above 0, float would lose it.
  double GetDatum() const { return this->Datum; }

  /// Whether any sample has data.
  bool HasData() const { return this->Top >= this->Bottom; }

  /// Least and greatest height in the field.
  float GetBottom() const { return this->Bottom; }
  float GetTop() const { return this->Top; }

  HeightField() = default;
  HeightField(const HeightField&) = delete; // holds pointers into itself
  void operator=(const HeightField&) = delete;

private:
  friend class SparseHeights;

  static std::uint64_t NextVersion();
  static constexpr int GetNumberOfBlocks(int size) { return size == 0 ? 6 : 5; }

  // Uses the caller's samples where they are, if nothing has to change; returns whether, and what
  // is wrong with the heights then.
  bool AssignInPlace(
    const HeightSource<float>& source, const ParallelFor& parallelFor, std::string& wrong);

  // Copies the samples as lengths, above a datum where float needs one. Returns what is wrong.
  template <class T>
  std::string AssignCopy(
    const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded);

  // Finds the bounds of a band of rows, as high as a block, from so many rows of samples on, as far
  // as there are any: the windows that begin last reach farthest.
  static constexpr int RowsOfBand =
    MinMaxPyramid::BlockSize - HeightWindows::Step + HeightWindows::Size + 1;
  void BoundBand(int band, const float* const* rows, int count);

  Field<float> Prepared;
  RawArray<float> Copy;
  const float* MissingRow = nullptr;
  MinMaxPyramid Pyramid;
  HeightWindows Windows;
  SlidingBounds Squares[NumberOfSquares];
  std::uint64_t Version = 0;
  double Datum = 0.0;
  float Bottom = 0.0f;
  float Top = 0.0f;
};

}

#endif
