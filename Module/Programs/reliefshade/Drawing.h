// SPDX-License-Identifier: BSD-3-Clause
#ifndef Drawing_h
#define Drawing_h

#include <string>
#include <vector>

namespace reliefshade
{

/// What a part of a drawing is painted with; which colour that is depends on the paper.
enum class Ink
{
  Paper,
  Grid,
  Frame,
  Words,
  Exact,
  Steps,
  Mark
};

/// Lines, circles and words, to be written as SVG or painted as a picture. x runs to the right, y
/// downward, in pixels.
struct Drawing
{
  struct Line
  {
    double X0, Y0, X1, Y1;
    double Width;
    Ink Color;
  };
  struct Circle
  {
    double X, Y, Radius;
    double Width; ///< of its line; 0 if it is filled
    Ink Color;
  };
  struct Text
  {
    double X, Y; ///< on the base line
    double Size;
    double Align; ///< which part of it stands left of x: 0, 0.5 or 1
    Ink Color;
    std::string Words; ///< ASCII
  };

  double Width = 0.0;
  double Height = 0.0;
  std::vector<Line> Lines;
  std::vector<Circle> Circles;
  std::vector<Text> Texts;
};

}

#endif
