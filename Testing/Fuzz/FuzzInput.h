// SPDX-License-Identifier: BSD-3-Clause
#ifndef FuzzInput_h
#define FuzzInput_h

/// @file
/// What the fuzzers share: bytes read as numbers, checks that end the program, files to be read.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

/// Ends the program where a condition fails, as a sanitizer does.
#define FUZZ_CHECK(condition)                                                                      \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      std::fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);                 \
      std::abort();                                                                                \
    }                                                                                              \
  } while (false)

/// Bytes as numbers; zeros follow the last byte.
class FuzzInput
{
public:
  FuzzInput(const std::uint8_t* data, std::size_t size)
    : Next(data)
    , End(data + size)
  {
  }

  std::size_t Left() const { return static_cast<std::size_t>(this->End - this->Next); }

  template <class T>
  T Take()
  {
    T value{};
    const std::size_t count = std::min(sizeof(T), this->Left());
    std::memcpy(&value, this->Next, count);
    this->Next += count;
    return value;
  }

  bool Flag() { return (this->Take<std::uint8_t>() & 1) != 0; }

  int Integer(int lo, int hi) { return lo + this->Take<std::uint16_t>() % (hi - lo + 1); }

  /// Any number at all, the usual and the most unusual ones often.
  double Number()
  {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double special[] = { 0.0, -0.0, inf, -inf, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<float>::max(), -std::numeric_limits<float>::max(),
      std::numeric_limits<float>::min(), std::numeric_limits<float>::denorm_min(),
      std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
      std::numeric_limits<double>::denorm_min(), std::numeric_limits<float>::epsilon(), 1e-6, 1e6,
      1e9, 1e30, -1e30, 1e-30, 1e300, 32767.0, -32768.0, 16777217.0, 45.0, 90.0, 135.0, 180.0,
      270.0, 315.0, 360.0, 1e-300, -9999.0 };
    const int kind = this->Take<std::uint8_t>();
    if (kind < 128)
    {
      return (kind - 32) / 8.0;
    }
    if (kind < 160)
    {
      return special[kind - 128];
    }
    if (kind < 192)
    {
      return this->Take<std::int16_t>() / 256.0;
    }
    return kind < 224 ? this->Take<float>() : this->Take<double>();
  }

  double Finite(double otherwise = 0.0)
  {
    const double value = this->Number();
    return std::isfinite(value) ? value : otherwise;
  }

  double NonNegative(double otherwise = 0.0) { return std::abs(this->Finite(otherwise)); }

  double Positive(double otherwise = 1.0)
  {
    const double value = this->NonNegative(otherwise);
    return value > 0.0 ? value : otherwise;
  }

  /// A number of limited size, as hosts hand it to the model.
  double Bounded(double largest) { return std::clamp(this->Finite(), -largest, largest); }

  double Share()
  {
    const double value = this->NonNegative();
    return value <= 1.0 ? value : 1.0 / value;
  }

private:
  const std::uint8_t* Next;
  const std::uint8_t* End;
};

/// A file of the given bytes in an empty folder of its own, both gone with the object.
class FuzzFile
{
public:
  FuzzFile(const std::string& extension, const std::uint8_t* data, std::size_t size)
    : Folder(std::filesystem::temp_directory_path() / ("relief-fuzz-" + std::to_string(getpid())))
    , Path(this->Folder / ("input" + extension))
  {
    std::filesystem::create_directories(this->Folder);
    std::ofstream(this->Path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  ~FuzzFile()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }
  FuzzFile(const FuzzFile&) = delete;
  void operator=(const FuzzFile&) = delete;

  std::string Name() const { return this->Path.string(); }

private:
  std::filesystem::path Folder;
  std::filesystem::path Path;
};

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// One of the three offsets; from one byte, of which odd ones are a normal.
inline int AnyOffset(FuzzInput& input)
{
  const int byte = input.Take<std::uint8_t>() % 4;
  return byte == 3 ? 1 : byte;
}

#endif
