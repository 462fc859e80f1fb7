// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightField_h
#define HeightField_h

#include "HeightView.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace relief
{

/// How a host runs body(begin, end) over disjoint parts of [0, count), on as many threads as it
/// likes.
using ParallelFor =
  std::function<void(int count, const std::function<void(int begin, int end)>& body)>;

/// A caller's heights, of any numeric type, and how they become lengths.
template <class T>
struct HeightSource
{
  const T* data = nullptr;
  std::ptrdiff_t stepX = 1;
  std::ptrdiff_t stepY = 0;
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
/// object; others are copied, which takes 4 bytes a sample. The bounds take 1.
class HeightField
{
public:
  /// Prepares a field. Returns an empty text, or what is wrong with the heights. With `padded` it
  /// is a copy in any case.
  template <class T>
  std::string Assign(
    const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded = false);

  static constexpr int Padding = 32;

  /// The row that stands for all rows outside a padded field, from x = 0; null without padding.
  const float* GetMissingRow() const { return this->MissingRow; }

  const MinMaxPyramid& GetPyramid() const { return this->Pyramid; }

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
  Field<float> Prepared;
  std::vector<float> Copy;
  const float* MissingRow = nullptr;
  MinMaxPyramid Pyramid;
  std::uint64_t Version = 0;
  double Datum = 0.0;
  float Bottom = 0.0f;
  float Top = 0.0f;
};

}

#endif
