// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationCache.h"

#include <glm/vector_relational.hpp>

#include <algorithm>

namespace relief
{

bool IlluminationCache::Key::operator==(const Key& o) const
{
  const f64::ReliefMedium& a = this->medium;
  const f64::ReliefMedium& b = o.medium;
  return this->field == o.field && this->i0 == o.i0 && this->j0 == o.j0 &&
    this->columns == o.columns && this->rows == o.rows && this->vector == o.vector &&
    this->positional == o.positional && this->steps == o.steps && this->thickness == o.thickness &&
    a.depth == b.depth && a.offset == b.offset && a.attenuation == b.attenuation &&
    a.density == b.density && a.useFloor == b.useFloor && a.floorHeight == b.floorHeight &&
    a.tolerance == b.tolerance;
}

std::shared_ptr<const IlluminationCache::Entry> IlluminationCache::Find(const Key& key) const
{
  auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&](const std::shared_ptr<const Entry>& entry) { return entry->key == key; });
  return found == this->Entries.end() ? nullptr : *found;
}

void IlluminationCache::Keep(std::vector<std::shared_ptr<const Entry>> used)
{
  this->Entries.clear();
  std::size_t size = 0;
  for (std::shared_ptr<const Entry>& entry : used)
  {
    size += SizeOf(entry->key);
    if (size > this->Limit)
    {
      return;
    }
    this->Entries.push_back(std::move(entry));
  }
}

}
