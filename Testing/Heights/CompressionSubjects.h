// SPDX-License-Identifier: BSD-3-Clause
#ifndef CompressionSubjects_h
#define CompressionSubjects_h

/// @file
/// What reliefs are made of in tests. Heights and spacing have the same unit.

#include "ReliefTestUtilities.h"
#include "Sculpture.h"

#include <cmath>

inline vtkSmartPointer<vtkImageData> MakeOwl(int size)
{
  const sculpture::HeightImage owl = sculpture::CarveOwl(size);
  auto image =
    MakeHeights(owl.columns, owl.rows, [&](int i, int j) { return owl.heights[owl.At(i, j)]; });
  image->SetSpacing(owl.spacing, owl.spacing, 1.0);
  return image;
}

inline vtkSmartPointer<vtkImageData> MakeRosette(int size)
{
  const sculpture::HeightImage rosette = sculpture::StrikeRosette(size);
  auto image = MakeHeights(
    rosette.columns, rosette.rows, [&](int i, int j) { return rosette.heights[rosette.At(i, j)]; });
  image->SetSpacing(rosette.spacing, rosette.spacing, 1.0);
  return image;
}

/// A torus that hovers before a wall, turned toward the viewer by 35 degrees; no background.
inline vtkSmartPointer<vtkImageData> MakeTorus(int size)
{
  const double tilt = std::acos(-1.0) * 35.0 / 180.0;
  const double c = std::cos(tilt);
  const double s = std::sin(tilt);
  const auto distance = [=](double x, double y, double z)
  {
    const double v = c * y + s * z;
    const double w = -s * y + c * z;
    return std::hypot(std::hypot(x, v) - 0.55, w) - 0.24;
  };
  auto image = MakeHeights(size, size,
    [=](int i, int j)
    {
      const double x = 2.0 * (i + 0.5) / size - 1.0;
      const double y = 2.0 * (j + 0.5) / size - 1.0;
      for (double z = 0.8; z > -0.8;)
      {
        const double d = distance(x, y, z);
        if (d < 1e-7)
        {
          return z;
        }
        z -= d;
      }
      return -0.8;
    });
  image->SetSpacing(2.0 / size, 2.0 / size, 1.0);
  return image;
}

/// A superquadric with rounded edges, a box but for them, turned so that three sides show; NaN
/// around it. (A. Barr, "Superquadrics and angle-preserving transformations", 1981.)
inline vtkSmartPointer<vtkImageData> MakeSuperquadric(int size)
{
  const auto inside = [](double x, double y, double z)
  {
    const double u = 0.8 * x + 0.6 * z;
    const double t = -0.6 * x + 0.8 * z;
    const double v = 0.8 * y + 0.6 * t;
    const double w = -0.6 * y + 0.8 * t;
    const auto power = [](double value) { return std::pow(std::abs(value) / 0.6, 2.0 / 0.3); };
    return power(u) + power(v) + power(w) < 1.0;
  };
  auto image = MakeHeights(size, size,
    [=](int i, int j)
    {
      const double x = 2.0 * (i + 0.5) / size - 1.0;
      const double y = 2.0 * (j + 0.5) / size - 1.0;
      double z = 1.2;
      while (z > -1.2 && !inside(x, y, z))
      {
        z -= 0.01;
      }
      if (z <= -1.2)
      {
        return std::nan("");
      }
      double outside = z + 0.01;
      for (int n = 0; n < 30; ++n)
      {
        const double middle = 0.5 * (z + outside);
        (inside(x, y, middle) ? z : outside) = middle;
      }
      return z;
    });
  image->SetSpacing(2.0 / size, 2.0 / size, 1.0);
  return image;
}

/// Ridges of several sizes, as steep as mountains.
inline vtkSmartPointer<vtkImageData> MakeTerrain(int size)
{
  auto image = MakeHeights(size, size,
    [=](int i, int j)
    {
      double x = 3.0 * i / size;
      double y = 3.0 * j / size;
      double height = 0.0;
      double share = 0.35;
      for (int octave = 0; octave < 6; ++octave)
      {
        const double n = std::sin(2.1 * x + 1.3 * std::sin(1.7 * y)) *
          std::cos(1.9 * y + 1.1 * std::sin(1.3 * x + 0.5));
        height += share * (1.0 - std::abs(n));
        share *= 0.42;
        const double turned = 1.6 * x + 1.2 * y + 0.7;
        y = 1.6 * y - 1.2 * x + 3.1;
        x = turned;
      }
      return height;
    });
  image->SetSpacing(2.0 / size, 2.0 / size, 1.0);
  return image;
}

#endif
