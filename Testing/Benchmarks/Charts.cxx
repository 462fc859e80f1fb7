// SPDX-License-Identifier: BSD-3-Clause
#include "Charts.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRect.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

namespace bench
{

namespace
{
constexpr int Width = 1000;
constexpr int Height = 700;
// Drawn so many times larger and averaged: smooth lines and letters everywhere.
constexpr int Scale = 2;

// 0.001, 1, 1 000, 1 000 000: as people read them. The spaces keep the picture of a label, which is
// repeated as a texture, from showing its other edge.
std::string DecadeLabel(int exponent)
{
  if (exponent < 0)
  {
    return exponent < -3 ? " 1e" + std::to_string(exponent) + " "
                         : " 0." + std::string(-exponent - 1, '0') + "1 ";
  }
  std::string text = "1" + std::string(exponent, '0');
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3)
  {
    text.insert(place, " ");
  }
  return " " + text + " ";
}

// Whole decades about all values, with a label each; or the values themselves.
void SetUpAxis(vtkAxis* axis, const std::string& title, std::vector<double> values, bool eachValue)
{
  axis->SetTitle(" \n" + title + "\n "); // empty lines, for the reason of DecadeLabel()'s spaces
  axis->GetTitleProperties()->SetFontSize(17 * Scale);
  axis->GetTitleProperties()->BoldOff();
  axis->GetLabelProperties()->SetFontSize(15 * Scale);
  axis->GetGridPen()->SetColor(225, 225, 225, 255);
  axis->GetPen()->SetWidth(1.5f * Scale);
  axis->LogScaleOn();
  axis->SetBehavior(vtkAxis::FIXED);
  if (values.empty())
  {
    return;
  }
  std::sort(values.begin(), values.end());
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  if (eachValue)
  {
    values.erase(std::unique(values.begin(), values.end()), values.end());
    axis->SetRange(values.front() / 1.15, values.back() * 1.15);
    for (double value : values)
    {
      places->InsertNextValue(std::log10(value));
      labels->InsertNextValue(std::to_string(static_cast<int>(value)) + "\xc2\xb2");
    }
  }
  else
  {
    const int first = static_cast<int>(std::floor(std::log10(values.front()) + 1e-9));
    const int last =
      std::max(static_cast<int>(std::ceil(std::log10(values.back()) - 1e-9)), first + 1);
    axis->SetRange(std::pow(10.0, first), std::pow(10.0, last));
    for (int exponent = first; exponent <= last; ++exponent)
    {
      places->InsertNextValue(exponent);
      labels->InsertNextValue(DecadeLabel(exponent));
    }
  }
  axis->SetCustomTickPositions(places, labels);
}

void AddSeries(vtkChartXY* chart, const Series& series)
{
  vtkNew<vtkDoubleArray> x;
  vtkNew<vtkDoubleArray> y;
  x->SetName("x");
  y->SetName(series.name.c_str());
  for (std::size_t k = 0; k < series.x.size(); ++k)
  {
    if (series.x[k] > 0.0 && series.y[k] > 0.0)
    {
      x->InsertNextValue(series.x[k]);
      y->InsertNextValue(series.y[k]);
    }
  }
  if (x->GetNumberOfValues() == 0)
  {
    return;
  }
  vtkNew<vtkTable> table;
  table->AddColumn(x);
  table->AddColumn(y);
  auto* plot =
    vtkPlotPoints::SafeDownCast(chart->AddPlot(series.line ? vtkChart::LINE : vtkChart::POINTS));
  plot->SetInputData(table, 0, 1);
  plot->SetColor(series.color[0], series.color[1], series.color[2], 255);
  plot->SetWidth(2.5f * Scale);
  plot->SetMarkerStyle(series.marker);
  plot->SetMarkerSize((series.line ? 9.0f : 17.0f) * Scale);
}
}

bool DrawChart(const Chart& description, const std::string& fileName)
{
  vtkNew<vtkContextView> view;
  view->GetRenderWindow()->SetOffScreenRendering(1);
  view->GetRenderWindow()->SetSize(Width * Scale, Height * Scale);
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);

  vtkNew<vtkChartXY> chart;
  view->GetScene()->AddItem(chart);
  // Room at the edges for the last labels.
  chart->SetAutoSize(false);
  chart->SetSize(
    vtkRectf(8.0f * Scale, 8.0f * Scale, (Width - 36.0f) * Scale, (Height - 14.0f) * Scale));
  chart->SetTitle(description.title);
  chart->GetTitleProperties()->SetFontSize(19 * Scale);
  chart->GetTitleProperties()->BoldOn();
  std::vector<double> x;
  std::vector<double> y;
  for (const Series& series : description.series)
  {
    AddSeries(chart, series);
    for (std::size_t k = 0; k < series.x.size(); ++k)
    {
      if (series.x[k] > 0.0 && series.y[k] > 0.0)
      {
        x.push_back(series.x[k]);
        y.push_back(series.y[k]);
      }
    }
  }
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), description.xTitle, x, description.powersOfTwo);
  SetUpAxis(chart->GetAxis(vtkAxis::LEFT), description.yTitle, y, false);
  chart->SetShowLegend(true);
  vtkChartLegend* legend = chart->GetLegend();
  legend->SetHorizontalAlignment(
    description.legendAbove ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(
    description.legendAbove ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
  legend->SetLabelSize(15 * Scale);
  legend->SetSymbolWidth(35 * Scale);
  legend->SetPadding(7 * Scale);
  legend->GetBrush()->SetColor(255, 255, 255, 230);
  legend->GetPen()->SetColor(180, 180, 180, 255);

  view->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(view->GetRenderWindow());
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(grab->GetOutputPort());
  shrink->SetShrinkFactors(Scale, Scale, 1);
  shrink->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(fileName.c_str());
  writer->SetCompressionLevel(9);
  writer->SetInputConnection(shrink->GetOutputPort());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

}
