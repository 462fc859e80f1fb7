// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefSimilarity_h
#define ReliefSimilarity_h

/// @file
/// How alike two reliefs look: the mean structural similarity of their pictures under 32 suns.

#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/// A picture of grey values in [0, 255], NaN where there is nothing.
struct GreyPicture
{
  int columns = 0;
  int rows = 0;
  std::vector<double> values;
};

/// The 32 suns: 8 azimuths at each of 4 altitudes.
inline std::vector<std::array<double, 2>> SimilaritySuns()
{
  std::vector<std::array<double, 2>> suns;
  for (const double altitude : { 25.0, 40.0, 55.0, 70.0 })
  {
    for (int n = 0; n < 8; ++n)
    {
      suns.push_back({ 45.0 * n + 22.5, altitude });
    }
  }
  return suns;
}

/// Shades heights of a matt white material as vtkImageReliefShading does, 8-bit and sRGB-encoded as
/// a screen shows it: with cast shadows, or without any, by the surface's slope alone.
inline GreyPicture ShadeGrey(vtkImageData* heights, const std::array<double, 2>& sun, bool shadows)
{
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(heights);
  shading->SetOutputScalarTypeToUnsignedChar();
  vtkReliefScene* scene = shading->GetScene();
  scene->RemoveAllLights();
  scene->AddSun(sun[0], sun[1]);
  scene->GetMaterial()->SetSpecularCoefficient(0.0);
  shading->SetGenerateNormals(!shadows);
  shading->Update();
  vtkImageData* result = shading->GetOutput();
  GreyPicture picture;
  picture.columns = result->GetDimensions()[0];
  picture.rows = result->GetDimensions()[1];
  picture.values.resize(static_cast<std::size_t>(picture.columns) * picture.rows);
  vtkDataArray* colors = result->GetPointData()->GetScalars();
  vtkDataArray* normals = shadows ? nullptr : result->GetPointData()->GetArray("Normals");
  const double radians = std::acos(-1.0) / 180.0;
  const double toSun[3] = { std::sin(sun[0] * radians) * std::cos(sun[1] * radians),
    std::cos(sun[0] * radians) * std::cos(sun[1] * radians), std::sin(sun[1] * radians) };
  for (std::size_t k = 0; k < picture.values.size(); ++k)
  {
    const auto at = static_cast<vtkIdType>(k);
    double grey = colors->GetComponent(at, 0);
    if (normals)
    {
      const double light = std::max(normals->GetComponent(at, 0) * toSun[0] +
          normals->GetComponent(at, 1) * toSun[1] + normals->GetComponent(at, 2) * toSun[2],
        0.0);
      grey =
        255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
    }
    picture.values[k] = colors->GetComponent(at, 3) > 0.0 ? grey : std::nan("");
  }
  return picture;
}

