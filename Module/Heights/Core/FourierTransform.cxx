// SPDX-License-Identifier: BSD-3-Clause
#include "FourierTransform.h"

#include "Angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace relief
{

namespace
{
using Complex = FourierTransform::Complex;

// i c, or -i c.
Complex QuarterTurn(const Complex& c, double sign)
{
  return { -sign * c.imag(), sign * c.real() };
}

// Sums of few numbers, each weighed by a root of 1. In their place.
struct SumsOf2
{
  static constexpr int Factor = 2;
  void operator()(Complex* c) const
  {
    const Complex difference = c[0] - c[1];
    c[0] += c[1];
    c[1] = difference;
  }
};

struct SumsOf3
{
  static constexpr int Factor = 3;
  double sign;
  void operator()(Complex* c) const
  {
    const double sine = 0.86602540378443864676; // of 60 degrees
    const Complex sum = c[1] + c[2];
    const Complex turned = QuarterTurn(sine * (c[1] - c[2]), this->sign);
    const Complex middle = c[0] - 0.5 * sum;
    c[0] += sum;
    c[1] = middle + turned;
    c[2] = middle - turned;
  }
};

struct SumsOf4
{
  static constexpr int Factor = 4;
  double sign;
  void operator()(Complex* c) const
  {
    const Complex even = c[0] + c[2];
    const Complex evenRest = c[0] - c[2];
    const Complex odd = c[1] + c[3];
    const Complex oddRest = QuarterTurn(c[1] - c[3], this->sign);
    c[0] = even + odd;
    c[1] = evenRest + oddRest;
    c[2] = even - odd;
    c[3] = evenRest - oddRest;
  }
};

struct SumsOf5
{
  static constexpr int Factor = 5;
  double sign;
  void operator()(Complex* c) const
  {
    // Cosines and sines of 72 and 144 degrees.
    const double cosines[2] = { 0.30901699437494742410, -0.80901699437494742410 };
    const double sines[2] = { 0.95105651629515357212, 0.58778525229247312917 };
    const Complex outer = c[1] + c[4];
    const Complex inner = c[2] + c[3];
    const Complex outerRest = c[1] - c[4];
    const Complex innerRest = c[2] - c[3];
    const Complex first = c[0] + cosines[0] * outer + cosines[1] * inner;
    const Complex second = c[0] + cosines[1] * outer + cosines[0] * inner;
    const Complex firstTurned =
      QuarterTurn(sines[0] * outerRest + sines[1] * innerRest, this->sign);
    const Complex secondTurned =
      QuarterTurn(sines[1] * outerRest - sines[0] * innerRest, this->sign);
    c[0] += outer + inner;
    c[1] = first + firstTurned;
    c[2] = second + secondTurned;
    c[3] = second - secondTurned;
    c[4] = first - firstTurned;
  }
};
}

//------------------------------------------------------------------------------
std::complex<double> TurnedBy(long long numerator, long long denominator)
{
  const double angle =
    Pi * static_cast<double>(numerator % (2 * denominator)) / static_cast<double>(denominator);
  return { std::cos(angle), std::sin(angle) };
}

//------------------------------------------------------------------------------
FourierTransform::FourierTransform(int length, bool backward)
  : Sign(backward ? 1.0 : -1.0)
{
  int rest = length;
  int stride = 1;
  // Pairs of twos first, which take least.
  for (int factor = 4; rest > 1;)
  {
    if (rest % factor != 0)
    {
      factor = factor == 4 ? 2 : factor == 2 ? 3 : factor + 2;
      continue;
    }
    Step step;
    step.factor = factor;
    step.groups = rest / factor;
    step.stride = stride;
    const auto root = [this](long long k, long long n)
    {
      const Complex turned = TurnedBy(2 * k, n);
      return this->Sign > 0.0 ? turned : std::conj(turned);
    };
    for (int group = 0; group < step.groups; ++group)
    {
      for (int k = 1; k < factor; ++k)
      {
        step.turns.push_back(root(static_cast<long long>(group) * k, rest));
      }
    }
    for (int k = 0; k < factor; ++k)
    {
      step.circle.push_back(root(k, factor));
    }
    this->Steps.push_back(std::move(step));
    rest /= factor;
    stride *= factor;
  }
}

//------------------------------------------------------------------------------
namespace
{
// A step of a factor that sums are written down for.
template <class Sums>
void RunSums(
  const Sums& sums, int groups, int stride, const Complex* turns, const Complex* from, Complex* to)
{
  constexpr int factor = Sums::Factor;
  const std::size_t apart = static_cast<std::size_t>(groups) * static_cast<std::size_t>(stride);
  for (int group = 0; group < groups; ++group, turns += factor - 1)
  {
    const std::size_t first = static_cast<std::size_t>(group) * static_cast<std::size_t>(stride);
    const Complex* begin = from + first;
    Complex* end = to + factor * first;
    for (int i = 0; i < stride; ++i)
    {
      Complex c[factor];
      for (int k = 0; k < factor; ++k)
      {
        c[k] = begin[i + k * apart];
      }
      sums(c);
      end[i] = c[0];
      for (int k = 1; k < factor; ++k)
      {
        end[i + static_cast<std::size_t>(k) * static_cast<std::size_t>(stride)] =
          Times(c[k], turns[k - 1]);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
void FourierTransform::RunStep(const Step& step, const Complex* from, Complex* to) const
{
  const auto run = [&](const auto& sums)
  { RunSums(sums, step.groups, step.stride, step.turns.data(), from, to); };
  const int factor = step.factor;
  switch (factor)
  {
    case 2:
      return run(SumsOf2{});
    case 3:
      return run(SumsOf3{ this->Sign });
    case 4:
      return run(SumsOf4{ this->Sign });
    case 5:
      return run(SumsOf5{ this->Sign });
    default:
      break;
  }
  const std::size_t stride = static_cast<std::size_t>(step.stride);
  const std::size_t apart = static_cast<std::size_t>(step.groups) * stride;
  for (std::size_t group = 0; group < static_cast<std::size_t>(step.groups); ++group)
  {
    const Complex* turns = step.turns.data() + group * (factor - 1);
    for (std::size_t i = 0; i < stride; ++i)
    {
      for (int k = 0; k < factor; ++k)
      {
        Complex sum = from[group * stride + i];
        for (int n = 1; n < factor; ++n)
        {
          sum += Times(from[group * stride + i + n * apart], step.circle[k * n % factor]);
        }
        to[(factor * group + k) * stride + i] = k == 0 ? sum : Times(sum, turns[k - 1]);
      }
    }
  }
}

//------------------------------------------------------------------------------
void FourierTransform::Run(std::vector<Complex>& values, std::vector<Complex>& room) const
{
  for (const Step& step : this->Steps)
  {
    this->RunStep(step, values.data(), room.data());
    values.swap(room);
  }
}

//------------------------------------------------------------------------------
int FourierTransform::LargestPrimeFactor(int length)
{
  int largest = 1;
  for (int p = 2; p <= length / p; ++p)
  {
    while (length % p == 0)
    {
      largest = p;
      length /= p;
    }
  }
  return std::max(largest, length);
}

//------------------------------------------------------------------------------
int FourierTransform::FastLength(int length)
{
  while (LargestPrimeFactor(length) > 5)
  {
    ++length;
  }
  return length;
}

}
