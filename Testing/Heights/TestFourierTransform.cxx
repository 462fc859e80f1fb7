// SPDX-License-Identifier: BSD-3-Clause
// FourierTransform: the sums that it stands for, both ways, for lengths with all kinds of factors;
// and CosineTransform, which takes it.
#include "CosineTransform.h"
#include "FourierTransform.h"

#include "ReliefTestUtilities.h"

#include <cmath>
#include <complex>
#include <cstdlib>
#include <random>
#include <vector>

namespace
{
using relief::CosineTransform;
using relief::FourierTransform;
using Complex = FourierTransform::Complex;
constexpr double Pi = 3.14159265358979323846;

int Failures = 0;

void Serial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

std::vector<Complex> MakeNumbers(int count)
{
  std::mt19937 random(static_cast<unsigned int>(count));
  const auto uniform = [&random] { return random() / 2147483648.0 - 1.0; };
  std::vector<Complex> numbers(static_cast<std::size_t>(count));
  for (Complex& number : numbers)
  {
    number = { uniform(), uniform() };
  }
  return numbers;
}

//------------------------------------------------------------------------------
// Against the sums as they are written down.
void TestSums()
{
  std::vector<int> lengths;
  for (int length = 1; length <= 130; ++length)
  {
    lengths.push_back(length);
  }
  lengths.insert(lengths.end(), { 243, 512, 625, 961, 1024, 1080 });
  for (const int length : lengths)
  {
    const std::vector<Complex> numbers = MakeNumbers(length);
    for (const bool backward : { false, true })
    {
      std::vector<Complex> found = numbers;
      std::vector<Complex> room(found.size());
      FourierTransform(length, backward).Run(found, room);
      double worst = 0.0;
      for (int k = 0; k < length; ++k)
      {
        Complex sum;
        for (int n = 0; n < length; ++n)
        {
          const double angle = 2.0 * Pi * (static_cast<long long>(k) * n % length) / length;
          sum += numbers[n] * std::polar(1.0, backward ? angle : -angle);
        }
        worst = std::max(worst, std::abs(sum - found[k]));
      }
      CHECK_NEAR(worst, 0.0, 2e-15 * length + 1e-15);
    }
  }
}

//------------------------------------------------------------------------------
// Forth and back is the length times as much.
void TestBack()
{
  for (const int length : { 1, 2, 4096, 3125, 6561, 30030, 46189, 65536 })
  {
    const std::vector<Complex> numbers = MakeNumbers(length);
    std::vector<Complex> found = numbers;
    std::vector<Complex> room(found.size());
    FourierTransform(length, false).Run(found, room);
    FourierTransform(length, true).Run(found, room);
    double worst = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      worst = std::max(worst, std::abs(found[k] / static_cast<double>(length) - numbers[k]));
    }
    CHECK_NEAR(worst, 0.0, 1e-14);
  }
}

//------------------------------------------------------------------------------
void TestLengths()
{
  CHECK(FourierTransform::LargestPrimeFactor(1) == 1);
  CHECK(FourierTransform::LargestPrimeFactor(97) == 97);
  CHECK(FourierTransform::LargestPrimeFactor(2 * 2 * 3 * 31) == 31);
  CHECK(FourierTransform::LargestPrimeFactor(65536) == 2);
  CHECK(FourierTransform::FastLength(1) == 1);
  CHECK(FourierTransform::FastLength(7) == 8);
  CHECK(FourierTransform::FastLength(2041) == 2048);
  CHECK(FourierTransform::FastLength(121) == 125);
}

//------------------------------------------------------------------------------
// Of one row with every kind of length, large primes among them, and of rectangles there and back.
void TestCosines()
{
  for (const int length : { 1, 2, 3, 7, 37, 64, 74, 101, 120 })
  {
    const std::vector<Complex> numbers = MakeNumbers(length);
    std::vector<double> values;
    for (const Complex& number : numbers)
    {
      values.push_back(number.real());
    }
    std::vector<double> found = values;
    CosineTransform(length, 1).Forward(found, Serial);
    double worst = 0.0;
    for (int k = 0; k < length; ++k)
    {
      double sum = 0.0;
      for (int n = 0; n < length; ++n)
      {
        sum += values[n] * std::cos(Pi * k * (2 * n + 1) / (2.0 * length));
      }
      worst = std::max(worst, std::abs(sum - found[k]));
    }
    CHECK_NEAR(worst, 0.0, 1e-12);
  }
  for (const auto& [columns, rows] : { std::pair{ 96, 60 }, { 1, 41 }, { 37, 53 }, { 128, 1 } })
  {
    std::vector<double> values;
    for (const Complex& number : MakeNumbers(columns * rows))
    {
      values.push_back(number.imag());
    }
    std::vector<double> found = values;
    const CosineTransform transform(columns, rows);
    transform.Forward(found, Serial);
    CHECK(columns * rows == 1 || found != values);
    transform.Backward(found, Serial);
    double worst = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      worst = std::max(worst, std::abs(found[k] - values[k]));
    }
    CHECK_NEAR(worst, 0.0, 1e-13);
  }
}
}

//------------------------------------------------------------------------------
int TestFourierTransform(int, char*[])
{
  TestSums();
  TestBack();
  TestLengths();
  TestCosines();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
