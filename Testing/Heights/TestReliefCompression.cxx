// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefCompression: the budget, what does not change the relief, background, steps where depth
// jumps, the order of depth, hard inputs, refusals.
#include "vtkCallbackCommand.h"
#include "vtkReliefCompression.h"

#include "CompressionSubjects.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace
{
int Failures = 0;

constexpr int AllMethods[] = { vtkReliefCompression::GradientDomain, vtkReliefCompression::TwoScale,
  vtkReliefCompression::Linear };

vtkSmartPointer<vtkImageData> Compress(
  vtkImageData* depth, int method, double budget, bool fill = false)
{
  vtkNew<vtkReliefCompression> compression;
  compression->SetInputData(depth);
  compression->SetMethod(method);
  compression->SetHeightBudget(budget);
  compression->SetFillBackground(fill);
  compression->Update();
  return compression->GetOutput();
}

struct Bounds
{
  double least = VTK_DOUBLE_MAX;
  double largest = -VTK_DOUBLE_MAX;
  vtkIdType missing = 0;
};

Bounds BoundsOf(vtkImageData* image)
{
  vtkDataArray* values = image->GetPointData()->GetScalars();
  Bounds bounds;
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    const double value = values->GetTuple1(k);
    bounds.missing += std::isfinite(value) ? 0 : 1;
    if (std::isfinite(value))
    {
      bounds.least = std::min(bounds.least, value);
      bounds.largest = std::max(bounds.largest, value);
    }
  }
  return bounds;
}

double Difference(vtkImageData* a, vtkImageData* b)
{
  return LargestDifference(a->GetPointData()->GetScalars(), b->GetPointData()->GetScalars());
}

vtkDataArray* Scalars(vtkImageData* image)
{
  return image->GetPointData()->GetScalars();
}

// A dome with a bar across it, whole numbers from 0 to 240, half of it against nothing.
double Dome(int i, int j)
{
  const double x = (i - 30.0) / 28.0;
  const double y = (j - 24.0) / 22.0;
  const double r = x * x + y * y;
  const double bar = std::abs(j - 20 - i / 8) < 4 ? 90.0 : 0.0;
  return r < 1.0 ? std::round(150.0 * std::sqrt(1.0 - r) + bar) : 0.0;
}

double DomeOnNothing(int i, int j)
{
  const double height = Dome(i, j);
  return height > 0.0 ? height : vtkMath::Nan();
}

//------------------------------------------------------------------------------
void TestLinear()
{
  const auto depth = MakeHeights(61, 50, [](int i, int j) { return Dome(i, j) - 17.0; });
  vtkImageData* output = nullptr;
  vtkNew<vtkReliefCompression> compression;
  compression->SetInputData(depth);
  compression->SetMethodToLinear();
  for (const double budget : { 1.0, 0.25 })
  {
    compression->SetHeightBudget(budget);
    compression->Update();
    output = compression->GetOutput();
    const auto expected = MakeHeights(61, 50, [&](int i, int j) { return budget * Dome(i, j); });
    CHECK(Difference(output, expected) == 0.0);
  }
}

//------------------------------------------------------------------------------
template <class ArrayType>
void TestBudget(double factor, double constant)
{
  const auto depth =
    MakeHeights<ArrayType>(61, 50, [=](int i, int j) { return factor * Dome(i, j) + constant; });
  depth->SetOrigin(5.0, -3.0, 1.0);
  depth->SetSpacing(0.5, 0.25, 1.0);
  vtkNew<vtkIntArray> place;
  place->SetName("place");
  depth->GetFieldData()->AddArray(place);
  const double range = BoundsOf(depth).largest - BoundsOf(depth).least;
  for (const int method : AllMethods)
  {
    for (const double budget : { 0.003, 0.02, 0.1, 0.37, 1.0 })
    {
      const auto output = Compress(depth, method, budget);
      const Bounds bounds = BoundsOf(output);
      CHECK(bounds.missing == 0 && bounds.least == 0.0);
      CHECK(bounds.largest == static_cast<float>(budget * range));
      CHECK(output->GetScalarType() == VTK_FLOAT && output->GetSpacing()[1] == 0.25);
      CHECK(Scalars(output)->GetName() == std::string("Height") && output->GetOrigin()[0] == 5.0);
      CHECK(output->GetFieldData()->GetArray("place") == place);
    }
  }
}

