// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationCheck.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace relief
{

namespace
{
// Shuffles all that have data, of which there may be more than memory holds: known are only those
// that have changed places.
void DrawOfFew(std::size_t total, std::size_t wanted, std::mt19937_64& random,
  const std::function<bool(std::size_t)>& hasData, std::vector<std::size_t>& drawn)
{
  std::size_t count = 0;
  for (std::size_t at = 0; at < total; ++at)
  {
    count += hasData(at) ? 1 : 0;
  }
  std::unordered_map<std::size_t, std::size_t> moved;
  const auto numberAt = [&moved](std::size_t place)
  {
    const auto found = moved.find(place);
    return found != moved.end() ? found->second : place;
  };
  std::vector<std::pair<std::size_t, std::size_t>> numbers; // among those with data, and for which
  const std::size_t some = std::min(wanted, count);
  for (std::size_t k = 0; k < some; ++k)
  {
    const std::size_t other = k + static_cast<std::size_t>(random() % (count - k));
    numbers.emplace_back(numberAt(other), k);
    moved[other] = numberAt(k);
  }
  std::sort(numbers.begin(), numbers.end());
  drawn.assign(some, 0);
  std::size_t number = 0;
  auto next = numbers.begin();
  for (std::size_t at = 0; at < total && next != numbers.end(); ++at)
  {
    if (hasData(at) && number++ == next->first)
    {
      drawn[next->second] = at;
      ++next;
    }
  }
}
}

std::vector<std::size_t> DrawSamples(std::size_t total, std::size_t wanted, std::uint64_t seed,
  const std::function<bool(std::size_t)>& hasData)
{
  std::vector<std::size_t> drawn;
  std::mt19937_64 random(seed);
  std::unordered_set<std::size_t> tried;
  // Where few have data, or most are wanted, drawing would take too long.
  for (std::size_t draws = 0; drawn.size() < wanted && draws < 16 * wanted && 4 * wanted < total;
       ++draws)
  {
    const std::size_t at = static_cast<std::size_t>(random() % total);
    if (tried.insert(at).second && hasData(at))
    {
      drawn.push_back(at);
    }
  }
  if (drawn.size() < wanted)
  {
    DrawOfFew(total, wanted, random, hasData, drawn);
  }
  return drawn;
}

IlluminationCheck::IlluminationCheck(const HeightField& field, const Scene& scene, const Part& part,
  std::size_t samples, std::uint64_t seed)
  : Reference(field, scene)
{
  const HeightView<float>& heights = field.GetField().heights;
  const std::size_t columns = static_cast<std::size_t>(part.columns);
  const auto column = [&](std::size_t at) { return part.i0 + static_cast<int>(at % columns); };
  const auto row = [&](std::size_t at) { return part.j0 + static_cast<int>(at / columns); };
  for (const std::size_t at : DrawSamples(columns * static_cast<std::size_t>(part.rows), samples,
         seed, [&](std::size_t k) { return !std::isnan(heights.At(column(k), row(k))); }))
  {
    Sample sample;
    sample.i = column(at);
    sample.j = row(at);
    sample.d = part.illumination[at];
    this->Samples.push_back(sample);
  }
}

IlluminationCheck::IlluminationCheck(
  const HeightField& field, const Scene& scene, std::vector<Sample> samples)
  : Reference(field, scene)
  , Samples(std::move(samples))
{
}

void IlluminationCheck::Retrace(std::size_t k)
{
  const double promised = this->GetTolerance() + this->GetRounding();
  Sample& sample = this->Samples[k];
  std::uint64_t cells = 0;
  sample.reference = this->Reference.At(sample.i, sample.j, cells);
  sample.error = std::abs(sample.d - sample.reference);
  if (!(sample.error <= promised))
  {
    const ReferenceIllumination::Span span = this->Reference.SpanAt(sample.i, sample.j);
    const double beyond = std::max({ span.lo - sample.d, sample.d - span.hi, 0.0 });
    sample.grazing = beyond <= promised;
    sample.error = sample.grazing ? beyond : sample.error;
  }
}

const IlluminationCheck::Sample* IlluminationCheck::GetWorst() const
{
  // NaN is worse than any number.
  const auto badness = [](const Sample& sample)
  { return std::isnan(sample.error) ? std::numeric_limits<double>::infinity() : sample.error; };
  const auto worst = std::max_element(this->Samples.begin(), this->Samples.end(),
    [&](const Sample& a, const Sample& b) { return badness(a) < badness(b); });
  return worst != this->Samples.end() ? &*worst : nullptr;
}

std::size_t IlluminationCheck::CountGrazing() const
{
  return static_cast<std::size_t>(std::count_if(this->Samples.begin(), this->Samples.end(),
    [](const Sample& sample) { return sample.grazing; }));
}

bool IlluminationCheck::IsKept() const
{
  const Sample* worst = this->GetWorst();
  return !worst || worst->error <= this->GetTolerance() + this->GetRounding();
}

}
