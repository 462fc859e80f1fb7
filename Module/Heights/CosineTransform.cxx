// SPDX-License-Identifier: BSD-3-Clause
#include "CosineTransform.h"

#include "vtk_kissfft.h"
// clang-format off
#include VTK_KISSFFT_HEADER(kiss_fft.h)
// clang-format on

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <memory>
#include <new>

namespace relief
{
namespace
{
using Complex = std::complex<double>;
static_assert(sizeof(kiss_fft_cpx) == sizeof(Complex), "the library is to compute with double");

// The library's own transform of a length p takes p^2 steps for a prime p.
constexpr int LargestPrime = 31;

// Rows that are transformed at once: those of columns share cache lines.
constexpr int LinesAtOnce = 8;

int LargestPrimeFactor(int n)
{
  int largest = 1;
  for (int p = 2; p <= n / p; ++p)
  {
    while (n % p == 0)
    {
      largest = p;
      n /= p;
    }
  }
  return std::max(largest, n);
}

// exp(i pi numerator / denominator), exact to the last digits for large numerators.
Complex Turn(long long numerator, long long denominator)
{
  const double pi = 3.14159265358979323846;
  const double angle =
    pi * static_cast<double>(numerator % (2 * denominator)) / static_cast<double>(denominator);
  return { std::cos(angle), std::sin(angle) };
}

// std::complex asks each product whether it is NaN.
Complex Times(const Complex& a, const Complex& b)
{
  return { a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real() };
}

struct Free
{
  void operator()(void* memory) const { std::free(memory); }
};
using Plan = std::unique_ptr<kiss_fft_state, Free>;

Plan MakePlan(int length, bool backward)
{
  Plan plan(kiss_fft_alloc(length, backward, nullptr, nullptr));
  if (!plan)
  {
    throw std::bad_alloc();
  }
  return plan;
}

void Run(const Plan& plan, const Complex* from, Complex* to)
{
  // A std::complex is laid out as two numbers.
  kiss_fft(
    plan.get(), reinterpret_cast<const kiss_fft_cpx*>(from), reinterpret_cast<kiss_fft_cpx*>(to));
}
}

//------------------------------------------------------------------------------
// Transforms of one length.
class CosineTransform::Line
{
public:
  explicit Line(int length);

  // Room that a thread needs.
  struct Room
  {
    std::vector<Complex> from;
    std::vector<Complex> to;
    std::vector<Complex> padded;
    std::vector<Complex> product;
  };
  Room MakeRoom() const;

  // Two lines at once, as real and imaginary part; the second may be null.
  void Forward(double* a, double* b, Room& room) const;
  void Backward(double* a, double* b, Room& room) const;

private:
  void Fourier(Room& room, bool backward) const;