//------------------------------------------------------------------------------
// A constant changes no bit, a factor is passed on, and so are mirroring and transposing.
void TestInvariances()
{
  const int columns = 61;
  const int rows = 50;
  const auto depth = MakeHeights(columns, rows, DomeOnNothing);
  const auto raised =
    MakeHeights(columns, rows, [](int i, int j) { return DomeOnNothing(i, j) + 4096.0; });
  const auto fourfold =
    MakeHeights(columns, rows, [](int i, int j) { return 4.0 * DomeOnNothing(i, j); });
  const auto mirrored =
    MakeHeights(columns, rows, [=](int i, int j) { return DomeOnNothing(columns - 1 - i, j); });
  const auto transposed =
    MakeHeights(rows, columns, [](int i, int j) { return DomeOnNothing(j, i); });
  for (const int method : AllMethods)
  {
    for (const double budget : { 0.05, 0.5, 1.0 })
    {
      const auto output = Compress(depth, method, budget);
      const double top = BoundsOf(output).largest;
      CHECK(SameBytes(Scalars(output), Scalars(Compress(raised, method, budget))));
      const auto four = Compress(fourfold, method, budget);
      const auto mirror = Compress(mirrored, method, budget);
      const auto turned = Compress(transposed, method, budget);
      double worst[3] = { 0.0, 0.0, 0.0 };
      for (int j = 0; j < rows; ++j)
      {
        for (int i = 0; i < columns; ++i)
        {
          const double value = Value(output, nullptr, i, j);
          if (std::isnan(value))
          {
            continue;
          }
          const double others[3] = { Value(four, nullptr, i, j) / 4.0,
            Value(mirror, nullptr, columns - 1 - i, j), Value(turned, nullptr, j, i) };
          for (int n = 0; n < 3; ++n)
          {
            worst[n] = std::max(worst[n], std::abs(others[n] - value));
          }
        }
      }
      CHECK(worst[0] == 0.0);
      CHECK_NEAR(worst[1], 0.0, 2e-3 * top);
      CHECK_NEAR(worst[2], 0.0, 2e-3 * top);
    }
  }
}

//------------------------------------------------------------------------------
void TestThreads()
{
  vtkSMPTools::SetBackend("STDThread");
  const auto depth = MakeOwl(200);
  for (const int method : AllMethods)
  {
    vtkSMPTools::Initialize(1);
    const auto one = Compress(depth, method, 0.05);
    for (const int threads : { 2, 5 })
    {
      vtkSMPTools::Initialize(threads);
      CHECK(SameBytes(Scalars(one), Scalars(Compress(depth, method, 0.05))));
    }
  }
  vtkSMPTools::Initialize(0);
}

//------------------------------------------------------------------------------
void TestBackground()
{
  const auto byNaN = MakeHeights(61, 50, DomeOnNothing);
  const auto byValue = MakeHeights<vtkShortArray>(61, 50, Dome);
  const auto mask =
    MakeHeights<vtkUnsignedCharArray>(61, 50, [](int i, int j) { return Dome(i, j) > 0.0; });
  for (const int method : AllMethods)
  {
    const auto expected = Compress(byNaN, method, 0.1);
    vtkNew<vtkReliefCompression> compression;
    compression->SetMethod(method);
    compression->SetInputData(byValue);
    compression->SetNoDataValue(0.0);
    compression->Update();
    CHECK(SameBytes(Scalars(compression->GetOutput()), Scalars(expected)));
    compression->SetNoDataValue(vtkMath::Nan());
    compression->SetMaskData(mask);
    compression->Update();
    CHECK(SameBytes(Scalars(compression->GetOutput()), Scalars(expected)));

    const auto filled = Compress(byNaN, method, 0.1, true);
    const bool stepped = method == vtkReliefCompression::GradientDomain;
    int wrong = 0;
    for (int j = 0; j < 50; ++j)
    {
      for (int i = 0; i < 61; ++i)
      {
        const float value = Value(expected, nullptr, i, j);
        const bool missing = std::isnan(value);
        const bool right = missing == std::isnan(DomeOnNothing(i, j)) &&
          Value(filled, nullptr, i, j) == (missing ? 0.0f : value) &&
          (missing || (stepped ? value > 0.0f : value >= 0.0f));
        wrong += right ? 0 : 1;
      }
    }
    CHECK(wrong == 0);
    CHECK_NEAR(BoundsOf(expected).least / BoundsOf(expected).largest, stepped ? 0.05 : 0.0, 1e-6);
  }
}

