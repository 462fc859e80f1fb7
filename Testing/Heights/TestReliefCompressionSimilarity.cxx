// SPDX-License-Identifier: BSD-3-Clause
// How much a relief's shading is like that of the full depth, under 32 suns, at budgets of 2, 5 and
// 10 % of the depth: better than that of depth which is merely scaled, on all subjects.
#include "vtkReliefCompression.h"

#include "CompressionSubjects.h"
#include "ReliefSimilarity.h"

#include <cstdlib>
#include <iomanip>

namespace
{
int Failures = 0;

constexpr double Budgets[] = { 0.02, 0.05, 0.1 };

void TestSubject(const char* name, vtkImageData* depth, const double margins[3])
{
  const SimilarityToFullRound similarity(depth, true);
  vtkNew<vtkReliefCompression> compression;
  compression->SetInputData(depth);
  double found[3][3];
  for (int method = 0; method < 3; ++method)
  {
    compression->SetMethod(method);
    for (int n = 0; n < 3; ++n)
    {
      compression->SetHeightBudget(Budgets[n]);
      compression->Update();
      found[method][n] = similarity.Of(compression->GetOutput());
    }
  }
  for (int n = 0; n < 3; ++n)
  {
    std::cout << std::setw(14) << name << std::setw(8) << 100.0 * Budgets[n] << " %" << std::fixed
              << std::setprecision(4);
    for (const int method : { 2, 1, 0 })
    {
      std::cout << std::setw(12) << found[method][n];
    }
    std::cout << std::defaultfloat << std::setprecision(6) << std::endl;
    CHECK(found[vtkReliefCompression::GradientDomain][n] >=
      found[vtkReliefCompression::Linear][n] + margins[n]);
  }
}

// Equal pictures have a similarity of 1, a negative has less than none, and one sample without data
// counts in neither.
void TestMeasure()
{
  GreyPicture a;
  a.columns = 40;
  a.rows = 30;
  GreyPicture b = a;
  for (int k = 0; k < a.columns * a.rows; ++k)
  {
    a.values.push_back(127.5 + 100.0 * std::sin(0.9 * k));
    b.values.push_back(255.0 - a.values.back());
  }
  CHECK_NEAR(MeanSSIM(a, a), 1.0, 1e-12);
  CHECK(MeanSSIM(a, b) < -0.8);
  GreyPicture c = a;
  c.values[100] = std::nan("");
  CHECK_NEAR(MeanSSIM(a, c), 1.0, 1e-12);
}
}

//------------------------------------------------------------------------------
int TestReliefCompressionSimilarity(int, char*[])
{
  TestMeasure();
  std::cout << "       subject    budget      Linear    TwoScale  GradientDomain" << std::endl;
  constexpr int Size = 200;
  const double owl[3] = { 0.15, 0.25, 0.25 };
  const double rosette[3] = { 0.015, 0.05, 0.08 };
  const double torus[3] = { 0.005, 0.015, 0.025 };
  const double superquadric[3] = { 0.003, 0.005, 0.005 };
  const double terrain[3] = { 0.06, 0.1, 0.12 };
  TestSubject("owl", MakeOwl(Size), owl);
  TestSubject("rosette", MakeRosette(Size), rosette);
  TestSubject("torus", MakeTorus(Size), torus);
  TestSubject("superquadric", MakeSuperquadric(Size), superquadric);
  TestSubject("terrain", MakeTerrain(Size), terrain);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
