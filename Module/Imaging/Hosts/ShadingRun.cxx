// SPDX-License-Identifier: BSD-3-Clause
#include "ShadingRun.h"

#include "vtkReliefAbort.h"
#include "vtkReliefStatistics.h"
#include "vtkReliefThreads.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <locale>
#include <new>
#include <sstream>

namespace relief::hosts
{

//------------------------------------------------------------------------------
ShadingRun::ShadingRun(vtkAlgorithm* host, HostInputs& inputs, const PreparedScene& scene)
  : Host(host)
  , Inputs(inputs)
  , Scene(scene)
{
}

//------------------------------------------------------------------------------
ShadingRun::~ShadingRun() = default;

//------------------------------------------------------------------------------
void ShadingRun::SetLimit(const TiledHeights::Limit& limit)
{
  if (this->Limit.bytes != limit.bytes || this->Limit.leavesOut != limit.leavesOut)
  {
    this->ExposedScene = 0; // it may be found from others
  }
  this->Limit = limit;
}

//------------------------------------------------------------------------------
std::string ShadingRun::Plan(const Target& target, std::size_t cacheBytes)
{
  this->Out = target;
  this->Whole.reset();
  if (this->Inputs.GetTiledHeights())
  {
    try
    {
      this->FindExposure();
      this->PlanTile();
    }
    catch (const std::bad_alloc&)
    {
      throw;
    }
    catch (const std::exception& error) // of who reads heights
    {
      return error.what();
    }
    return std::string();
  }
  this->Cache.SetLimit(cacheBytes);
  try
  {
    this->FindExposure();
    this->Whole = this->MakeShading(&this->Cache);
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory to keep illuminations; SetCacheMemoryLimit(0) keeps none";
  }
  this->Current = this->Whole.get();
  return std::string();
}

//------------------------------------------------------------------------------
std::unique_ptr<SceneShading> ShadingRun::MakeShading(IlluminationCache* cache)
{
  relief::Scene scene = this->Scene.Get();
  scene.exposure = this->Exposure.stops;
  return std::make_unique<SceneShading>(this->Inputs.GetField(), scene, this->Out, cache);
}

//------------------------------------------------------------------------------
/// Provides the heights that a part of the picture depends on. What is planned holds for all tiles.
void ShadingRun::PlanTile()
{
  const Target& out = this->Out;
  const HeightOutline* outline =
    this->GetProvider()({ { out.i0, out.i0 + out.width, out.j0, out.j0 + out.rows } });
  const std::vector<bool> layers{ out.rgba8 != nullptr, out.illumination != nullptr,
    out.thickness != nullptr, out.shadow != nullptr, out.normals != nullptr, out.base != nullptr,
    out.diffuse != nullptr, out.scatter != nullptr, out.specular != nullptr };
  const std::uint64_t version = this->Scene.GetVersion();
  const std::uint64_t field = this->Inputs.GetField().GetVersion();
  TileShading& tiles = this->Tiles;
  if (tiles.shading && tiles.scene == version && tiles.field == field && tiles.layers == layers)
  {
    tiles.shading->Redirect(out);
    tiles.rays = tiles.shading->GetRaysTraced();
    tiles.cells = tiles.shading->GetCellsVisited();
  }
  else
  {
    tiles = { this->MakeShading(nullptr), version, field, layers, 0, 0 };
  }
  this->Current = tiles.shading.get();
  this->Current->SetOutline(outline);
}

//------------------------------------------------------------------------------
/// What fills heights that are read as they are needed; none where all are in memory.
WindowProvider ShadingRun::GetProvider()
{
  TiledHeights* heights = this->Inputs.GetTiledHeights();
  return !heights ? WindowProvider()
                  : [this, heights](const std::vector<HeightSupply::Window>& windows)
  { return heights->Provide(this->Scene.Get(), this->Scene.GetVersion(), windows, this->Limit); };
}

//------------------------------------------------------------------------------
/// The exposure of 8-bit output, unless it is at hand.
void ShadingRun::FindExposure()
{
  const std::uint64_t version = this->Scene.GetVersion();
  const std::uint64_t field = this->Inputs.GetField().GetVersion();
  if (!this->Out.rgba8)
  {
    this->Exposure = PictureExposure();
    this->ExposedScene = 0;
  }
  else if (this->ExposedScene != version || this->ExposedField != field)
  {
    this->Exposure = hosts::FindExposure(this->Inputs.GetScene(), this->Inputs.GetField(),
      this->Scene.Get(), this->GetProvider(), std::isfinite(this->Limit.bytes));
    this->ExposedScene = version;
    this->ExposedField = field;
  }
  else
  {
    this->Exposure.rays = this->Exposure.cells = 0; // no work of this run's
  }
}

//------------------------------------------------------------------------------
/// Bands of tiles, one after another: between them observers hear of progress, on this thread, and
/// may abort.
bool ShadingRun::Shade()
{
  const Target& target = this->Out;
  SceneShading& shading = *this->Current;
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  const int firstRow = target.j0;
  const int endRow = target.j0 + target.rows;
  const int firstColumn = target.i0 / width;
  const int columns = (target.i0 + target.width + width - 1) / width - firstColumn;
  const int rows = (endRow + height - 1) / height - firstRow / height;
  // Threads wait for one another at a band's end, so short runs have few; and they take pieces of a
  // row that are short beside a band, but long beside the handing out.
  const double lights = std::max(shading.GetNumberOfLights(), 1);
  const double work = lights * target.width * target.rows;
  const int bands = static_cast<int>(std::clamp(work / 4.0e6, 3.0, 16.0));
  const int band = (rows + bands - 1) / bands;
  const double shares = 8.0 * vtkSMPTools::GetEstimatedNumberOfThreads();
  const int piece = std::clamp(
    static_cast<int>(std::min(64.0 / lights, columns * static_cast<double>(band) / shares)), 1,
    columns);
  const int pieces = (columns + piece - 1) / piece;
  for (int begin = 0; begin < rows && !vtkReliefIsAborted(this->Host); begin += band)
  {
    const int end = std::min(begin + band, rows);
    vtkReliefFor(static_cast<vtkIdType>(begin) * pieces, static_cast<vtkIdType>(end) * pieces, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (vtkIdType at = from; at < to; ++at)
        {
          const int row = firstRow / height + static_cast<int>(at / pieces);
          const int column = firstColumn + static_cast<int>(at % pieces) * piece;
          shading.Shade(std::max(target.i0, column * width),
            std::min(target.i0 + target.width, (column + piece) * width),
            std::max(firstRow, row * height), std::min(endRow, (row + 1) * height));
        }
      });
    this->Host->UpdateProgress(static_cast<double>(end) / rows);
  }
  return !vtkReliefIsAborted(this->Host);
}

