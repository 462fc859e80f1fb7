// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyChart.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{

using namespace reliefshade;

constexpr double Width = 1000.0;
constexpr double Left = 80.5;
constexpr double Right = 970.5;
constexpr double Top = 96.5;
constexpr double Bottom = 560.5;
constexpr double Small = 15.0;

// Errors below this are rounding's, and 0 has no logarithm.
constexpr double LeastError = 1e-8;

//------------------------------------------------------------------------------
/// A logarithmic axis from one place of the drawing to another, over whole decades.
struct Axis
{
  double From;
  double To;
  int First; // exponents
  int Last;

  Axis(double from, double to, double least, double greatest)
    : From(from)
    , To(to)
    , First(static_cast<int>(std::floor(std::log10(least) + 1e-9)))
    , Last(std::max(static_cast<int>(std::ceil(std::log10(greatest) - 1e-9)), First + 1))
  {
  }

  double Place(double value) const
  {
    return this->From +
      (this->To - this->From) * (std::log10(value) - this->First) / (this->Last - this->First);
  }
};

//------------------------------------------------------------------------------
/// The middle of a pixel, where a line of a pixel's width is sharp.
double sharp(double place)
{
  return std::floor(place) + 0.5;
}

//------------------------------------------------------------------------------
double errorOf(const AccuracyRow& row)
{
  return std::max(row.ErrorOf999, LeastError);
}

//------------------------------------------------------------------------------
/// 1e-05 as 0.00001, for that is how it is typed.
std::string decade(int exponent)
{
  return exponent < -4 || exponent > 5 ? "1e" + std::to_string(exponent)
                                       : brief(std::pow(10.0, exponent), 6);
}

//------------------------------------------------------------------------------
void addAxes(const AccuracyTable& table, const Axis& times, const Axis& errors, Drawing& drawing)
{
  for (int exponent = errors.First; exponent <= errors.Last; ++exponent)
  {
    const double y = sharp(errors.Place(std::pow(10.0, exponent)));
    drawing.Lines.push_back({ Left, y, Right, y, 1.0, Ink::Grid });
    drawing.Texts.push_back({ Left - 8.0, y + 5.0, Small, 1.0, Ink::Words, decade(exponent) });
  }
  for (int exponent = times.First; exponent <= times.Last; ++exponent)
  {
    const double x = sharp(times.Place(std::pow(10.0, exponent)));
    drawing.Lines.push_back({ x, Top, x, Bottom, 1.0, Ink::Grid });
    drawing.Texts.push_back({ x, Bottom + 22.0, Small, 0.5, Ink::Words, decade(exponent) });
  }
  // The whole picture's seconds along the upper edge.
  const double seconds = 1e-9 * static_cast<double>(table.Samples);
  const double first = std::pow(10.0, times.First) * seconds;
  const double last = std::pow(10.0, times.Last) * seconds;
  for (int exponent = static_cast<int>(std::ceil(std::log10(first) - 1e-9));
       exponent <= std::log10(last) + 1e-9; ++exponent)
  {
    const double x = sharp(times.Place(std::pow(10.0, exponent) / seconds));
    drawing.Lines.push_back({ x, Top - 6.0, x, Top, 1.5, Ink::Frame });
    drawing.Texts.push_back({ x, Top - 11.0, Small, 0.5, Ink::Words, decade(exponent) + " s" });
  }
  const double corners[4][4] = { { Left, Top, Right, Top }, { Right, Top, Right, Bottom },
    { Right, Bottom, Left, Bottom }, { Left, Bottom, Left, Top } };
  for (const auto& c : corners)
  {
    drawing.Lines.push_back({ c[0], c[1], c[2], c[3], 1.5, Ink::Frame });
  }
  drawing.Texts.push_back({ 10.0, 24.0, 18.0, 0.0, Ink::Words,
    "Error of the illumination that 99.9 % of the samples keep (down) against time (across)" });
  drawing.Texts.push_back(
    { 10.0, 50.0, Small, 0.0, Ink::Words, "Above: seconds for the whole picture" });
  drawing.Texts.push_back({ (Left + Right) / 2.0, Bottom + 46.0, Small, 0.5, Ink::Words,
    "Processor time of one thread, nanoseconds a sample" });
}