//------------------------------------------------------------------------------
// What is in front stays in front at every gap, and nearly everywhere else, by how steep it was.
void TestOrder(vtkImageData* depth, double budget)
{
  const auto output = Compress(depth, vtkReliefCompression::GradientDomain, budget);
  const double gap = 0.06 * (BoundsOf(depth).largest - BoundsOf(depth).least);
  const int* size = depth->GetDimensions();
  int gaps = 0;
  int wrongGaps = 0;
  double slopes = 0.0;
  double wrongSlopes = 0.0;
  for (int j = 0; j + 1 < size[1]; ++j)
  {
    for (int i = 0; i + 1 < size[0]; ++i)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        const double before =
          Value(depth, nullptr, i + 1 - axis, j + axis) - Value(depth, nullptr, i, j);
        const double after =
          Value(output, nullptr, i + 1 - axis, j + axis) - Value(output, nullptr, i, j);
        if (std::abs(before) > gap)
        {
          ++gaps;
          wrongGaps += before * after > 0.0 ? 0 : 1;
        }
        else if (!std::isnan(before))
        {
          slopes += std::abs(before);
          wrongSlopes += before * after < 0.0 ? std::abs(before) : 0.0;
        }
      }
    }
  }
  std::cout << "budget " << budget << ": " << wrongGaps << " of " << gaps << " gaps and "
            << 100.0 * wrongSlopes / slopes << " % of the slopes are turned around" << std::endl;
  CHECK(gaps > 100 && wrongGaps == 0);
  CHECK(wrongSlopes < 0.1 * slopes);
}

//------------------------------------------------------------------------------
// A block on a slope, with a ripple on all.
double Block(int i, int j)
{
  const bool top = i > 20 && i < 60 && j > 15 && j < 45;
  return (top ? 60.0 : 0.0) + 0.4 * i + 0.5 * (i % 4 < 2 ? 1.0 : -1.0);
}

// How rough the ripple is, and how high the block's sides are.
struct Look
{
  double ripple = 0.0;
  double step = 0.0;
};

Look LookOf(vtkImageData* image)
{
  Look look;
  for (int i = 25; i < 55; ++i)
  {
    look.ripple += std::abs(Value(image, nullptr, i, 30) - 2.0 * Value(image, nullptr, i + 1, 30) +
                     Value(image, nullptr, i + 2, 30)) /
      30.0;
    look.step += (Value(image, nullptr, i, 16) - Value(image, nullptr, i, 15)) / 30.0;
  }
  return look;
}

//------------------------------------------------------------------------------
void TestProperties()
{
  vtkNew<vtkReliefCompression> compression;
  const auto depth = MakeHeights(80, 60, Block);
  compression->SetInputData(depth);
  const Look full = LookOf(depth);
  const auto look = [&]
  {
    compression->Update();
    return LookOf(compression->GetOutput());
  };
  const double budget = 0.1 * (BoundsOf(depth).largest - BoundsOf(depth).least);
  // With 1 the ripple is as it was, but for the attenuation of slopes.
  double last = 0.0;
  for (const double detail : { 0.0, 0.3, 0.6, 0.9 })
  {
    compression->SetDetail(detail);
    const double ripple = look().ripple;
    CHECK(ripple > 1.05 * last && ripple < full.ripple);
    last = ripple;
  }
  compression->SetDetail(1.0);
  CHECK(look().ripple > 0.4 * full.ripple);
  // The block's side is a gap.
  compression->SetDetail(0.3);
  last = -1.0;
  for (const double silhouettes : { 0.0, 0.5, 1.0 })
  {
    compression->SetSilhouettes(silhouettes);
    const double step = look().step / budget;
    CHECK(step > last && step >= 0.04 * silhouettes && step < 0.4);
    last = step;
  }
  // No gap is as large as the whole range.
  compression->SetJumpThreshold(1.0);
  CHECK(look().step / budget > last);
}