  int Length;
  std::vector<Complex> Quarter; // exp(-i pi k / 2N)
  Plan Forth;
  Plan Back;
  // By convolution only.
  int Padded = 0;
  std::vector<Complex> Chirp;
  std::vector<Complex> Filter;
};

//------------------------------------------------------------------------------
CosineTransform::Line::Line(int length)
  : Length(length)
  , Quarter(static_cast<std::size_t>(length))
{
  for (int k = 0; k < length; ++k)
  {
    this->Quarter[k] = std::conj(Turn(k, 2LL * length));
  }
  if (LargestPrimeFactor(length) <= LargestPrime)
  {
    this->Forth = MakePlan(length, false);
    this->Back = MakePlan(length, true);
    return;
  }
  this->Padded = kiss_fft_next_fast_size(2 * length - 1);
  this->Forth = MakePlan(this->Padded, false);
  this->Back = MakePlan(this->Padded, true);
  this->Chirp.resize(static_cast<std::size_t>(length));
  std::vector<Complex> filter(static_cast<std::size_t>(this->Padded));
  for (long long k = 0; k < length; ++k)
  {
    this->Chirp[k] = std::conj(Turn(k * k, length));
    filter[k] = std::conj(this->Chirp[k]);
    filter[k == 0 ? 0 : this->Padded - k] = filter[k];
  }
  this->Filter.resize(filter.size());
  Run(this->Forth, filter.data(), this->Filter.data());
  for (Complex& value : this->Filter)
  {
    value /= this->Padded;
  }
}

//------------------------------------------------------------------------------
CosineTransform::Line::Room CosineTransform::Line::MakeRoom() const
{
  Room room;
  room.from.resize(static_cast<std::size_t>(this->Length));
  room.to.resize(static_cast<std::size_t>(this->Length));
  room.padded.resize(static_cast<std::size_t>(this->Padded));
  room.product.resize(static_cast<std::size_t>(this->Padded));
  return room;
}

//------------------------------------------------------------------------------
void CosineTransform::Line::Fourier(Room& room, bool backward) const
{
  if (this->Padded == 0)
  {
    Run(backward ? this->Back : this->Forth, room.from.data(), room.to.data());
    return;
  }
  // The transform back is the one forth of conjugates.
  const auto turned = [backward](const Complex& c) { return backward ? std::conj(c) : c; };
  std::fill(room.padded.begin() + this->Length, room.padded.end(), Complex());
  for (int k = 0; k < this->Length; ++k)
  {
    room.padded[k] = Times(turned(room.from[k]), this->Chirp[k]);
  }
  Run(this->Forth, room.padded.data(), room.product.data());
  for (int k = 0; k < this->Padded; ++k)
  {
    room.product[k] = Times(room.product[k], this->Filter[k]);
  }
  Run(this->Back, room.product.data(), room.padded.data());
  for (int k = 0; k < this->Length; ++k)
  {
    room.to[k] = turned(Times(room.padded[k], this->Chirp[k]));
  }
}

//------------------------------------------------------------------------------
void CosineTransform::Line::Forward(double* a, double* b, Room& room) const
{
  const int n = this->Length;
  if (n == 1)
  {
    return;
  }
  for (int k = 0; k < n; ++k)
  {
    // Even places forth, odd ones back.
    const int at = k % 2 == 0 ? k / 2 : n - 1 - k / 2;
    room.from[at] = Complex(a[k], b ? b[k] : 0.0);
  }
  this->Fourier(room, false);
  for (int k = 0; k < n; ++k)
  {
    const Complex here = room.to[k];
    const Complex mirrored = std::conj(room.to[k == 0 ? 0 : n - k]);
    const Complex first = 0.5 * (here + mirrored);
    const Complex second(0.5 * (here - mirrored).imag(), -0.5 * (here - mirrored).real());
    a[k] = Times(this->Quarter[k], first).real();
    if (b)
    {
      b[k] = Times(this->Quarter[k], second).real();
    }
  }
}

//------------------------------------------------------------------------------
void CosineTransform::Line::Backward(double* a, double* b, Room& room) const
{
  const int n = this->Length;
  if (n == 1)
  {
    return;
  }
  for (int k = 0; k < n; ++k)
  {
    const Complex first(a[k], k == 0 ? 0.0 : -a[n - k]);
    const Complex second = b ? Complex(b[k], k == 0 ? 0.0 : -b[n - k]) : Complex();
    room.from[k] = Times(std::conj(this->Quarter[k]),
      Complex(first.real() - second.imag(), first.imag() + second.real()));
  }
  this->Fourier(room, true);
  for (int k = 0; k < n; ++k)
  {
    const int at = k % 2 == 0 ? k / 2 : n - 1 - k / 2;
    a[k] = room.to[at].real() / n;
    if (b)
    {
      b[k] = room.to[at].imag() / n;
    }
  }
}

//------------------------------------------------------------------------------
CosineTransform::CosineTransform(int columns, int rows)
  : Columns(columns)
  , Rows(rows)
  , AlongX(std::make_unique<Line>(columns))
  , AlongY(std::make_unique<Line>(rows))
{
}

//------------------------------------------------------------------------------
CosineTransform::~CosineTransform() = default;

//------------------------------------------------------------------------------
void CosineTransform::Forward(std::vector<double>& values, const ParallelFor& parallelFor) const
{
  this->Transform(values, false, parallelFor);
}

//------------------------------------------------------------------------------
void CosineTransform::Backward(std::vector<double>& values, const ParallelFor& parallelFor) const
{
  this->Transform(values, true, parallelFor);
}

//------------------------------------------------------------------------------
void CosineTransform::Transform(
  std::vector<double>& values, bool backward, const ParallelFor& parallelFor) const
{
  const auto transform = [backward](const Line& line, double* a, double* b, Line::Room& room)
  { backward ? line.Backward(a, b, room) : line.Forward(a, b, room); };
  const auto columns = static_cast<std::size_t>(this->Columns);
  parallelFor((this->Rows + 1) / 2,
    [&](int begin, int end)
    {
      Line::Room room = this->AlongX->MakeRoom();
      for (int pair = begin; pair < end; ++pair)
      {
        double* a = values.data() + 2 * pair * columns;
        transform(*this->AlongX, a, 2 * pair + 1 < this->Rows ? a + columns : nullptr, room);
      }
    });
  parallelFor((this->Columns + LinesAtOnce - 1) / LinesAtOnce,
    [&](int begin, int end)
    {
      Line::Room room = this->AlongY->MakeRoom();
      const auto rows = static_cast<std::size_t>(this->Rows);
      std::vector<double> lines(LinesAtOnce * rows);
      for (int group = begin; group < end; ++group)
      {
        const int first = group * LinesAtOnce;
        const int count = std::min(LinesAtOnce, this->Columns - first);
        for (std::size_t j = 0; j < rows; ++j)
        {
          for (int line = 0; line < count; ++line)
          {
            lines[line * rows + j] = values[j * columns + first + line];
          }
        }
        for (int line = 0; line < count; line += 2)
        {
          double* a = lines.data() + line * rows;
          transform(*this->AlongY, a, line + 1 < count ? a + rows : nullptr, room);
        }
        for (std::size_t j = 0; j < rows; ++j)
        {
          for (int line = 0; line < count; ++line)
          {
            values[j * columns + first + line] = lines[line * rows + j];
          }
        }
      }
    });
}

}
