// SPDX-License-Identifier: BSD-3-Clause
#include "MeshHeights.h"

#include "Failure.h"
#include "FileGuard.h"
#include "ImageFormats.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkDepthToHeightField.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// The first option that rasters have and meshes have not; null if none was given.
const char* rasterOption(const ReadOptions& options)
{
  return options.Band > 0                                      ? "--band"
    : !options.Channel.empty()                                 ? "--channel"
    : !options.Part.empty()                                    ? "--part"
    : options.Encoding != relief::raster::HeightEncoding::None ? "--encoding"
    : options.Degrees                                          ? "--degrees"
    : !options.NoDataFromFile                                  ? "--nodata"
                                                               : nullptr;
}

//------------------------------------------------------------------------------
/// In bytes; 0 where the system does not tell.
double fileSize(const std::string& file)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0.0 : static_cast<double>(size);
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
// As vtkReliefMeshReader has them, which is not loaded for other files.
bool isMesh(const std::string& file)
{
  static const char* const extensions[] = { ".obj", ".ply", ".stl", ".vtp", ".vtk", ".gltf",
    ".glb" };
  const std::string extension = relief::io::LowerExtension(file);
  return std::find(std::begin(extensions), std::end(extensions), extension) != std::end(extensions);
}

//------------------------------------------------------------------------------
void checkMeshOptions(
  const std::string& input, const MeshView& view, const ReadOptions& options, bool normals)
{
  if (normals && isMesh(input))
  {
    throw Failure("--normal-map", "is of pictures, and INPUT is a mesh", UsageFailure);
  }
  if (normals && rasterOption(options))
  {
    throw Failure(rasterOption(options), "is of rasters, and INPUT is a normal map", UsageFailure);
  }
  const char* const wrong = isMesh(input) ? rasterOption(options)
    : view.Direction                      ? "--view"
    : view.Up                             ? "--view-up"
    : view.Resolution                     ? "--resolution"
                                          : nullptr;
  if (wrong)
  {
    throw Failure(wrong,
      isMesh(input) ? "is of rasters, and INPUT is a mesh"
                    : "is of meshes, and INPUT has the extension of none",
      UsageFailure);
  }
}

//------------------------------------------------------------------------------
Raster readMesh(
  const std::string& file, const MeshView& view, MemoryBudget& budget, double bytesPerSample)
{
  Raster raster;
  aboutFile(file,
    [&]
    {
      const vtkSmartPointer<vtkPolyDataAlgorithm> reader = imageFormats().NewMeshReader(file);
      // A mesh takes more than its file, above all if that is binary and packed.
      budget.Claim(0.0, 3.0 * fileSize(file));
      runToEnd(reader);
      // Points and triangles as they are gathered, and a height of 8 bytes twice.
      vtkPolyData* mesh = reader->GetOutput();
      budget.Claim(0.0,
        1024.0 * static_cast<double>(mesh->GetActualMemorySize()) +
          24.0 * static_cast<double>(mesh->GetNumberOfPoints()) +
          12.0 * static_cast<double>(mesh->GetNumberOfPolys()));
      vtkNew<vtkDepthToHeightField> heights;
      heights->SetInputConnection(reader->GetOutputPort());
      heights->SetOutputScalarTypeToDouble();
      if (view.Direction)
      {
        heights->SetViewDirection(view.Direction->data());
      }
      if (view.Up)
      {
        heights->SetViewUp(view.Up->data());
      }
      if (view.Resolution)
      {
        heights->SetResolution(*view.Resolution);
      }
      heights->UpdateInformation();
      int extent[6];
      heights->GetOutputInformation(0)->Get(
        vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
      const double samples = (extent[1] + 1.0) * (extent[3] + 1.0);
      budget.Claim((8.0 + bytesPerSample) * samples, 8.0 * samples);
      runToEnd(heights);
      raster.Heights = heights->GetOutput();
      raster.ScalarType = raster.Heights->GetScalarType();
      raster.Columns = raster.Heights->GetDimensions()[0];
      raster.Rows = raster.Heights->GetDimensions()[1];
      raster.OneUnit = true;
      const double* spacing = raster.Heights->GetSpacing();
      relief::raster::SetSpacing(raster, { spacing[0], spacing[1] });
    });
  return raster;
}

}
