// SPDX-License-Identifier: BSD-3-Clause
//
// Carves one of the gallery's sculptures into a file: heights as TIFF in floating point, or its
// front as a mesh.
#include "Sculpture.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTIFFWriter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
bool WriteHeights(const sculpture::HeightImage& carved, const std::string& file)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(carved.columns, carved.rows, 1);
  vtkNew<vtkFloatArray> heights;
  heights->SetNumberOfTuples(image->GetNumberOfPoints());
  // TIFF knows no spacing: in samples.
  std::transform(carved.heights.begin(), carved.heights.end(), heights->GetPointer(0),
    [&](float height) { return static_cast<float>(height / carved.spacing); });
  image->GetPointData()->SetScalars(heights);
  vtkNew<vtkTIFFWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

// Two triangles for each four samples that are on the sculpture.
bool WriteMesh(const sculpture::HeightImage& carved, const std::string& file)
{
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> point(carved.heights.size(), -1);
  for (int j = 0; j < carved.rows; ++j)
  {
    for (int i = 0; i < carved.columns; ++i)
    {
      const float height = carved.heights[carved.At(i, j)];
      if (!std::isnan(height))
      {
        point[carved.At(i, j)] =
          points->InsertNextPoint(i * carved.spacing, j * carved.spacing, height);
      }
    }
  }
  vtkNew<vtkCellArray> triangles;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c)
  {
    if (point[a] >= 0 && point[b] >= 0 && point[c] >= 0)
    {
      triangles->InsertNextCell({ point[a], point[b], point[c] });
    }
  };
  for (int j = 0; j + 1 < carved.rows; ++j)
  {
    for (int i = 0; i + 1 < carved.columns; ++i)
    {
      const std::size_t here = carved.At(i, j);
      const std::size_t above = carved.At(i, j + 1);
      add(here, here + 1, above + 1);
      add(here, above + 1, above);
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}
}

int main(int argc, char* argv[])
{
  const std::string name = argc == 4 ? argv[1] : "";
  const int size = argc == 4 ? std::atoi(argv[2]) : 0;
  const std::string file = argc == 4 ? argv[3] : "";
  const bool mesh = file.size() > 4 && file.substr(file.size() - 4) == ".ply";
  if ((name != "owl" && name != "rosette") || size < 2 || size > 8192)
  {
    std::cerr << "usage: carve owl|rosette SAMPLES FILE.tif|FILE.ply, SAMPLES from 2 to 8192\n";
    return EXIT_FAILURE;
  }
  const sculpture::HeightImage carved =
    name == "owl" ? sculpture::CarveOwl(size) : sculpture::StrikeRosette(size);
  const bool written = mesh ? WriteMesh(carved, file) : WriteHeights(carved, file);
  return written ? EXIT_SUCCESS : EXIT_FAILURE; // the writer has said why
}
