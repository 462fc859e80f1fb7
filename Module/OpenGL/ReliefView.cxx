// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefView.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
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

void Append(std::vector<double>& key, const glm::dvec3& v)
{
  key.insert(key.end(), { v.x, v.y, v.z });
}

void Append(std::vector<double>& key, const relief::ReliefGrid& grid)
{
  key.insert(key.end(),
    { static_cast<double>(grid.first[0]), static_cast<double>(grid.first[1]),
      static_cast<double>(grid.size[0]), static_cast<double>(grid.size[1]), grid.stride[0],
      grid.stride[1] });
}

void Append(std::vector<double>& key, const relief::f64::ReliefFalloff& falloff)
{
  key.insert(key.end(), { falloff.lo, falloff.hi, falloff.power });
}

void Append(std::vector<double>& key, const relief::SumFeatures& sums)
{
  key.insert(
    key.end(), { sums.diffuse ? 1.0 : 0.0, sums.scatter ? 1.0 : 0.0, sums.specular ? 1.0 : 0.0 });
}

bool Same(const relief::f64::ReliefFalloff& a, const relief::f64::ReliefFalloff& b)
{
  return a.lo == b.lo && a.hi == b.hi && a.power == b.power;
}

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
double ReliefView::GetElapsed() const
{
  return vtkTimerLog::GetUniversalTime() - this->Begin;
}

//------------------------------------------------------------------------------
// Finds the illumination that is kept for a light, or makes room for it.
ReliefView::Entry* ReliefView::FindEntry(const Key& key)
{
  auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&](const Entry& entry) { return !entry.used && entry.key == key; });
  if (found == this->Entries.end())
  {
    found = this->Entries.emplace(this->Entries.end());
    found->key = key;
  }
  found->used = true;
  return &*found;
}

//------------------------------------------------------------------------------
// Sorts the lights into the two classes and finds what is kept of them.
void ReliefView::Classify(const relief::HeightField& field, const relief::Scene& scene)
{
  this->Plan = relief::PlanEffects(field, scene);
  this->Parameters = scene;
  this->Sums.diffuse = this->Plan.diffuse;
  this->Sums.scatter = this->Plan.scatter;
  this->Sums.specular = this->Plan.specular;
  this->First.clear();
  this->Rest.clear();
  for (Entry& entry : this->Entries)
  {
    entry.used = false;
  }
  double room = this->Asked.memory / (this->Full.GetNumberOfTexels() * sizeof(float));
  for (const relief::LightPlan& light : this->Plan.lights)
  {
    if (!light.shows || (!light.trace && !this->Sums.specular))
    {
      continue;
    }
    Key key;
    key.field = field.GetVersion();
    key.vector = light.light.vector;
    key.positional = light.light.positional;
    key.medium = scene.medium;
    key.medium.tolerance *= light.light.toleranceScale;
    key.steps = scene.integrator == relief::Integrator::FixedStep ? scene.steps : 0;
    // What stands for a patch of the sky, or of a sun's disc, is one of many.
    const bool first = !light.trace ||
      (light.light.weight == 1.0 && room >= 1.0 && this->First.size() < MaximumFirstLights);
    const bool kept = light.trace && room >= 1.0;
    room -= kept ? 1.0 : 0.0;
    (first ? this->First : this->Rest)
      .push_back({ &light, key, kept ? this->FindEntry(key) : nullptr });
  }
  this->Entries.remove_if([](const Entry& entry) { return !entry.used; });
}

//------------------------------------------------------------------------------
// Traces rows of a layer from `row` on until all are done or the time is up, at least one band.
bool ReliefView::TraceRows(
  const relief::LightPlan& light, const ReliefLayer& layer, int& row, double seconds)
{
  const int rows = layer.grid.size[1];
  double used = 0.0;
  do
  {
    const double rowSeconds = this->Estimate(layer.grid.size[0]);
    const int band =
      rowSeconds > 0.0 ? static_cast<int>(std::clamp(BandSeconds / rowSeconds, 1.0, 1.0e6)) : 32;
    const int end = std::min(row + band, rows);
    const double before = vtkTimerLog::GetUniversalTime();
    if (!this->Passes->Trace(light, layer, row, end))
    {
      return false;
    }
    this->Passes->Finish();
    const double took = vtkTimerLog::GetUniversalTime() - before;
    const double texels = static_cast<double>(end - row) * layer.grid.size[0];
    if (!this->Passes->WasCompiled())
    {
      const double measured = took / texels;
      this->SecondsPerTexel =
        this->SecondsPerTexel > 0.0 ? 0.5 * (this->SecondsPerTexel + measured) : measured;
    }
    this->Done.rays += static_cast<std::int64_t>(texels);
    used += took;
    row = end;
  } while (row < rows && used < seconds);
  return true;
}