//------------------------------------------------------------------------------
/// A line with a dot for each setting of an integrator.
void addSeries(
  const AccuracyTable& table, bool exact, const Axis& times, const Axis& errors, Drawing& drawing)
{
  const Ink ink = exact ? Ink::Exact : Ink::Steps;
  const AccuracyRow* before = nullptr;
  for (const AccuracyRow& row : table.Rows)
  {
    if (row.Exact != exact)
    {
      continue;
    }
    const double x = times.Place(row.Nanoseconds);
    const double y = errors.Place(errorOf(row));
    if (before)
    {
      drawing.Lines.push_back(
        { times.Place(before->Nanoseconds), errors.Place(errorOf(*before)), x, y, 2.5, ink });
    }
    drawing.Circles.push_back({ x, y, 5.0, 0.0, ink });
    before = &row;
  }
}

//------------------------------------------------------------------------------
void addMark(double x, double y, bool square, Drawing& drawing)
{
  if (!square)
  {
    drawing.Circles.push_back({ x, y, 10.0, 2.5, Ink::Mark });
    return;
  }
  constexpr double r = 14.0;
  for (const double side : { -r, r })
  {
    drawing.Lines.push_back({ x - r, y + side, x + r, y + side, 2.0, Ink::Mark });
    drawing.Lines.push_back({ x + side, y - r, x + side, y + r, 2.0, Ink::Mark });
  }
}

//------------------------------------------------------------------------------
/// Names the dots as far as there is room, the marked ones first.
void addLabels(const AccuracyTable& table, const Axis& times, const Axis& errors, Drawing& drawing)
{
  struct Box
  {
    double X0, Y0, X1, Y1;
  };
  std::vector<Box> taken;
  std::vector<const AccuracyRow*> rows;
  for (const AccuracyRow& row : table.Rows)
  {
    rows.push_back(&row);
    const double x = times.Place(row.Nanoseconds);
    const double y = errors.Place(errorOf(row));
    taken.push_back({ x - 6.0, y - 6.0, x + 6.0, y + 6.0 });
  }
  std::stable_sort(rows.begin(), rows.end(),
    [](const AccuracyRow* a, const AccuracyRow* b)
    { return 2 * a->Present + a->Recommended > 2 * b->Present + b->Recommended; });
  for (const AccuracyRow* row : rows)
  {
    const double x = times.Place(row->Nanoseconds);
    const double y = errors.Place(errorOf(*row));
    const std::string words = row->Exact ? brief(row->Tolerance, 6) : std::to_string(row->Steps);
    const double width = 0.6 * Small * static_cast<double>(words.size());
    const double away = row->Present || row->Recommended ? 20.0 : 10.0;
    // On the right, on the left, above or below; above first where the line runs across.
    const std::array<double, 3> right = { x + away, y + 5.0, 0.0 };
    const std::array<double, 3> left = { x - away, y + 5.0, 1.0 };
    const std::array<double, 3> above = { x, y - away, 0.5 };
    const std::array<double, 3> below = { x, y + away + 10.0, 0.5 };
    const std::array<std::array<double, 3>, 4> places = row->Exact
      ? std::array{ right, left, above, below }
      : std::array{ above, below, right, left };
    for (const auto& [textX, textY, align] : places)
    {
      const double x0 = textX - align * width;
      const Box box = { x0, textY - 12.0, x0 + width, textY + 2.0 };
      const bool free = box.X0 > Left && box.X1 < Right && box.Y0 > Top && box.Y1 < Bottom &&
        std::none_of(taken.begin(), taken.end(),
          [&box](const Box& other) {
            return box.X0 < other.X1 && other.X0 < box.X1 && box.Y0 < other.Y1 && other.Y0 < box.Y1;
          });
      if (free)
      {
        taken.push_back(box);
        drawing.Texts.push_back(
          { textX, textY, Small, align, row->Exact ? Ink::Exact : Ink::Steps, words });
        break;
      }
    }
  }
}

