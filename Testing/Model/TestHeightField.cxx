// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace
{
using relief::HeightField;
using relief::HeightSource;

// Parts of three rows, last one first, as threads might.
void InParts(int count, const std::function<void(int, int)>& body)
{
  for (int begin = (count - 1) / 3 * 3; begin >= 0; begin -= 3)
  {
    body(begin, std::min(begin + 3, count));
  }
}

template <class T>
HeightSource<T> SourceOf(const std::vector<T>& values, int columns)
{
  HeightSource<T> source;
  source.data = values.data();
  source.stepX = 1;
  source.stepY = columns;
  source.columns = columns;
  source.rows = static_cast<int>(values.size()) / columns;
  return source;
}

float At(const HeightField& field, int i, int j)
{
  return field.GetField().heights.At(i, j);
}
}

template <class T>
class HeightFieldOf : public ::testing::Test
{
};

using NumericTypes = ::testing::Types<char, signed char, unsigned char, short, unsigned short, int,
  unsigned int, long, unsigned long, long long, unsigned long long, float, double>;
TYPED_TEST_SUITE(HeightFieldOf, NumericTypes);

// Every numeric type, scaled, with a value that means no data.
TYPED_TEST(HeightFieldOf, ScaleAndNoData)
{
  using T = TypeParam;
  std::vector<T> values = { 1, 2, 3, 4, 99, 6, 7, 8, 9, 10, 11, 12 };
  HeightSource<T> source = SourceOf(values, 4);
  source.spacingX = 2.0;
  source.spacingY = 3.0;
  source.scale = -0.5;
  source.hasNoData = true;
  source.noData = 99.0;
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_TRUE(field.HasData());
  EXPECT_EQ(field.GetDatum(), 0.0);
  EXPECT_EQ(field.GetBottom(), -6.0f);
  EXPECT_EQ(field.GetTop(), -0.5f);
  EXPECT_EQ(field.GetField().top, -0.5f);
  EXPECT_EQ(field.GetField().heights.columns, 4);
  EXPECT_EQ(field.GetField().heights.rows, 3);
  EXPECT_EQ(field.GetField().heights.spacingX, 2.0);
  EXPECT_EQ(field.GetField().heights.spacingY, 3.0);
  for (int k = 0; k < 12; ++k)
  {
    if (k == 4)
    {
      EXPECT_TRUE(std::isnan(At(field, 0, 1)));
    }
    else
    {
      EXPECT_EQ(At(field, k % 4, k / 4), -0.5f * static_cast<float>(values[k]));
    }
  }
}

// The ends of each integer type's range are heights as any other. From one end of float to the
// other is further than float can tell.
TYPED_TEST(HeightFieldOf, Limits)
{
  using T = TypeParam;
  if (std::is_same_v<T, double>)
  {
    return;
  }
  std::vector<T> values = { std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max() };
  HeightField field;
  if (std::is_same_v<T, float>)
  {
    const std::string message = field.Assign(SourceOf(values, 2), InParts);
    EXPECT_NE(message.find("from -3.40282e+38 to 3.40282e+38, a relief of at most 2.12676e+37"),
      std::string::npos)
      << message;
  }
  else
  {
    EXPECT_EQ(field.Assign(SourceOf(values, 2), InParts), "");
    EXPECT_EQ(At(field, 0, 0), static_cast<float>(values[0]));
    EXPECT_EQ(At(field, 1, 0), static_cast<float>(values[1]));
  }

  // The greatest value as no data, as many files have it.
  HeightSource<T> source = SourceOf(values, 2);
  source.hasNoData = true;
  source.noData = static_cast<double>(std::numeric_limits<T>::lowest());
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_TRUE(std::isnan(At(field, 0, 0)));
  EXPECT_FALSE(std::isnan(At(field, 1, 0)));
}

TEST(HeightField, NoDataOutsideTheTypeIsNoHeight)
{
  std::vector<unsigned char> bytes = { 0, 44, 255, 1 };
  for (double noData : { -9999.0, 300.0, 0.5, NoData, std::numeric_limits<double>::infinity() })
  {
    HeightSource<unsigned char> source = SourceOf(bytes, 2);
    source.hasNoData = true;
    source.noData = noData;
    HeightField field;
    EXPECT_EQ(field.Assign(source, InParts), "");
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(At(field, k % 2, k / 2), bytes[k]) << noData;
    }
  }
  std::vector<float> singles = { 0.0f, 1.0f, std::numeric_limits<float>::max() / 32.0f, 2.0f };
  HeightSource<float> source = SourceOf(singles, 2);
  source.hasNoData = true;
  source.noData = 1e300;
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_EQ(At(field, 0, 1), singles[2]);
}