//------------------------------------------------------------------------------
// A smooth surface without gaps in full round is what it was.
void TestFullRound()
{
  const auto depth = MakeHeights(
    70, 90, [](int i, int j) { return 5.0 * std::sin(0.11 * i) * std::cos(0.07 * j) + 0.02 * i; });
  for (const int method : AllMethods)
  {
    const auto output = Compress(depth, method, 1.0);
    const double least = BoundsOf(depth).least;
    double worst = 0.0;
    for (vtkIdType k = 0; k < Scalars(output)->GetNumberOfTuples(); ++k)
    {
      worst = std::max(
        worst, std::abs(Scalars(output)->GetTuple1(k) - Scalars(depth)->GetTuple1(k) + least));
    }
    CHECK_NEAR(worst, 0.0, 1e-4);
  }
}

//------------------------------------------------------------------------------
// All are taken: the largest height is the budget wherever there is depth at all.
void TestHardInputs()
{
  const double nan = vtkMath::Nan();
  const double inf = vtkMath::Inf();
  struct Case
  {
    const char* name;
    int columns;
    int rows;
    std::function<double(int, int)> height;
  };
  const std::vector<Case> cases = {
    { "one sample", 1, 1, [](int, int) { return 7.0; } },
    { "one sample without data", 1, 1, [=](int, int) { return nan; } },
    { "two samples", 2, 1, [](int i, int) { return 3.0 * i; } },
    { "a row", 100, 1, [](int i, int) { return std::sin(0.2 * i); } },
    { "a column", 1, 100, [](int, int j) { return std::sin(0.2 * j); } },
    { "level", 20, 30, [](int, int) { return -1e6; } },
    { "no data", 20, 30, [=](int, int) { return nan; } },
    { "infinite", 20, 30, [=](int i, int) { return i < 5 ? inf
                                              : i < 9    ? -inf
                                                         : 0.1 * i; } },
    { "terraces", 40, 30, [](int i, int j) { return i / 10 + 4.0 * (j / 10); } },
    { "two level islands", 40, 30, [=](int i, int) { return i < 10 ? 1.0
                                                       : i < 20    ? nan
                                                                   : 2.0; } },
    { "single samples", 40, 30, [=](int i, int j) { return (i + j) % 2 ? nan : i * 0.01 * j; } },
    { "noise", 40, 30, [](int i, int j) { return Hills(5)(i, j); } },
    { "tiny", 40, 30, [](int i, int j) { return 1e-30 * Dome(i, j); } },
    { "huge", 40, 30, [](int i, int j) { return 1e35 * Dome(i, j); } },
    { "high up", 40, 30, [](int i, int j) { return 1e15 + Dome(i, j); } },
    { "a needle", 40, 30, [](int i, int j) { return i == 20 && j == 15 ? 1e6 : 0.001 * i; } },
  };
  for (const Case& one : cases)
  {
    const auto depth = MakeHeights<vtkDoubleArray>(one.columns, one.rows, one.height);
    const Bounds before = BoundsOf(depth);
    const bool some = before.largest >= before.least;
    for (const int method : AllMethods)
    {
      vtkNew<vtkReliefCompression> compression;
      MessageKeeper messages(compression);
      compression->SetInputData(depth);
      compression->SetMethod(method);
      compression->Update();
      const Bounds after = BoundsOf(compression->GetOutput());
      const bool good = messages.Silent() && after.missing == before.missing &&
        (!some ||
          (after.least >= 0.0 &&
            after.largest == static_cast<float>(0.1 * (before.largest - before.least))));
      if (!good)
      {
        std::cout << one.name << ", method " << method << ": " << after.least << " to "
                  << after.largest << std::endl;
      }
      CHECK(good);
    }
  }
}