//------------------------------------------------------------------------------
void addLegend(Drawing& drawing)
{
  const double y = 74.0 - 29.0;
  double x = 380.0;
  const auto add = [&](const std::string& words, Ink ink, int mark)
  {
    if (mark == 0)
    {
      drawing.Lines.push_back({ x - 12.0, y, x + 12.0, y, 2.5, ink });
      drawing.Circles.push_back({ x, y, 5.0, 0.0, ink });
    }
    else
    {
      addMark(x, y, mark == 2, drawing);
    }
    drawing.Texts.push_back({ x + 20.0, y + 5.0, Small, 0.0, Ink::Words, words });
    x += 50.0 + 7.6 * static_cast<double>(words.size());
  };
  add("exact, by tolerance", Ink::Exact, 0);
  add("the thesis's fixed steps", Ink::Steps, 0);
  add("yours", Ink::Mark, 1);
  add("to take", Ink::Mark, 2);
}

//------------------------------------------------------------------------------
const char* classOf(Ink ink)
{
  switch (ink)
  {
    case Ink::Paper:
      return "paper";
    case Ink::Grid:
      return "grid";
    case Ink::Frame:
      return "frame";
    case Ink::Words:
      return "words";
    case Ink::Exact:
      return "exact";
    case Ink::Steps:
      return "steps";
    default:
      return "mark";
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
Drawing drawAccuracy(const AccuracyTable& table, const std::vector<std::string>& captions)
{
  double quickest = table.Rows.front().Nanoseconds;
  double slowest = quickest;
  double least = errorOf(table.Rows.front());
  double greatest = least;
  for (const AccuracyRow& row : table.Rows)
  {
    quickest = std::min(quickest, row.Nanoseconds);
    slowest = std::max(slowest, row.Nanoseconds);
    least = std::min(least, errorOf(row));
    greatest = std::max(greatest, errorOf(row));
  }
  const Axis times(Left, Right, quickest, slowest);
  const Axis errors(Bottom, Top, least, greatest);

  Drawing drawing;
  drawing.Width = Width;
  drawing.Height = Bottom + 64.0 + 22.0 * static_cast<double>(captions.size());
  addAxes(table, times, errors, drawing);
  addSeries(table, false, times, errors, drawing);
  addSeries(table, true, times, errors, drawing);
  for (const AccuracyRow& row : table.Rows)
  {
    for (const bool square : { false, true })
    {
      if (square ? row.Recommended : row.Present)
      {
        addMark(times.Place(row.Nanoseconds), errors.Place(errorOf(row)), square, drawing);
      }
    }
  }
  addLabels(table, times, errors, drawing);
  addLegend(drawing);
  for (std::size_t k = 0; k < captions.size(); ++k)
  {
    drawing.Texts.push_back(
      { 10.0, Bottom + 76.0 + 22.0 * static_cast<double>(k), Small, 0.0, Ink::Words, captions[k] });
  }
  return drawing;
}

//------------------------------------------------------------------------------
std::string toSvg(const Drawing& drawing)
{
  const auto number = [](const char* name, double value)
  { return std::string(" ") + name + "=\"" + brief(value, 6) + "\""; };
  const std::string size = brief(drawing.Width, 6) + " " + brief(drawing.Height, 6);
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
    "\" role=\"img\" aria-label=\"Error against time\">\n";
  for (const Drawing::Line& line : drawing.Lines)
  {
    text += std::string("<line class=\"") + classOf(line.Color) + "\"" + number("x1", line.X0) +
      number("y1", line.Y0) + number("x2", line.X1) + number("y2", line.Y1) +
      number("stroke-width", line.Width) + "/>\n";
  }
  for (const Drawing::Circle& circle : drawing.Circles)
  {
    const bool filled = circle.Width == 0.0;
    text += std::string("<circle class=\"") + (filled ? "dot " : "ring ") + classOf(circle.Color) +
      "\"" + number("cx", circle.X) + number("cy", circle.Y) + number("r", circle.Radius) +
      (filled ? "" : number("stroke-width", circle.Width)) + "/>\n";
  }
  for (const Drawing::Text& words : drawing.Texts)
  {
    text += std::string("<text class=\"") + classOf(words.Color) + "\"" + number("x", words.X) +
      number("y", words.Y) + number("font-size", words.Size) + " text-anchor=\"" +
      (words.Align == 0.0      ? "start"
          : words.Align == 1.0 ? "end"
                               : "middle") +
      "\">" + words.Words + "</text>\n";
  }
  return text + "</svg>\n";
}

}