// 2^63 and 2^64 are what the greatest values become as a double, and no values themselves.
template <class T>
void TestEnds(double end)
{
  EXPECT_FALSE(relief::NoDataOf<T>(end).has_value());
  EXPECT_FALSE(relief::NoDataOf<T>(-2.0 * end).has_value());
  EXPECT_FALSE(relief::NoDataOf<T>(NoData).has_value());
  const double below = std::nextafter(end, 0.0);
  EXPECT_EQ(relief::NoDataOf<T>(std::floor(below)), static_cast<T>(below));
  const T lowest = std::numeric_limits<T>::lowest();
  EXPECT_EQ(relief::NoDataOf<T>(static_cast<double>(lowest)), lowest);
  EXPECT_FALSE(relief::NoDataOf<T>(static_cast<double>(lowest) - 4096.0).has_value());
}

TEST(HeightField, NoDataAtTheEndsOfTheType)
{
  TestEnds<signed char>(128.0);
  TestEnds<unsigned char>(256.0);
  TestEnds<int>(std::ldexp(1.0, 31));
  TestEnds<unsigned int>(std::ldexp(1.0, 32));
  TestEnds<long long>(std::ldexp(1.0, 63));
  TestEnds<unsigned long long>(std::ldexp(1.0, 64));

  // Cast as it was, 2^63 would be the lowest value on some machines, and the greatest on others.
  std::vector<long long> values = { std::numeric_limits<long long>::lowest(), 0, 5,
    std::numeric_limits<long long>::max() };
  HeightSource<long long> source = SourceOf(values, 2);
  source.hasNoData = true;
  source.noData = std::ldexp(1.0, 63);
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_FALSE(std::isnan(At(field, k % 2, k / 2))) << values[k];
  }
}

// Values are compared in their own type: a file's text rarely has all digits of a float.
TEST(HeightField, NoDataIsComparedInTheSamplesType)
{
  std::vector<float> values = { 0.1f, 1.0f, -9999.0f, 2.0f };
  HeightSource<float> source = SourceOf(values, 2);
  source.hasNoData = true;
  source.noData = 0.1;
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_TRUE(std::isnan(At(field, 0, 0)));
  // The lowest float as 15 digits have it, which is a little lower.
  values[2] = std::numeric_limits<float>::lowest();
  source.noData = -3.40282346638529e+38;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_TRUE(std::isnan(At(field, 0, 1)));
  EXPECT_EQ(field.GetBottom(), 0.1f);
}

TEST(HeightField, NaNInfinityAndMask)
{
  float inf = std::numeric_limits<float>::infinity();
  std::vector<float> values = { 1.0f, std::nanf(""), inf, -inf, 5.0f, 6.0f };
  HeightSource<float> source = SourceOf(values, 3);
  source.hasNoData = true;
  source.noData = NoData;
  source.hasData = [](int i, int j) { return !(i == 1 && j == 1); };
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_EQ(At(field, 0, 0), 1.0f);
  EXPECT_TRUE(std::isnan(At(field, 1, 0)));
  EXPECT_TRUE(std::isnan(At(field, 2, 0)));
  EXPECT_TRUE(std::isnan(At(field, 0, 1)));
  EXPECT_TRUE(std::isnan(At(field, 1, 1)));
  EXPECT_EQ(At(field, 2, 1), 6.0f);
  EXPECT_EQ(field.GetBottom(), 1.0f);
  EXPECT_EQ(field.GetTop(), 6.0f);
}

// Float samples that need no change are used where they are.
TEST(HeightField, InPlace)
{
  std::vector<float> values = { 1.0f, std::nanf(""), 3.0f, 1e7f, 5.0f, 6.0f };
  HeightSource<float> source = SourceOf(values, 3);
  HeightField field;
  auto data = [&]()
  {
    EXPECT_EQ(field.Assign(source, InParts), "");
    return field.GetField().heights.data;
  };
  EXPECT_EQ(data(), values.data());
  EXPECT_EQ(field.GetDatum(), 0.0);
  source.hasNoData = true;
  source.noData = 5.0;
  EXPECT_NE(data(), values.data());
  source.hasNoData = false;
  source.scale = 2.0;
  EXPECT_NE(data(), values.data());
  EXPECT_EQ(At(field, 2, 0), 6.0f);
  source.scale = 1.0;
  source.hasData = [](int i, int) { return i != 0; };
  EXPECT_NE(data(), values.data());
  source.hasData = [](int i, int) { return i != 1; };
  EXPECT_NE(data(), values.data());
  source.hasData = nullptr;
  values[4] = std::numeric_limits<float>::infinity();
  EXPECT_NE(data(), values.data());
  values[4] = 5.0f;
  EXPECT_EQ(data(), values.data());
  // The caller's values are never touched.
  EXPECT_EQ(values[2], 3.0f);
}

