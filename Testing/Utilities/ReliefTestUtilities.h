// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefTestUtilities_h
#define ReliefTestUtilities_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// Whether memory is handed out by a sanitizer, which takes more, gives back later and does not
/// tell.
#if defined(RELIEFSHADING_SANITIZED)
constexpr bool IsMemorySanitized = true;
#else
constexpr bool IsMemorySanitized = false;
#endif

/// Counts a failed check and says where; the test goes on.
#define CHECK(condition)                                                                           \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      std::cout << __FILE__ << ":" << __LINE__ << ": failed: " #condition << std::endl;            \
      ++Failures;                                                                                  \
    }                                                                                              \
  } while (false)

/// Checks that two numbers differ by no more than a bound.
#define CHECK_NEAR(a, b, bound)                                                                    \
  do                                                                                               \
  {                                                                                                \
    double checkA = (a);                                                                           \
    double checkB = (b);                                                                           \
    if (!(std::abs(checkA - checkB) <= (bound)))                                                   \
    {                                                                                              \
      std::cout << __FILE__ << ":" << __LINE__ << ": " #a " is " << checkA << ", " #b " is "       \
                << checkB << std::endl;                                                            \
      ++Failures;                                                                                  \
    }                                                                                              \
  } while (false)

/// An image of heights, as a function of the indices.
template <class ArrayType = vtkFloatArray>
vtkSmartPointer<vtkImageData> MakeHeights(
  int columns, int rows, const std::function<double(int, int)>& height)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  vtkNew<ArrayType> values;
  values->SetName("Height");
  values->SetNumberOfTuples(static_cast<vtkIdType>(columns) * rows);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      values->SetTuple1(static_cast<vtkIdType>(j) * columns + i, height(i, j));
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

/// Waves with rough detail and one sample without data.
inline double Waves(int i, int j)
{
  return i == 5 && j == 7
    ? std::numeric_limits<double>::quiet_NaN()
    : 4.0 * std::sin(0.3 * i) * std::cos(0.21 * j) + 0.3 * ((7 * i + 3 * j) % 5);
}

/// Rolling hills with rough detail, whole numbers from 0 to about 60, the same for the same seed.
inline std::function<double(int, int)> Hills(unsigned int seed)
{
  return [seed](int i, int j)
  {
    unsigned int detail = 2654435761u * (seed + 7919u * static_cast<unsigned int>(i)) ^
      2246822519u * (seed + 104729u * static_cast<unsigned int>(j));
    detail = (detail ^ detail >> 15) * 3266489917u;
    return std::floor(30.0 + 15.0 * std::sin(0.21 * i) * std::cos(0.17 * j) +
      10.0 * std::sin(0.05 * (i + 2 * j)) + static_cast<double>(detail >> 30));
  };
}

inline float Value(vtkImageData* image, const char* array, int i, int j, int component = 0)
{
  int extent[6];
  image->GetExtent(extent);
  vtkDataArray* values =
    array ? image->GetPointData()->GetArray(array) : image->GetPointData()->GetScalars();
  vtkIdType at =
    static_cast<vtkIdType>(j - extent[2]) * (extent[1] - extent[0] + 1) + (i - extent[0]);
  return static_cast<float>(values->GetComponent(at, component));
}

/// Whether two arrays hold the same bytes.
inline bool SameBytes(vtkDataArray* a, vtkDataArray* b)
{
  return a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      static_cast<std::size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize()) == 0;
}

/// Largest difference between two arrays' values; infinite where they do not match, NaN equals NaN.
inline double LargestDifference(vtkDataArray* a, vtkDataArray* b)
{
  if (!a || !b || a->GetNumberOfTuples() != b->GetNumberOfTuples() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return VTK_DOUBLE_MAX;
  }
  double largest = 0.0;
  for (vtkIdType t = 0; t < a->GetNumberOfTuples(); ++t)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      double x = a->GetComponent(t, c);
      double y = b->GetComponent(t, c);
      if (std::isnan(x) != std::isnan(y))
      {
        return VTK_DOUBLE_MAX;
      }
      largest = x == y || std::isnan(x) ? largest : std::max(largest, std::abs(x - y));
    }
  }
  return largest;
}

/// Keeps what an object reports as errors and warnings, which then are not printed.
class MessageKeeper
{
public:
  explicit MessageKeeper(vtkObject* object)
    : Object(object)
    , Tags{ object->AddObserver(vtkCommand::ErrorEvent, this, &MessageKeeper::Keep),
      object->AddObserver(vtkCommand::WarningEvent, this, &MessageKeeper::Keep) }
  {
  }
  ~MessageKeeper()
  {
    this->Object->RemoveObserver(this->Tags[0]);
    this->Object->RemoveObserver(this->Tags[1]);
  }
  MessageKeeper(const MessageKeeper&) = delete;
  void operator=(const MessageKeeper&) = delete;

  /// Whether one error and nothing else came since the last call, and it contains the text.
  bool OneError(const std::string& text) { return this->One(vtkCommand::ErrorEvent, text); }
  bool OneWarning(const std::string& text) { return this->One(vtkCommand::WarningEvent, text); }
  bool Silent() const { return this->Messages.empty(); }

private:
  void Keep(vtkObject*, unsigned long event, void* text)
  {
    this->Messages.emplace_back(event, static_cast<const char*>(text));
  }

  bool One(unsigned long event, const std::string& text)
  {
    bool one = this->Messages.size() == 1 && this->Messages[0].first == event &&
      this->Messages[0].second.find(text) != std::string::npos;
    if (!one)
    {
      std::cout << this->Messages.size() << " messages where one with '" << text
                << "' is expected\n";
      for (const auto& message : this->Messages)
      {
        std::cout << "  " << message.second << std::endl;
      }
    }
    this->Messages.clear();
    return one;
  }

  vtkObject* Object;
  unsigned long Tags[2];
  std::vector<std::pair<unsigned long, std::string>> Messages;
};

/// Keeps what an algorithm reports as progress, and stops it on the way if it is told to.
class ProgressKeeper
{
public:
  explicit ProgressKeeper(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
    , Tag(algorithm->AddObserver(vtkCommand::ProgressEvent, this, &ProgressKeeper::Keep))
  {
  }
  ~ProgressKeeper() { this->Algorithm->RemoveObserver(this->Tag); }
  ProgressKeeper(const ProgressKeeper&) = delete;
  void operator=(const ProgressKeeper&) = delete;

  bool Rises() const { return std::is_sorted(this->Steps.begin(), this->Steps.end()); }

  double StopAbove = VTK_DOUBLE_MAX;
  std::vector<double> Steps;
  std::function<void()> AtStep = [] {};

private:
  void Keep(vtkObject*, unsigned long, void* amount)
  {
    this->Steps.push_back(*static_cast<double*>(amount));
    this->AtStep();
    this->Algorithm->SetAbortExecute(this->Steps.back() > this->StopAbove);
  }

  vtkAlgorithm* Algorithm;
  unsigned long Tag;
};

#endif
