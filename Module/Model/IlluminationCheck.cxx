// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationCheck.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <unordered_set>

namespace relief
{

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
    drawn.clear();
    for (std::size_t at = 0; at < total; ++at)
    {
      if (hasData(at))
      {
        drawn.push_back(at);
      }
    }
    const std::size_t some = std::min(wanted, drawn.size());
    for (std::size_t k = 0; k < some; ++k)
    {
      std::swap(drawn[k], drawn[k + static_cast<std::size_t>(random() % (drawn.size() - k))]);
    }
    drawn.resize(some);
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

void IlluminationCheck::Retrace(std::size_t begin, std::size_t end)
{
  const double promised = this->GetTolerance() + this->GetRounding();
  for (std::size_t k = begin; k < end; ++k)
  {
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