/// The mean structural similarity of two pictures over the samples that both have: Z. Wang,
/// A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error visibility
/// to structural similarity", IEEE Transactions on Image Processing 13/4, 2004: windows of 11 x
/// 11 with Gaussian weights, sigma 1.5, K1 = 0.01, K2 = 0.03, L = 255. At borders the weights of
/// what is there sum to 1.
inline double MeanSSIM(const GreyPicture& a, const GreyPicture& b)
{
  constexpr int Reach = 5;
  constexpr double C1 = 0.01 * 255.0 * 0.01 * 255.0;
  constexpr double C2 = 0.03 * 255.0 * 0.03 * 255.0;
  double weights[2 * Reach + 1];
  for (int n = -Reach; n <= Reach; ++n)
  {
    weights[n + Reach] = std::exp(-n * n / (2.0 * 1.5 * 1.5));
  }
  // Weights are products, and so are sums over windows: first along rows, then along columns.
  const std::size_t size = a.values.size();
  using Sums = std::array<double, 6>; // weight, a, b, aa, bb, ab
  std::vector<Sums> rows(size, Sums{});
  const auto samples = [&](int i, int j)
  {
    const std::size_t k = static_cast<std::size_t>(j) * a.columns + i;
    const double x = a.values[k];
    const double y = b.values[k];
    return std::isnan(x) || std::isnan(y) ? Sums{} : Sums{ 1.0, x, y, x * x, y * y, x * y };
  };
  const auto gather = [&](int i, int end, const auto& read)
  {
    Sums sums{};
    for (int n = std::max(i - Reach, 0); n <= std::min(i + Reach, end - 1); ++n)
    {
      const Sums one = read(n);
      for (std::size_t c = 0; c < sums.size(); ++c)
      {
        sums[c] += weights[n - i + Reach] * one[c];
      }
    }
    return sums;
  };
  for (int j = 0; j < a.rows; ++j)
  {
    for (int i = 0; i < a.columns; ++i)
    {
      rows[static_cast<std::size_t>(j) * a.columns + i] =
        gather(i, a.columns, [&](int n) { return samples(n, j); });
    }
  }
  double sum = 0.0;
  double count = 0.0;
  for (int j = 0; j < a.rows; ++j)
  {
    for (int i = 0; i < a.columns; ++i)
    {
      if (samples(i, j)[0] > 0.0)
      {
        const Sums s = gather(
          j, a.rows, [&](int n) { return rows[static_cast<std::size_t>(n) * a.columns + i]; });
        const double ma = s[1] / s[0];
        const double mb = s[2] / s[0];
        const double va = s[3] / s[0] - ma * ma;
        const double vb = s[4] / s[0] - mb * mb;
        const double vab = s[5] / s[0] - ma * mb;
        sum +=
          (2.0 * ma * mb + C1) * (2.0 * vab + C2) / ((ma * ma + mb * mb + C1) * (va + vb + C2));
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? sum / count : 1.0;
}

/// Their mean over the suns. Samples beside a gap in the full depth, of more than a share of its
/// range, are left out: the slopes there are those of the gap, and belong to neither surface.
class SimilarityToFullRound
{
public:
  SimilarityToFullRound(vtkImageData* full, bool shadows, double gap = 0.03)
    : Shadows(shadows)
    , Surface(FindSurface(full, gap))
  {
    for (const auto& sun : SimilaritySuns())
    {
      this->Pictures.push_back(ShadeGrey(full, sun, shadows));
      this->LeaveOut(this->Pictures.back());
    }
  }

  double Of(vtkImageData* relief) const
  {
    double sum = 0.0;
    std::size_t n = 0;
    for (const auto& sun : SimilaritySuns())
    {
      sum += MeanSSIM(this->Pictures[n++], ShadeGrey(relief, sun, this->Shadows));
    }
    return sum / static_cast<double>(n);
  }

private:
  static std::vector<bool> FindSurface(vtkImageData* full, double gap)
  {
    const int columns = full->GetDimensions()[0];
    const int rows = full->GetDimensions()[1];
    vtkDataArray* heights = full->GetPointData()->GetScalars();
    double range[2];
    heights->GetFiniteRange(range, 0);
    std::vector<bool> result(static_cast<std::size_t>(columns) * rows, true);
    const auto compare = [&](vtkIdType a, vtkIdType b)
    {
      if (std::abs(heights->GetTuple1(a) - heights->GetTuple1(b)) > gap * (range[1] - range[0]))
      {
        result[static_cast<std::size_t>(a)] = false;
        result[static_cast<std::size_t>(b)] = false;
      }
    };
    for (vtkIdType k = 0; k < heights->GetNumberOfTuples(); ++k)
    {
      if (k % columns + 1 < columns)
      {
        compare(k, k + 1);
      }
      if (k / columns + 1 < rows)
      {
        compare(k, k + columns);
      }
    }
    return result;
  }

  void LeaveOut(GreyPicture& picture) const
  {
    for (std::size_t k = 0; k < picture.values.size(); ++k)
    {
      picture.values[k] = this->Surface[k] ? picture.values[k] : std::nan("");
    }
  }

  bool Shadows;
  std::vector<bool> Surface;
  std::vector<GreyPicture> Pictures;
};

#endif
