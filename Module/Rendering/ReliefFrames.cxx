// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefFrames.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace
{

// Longer draws would make the graphics driver believe that it hangs, and would not notice the time.
constexpr double BandSeconds = 0.04;
constexpr double Coarsest = 16.0;
constexpr std::size_t MaximumFirstLights = 8;
// Texels for a pixel at most, where a slanted view needs many for its foreground.
constexpr double TexelsPerPixel = 3.0;

double Sum(const glm::dvec3& v)
{
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// How bright a light makes level ground, about: the order in which lights are added, and what they
// count while some are missing.
double Strength(const relief::LightPlan& light)
{
  const double height = light.directional ? std::max<double>(light.vector.z, 0.05) : 1.0;
  return Sum(glm::dvec3(light.radiance)) * height;
}

}

//------------------------------------------------------------------------------
double ReliefFrames::GetElapsed() const
{
  return vtkTimerLog::GetUniversalTime() - this->Begin;
}

//------------------------------------------------------------------------------
// Finds the illumination that is kept for a light, or makes room for it.
ReliefFrames::Entry* ReliefFrames::FindEntry(const Key& key)
{
  auto [found, end] = this->Entries.equal_range(key);
  while (found != end && found->second.used)
  {
    ++found;
  }
  if (found == end)
  {
    found = this->Entries.emplace(key, Entry());
  }
  found->second.used = true;
  return &found->second;
}

//------------------------------------------------------------------------------
// Finds the effects of a scene, unless it is the one of the last frame.
void ReliefFrames::Plan(const relief::HeightField& field, const relief::hosts::PreparedScene& scene)
{
  this->Parameters = &scene.Get();
  const std::pair<std::uint64_t, std::uint64_t> from(field.GetVersion(), scene.GetVersion());
  if (from == this->PlannedFrom)
  {
    return;
  }
  this->PlannedFrom = {};
  this->Planned = relief::PlanEffects(field, scene.Get());
  this->Effects = relief::FindEffects(scene.Get(), this->Planned);
  this->Sums.diffuse = this->Planned.diffuse;
  this->Sums.scatter = this->Planned.scatter;
  this->Sums.specular = this->Planned.specular;
  this->PlannedFrom = from;
}

//------------------------------------------------------------------------------
// Sorts the lights into the two classes and finds what is kept of them.
void ReliefFrames::Classify(const relief::HeightField& field)
{
  this->First.clear();
  this->Rest.clear();
  for (auto& [key, entry] : this->Entries)
  {
    entry.used = false;
  }
  double room = this->Asked.memory / (this->Full.GetNumberOfTexels() * sizeof(float));
  for (const relief::LightPlan& light : this->Planned.lights)
  {
    if (!light.shows || (!light.matte && !this->Sums.specular))
    {
      continue;
    }
    Key key = relief::MakeIlluminationKey(field.GetVersion(), *this->Parameters, light);
    key.response = this->Parameters->response;
    // What stands for a patch of the sky, or of a sun's disc, is one of many.
    const bool first = !light.matte ||
      (light.light.weight == 1.0 && room >= 1.0 && this->First.size() < MaximumFirstLights);
    const bool kept = light.matte && room >= 1.0;
    room -= kept ? 1.0 : 0.0;
    (first ? this->First : this->Rest)
      .push_back({ &light, key, kept ? this->FindEntry(key) : nullptr });
  }
  for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
  {
    entry = entry->second.used ? std::next(entry) : this->Entries.erase(entry);
  }
}

//------------------------------------------------------------------------------
// How long it takes to trace a light for a grid, as far as is known.
double ReliefFrames::Estimate(const relief::LightPlan& light, const relief::ReliefGrid& grid) const
{
  return this->Passes->EstimateWork(light, grid) * this->SecondsPerWork;
}

//------------------------------------------------------------------------------
// Traces rows of a layer from `row` on until all are done or the time is up, at least one band.
bool ReliefFrames::TraceRows(
  const relief::LightPlan& light, const ReliefLayer& layer, int& row, double seconds)
{
  const int rows = layer.grid.size[1];
  const double rowWork = this->Passes->EstimateWork(light, layer.grid) / rows;
  double used = 0.0;
  // The first band tells how long others take, with work for every thread.
  const int first = this->OnProcessor ? 32 * vtkSMPTools::GetEstimatedNumberOfThreads() : 32;
  this->Passes->BeginTrace(light, layer.grid);
  do
  {
    const double rowSeconds = rowWork * this->SecondsPerWork;
    const int band =
      rowSeconds > 0.0 ? static_cast<int>(std::clamp(BandSeconds / rowSeconds, 1.0, 1.0e6)) : first;
    const int end = this->Passes->EndOfBand(layer.grid, std::min(row + band, rows));
    const double before = vtkTimerLog::GetUniversalTime();
    if (!this->Passes->Trace(light, layer, row, end))
    {
      return false;
    }
    this->Passes->Finish();
    const double took = vtkTimerLog::GetUniversalTime() - before;
    if (!this->Passes->WasCompiled())
    {
      const double measured = took / ((end - row) * rowWork);
      this->SecondsPerWork =
        this->SecondsPerWork > 0.0 ? 0.5 * (this->SecondsPerWork + measured) : measured;
    }
    this->Done.rays += static_cast<std::int64_t>(end - row) * layer.grid.size[0];
    used += took;
    row = end;
  } while (row < rows && used < seconds);
  return true;
}

//------------------------------------------------------------------------------
// The finest grid over what can be seen that lights can be traced for in the time given, if any.
relief::ReliefGrid ReliefFrames::AffordableGrid(
  const std::vector<LightInUse>& lights, double seconds) const
{
  for (double coarseness = 1.0;; coarseness *= std::exp2(0.25))
  {
    const relief::ReliefGrid grid = relief::MakeGrid(this->Asked.part, this->Samples[0],
      this->Samples[1], std::min(coarseness, Coarsest), this->Full.GetNumberOfTexels(),
      this->Asked.maximumTextureSize);
    double expected = 0.0;
    for (const LightInUse& light : lights)
    {
      expected += this->Estimate(*light.plan, grid);
    }
    if (expected <= seconds || coarseness >= Coarsest)
    {
      return grid;
    }
  }
}

//------------------------------------------------------------------------------
// Brings the lights whose illumination is kept as far as time allows, and chooses the grid to show.
bool ReliefFrames::UpdateFirst()
{
  constexpr double forever = std::numeric_limits<double>::infinity();
  std::vector<LightInUse> missing;
  double expected = 0.0; // seconds
  for (const LightInUse& light : this->First)
  {
    Entry* entry = light.entry;
    if (entry && entry->complete.grid.Holds(this->Full))
    {
      ++this->Done.lightsReused;
    }
    else if (entry)
    {
      missing.push_back(light);
      entry->rows = entry->pending.grid == this->Full ? entry->rows : 0;
      expected += this->Estimate(*light.plan, this->Full) *
        (1.0 - static_cast<double>(entry->rows) / this->Full.size[1]);
    }
  }
  this->Shown = this->Full;
  const bool all = expected <= this->Asked.seconds;
  if (!all)
  {
    // Something to show first, of which a still picture may take half its time.
    const relief::ReliefGrid coarse = this->AffordableGrid(
      missing, this->Asked.moving ? this->Asked.seconds : this->Asked.seconds / 2.0);
    for (const auto& [light, key, entry] : missing)
    {
      if (entry->complete.grid.Reaches(this->Full) &&
        entry->complete.grid.GetDetail() >= coarse.GetDetail() / 2.0)
      {
        continue;
      }
      this->Traced.insert(light);
      int row = 0;
      if (!entry->complete.Allocate(this->Window, coarse, 1) ||
        !this->TraceRows(*light, entry->complete, row, forever))
      {
        return false;
      }
      entry->stamp = ++this->Stamp;
    }
  }
  for (const auto& [light, key, entry] : missing)
  {
    const double left = this->Asked.seconds - this->GetElapsed();
    if (!all && (this->Asked.moving || left <= 0.0))
    {
      break;
    }
    this->Traced.insert(light);
    if ((entry->rows == 0 && !entry->pending.Allocate(this->Window, this->Full, 1)) ||
      !this->TraceRows(*light, entry->pending, entry->rows, all ? forever : left))
    {
      return false;
    }
    if (entry->rows == this->Full.size[1])
    {
      entry->complete = std::move(entry->pending);
      entry->pending = ReliefLayer();
      entry->rows = 0;
      entry->stamp = ++this->Stamp;
    }
  }
  for (const auto& [light, key, entry] : missing)
  {
    if (!entry->complete.grid.Holds(this->Full) &&
      (this->Shown == this->Full || entry->complete.grid.GetDetail() < this->Shown.GetDetail()))
    {
      this->Shown = entry->complete.grid;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Sums the lights whose illumination is kept, if anything has changed.
bool ReliefFrames::GatherFirst()
{
  Gathered from = this->DescribeFirst();
  if (this->GatheredFrom == from)
  {
    return true;
  }
  this->GatheredFrom.reset();
  if (!this->Sums.Any() || this->First.empty())
  {
    this->FirstSums = ReliefSumLayers();
    this->GatheredFrom = std::move(from);
    return true;
  }
  // Lights that give highlights only come last: they add to one of the sums.
  std::vector<LitLayer> lit;
  std::vector<LitLayer> mirrors;
  for (const auto& [light, key, entry] : this->First)
  {
    (entry ? lit : mirrors).push_back({ *light, entry ? &entry->complete : nullptr });
  }
  if (!this->FirstSums.Allocate(this->Window, this->Shown, this->Sums) ||
    (lit.empty() && !this->Passes->Clear(this->FirstSums)))
  {
    return false;
  }
  ReliefSumLayers mirrored = this->FirstSums;
  mirrored.features.diffuse = mirrored.features.scatter = false;
  mirrored.textures[0] = mirrored.textures[1] = nullptr;
  if (!this->Passes->Gather(lit, this->FirstSums, false) ||
    !this->Passes->Gather(mirrors, mirrored, true))
  {
    return false;
  }
  this->GatheredFrom = std::move(from);
  return true;
}

//------------------------------------------------------------------------------
// Whether the later sums are over the lights at hand, up to a common factor of their radiances.
bool ReliefFrames::IsLaterValid(glm::dvec3& scale) const
{
  const Later& later = this->LaterSums;
  if (later.keys.size() != this->Rest.size() || !(later.sums.features == this->Sums) ||
    (this->Sums.specular && !Same(later.falloffs[0], this->Parameters->specularFalloff)) ||
    (this->Sums.scatter && !Same(later.falloffs[1], this->Parameters->scatterFalloff)))
  {
    return false;
  }
  glm::dvec3 before(0.0);
  glm::dvec3 now(0.0);
  for (std::size_t k = 0; k < this->Rest.size(); ++k)
  {
    before += later.radiances[k];
    now += glm::dvec3(this->Rest[k].plan->radiance);
  }
  for (int c = 0; c < 3; ++c)
  {
    scale[c] = before[c] != 0.0 ? now[c] / before[c] : 1.0;
  }
  for (std::size_t k = 0; k < this->Rest.size(); ++k)
  {
    const glm::dvec3 expected = scale * later.radiances[k];
    const glm::dvec3 difference = glm::dvec3(this->Rest[k].plan->radiance) - expected;
    if (!(later.keys[k] == this->Rest[k].key) ||
      Sum(difference) > 1.0e-6 * (Sum(expected) + 1.0e-30))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool ReliefFrames::RestartLater()
{
  Later& later = this->LaterSums;
  relief::ReliefGrid grid = this->Shown;
  if (this->Asked.moving)
  {
    // A few lights, that shadows do not come from one side only.
    const double left =
      std::max(this->Asked.seconds - this->GetElapsed(), this->Asked.seconds / 4.0);
    const auto few = static_cast<std::ptrdiff_t>(std::min<std::size_t>(this->Rest.size(), 4));
    const relief::ReliefGrid coarse =
      this->AffordableGrid({ this->Rest.begin(), this->Rest.begin() + few }, left);
    grid = coarse.GetDetail() < grid.GetDetail() ? coarse : grid;
  }
  later.keys.clear();
  later.radiances.clear();
  for (const LightInUse& light : this->Rest)
  {
    later.keys.push_back(light.key);
    later.radiances.emplace_back(light.plan->radiance);
  }
  later.order.resize(this->Rest.size());
  std::iota(later.order.begin(), later.order.end(), std::size_t(0));
  std::stable_sort(later.order.begin(), later.order.end(),
    [this](std::size_t a, std::size_t b)
    { return Strength(*this->Rest[a].plan) > Strength(*this->Rest[b].plan); });
  later.falloffs[0] = this->Parameters->specularFalloff;
  later.falloffs[1] = this->Parameters->scatterFalloff;
  later.added = 0;
  later.stamp = ++this->Stamp;
  return later.sums.Allocate(this->Window, grid, this->Sums) && this->Passes->Clear(later.sums);
}

//------------------------------------------------------------------------------
// How much of the strength of the later lights has been added.
double ReliefFrames::GetLaterShare() const
{
  const Later& later = this->LaterSums;
  double all = 0.0;
  double added = 0.0;
  for (std::size_t k = 0; k < later.order.size(); ++k)
  {
    const double strength = Strength(*this->Rest[later.order[k]].plan);
    all += strength;
    added += k < later.added ? strength : 0.0;
  }
  return later.added < later.order.size() && added > 0.0 ? added / all : 1.0;
}

//------------------------------------------------------------------------------
// Finds the illumination of one of the rest, in a layer that is kept or in another.
const ReliefLayer* ReliefFrames::LightLater(const LightInUse& light, ReliefLayer& scratch)
{
  const relief::ReliefGrid& grid = this->LaterSums.sums.grid;
  Entry* entry = light.entry;
  if (entry && entry->complete.grid.Reaches(grid) &&
    entry->complete.grid.GetDetail() >= grid.GetDetail())
  {
    ++this->Done.lightsReused;
    return &entry->complete;
  }
  // What is kept is worth more than a passing view.
  ReliefLayer& layer = entry && !this->Asked.moving ? entry->complete : scratch;
  int row = 0;
  if (!layer.Allocate(this->Window, grid, 1) ||
    !this->TraceRows(*light.plan, layer, row, std::numeric_limits<double>::infinity()))
  {
    return nullptr;
  }
  this->Traced.insert(light.plan);
  return &layer;
}

//------------------------------------------------------------------------------
// Adds as many of the other lights as time allows, at least one.
bool ReliefFrames::UpdateLater()
{
  Later& later = this->LaterSums;
  this->LaterScale = glm::dvec3(1.0);
  if (this->Rest.empty())
  {
    later = Later();
    this->Scratch = {};
    return true;
  }
  // While things move, what there is serves, however coarse it is.
  const bool fits =
    this->Asked.moving ? later.sums.grid.Reaches(this->Full) : later.sums.grid.Holds(this->Shown);
  if (!this->IsLaterValid(this->LaterScale) || !fits)
  {
    this->LaterScale = glm::dvec3(1.0);
    if (!this->RestartLater())
    {
      return false;
    }
  }
  for (bool inTime = true; later.added < later.keys.size() && inTime;)
  {
    std::vector<LitLayer> lights;
    while (later.added + lights.size() < later.keys.size() &&
      lights.size() < relief::MostGathered && inTime)
    {
      const std::size_t index = later.order[later.added + lights.size()];
      const ReliefLayer* layer = this->LightLater(this->Rest[index], this->Scratch[lights.size()]);
      if (!layer)
      {
        return false;
      }
      // With the radiance that it had when the sums were begun.
      lights.push_back({ *this->Rest[index].plan, layer });
      lights.back().light.radiance = glm::vec3(later.radiances[index]);
      inTime = this->GetElapsed() < this->Asked.seconds;
    }
    if (!this->Passes->Gather(lights, later.sums, true))
    {
      return false;
    }
    later.added += lights.size();
    later.stamp = ++this->Stamp;
  }
  this->LaterScale /= this->GetLaterShare();
  return true;
}

//------------------------------------------------------------------------------
bool ReliefFrames::ComposeColors()
{
  Composed from = this->DescribeColors();
  if (this->ComposedFrom == from)
  {
    return true;
  }
  this->ComposedFrom.reset();
  const ReliefSumLayers* first = this->FirstSums.Used().empty() ? nullptr : &this->FirstSums;
  const ReliefSumLayers* later = this->Rest.empty() ? nullptr : &this->LaterSums.sums;
  if (!this->Textures.Update(this->Window, *this->Parameters, this->Effects, this->Shown,
        this->Samples[0], this->Samples[1], this->Asked.textures) ||
    !this->Colors.Allocate(this->Window, this->Shown, 4) ||
    !this->Passes->Compose(first, later, this->LaterScale,
      first || later ? this->Sums : relief::SumFeatures(), this->Textures, this->Colors))
  {
    return false;
  }
  this->ComposedFrom = std::move(from);
  return true;
}

//------------------------------------------------------------------------------
void ReliefFrames::JudgeProgress()
{
  double lights = 0.0;
  double done = 0.0;
  for (const auto& [light, key, entry] : this->First)
  {
    lights += 1.0;
    done += !entry || entry->complete.grid.Holds(this->Full)
      ? 1.0
      : static_cast<double>(entry->rows) / this->Full.size[1];
  }
  lights += static_cast<double>(this->Rest.size());
  if (this->LaterSums.sums.grid.Holds(this->Full))
  {
    done += static_cast<double>(this->LaterSums.added);
  }
  this->Converged = done == lights;
  this->Progress = lights > 0.0 ? done / lights : 1.0;
}

//------------------------------------------------------------------------------
// After a frame that has failed nobody knows which layers hold what they say.
void ReliefFrames::Forget()
{
  this->First.clear();
  this->Rest.clear();
  this->Entries.clear();
  this->LaterSums = Later();
  this->GatheredFrom.reset();
  this->ComposedFrom.reset();
}

//------------------------------------------------------------------------------
bool ReliefFrames::Update(vtkOpenGLRenderWindow* window, ReliefPasses& passes,
  const relief::HeightField& field, const relief::hosts::PreparedScene& scene,
  const Request& request)
{
  this->Window = window;
  this->Passes = &passes;
  this->Asked = request;
  this->Begin = vtkTimerLog::GetUniversalTime();
  this->Done = Work();
  this->Traced.clear();
  this->Converged = false;
  const relief::HeightView<float>& heights = field.GetField().heights;
  const bool sameField = this->Samples[0] == heights.columns && this->Samples[1] == heights.rows;
  this->Samples[0] = heights.columns;
  this->Samples[1] = heights.rows;
  const double pixels = static_cast<double>(request.viewportSize[0]) * request.viewportSize[1];
  const relief::ReliefGrid full = relief::MakeGrid(request.part, heights.columns, heights.rows, 1.0,
    std::max(TexelsPerPixel * pixels, 4096.0), request.maximumTextureSize);
  // A larger one of the same stride, as after zooming in a little, saves tracing anew.
  const bool keep = sameField && this->Full.Holds(full) &&
    std::max(this->Full.size[0], this->Full.size[1]) <= request.maximumTextureSize &&
    this->Full.GetNumberOfTexels() <= 2.0 * full.GetNumberOfTexels();
  this->Full = keep ? this->Full : full;

  if (this->OnProcessor != request.onProcessor)
  {
    // Who asks for the other way wants to see it.
    this->Entries.clear();
    this->LaterSums = Later();
    this->SecondsPerWork = 0.0;
    this->OnProcessor = request.onProcessor;
  }
  this->Plan(field, scene);
  this->Classify(field);
  passes.SetScene(field, scene.Get(), request.onProcessor);
  const std::uint64_t cells = passes.GetTracedWork().cells;
  bool done = false;
  try
  {
    done =
      this->UpdateFirst() && this->GatherFirst() && this->UpdateLater() && this->ComposeColors();
  }
  catch (...)
  {
    this->Forget();
    throw;
  }
  if (done)
  {
    this->JudgeProgress();
  }
  else
  {
    this->Forget();
  }
  this->Done.lightsTraced = static_cast<int>(this->Traced.size());
  this->Done.cells = static_cast<std::int64_t>(passes.GetTracedWork().cells - cells);
  return done;
}