//------------------------------------------------------------------------------
/// What heights that are left out take of the tolerance; infinite where none would do.
double ShadingRun::FindToleranceTaken() const
{
  OutlineError error = this->Current->GetOutlineError();
  error.Add(this->Exposure.error);
  const bool any = this->Scene.Get().integrator != Integrator::FixedStep;
  return error.thickness || error.shadow || (!any && error.tolerance > 0.0)
    ? std::numeric_limits<double>::infinity()
    : error.tolerance;
}

//------------------------------------------------------------------------------
std::string ShadingRun::Finish(vtkReliefStatistics* statistics)
{
  const SceneShading& shading = *this->Current;
  if (this->Whole)
  {
    this->Whole->KeepIlluminations();
  }
  statistics->SetLightsReused(shading.GetLightsReused());
  statistics->SetLightsTraced(shading.GetLightsTraced());
  const std::uint64_t rays =
    shading.GetRaysTraced() - (this->Whole ? 0 : this->Tiles.rays) + this->Exposure.rays;
  const std::uint64_t cells =
    shading.GetCellsVisited() - (this->Whole ? 0 : this->Tiles.cells) + this->Exposure.cells;
  statistics->SetRaysTraced(static_cast<vtkTypeInt64>(rays));
  statistics->SetCellsVisited(static_cast<vtkTypeInt64>(cells));
  statistics->SetExposure(this->Exposure.stops);
  statistics->SetEffectsEvaluated(shading.GetEffects());
  const double taken = this->FindToleranceTaken();
  const double tolerance = this->Scene.Get().medium.tolerance;
  const TiledHeights* heights = this->Inputs.GetTiledHeights();
  statistics->SetToleranceTaken(taken);
  statistics->SetRegionsLeftOut(
    heights ? static_cast<vtkTypeInt64>(heights->GetNumberLeftOut()) : 0);
  this->Whole.reset();
  if (taken <= tolerance)
  {
    return std::string();
  }
  const std::string limit = ", or raise HeightMemoryLimit";
  if (std::isinf(taken))
  {
    return "the layers Thickness and Shadow and fixed steps know no tolerance, and depend on "
           "heights that are left out; do without" +
      limit;
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(4);
  text << "heights that are left out make illuminations uncertain by " << taken
       << ", and Tolerance is " << tolerance << "; make it " << taken * 1.001 << limit;
  return text.str();
}

//------------------------------------------------------------------------------
TiledHeights::Needs ShadingRun::Estimate(const HeightSupply::Window& window)
{
  TiledHeights* heights = this->Inputs.GetTiledHeights();
  return !heights
    ? TiledHeights::Needs()
    : heights->Estimate(this->Scene.Get(), this->Scene.GetVersion(), window, this->Limit);
}

//------------------------------------------------------------------------------
void ShadingRun::Release()
{
  this->Whole.reset();
  this->Tiles = TileShading();
  this->Cache.Keep({});
}
}
