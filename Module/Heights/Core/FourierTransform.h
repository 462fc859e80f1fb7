// SPDX-License-Identifier: BSD-3-Clause
#ifndef FourierTransform_h
#define FourierTransform_h

#include <complex>
#include <vector>

namespace relief
{

/// The product of complex numbers. That of std::complex asks each time whether it is NaN.
inline std::complex<double> Times(const std::complex<double>& a, const std::complex<double>& b)
{
  return { a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real() };
}

/// exp(i pi numerator / denominator), exact to the last digits for large numerators.
std::complex<double> TurnedBy(long long numerator, long long denominator);

/// Fourier transforms of one length, forth or back, a step for each of the length's factors, none
/// of which sorts its numbers. (J. W. Cooley and J. W. Tukey, "An algorithm for the machine
/// calculation of complex Fourier series", Mathematics of Computation 19, 1965; T. G. Stockham,
/// "High-speed convolution and correlation", Spring Joint Computer Conference 1966.) A prime factor
/// p takes p steps for each number.
class FourierTransform
{
public:
  using Complex = std::complex<double>;

  FourierTransform() = default;

  /// @param length    at least 1
  FourierTransform(int length, bool backward);

  /// values[k] = sum of values[n] exp(-2 pi i k n / length), backward with i for -i. `room` has as
  /// many elements as `values`, which mean nothing before and after.
  void Run(std::vector<Complex>& values, std::vector<Complex>& room) const;

  /// The largest prime factor of a length.
  static int LargestPrimeFactor(int length);

  /// The least number from `length` on that has no prime factor above 5.
  static int FastLength(int length);

private:
  struct Step
  {
    int factor;                  // how many numbers each number becomes a sum of
    int groups;                  // of so many numbers: length / factor / stride
    int stride;                  // numbers side by side that are treated alike
    std::vector<Complex> turns;  // of sum k of a group: at group * (factor - 1) + k - 1
    std::vector<Complex> circle; // the factor-th roots of 1
  };

  void RunStep(const Step& step, const Complex* from, Complex* to) const;

  double Sign = -1.0; // of i
  std::vector<Step> Steps;
};

}

#endif
