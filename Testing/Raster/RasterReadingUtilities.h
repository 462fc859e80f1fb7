// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterReadingUtilities_h
#define RasterReadingUtilities_h

#include "RasterTestUtilities.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkReliefRasterReader.h"

#include <cmath>

namespace
{
int Failures = 0;
std::string Directory;

inline bool Near(double one, double other)
{
  return std::abs(one - other) <= 1e-6 * std::abs(other);
}

/// A raster, and a reader that is to read it with one warning, or without a word.
struct Read
{
  explicit Read(
    const TestRaster& raster,
    const std::function<void(vtkReliefRasterReader*)>& set = [](vtkReliefRasterReader*) {},
    const std::string& warning = "")
    : Messages(Reader)
  {
    const std::string name = Directory + "raster.tif";
    WriteRaster(name, raster);
    this->Reader->SetFileName(name.c_str());
    set(this->Reader);
    this->Reader->Update();
    CHECK(this->Reader->GetErrorCode() == vtkErrorCode::NoError);
    CHECK(warning.empty() ? this->Messages.Silent() : this->Messages.OneWarning(warning));
    CHECK(this->Image()->GetDimensions()[0] == TestRaster::Columns);
    CHECK(this->Image()->GetDimensions()[1] == TestRaster::Rows);
    CHECK(this->Reader->GetMaskOutput()->GetNumberOfPoints() == 20);
  }
  Read(const TestRaster& raster, const std::string& warning)
    : Read(
        raster, [](vtkReliefRasterReader*) {}, warning)
  {
  }

  vtkImageData* Image() { return this->Reader->GetOutput(); }
  /// By the file's row and column.
  double At(int row, int column)
  {
    return this->Image()->GetScalarComponentAsDouble(column, TestRaster::Rows - 1 - row, 0, 0);
  }
  double MaskAt(int row, int column)
  {
    return this->Reader->GetMaskOutput()->GetScalarComponentAsDouble(
      column, TestRaster::Rows - 1 - row, 0, 0);
  }
  double Told(const char* name, int k = 0)
  {
    vtkDataArray* array = this->Image()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(k, 0) : std::nan("");
  }

  vtkNew<vtkReliefRasterReader> Reader;
  MessageKeeper Messages;
};
}

#endif
