// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationCache.h"

#include <gtest/gtest.h>

#include <functional>

using relief::IlluminationCache;

namespace
{
IlluminationCache::Key SomeKey()
{
  IlluminationCache::Key key;
  key.light.field = 7;
  key.light.vector = glm::dvec3(0.6, 0.0, 0.8);
  key.light.medium = { 1.0, 0, 1, 1.0, false, 0.0, 0.002 };
  key.i0 = 1;
  key.j0 = 2;
  key.columns = 16;
  key.rows = 8;
  return key;
}

std::shared_ptr<IlluminationCache::Entry> MakeEntry(const IlluminationCache::Key& key)
{
  auto entry = std::make_shared<IlluminationCache::Entry>();
  entry->key = key;
  return entry;
}
}

TEST(IlluminationCache, FindsTheSameKeyAndNoOther)
{
  IlluminationCache cache;
  cache.SetLimit(1 << 20);
  const auto entry = MakeEntry(SomeKey());
  cache.Keep({ entry });
  EXPECT_EQ(cache.Find(SomeKey()), entry);

  // d depends on every one of these.
  using Key = IlluminationCache::Key;
  const std::vector<std::function<void(Key&)>> changes = {
    [](Key& k) { ++k.light.field; },
    [](Key& k) { ++k.i0; },
    [](Key& k) { ++k.j0; },
    [](Key& k) { ++k.columns; },
    [](Key& k) { ++k.rows; },
    [](Key& k) { k.light.vector.z = 0.7; },
    [](Key& k) { k.light.positional = true; },
    [](Key& k) { k.light.steps = 8; },
    [](Key& k) { k.thickness = true; },
    [](Key& k) { k.light.medium.depth = 2.0; },
    [](Key& k) { k.light.medium.offset = 1; },
    [](Key& k) { k.light.medium.attenuation = 0; },
    [](Key& k) { k.light.medium.density = 2.0; },
    [](Key& k) { k.light.medium.useFloor = true; },
    [](Key& k) { k.light.medium.floorHeight = 1.0; },
    [](Key& k) { k.light.medium.tolerance = 0.0; },
  };
  for (std::size_t k = 0; k < changes.size(); ++k)
  {
    Key key = SomeKey();
    changes[k](key);
    EXPECT_EQ(cache.Find(key), nullptr) << "change " << k;
  }
}

TEST(IlluminationCache, KeepsTheFirstThatFitAndForgetsTheRest)
{
  IlluminationCache::Key first = SomeKey();
  IlluminationCache::Key second = SomeKey();
  second.light.vector.x = -0.6;
  IlluminationCache::Key third = SomeKey();
  third.light.vector.y = 0.1;
  third.thickness = true;
  const std::size_t size = 16 * 8 * sizeof(float);
  EXPECT_EQ(IlluminationCache::SizeOf(first), size);
  EXPECT_EQ(IlluminationCache::SizeOf(third), 2 * size);

  IlluminationCache cache;
  cache.SetLimit(4 * size - 1);
  cache.Keep({ MakeEntry(first), MakeEntry(second), MakeEntry(third) });
  EXPECT_NE(cache.Find(first), nullptr);
  EXPECT_NE(cache.Find(second), nullptr);
  EXPECT_EQ(cache.Find(third), nullptr);

  cache.SetLimit(4 * size);
  cache.Keep({ MakeEntry(second), MakeEntry(third) });
  EXPECT_EQ(cache.Find(first), nullptr);
  EXPECT_NE(cache.Find(third), nullptr);

  cache.SetLimit(0);
  cache.Keep({ MakeEntry(first) });
  EXPECT_EQ(cache.Find(first), nullptr);
}

// Room of an entry that nobody uses is given away once, and no entry keeps it.
TEST(IlluminationCache, GivesUnusedRoomAway)
{
  constexpr std::size_t samples = 16 * 8;
  IlluminationCache cache;
  cache.SetLimit(1 << 20);
  auto entry = MakeEntry(SomeKey());
  entry->illumination.Allocate(samples);
  const float* const room = entry->illumination.data();
  cache.Keep({ entry });
  EXPECT_TRUE(cache.TakeUnused(samples).empty()); // it is used here
  EXPECT_NE(cache.Find(SomeKey()), nullptr);
  entry = nullptr;
  EXPECT_TRUE(cache.TakeUnused(samples + 1).empty());
  const relief::RawArray<float> taken = cache.TakeUnused(samples);
  EXPECT_EQ(taken.data(), room);
  EXPECT_EQ(taken.size(), samples);
  EXPECT_EQ(cache.Find(SomeKey()), nullptr);
  EXPECT_TRUE(cache.TakeUnused(samples).empty());
}