//------------------------------------------------------------------------------
// A grid over what can be seen that a number of lights can be traced for in the time given.
relief::ReliefGrid ReliefView::AffordableGrid(std::size_t lights, double seconds) const
{
  const double wanted =
    this->Estimate(static_cast<double>(lights) * this->Full.GetNumberOfTexels());
  // Strides are rounded down.
  const double coarseness = std::clamp(1.2 * std::sqrt(wanted / seconds), 1.0, Coarsest);
  return relief::MakeGrid(this->Asked.part, this->Samples[0], this->Samples[1], coarseness,
    this->Full.GetNumberOfTexels(), this->Asked.maximumTextureSize);
}

//------------------------------------------------------------------------------
// Brings the lights whose illumination is kept as far as time allows, and chooses the grid to show.
bool ReliefView::UpdateFirst()
{
  constexpr double forever = std::numeric_limits<double>::infinity();
  std::vector<LightInUse> missing;
  double texels = 0.0;
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
      texels +=
        this->Full.GetNumberOfTexels() - static_cast<double>(entry->rows) * this->Full.size[0];
    }
  }
  this->Shown = this->Full;
  const bool all = this->Estimate(texels) <= this->Asked.seconds;
  if (!all)
  {
    // Something to show first, of which a still picture may take half its time.
    const relief::ReliefGrid coarse = this->AffordableGrid(
      missing.size(), this->Asked.moving ? this->Asked.seconds : this->Asked.seconds / 2.0);
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
bool ReliefView::GatherFirst()
{
  std::vector<double> from;
  Append(from, this->Shown);
  Append(from, this->Sums);
  Append(from, this->Parameters.specularFalloff);
  Append(from, this->Parameters.scatterFalloff);
  for (const auto& [light, key, entry] : this->First)
  {
    from.push_back(entry ? static_cast<double>(entry->stamp) : 0.0);
    from.push_back(light->directional ? 1.0 : 0.0);
    Append(from, light->light.vector);
    Append(from, glm::dvec3(light->radiance));
  }
  if (!this->First.empty())
  {
    from.push_back(this->Parameters.medium.depth);
    from.push_back(this->Parameters.medium.offset);
    from.push_back(static_cast<double>(this->Passes->GetField().GetVersion()));
  }
  if (from == this->GatheredFrom)
  {
    return true;
  }
  this->GatheredFrom.clear();
  if (!this->Sums.Any() || this->First.empty())
  {
    this->FirstSums = ReliefSumLayers();
    this->GatheredFrom = std::move(from);
    return true;
  }
  if (!this->FirstSums.Allocate(this->Window, this->Shown, this->Sums) ||
    !this->Passes->Clear(this->FirstSums))
  {
    return false;
  }
  // Lights that give highlights only.
  ReliefSumLayers mirrored = this->FirstSums;
  mirrored.features.diffuse = mirrored.features.scatter = false;
  mirrored.textures[0] = mirrored.textures[1] = nullptr;
  for (const auto& [light, key, entry] : this->First)
  {
    if (!this->Passes->Gather(
          *light, entry ? &entry->complete : nullptr, entry ? this->FirstSums : mirrored))
    {
      return false;
    }
  }
  this->GatheredFrom = std::move(from);
  return true;
}

//------------------------------------------------------------------------------
// Whether the later sums are over the lights at hand, up to a common factor of their radiances.
bool ReliefView::IsLaterValid(glm::dvec3& scale) const
{
  const Later& later = this->LaterSums;
  if (later.keys.size() != this->Rest.size() || !(later.sums.features == this->Sums) ||
    (this->Sums.specular && !Same(later.falloffs[0], this->Parameters.specularFalloff)) ||
    (this->Sums.scatter && !Same(later.falloffs[1], this->Parameters.scatterFalloff)))
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
bool ReliefView::RestartLater()
{
  Later& later = this->LaterSums;
  relief::ReliefGrid grid = this->Shown;
  if (this->Asked.moving)
  {
    // A few lights, that shadows do not come from one side only.
    const double left =
      std::max(this->Asked.seconds - this->GetElapsed(), this->Asked.seconds / 4.0);
    const relief::ReliefGrid coarse =
      this->AffordableGrid(std::min<std::size_t>(this->Rest.size(), 4), left);
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
    [&](std::size_t a, std::size_t b)
    { return Sum(later.radiances[a]) > Sum(later.radiances[b]); });
  later.falloffs[0] = this->Parameters.specularFalloff;
  later.falloffs[1] = this->Parameters.scatterFalloff;
  later.added = 0;
  later.stamp = ++this->Stamp;
  return later.sums.Allocate(this->Window, grid, this->Sums) && this->Passes->Clear(later.sums);
}

//------------------------------------------------------------------------------
// How much of the strength of the later lights has been added.
double ReliefView::GetLaterShare() const
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
// Adds one of the rest, with the radiance that it had when the sums were begun.
bool ReliefView::AddLater(const LightInUse& light, const glm::dvec3& radiance)
{
  const relief::ReliefGrid& grid = this->LaterSums.sums.grid;
  relief::LightPlan plan = *light.plan;
  plan.radiance = glm::vec3(radiance);
  Entry* entry = light.entry;
  if (entry && entry->complete.grid.Reaches(grid) &&
    entry->complete.grid.GetDetail() >= grid.GetDetail())
  {
    ++this->Done.lightsReused;
    return this->Passes->Gather(plan, &entry->complete, this->LaterSums.sums);
  }
  // What is kept is worth more than a passing view.
  const bool keep = entry && !this->Asked.moving;
  ReliefLayer& layer = keep ? entry->complete : this->Scratch;
  int row = 0;
  if (!layer.Allocate(this->Window, grid, 1) ||
    !this->TraceRows(plan, layer, row, std::numeric_limits<double>::infinity()))
  {
    return false;
  }
  this->Traced.insert(light.plan);
  return this->Passes->Gather(plan, &layer, this->LaterSums.sums);
}

//------------------------------------------------------------------------------
// Adds as many of the other lights as time allows, at least one.
bool ReliefView::UpdateLater()
{
  Later& later = this->LaterSums;
  this->LaterScale = glm::dvec3(1.0);
  if (this->Rest.empty())
  {
    later = Later();
    this->Scratch = ReliefLayer();
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
  for (bool first = true;
       later.added < later.keys.size() && (first || this->GetElapsed() < this->Asked.seconds);
       first = false)
  {
    const std::size_t index = later.order[later.added];
    if (!this->AddLater(this->Rest[index], later.radiances[index]))
    {
      return false;
    }
    ++later.added;
    later.stamp = ++this->Stamp;
  }
  this->LaterScale /= this->GetLaterShare();
  return true;
}

//------------------------------------------------------------------------------
bool ReliefView::ComposeColors()
{
  std::vector<double> from = this->GatheredFrom;
  Append(from, this->Shown);
  from.push_back(static_cast<double>(this->LaterSums.stamp));
  Append(from, this->LaterScale);
  Append(from, this->Parameters.base);
  Append(from, this->Parameters.diffuse);
  Append(from, this->Parameters.specular);
  from.push_back(this->Parameters.specularCoefficient);
  from.push_back(this->Parameters.scatterCoefficient);
  from.push_back(static_cast<double>(this->Passes->GetField().GetVersion()));
  from.push_back(static_cast<double>(this->Asked.textures));
  if (from == this->ComposedFrom)
  {
    return true;
  }
  this->ComposedFrom.clear();
  const ReliefSumLayers* first = this->FirstSums.Used().empty() ? nullptr : &this->FirstSums;
  const ReliefSumLayers* later = this->Rest.empty() ? nullptr : &this->LaterSums.sums;
  if (!this->Textures.Update(this->Window, this->Parameters, this->Shown, this->Samples[0],
        this->Samples[1], this->Asked.textures) ||
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
void ReliefView::JudgeProgress()
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
bool ReliefView::Update(vtkOpenGLRenderWindow* window, ReliefPasses& passes,
  const relief::HeightField& field, const relief::Scene& scene, const Request& request)
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

  this->Classify(field, scene);
  passes.SetScene(scene);
  const bool done =
    this->UpdateFirst() && this->GatherFirst() && this->UpdateLater() && this->ComposeColors();
  if (done)
  {
    this->JudgeProgress();
  }
  this->Done.lightsTraced = static_cast<int>(this->Traced.size());
  return done;
}
