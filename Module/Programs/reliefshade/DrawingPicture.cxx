// SPDX-License-Identifier: BSD-3-Clause
#include "DrawingPicture.h"

#include "Drawing.h"

#include "vtkFreeTypeTools.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{

using namespace reliefshade;

using Color = std::array<unsigned char, 3>;

//------------------------------------------------------------------------------
Color colorOf(Ink ink)
{
  switch (ink)
  {
    case Ink::Paper:
      return { 255, 255, 255 };
    case Ink::Grid:
      return { 223, 227, 232 };
    case Ink::Frame:
      return { 107, 114, 128 };
    case Ink::Words:
      return { 28, 31, 35 };
    case Ink::Exact:
      return { 26, 98, 168 };
    case Ink::Steps:
      return { 179, 72, 11 };
    default:
      return { 17, 17, 17 };
  }
}

//------------------------------------------------------------------------------
/// A picture on which shapes are laid by how much of each pixel they cover.
class Canvas
{
public:
  Canvas(double width, double height)
    : Columns(static_cast<int>(std::ceil(width)))
    , Rows(static_cast<int>(std::ceil(height)))
    , Image(vtkSmartPointer<vtkImageData>::New())
  {
    this->Image->SetDimensions(this->Columns, this->Rows, 1);
    this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    this->Pixels = static_cast<unsigned char*>(this->Image->GetScalarPointer());
    std::fill_n(this->Pixels, static_cast<std::ptrdiff_t>(3) * this->Columns * this->Rows,
      static_cast<unsigned char>(255));
  }

  vtkSmartPointer<vtkImageData> GetImage() const { return this->Image; }

  /// y downward, as drawings have it; the image's rows run upward.
  void Lay(int x, int y, const Color& color, double cover)
  {
    if (x < 0 || y < 0 || x >= this->Columns || y >= this->Rows)
    {
      return;
    }
    unsigned char* pixel =
      this->Pixels + 3 * (static_cast<std::ptrdiff_t>(this->Rows - 1 - y) * this->Columns + x);
    for (std::size_t c = 0; c < 3; ++c)
    {
      pixel[c] = static_cast<unsigned char>(
        std::lround(pixel[c] + std::clamp(cover, 0.0, 1.0) * (color[c] - pixel[c])));
    }
  }

  /// Lays a shape that is tell(x, y) pixels away, below 0 inside it.
  template <class Distance>
  void Fill(double x0, double y0, double x1, double y1, Ink ink, const Distance& tell)
  {
    for (int y = static_cast<int>(std::floor(y0)); y <= static_cast<int>(std::ceil(y1)); ++y)
    {
      for (int x = static_cast<int>(std::floor(x0)); x <= static_cast<int>(std::ceil(x1)); ++x)
      {
        this->Lay(x, y, colorOf(ink), 0.5 - tell(x + 0.5, y + 0.5));
      }
    }
  }

private:
  int Columns;
  int Rows;
  vtkSmartPointer<vtkImageData> Image;
  unsigned char* Pixels;
};

//------------------------------------------------------------------------------
void paintLine(const Drawing::Line& line, Canvas& canvas)
{
  const double dx = line.X1 - line.X0;
  const double dy = line.Y1 - line.Y0;
  const double square = std::max(dx * dx + dy * dy, 1e-12);
  const double half = line.Width / 2.0;
  canvas.Fill(std::min(line.X0, line.X1) - half - 1.0, std::min(line.Y0, line.Y1) - half - 1.0,
    std::max(line.X0, line.X1) + half + 1.0, std::max(line.Y0, line.Y1) + half + 1.0, line.Color,
    [&](double x, double y)
    {
      const double u = std::clamp(((x - line.X0) * dx + (y - line.Y0) * dy) / square, 0.0, 1.0);
      return std::hypot(x - line.X0 - u * dx, y - line.Y0 - u * dy) - half;
    });
}

//------------------------------------------------------------------------------
void paintCircle(const Drawing::Circle& circle, Canvas& canvas)
{
  const double reach = circle.Radius + circle.Width + 1.0;
  canvas.Fill(circle.X - reach, circle.Y - reach, circle.X + reach, circle.Y + reach, circle.Color,
    [&](double x, double y)
    {
      const double away = std::hypot(x - circle.X, y - circle.Y) - circle.Radius;
      return circle.Width > 0.0 ? std::abs(away) - circle.Width / 2.0 : away;
    });
}

//------------------------------------------------------------------------------
void paintText(const Drawing::Text& text, Canvas& canvas)
{
  // At 72 dots per inch a point is a pixel. The text's own picture has its colour and its cover.
  constexpr int dpi = 72;
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  vtkNew<vtkTextProperty> property;
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(text.Size));
  property->SetColor(0.0, 0.0, 0.0);
  vtkNew<vtkImageData> letters;
  int box[4]; // about the start of the base line, y upward
  int size[2];
  if (!tools->GetBoundingBox(property, text.Words, dpi, box) ||
    !tools->RenderString(property, text.Words, dpi, letters, size))
  {
    return;
  }
  const int left = static_cast<int>(std::lround(text.X - text.Align * (box[1] - box[0] + 1)));
  const int base = static_cast<int>(std::lround(text.Y)) - box[2];
  const Color color = colorOf(text.Color);
  const int* extent = letters->GetExtent();
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const auto* rgba = static_cast<const unsigned char*>(
        letters->GetScalarPointer(extent[0] + i, extent[2] + j, extent[4]));
      canvas.Lay(left + i, base - j, color, rgba[3] / 255.0);
    }
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> paint(const Drawing& drawing)
{
  Canvas canvas(drawing.Width, drawing.Height);
  for (const Drawing::Line& line : drawing.Lines)
  {
    paintLine(line, canvas);
  }
  for (const Drawing::Circle& circle : drawing.Circles)
  {
    paintCircle(circle, canvas);
  }
  for (const Drawing::Text& text : drawing.Texts)
  {
    paintText(text, canvas);
  }
  return canvas.GetImage();
}

}
