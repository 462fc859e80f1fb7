// SPDX-License-Identifier: BSD-3-Clause
#include "CosineTransform.h"

#include "FourierTransform.h"

#include <algorithm>
#include <complex>
#include <memory>

namespace relief
{
namespace
{
using Complex = std::complex<double>;

// The transform itself takes p steps for each number and a prime factor p of the length.
constexpr int LargestPrime = 31;

// Rows that are transformed at once: those of columns share cache lines.
constexpr int LinesAtOnce = 8;
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
    std::vector<Complex> values;
    std::vector<Complex> other;
    std::vector<Complex> padded;
    std::vector<Complex> otherPadded;
  };
  Room MakeRoom() const;

  // Two lines at once, as real and imaginary part; the second may be null.
  void Forward(double* a, double* b, Room& room) const;
  void Backward(double* a, double* b, Room& room) const;

private:
  void Fourier(Room& room, bool backward) const;

  int Length;
  std::vector<Complex> Quarter; // exp(-i pi k / 2N)
  FourierTransform Forth;
  FourierTransform Back;
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
    this->Quarter[k] = std::conj(TurnedBy(k, 2LL * length));
  }
  const bool padded = FourierTransform::LargestPrimeFactor(length) > LargestPrime;
  this->Padded = padded ? FourierTransform::FastLength(2 * length - 1) : 0;
  this->Forth = FourierTransform(padded ? this->Padded : length, false);
  this->Back = FourierTransform(padded ? this->Padded : length, true);
  if (!padded)
  {
    return;
  }
  this->Chirp.resize(static_cast<std::size_t>(length));
  std::vector<Complex>& filter = this->Filter;
  filter.resize(static_cast<std::size_t>(this->Padded));
  for (long long k = 0; k < length; ++k)
  {
    this->Chirp[k] = std::conj(TurnedBy(k * k, length));
    filter[k] = std::conj(this->Chirp[k]);
    filter[k == 0 ? 0 : this->Padded - k] = filter[k];
  }
  std::vector<Complex> other(filter.size());
  this->Forth.Run(filter, other);
  for (Complex& value : filter)
  {
    value /= this->Padded;
  }
}

//------------------------------------------------------------------------------
CosineTransform::Line::Room CosineTransform::Line::MakeRoom() const
{
  Room room;
  room.values.resize(static_cast<std::size_t>(this->Length));
  room.other.resize(static_cast<std::size_t>(this->Length));
  room.padded.resize(static_cast<std::size_t>(this->Padded));
  room.otherPadded.resize(static_cast<std::size_t>(this->Padded));
  return room;
}

//------------------------------------------------------------------------------
void CosineTransform::Line::Fourier(Room& room, bool backward) const
{
  if (this->Padded == 0)
  {
    (backward ? this->Back : this->Forth).Run(room.values, room.other);
    return;
  }
  // The transform back is the one forth of conjugates.
  const auto turned = [backward](const Complex& c) { return backward ? std::conj(c) : c; };
  std::fill(room.padded.begin() + this->Length, room.padded.end(), Complex());
  for (int k = 0; k < this->Length; ++k)
  {
    room.padded[k] = Times(turned(room.values[k]), this->Chirp[k]);
  }
  this->Forth.Run(room.padded, room.otherPadded);
  for (int k = 0; k < this->Padded; ++k)
  {
    room.padded[k] = Times(room.padded[k], this->Filter[k]);
  }
  this->Back.Run(room.padded, room.otherPadded);
  for (int k = 0; k < this->Length; ++k)
  {
    room.values[k] = turned(Times(room.padded[k], this->Chirp[k]));
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
    room.values[at] = Complex(a[k], b ? b[k] : 0.0);
  }
  this->Fourier(room, false);
  for (int k = 0; k < n; ++k)
  {
    const Complex here = room.values[k];
    const Complex mirrored = std::conj(room.values[k == 0 ? 0 : n - k]);
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
    room.values[k] = Times(std::conj(this->Quarter[k]),
      Complex(first.real() - second.imag(), first.imag() + second.real()));
  }
  this->Fourier(room, true);
  for (int k = 0; k < n; ++k)
  {
    const int at = k % 2 == 0 ? k / 2 : n - 1 - k / 2;
    a[k] = room.values[at].real() / n;
    if (b)
    {
      b[k] = room.values[at].imag() / n;
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