// What has its margins already needs no copy to be padded.
TEST(HeightField, Margins)
{
  constexpr int padding = HeightField::Padding;
  const int columns = 5;
  const int rows = 3;
  const int pitch = columns + 2 * padding;
  std::vector<float> values(
    static_cast<std::size_t>(pitch) * (rows + 1), std::numeric_limits<float>::quiet_NaN());
  HeightSource<float> source;
  source.data = values.data() + padding;
  source.stepY = pitch;
  source.columns = columns;
  source.rows = rows;
  for (int at = 0; at < columns * rows; ++at)
  {
    values[padding + at / columns * pitch + at % columns] = static_cast<float>(at);
  }
  for (const int margin : { padding, padding - 1 })
  {
    source.margin = margin;
    HeightField field;
    EXPECT_EQ(field.Assign(source, InParts, true), "");
    EXPECT_EQ(field.IsInPlace(), margin == padding);
    EXPECT_EQ(field.GetField().heights.data == source.data, margin == padding);
    ASSERT_NE(field.GetMissingRow(), nullptr);
    EXPECT_TRUE(std::isnan(field.GetMissingRow()[0]));
    EXPECT_EQ(field.GetTop(), 14.0f);
    EXPECT_EQ(At(field, 4, 2), 14.0f);
  }
  source.margin = padding;
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_EQ(field.GetMissingRow(), nullptr); // nobody has asked for it
}

// A row padded at its end, columns from right to left, one component of three.
TEST(HeightField, Strides)
{
  std::vector<float> values(3 * 4 * 5);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    values[k] = static_cast<float>(k);
  }
  for (double scale : { 1.0, 3.0 }) // in place and copied
  {
    HeightSource<float> source = SourceOf(values, 4);
    source.data = values.data() + 3 * 3 + 1;
    source.stepX = -3;
    source.stepY = 12;
    source.columns = 4;
    source.rows = 5;
    source.scale = scale;
    HeightField field;
    EXPECT_EQ(field.Assign(source, InParts), "");
    for (int j = 0; j < 5; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        EXPECT_EQ(At(field, i, j), static_cast<float>(scale) * values[12 * j + 3 * (3 - i) + 1]);
      }
    }
    EXPECT_EQ(field.GetField().bounds->At(0, 0, 0).hi, static_cast<float>(scale) * 58.0f);
  }
}

// A small relief far above height 0 keeps its digits: the field is lower by the datum.
TEST(HeightField, Datum)
{
  std::vector<double> doubles;
  std::vector<std::int32_t> integers;
  Random random(Seed());
  for (int k = 0; k < 24; ++k)
  {
    doubles.push_back(1e7 + random.Uniform(0.0, 1.0));
    integers.push_back(10000000 + random.Integer(0, 1000));
  }
  HeightField field;
  EXPECT_EQ(field.Assign(SourceOf(doubles, 6), InParts), "");
  for (int k = 0; k < 24; ++k)
  {
    EXPECT_NEAR(field.GetDatum() + At(field, k % 6, k / 6), doubles[k], 1e-6 / 2);
  }
  HeightSource<std::int32_t> source = SourceOf(integers, 6);
  source.scale = 0.001;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_NEAR(field.GetTop() - field.GetBottom(), 1.0, 0.3);
  for (int k = 0; k < 24; ++k)
  {
    EXPECT_NEAR(field.GetDatum() + At(field, k % 6, k / 6), integers[k] * 0.001, 1e-6);
  }
  // A field without relief, and one that needs no datum.
  EXPECT_EQ(field.Assign(SourceOf(std::vector<double>(6, 1e7), 3), InParts), "");
  EXPECT_EQ(field.GetDatum() + At(field, 1, 1), 1e7);
  EXPECT_EQ(field.GetTop(), field.GetBottom());
  EXPECT_EQ(field.Assign(SourceOf(std::vector<double>{ 1.0, 2.0, 1000.0, 1.0 }, 2), InParts), "");
  EXPECT_EQ(field.GetDatum(), 0.0);
}

TEST(HeightField, HeightsBeyondSinglePrecisionAreRefused)
{
  HeightField field;
  std::string message = field.Assign(SourceOf(std::vector<double>{ 0.0, 1e39 }, 2), InParts);
  EXPECT_NE(message.find("1e+39"), std::string::npos) << message;
  std::vector<float> values = { 1e30f, -1e30f };
  HeightSource<float> source = SourceOf(values, 2);
  source.scale = 1e10;
  EXPECT_NE(field.Assign(source, InParts), "");
  source.scale = 1.0;
  EXPECT_EQ(field.Assign(source, InParts), "");
}

TEST(HeightField, NothingHasData)
{
  std::vector<short> values(12, -32768);
  HeightSource<short> source = SourceOf(values, 4);
  source.hasNoData = true;
  source.noData = -32768;
  HeightField field;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_FALSE(field.HasData());
  for (int k = 0; k < 12; ++k)
  {
    EXPECT_TRUE(std::isnan(At(field, k % 4, k / 4)));
  }
  // The next heights do not remember these.
  source.hasNoData = false;
  EXPECT_EQ(field.Assign(source, InParts), "");
  EXPECT_TRUE(field.HasData());
  EXPECT_EQ(At(field, 0, 0) + field.GetDatum(), -32768.0);
}
