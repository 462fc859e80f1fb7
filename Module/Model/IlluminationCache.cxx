// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationCache.h"

#include <tuple>
#include <utility>

namespace relief
{

bool IlluminationCache::Key::operator==(const Key& other) const
{
  auto part = [](const Key& key)
  { return std::tie(key.i0, key.j0, key.columns, key.rows, key.thickness); };
  return this->light == other.light && part(*this) == part(other);
}

std::shared_ptr<IlluminationCache::Entry> IlluminationCache::Find(const Key& key) const
{
  const auto found = this->Entries.find(key);
  return found == this->Entries.end() ? nullptr : found->second;
}

RawArray<float> IlluminationCache::TakeUnused(std::size_t samples)
{
  for (auto at = this->Entries.begin(); at != this->Entries.end(); ++at)
  {
    const std::shared_ptr<Entry>& entry = at->second;
    if (entry.use_count() == 1 && entry->illumination.size() == samples)
    {
      RawArray<float> room = std::move(entry->illumination);
      this->Entries.erase(at);
      return room;
    }
  }
  return {};
}

void IlluminationCache::Keep(std::vector<std::shared_ptr<Entry>> used)
{
  this->Entries.clear();
  std::size_t size = 0;
  for (std::shared_ptr<Entry>& entry : used)
  {
    size += SizeOf(entry->key);
    if (size > this->Limit)
    {
      return;
    }
    const Key key = entry->key;
    this->Entries.emplace(key, std::move(entry));
  }
}

}
