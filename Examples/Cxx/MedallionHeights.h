// SPDX-License-Identifier: BSD-3-Clause
// The height field of a medallion: a sunflower, an inscription, beads and a rim.
#ifndef MedallionHeights_h
#define MedallionHeights_h

#include <vtkImageCast.h>
#include <vtkImageData.h>
#include <vtkImageExtractComponents.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

namespace medallion
{
// All lengths are in radii of the medallion, which is centred in the image.
constexpr int Samples = 900;
constexpr double Spacing = 2.2 / Samples;
constexpr double First = -1.1 + Spacing / 2.0;
constexpr double Field = 0.05; // height of the medallion's field above the plate that it lies on
constexpr double Turn = 6.283185307179586;
constexpr const char* Text = "EX VMBRA IN LVCEM \xc2\xb7 VTK RELIEF SHADING \xc2\xb7 ";

// Rounds edges, as wear does. The deviation is in samples.
inline vtkSmartPointer<vtkImageData> Smooth(vtkImageData* image, double deviation)
{
  vtkNew<vtkImageGaussianSmooth> gauss;
  gauss->SetInputData(image);
  gauss->SetDimensionality(2);
  gauss->SetStandardDeviation(deviation);
  gauss->SetRadiusFactor(3.0);
  gauss->Update();
  return gauss->GetOutput();
}

// The text, 0 to 255, with bevelled edges. Its size comes back as well: the image may be larger.
inline vtkSmartPointer<vtkImageData> Letters(int size[2])
{
  vtkNew<vtkTextProperty> font;
  font->SetFontFamilyToTimes();
  font->BoldOn();
  font->SetFontSize(48);
  vtkNew<vtkImageData> image;
  vtkTextRenderer::GetInstance()->RenderString(
    font, Text, image, size, 400, vtkTextRenderer::Default);
  vtkNew<vtkImageExtractComponents> alpha;
  alpha->SetInputData(image);
  alpha->SetComponents(3);
  vtkNew<vtkImageCast> toFloat;
  toFloat->SetInputConnection(alpha->GetOutputPort());
  toFloat->SetOutputScalarTypeToFloat();
  toFloat->Update();
  return Smooth(toFloat->GetOutput(), 9.0);
}

// Half an ellipse, across a line or about a point.
inline double Ridge(double distance, double halfWidth, double height)
{
  const double x = distance / halfWidth;
  return height * std::sqrt(std::max(1.0 - x * x, 0.0));
}

// One of 18 petals of a whorl, with a vein.
inline double Petal(double radius, double angle, double shift, double length, double height)
{
  const double along = std::clamp((radius - 0.25) / length, 0.0, 1.0);
  const double turns = 18.0 * angle / Turn + shift;
  const double across = 2.0 * (turns - std::floor(turns)) - 1.0;
  const double width = std::sqrt(std::sin(vtkMath::Pi() * std::pow(along, 0.7))) + 1e-6;
  const double vein = 1.0 - 0.25 * std::exp(-across * across / (0.12 * 0.12));
  const double crest = std::sqrt(std::sin(vtkMath::Pi() * (0.15 + 0.85 * along)));
  return Ridge(across, width, height * vein * crest);
}

// A ball, half sunk, painted into the samples about its centre.
inline void AddBall(float* heights, double x, double y, double radius, double base)
{
  const int column = static_cast<int>((x - First) / Spacing);
  const int row = static_cast<int>((y - First) / Spacing);
  const int reach = static_cast<int>(radius / Spacing) + 2;
  for (int j = row - reach; j <= row + reach; ++j)
  {
    for (int i = column - reach; i <= column + reach; ++i)
    {
      const double dx = First + i * Spacing - x;
      const double dy = First + j * Spacing - y;
      const double square = radius * radius - dx * dx - dy * dy;
      float& height = heights[j * Samples + i];
      height =
        square > 0.0 ? std::max(height, static_cast<float>(base + std::sqrt(square))) : height;
    }
  }
}

// An image of heights. The plate about the medallion has the height given.
inline vtkSmartPointer<vtkImageData> MakeHeights(double plate = 0.0)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(Samples, Samples, 1);
  image->SetSpacing(Spacing, Spacing, 1.0);
  image->SetOrigin(First, First, 0.0);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* heights = static_cast<float*>(image->GetScalarPointer());

  // Field, rim, two rings and two whorls of petals, the inner one higher and between those of the
  // outer one, about a dome.
  for (int k = 0; k < Samples * Samples; ++k)
  {
    const double x = First + k % Samples * Spacing;
    const int row = k / Samples;
    const double y = First + row * Spacing;
    const double radius = std::hypot(x, y);
    const double angle = std::atan2(y, x);
    double height = radius < 1.0 ? Field : 0.0;
    height += Ridge(radius - 0.95, 0.05, 0.05);
    height += Ridge(radius - 0.855, 0.012, 0.015) + Ridge(radius - 0.605, 0.012, 0.015);
    height = radius > 0.95 ? std::max(height, plate) : height;
    height = std::max(height, Field + Petal(radius, angle, 0.0, 0.32, 0.045));
    height = std::max(height, Field + Petal(radius, angle, 0.5, 0.23, 0.06));
    height = std::max(height, Field + Ridge(radius, 0.27, 0.05));
    heights[k] = static_cast<float>(height);
  }

  // Seeds on the dome, in the spiral in which sunflowers grow them; then the beads.
  for (int k = 1; k < 160; ++k)
  {
    const double radius = 0.245 * std::sqrt(k / 160.0);
    const double angle = k * vtkMath::Pi() * (3.0 - std::sqrt(5.0));
    AddBall(heights, radius * std::cos(angle), radius * std::sin(angle), 0.014 + 0.006 * k / 160.0,
      Field + Ridge(radius, 0.27, 0.05));
  }
  for (int k = 0; k < 96; ++k)
  {
    AddBall(
      heights, 0.893 * std::cos(k * Turn / 96.0), 0.893 * std::sin(k * Turn / 96.0), 0.022, Field);
  }

  // The text runs clockwise about the circle of radius 0.73, as wide as it is long.
  int size[2];
  auto letters = Letters(size);
  for (int k = 0; k < Samples * Samples; ++k)
  {
    const double x = First + k % Samples * Spacing;
    const int row = k / Samples;
    const double y = First + row * Spacing;
    const double turns = 0.5 - std::atan2(y, x) / Turn;
    const double u = (turns - std::floor(turns)) * (size[0] - 1);
    const double v = (std::hypot(x, y) - 0.73) / (Turn * 0.73) * size[0] + size[1] / 2.0;
    if (v >= 0.0 && v < size[1])
    {
      const double letter =
        letters->GetScalarComponentAsDouble(static_cast<int>(u), static_cast<int>(v), 0, 0);
      heights[k] += static_cast<float>(0.035 * letter / 255.0);
    }
  }
  return Smooth(image, 1.2);
}
}

#endif