//------------------------------------------------------------------------------
// The depth's range itself may be beyond double, if only the relief can be told.
void TestRange()
{
  vtkNew<vtkReliefCompression> compression;
  MessageKeeper messages(compression);
  compression->SetInputData(
    MakeHeights<vtkDoubleArray>(9, 8, [](int i, int) { return i % 2 ? 1e39 : 0.0; }));
  compression->SetHeightBudget(1.0);
  compression->Update();
  CHECK(messages.OneError("single precision"));
  CHECK(compression->GetOutput()->GetNumberOfPoints() == 0);
  compression->SetHeightBudget(0.1);
  compression->Update();
  CHECK(messages.Silent() && BoundsOf(compression->GetOutput()).largest == 1e38f);
  compression->SetInputData(MakeHeights<vtkDoubleArray>(
    9, 8, [](int i, int) { return i % 2 ? VTK_DOUBLE_MAX : -VTK_DOUBLE_MAX; }));
  compression->Update();
  CHECK(messages.OneError("single precision"));
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkReliefCompression> compression;
  MessageKeeper messages(compression);
  const vtkMTimeType time = compression->GetMTime();
  for (const double value : { -0.1, 0.0, 1.1, vtkMath::Nan(), vtkMath::Inf() })
  {
    compression->SetHeightBudget(value);
    CHECK(messages.OneError("SetHeightBudget") && compression->GetHeightBudget() == 0.1);
    compression->SetJumpThreshold(value);
    CHECK(messages.OneError("SetJumpThreshold") && compression->GetJumpThreshold() == 0.03);
  }
  for (const double value : { -0.1, 1.1, vtkMath::Nan(), vtkMath::Inf() })
  {
    compression->SetDetail(value);
    CHECK(messages.OneError("SetDetail") && compression->GetDetail() == 0.6);
    compression->SetSilhouettes(value);
    CHECK(messages.OneError("SetSilhouettes") && compression->GetSilhouettes() == 0.5);
  }
  for (const int method : { -1, 3 })
  {
    compression->SetMethod(method);
    CHECK(messages.OneError("SetMethod") && compression->GetMethod() == 0);
  }
  compression->SetNoDataValue(vtkMath::Nan());
  CHECK(compression->GetMTime() == time);

  vtkNew<vtkImageData> colors;
  colors->SetDimensions(4, 3, 1);
  colors->AllocateScalars(VTK_FLOAT, 3);
  compression->SetInputData(colors);
  compression->Update();
  CHECK(messages.OneError("3 components"));
  CHECK(compression->GetOutput()->GetNumberOfPoints() == 0);
  compression->SetInputData(MakeHeights(4, 3, Dome));
  compression->SetMaskData(MakeHeights(3, 4, Dome));
  compression->Update();
  CHECK(messages.OneError("the mask's extent"));
  compression->SetMaskData(nullptr);
  compression->Update();
  CHECK(messages.Silent());
}

//------------------------------------------------------------------------------
// It tells how far it is, always farther, and ends where an observer asks for it.
void TestProgress()
{
  vtkNew<vtkReliefCompression> compression;
  compression->SetInputData(MakeHeights(200, 200, Dome));
  struct Watch
  {
    vtkReliefCompression* filter;
    double last = 0.0;
    int events = 0;
    bool rises = true;
    bool end = false;
  } watch{ compression };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&watch);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      Watch& w = *static_cast<Watch*>(data);
      w.rises = w.rises && w.filter->GetProgress() >= w.last && w.filter->GetProgress() <= 1.0;
      w.last = w.filter->GetProgress();
      ++w.events;
      w.filter->SetAbortExecute(w.end && w.events > 10);
    });
  compression->AddObserver(vtkCommand::ProgressEvent, command);
  compression->Update();
  CHECK(watch.events > 20 && watch.rises);
  CHECK(compression->GetOutput()->GetNumberOfPoints() == 200 * 200);

  const int all = watch.events;
  watch = { compression };
  watch.end = true;
  compression->Modified();
  compression->Update();
  std::cout << "progress told " << all << " times, " << watch.events << " until it ended"
            << std::endl;
  CHECK(watch.events < 20 && all > 100);
  CHECK(compression->GetOutput()->GetNumberOfPoints() == 0);
}
}

//------------------------------------------------------------------------------
int TestReliefCompression(int, char*[])
{
  TestProgress();
  TestLinear();
  TestBudget<vtkUnsignedCharArray>(1.0, 0.0);
  TestBudget<vtkShortArray>(100.0, -5000.0);
  TestBudget<vtkFloatArray>(0.125, 3.0);
  TestBudget<vtkDoubleArray>(1.0 / 3.0, 1e5);
  TestInvariances();
  TestThreads();
  TestBackground();
  const auto torus = MakeTorus(200);
  const auto owl = MakeOwl(200);
  for (const double budget : { 0.02, 0.1, 0.5 })
  {
    TestOrder(torus, budget);
    TestOrder(owl, budget);
  }
  TestProperties();
  TestFullRound();
  TestHardInputs();
  TestRange();
  TestRefusals();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
