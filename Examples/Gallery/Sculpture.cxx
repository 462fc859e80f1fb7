// SPDX-License-Identifier: BSD-3-Clause
#include "Sculpture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpture
{

namespace
{

constexpr double Pi = 3.14159265358979323846;

struct Vec
{
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

Vec operator-(Vec a, Vec b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

Vec operator*(double s, Vec a)
{
  return { s * a.x, s * a.y, s * a.z };
}

double Dot(Vec a, Vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

double Length(Vec a)
{
  return std::sqrt(Dot(a, a));
}

// Turned by an angle, counterclockwise as the viewer sees it.
Vec Turn(Vec p, double angle)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return { c * p.x - s * p.y, s * p.x + c * p.y, p.z };
}

double Smooth(double from, double to, double x)
{
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The union of two bodies, with a fillet of about the width k.
double Blend(double a, double b, double k)
{
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * h * h * k;
}

// What is left of a body when another is cut out of it.
double Carve(double a, double cut, double k)
{
  return -Blend(-a, cut, k);
}

// First-order distance: exact near the surface of what is nearly round, less elsewhere.
double Ellipsoid(Vec p, Vec center, Vec radii)
{
  const Vec d = p - center;
  const Vec n{ d.x / radii.x, d.y / radii.y, d.z / radii.z };
  const double k0 = Length(n);
  const double k1 = Length({ n.x / radii.x, n.y / radii.y, n.z / radii.z });
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({ radii.x, radii.y, radii.z });
}

// A rod from a to b whose radius goes from ra to rb.
double Cone(Vec p, Vec a, Vec b, double ra, double rb)
{
  const Vec way = b - a;
  const double t = std::clamp(Dot(p - a, way) / Dot(way, way), 0.0, 1.0);
  return Length(p - a - t * way) - (ra + t * (rb - ra));
}

// Cheap waves that do not repeat soon, in [-1, 1].
double Grain(double x, double y)
{
  return (std::sin(x + 1.7 * std::sin(0.63 * y)) + std::sin(1.618 * x - 0.8 * y + 2.0) +
           std::sin(2.3 * x + 0.41 * y + std::sin(0.3 * x))) /
    3.0;
}

// Rows of feathers that hang down, upper ones over lower ones: how thick they are at a place, in
// [0, 1]. Feathers are 1 wide, and rows 1 apart.
double Feathers(double u, double v)
{
  constexpr double Hang = 2.1; // how long a feather is, in rows
  const double top = std::ceil(v + Hang);
  for (double row = top; row > v; row -= 1.0)
  {
    const double shift = std::fmod(std::abs(row), 2.0) < 0.5 ? 0.0 : 0.5;
    const double a = u - shift - std::round(u - shift);
    const double t = (row - v) / Hang;
    const double tip = 1.0 - 1.6 * a * a;
    if (t <= tip)
    {
      const double rim = Smooth(0.0, 0.12, tip - t);
      const double shaft = 0.18 * std::exp(-a * a / 0.0018);
      const double barbs = 0.07 * std::sin(46.0 * (t * 0.8 + std::abs(a)));
      return (0.35 + 0.65 * t) * (0.55 + 0.45 * rim) * (1.0 - 1.2 * a * a) + shaft * rim +
        barbs * rim;
    }
  }
  return 0.0;
}

//------------------------------------------------------------------------------
class Owl
{
public:
  explicit Owl(double detail)
    : Detail(detail)
  {
  }

  double Distance(Vec p) const
  {
    const double owl = std::min({ this->Bird(p), this->Feet(p), this->Branch(p) });
    return owl;
  }

private:
  // What lies in the left half is mirrored.
  static Vec Side(Vec p) { return { std::abs(p.x), p.y, p.z }; }

  double Bird(Vec p) const
  {
    const Vec s = Side(p);
    double body = Blend(this->Torso(p, s), this->Head(p, s), 0.1);
    body = std::min(body, this->Wing(s));
    return std::min({ body, this->Tail(p), this->Eyes(s), this->Beak(p) });
  }

  double Torso(Vec p, Vec s) const
  {
    double d = Ellipsoid(p, { 0.0, -0.24, 0.0 }, { 0.50, 0.66, 0.42 });
    d = Blend(d, Ellipsoid(s, { 0.2, -0.72, 0.12 }, { 0.2, 0.2, 0.22 }), 0.12); // thighs
    if (d < 0.08)
    {
      const double curve = 0.9 * p.x * p.x; // rows sag in the middle of the breast
      const double fade = Smooth(0.30, 0.05, p.y);
      d -= this->Detail * 0.028 * fade * Feathers(p.x / 0.115, (p.y - curve) / 0.078);
    }
    return d;
  }

  double Head(Vec p, Vec s) const
  {
    double d = Ellipsoid(p, { 0.0, 0.5, 0.06 }, { 0.47, 0.37, 0.35 });
    d = Blend(d, Ellipsoid(p, { 0.0, 0.66, 0.04 }, { 0.36, 0.27, 0.3 }), 0.1);
    const double tuft = Blend(Cone(s, { 0.24, 0.74, 0.12 }, { 0.43, 1.03, 0.08 }, 0.12, 0.018),
      Cone(s, { 0.20, 0.74, 0.14 }, { 0.37, 0.97, 0.14 }, 0.09, 0.015), 0.03);
    d = Blend(d, tuft, 0.07);
    d = this->Face(d, p, s);
    // Brows run from the beak to the tufts.
    const double brow = Blend(Cone(s, { 0.03, 0.51, 0.43 }, { 0.2, 0.70, 0.40 }, 0.032, 0.05),
      Cone(s, { 0.2, 0.70, 0.40 }, { 0.41, 0.95, 0.15 }, 0.05, 0.022), 0.05);
    const double across = 0.76 * (s.x - 0.03) - 0.65 * (s.y - 0.51);
    const double furrows = brow < 0.05
      ? 0.0045 * this->Detail * std::sin(150.0 * across + 9.0 * std::sin(14.0 * (s.x + s.y)))
      : 0.0;
    return Blend(d, brow - furrows, 0.03);
  }

  // The discs around the eyes: dishes with a raised rim and rays.
  double Face(double d, Vec p, Vec s) const
  {
    const double x = s.x - 0.2;
    const double y = s.y - 0.5;
    const double r = std::sqrt(x * x + 1.1 * y * y);
    if (d > 0.15 || p.z < 0.0)
    {
      return d;
    }
    const double angle = std::atan2(y, x);
    const double dish = 0.075 * (1.0 - Smooth(0.05, 0.235, r));
    const double rim = 0.035 * std::exp(-(r - 0.255) * (r - 0.255) / 0.0007);
    const double rays = std::sin(34.0 * angle + 5.0 * std::sin(9.0 * r)) * Smooth(0.09, 0.14, r) *
      Smooth(0.25, 0.22, r);
    const double nicks = std::exp(-(r - 0.255) * (r - 0.255) / 0.0007) * std::sin(40.0 * angle);
    double plumes = 0.0;
    if (r > 0.28)
    {
      plumes = Smooth(0.28, 0.31, r) * Feathers(p.x / 0.075, (p.y - 0.3 * p.x * p.x) / 0.055);
    }
    return d + dish - rim - this->Detail * (0.009 * rays + 0.006 * nicks + 0.016 * plumes);
  }

  double Eyes(Vec s) const
  {
    const Vec center{ 0.195, 0.505, 0.315 };
    double eye = Length(s - center) - 0.1;
    const double r = std::hypot(s.x - center.x, s.y - center.y);
    // An iris that is set off by a groove, and a drilled pupil.
    eye += 0.010 * std::exp(-(r - 0.066) * (r - 0.066) / 0.00006);
    eye = Carve(eye, Length(s - Vec{ 0.195, 0.505, 0.425 }) - 0.042, 0.01);
    const double lid = std::abs(Length(s - center) - 0.108) - 0.014;
    const double above = (s.y - 0.545) - 0.35 * (s.x - 0.195);
    return std::min(eye, Carve(lid, above, 0.01));
  }

  double Beak(Vec p) const
  {
    const double base = Cone(p, { 0.0, 0.47, 0.40 }, { 0.0, 0.37, 0.47 }, 0.062, 0.05);
    const double hook = Cone(p, { 0.0, 0.37, 0.47 }, { 0.0, 0.27, 0.425 }, 0.05, 0.012);
    const double beak = Blend(base, hook, 0.04);
    const double nostril = Length(Side(p) - Vec{ 0.038, 0.43, 0.465 }) - 0.014;
    return Carve(beak, nostril, 0.01);
  }

  double Wing(Vec s) const
  {
    const Vec q = Turn(s - Vec{ 0.47, -0.26, 0.03 }, -0.13);
    double d = Ellipsoid(q, {}, { 0.155, 0.62, 0.30 });
    d = Blend(d, Ellipsoid(q, { -0.02, 0.32, 0.02 }, { 0.15, 0.25, 0.29 }), 0.08); // shoulder
    if (d > 0.08)
    {
      return d;
    }
    const double coverts = Smooth(-0.10, 0.0, q.y);
    const double small = Feathers(q.x / 0.085, q.y / 0.062);
    const double pinion = Feathers((q.x + 0.08 * q.y) / 0.088, (q.y + 0.03) / 0.15);
    return d - this->Detail * (0.026 * coverts * small + 0.030 * (1.0 - coverts) * pinion);
  }

  double Tail(Vec p) const
  {
    double d = Ellipsoid(p, { 0.0, -0.97, -0.1 }, { 0.21, 0.31, 0.13 });
    if (d < 0.05)
    {
      d -= this->Detail * 0.025 * Feathers(p.x / 0.12 + 0.5, (p.y + 0.6) / 0.2);
    }
    return d;
  }

  double Feet(Vec p) const
  {
    const Vec s = Side(p);
    double d = 1e9;
    for (int toe = -1; toe <= 1; ++toe)
    {
      const double x = 0.21 + 0.085 * toe;
      const Vec root{ 0.21 + 0.03 * toe, -0.79, 0.23 };
      const Vec knuckle{ x, -0.835, 0.315 };
      const Vec tip{ x + 0.012 * toe, -0.925, 0.30 };
      const Vec claw{ x + 0.014 * toe, -1.0, 0.235 };
      double one =
        Blend(Cone(s, root, knuckle, 0.045, 0.042), Cone(s, knuckle, tip, 0.042, 0.03), 0.02);
      one += one < 0.05 ? this->Detail * 0.0022 * std::sin(210.0 * s.y) : 0.0;
      d = std::min(d, std::min(one, Cone(s, tip, claw, 0.024, 0.005)));
    }
    return d;
  }

  double Branch(Vec p) const
  {
    const double lift = 0.06 * std::sin(2.2 * p.x) + 0.05 * p.x;
    const Vec q{ p.x, p.y + 0.93 - lift, p.z - 0.12 };
    const double radius = 0.10 - 0.02 * p.x;
    double d = std::hypot(q.y, q.z) - radius;
    const Vec twig{ 0.5, -0.86, 0.13 };
    d = Blend(d, Cone(p, twig, { 0.76, -0.66, 0.16 }, 0.05, 0.022), 0.06);
    const double knot = std::hypot(p.x + 0.66, q.y - 0.01);
    if (d < 0.06)
    {
      const double around = std::atan2(q.y, q.z);
      const double bark = Grain(9.0 * p.x + 2.0 * std::sin(3.0 * around), 13.0 * around) +
        0.6 * Grain(31.0 * p.x, 37.0 * around);
      d -= this->Detail * 0.010 * bark * Smooth(0.05, 0.10, knot);
      d -= 0.022 * std::exp(-(knot - 0.06) * (knot - 0.06) / 0.0004) -
        0.02 * std::exp(-knot * knot / 0.0009);
    }
    d *= 0.8;
    d = std::min(d, this->Leaf(p, { 0.75, -0.67, 0.17 }, 1.0));
    return std::min(d, this->Leaf(p, { 0.66, -0.74, 0.2 }, -0.05));
  }

  double Leaf(Vec p, Vec root, double angle) const
  {
    const Vec q = Turn(p - root, -angle);
    const double length = 0.30;
    const double t = std::clamp(q.x / length, 0.0, 1.0);
    const double half = 0.085 * std::sin(Pi * std::pow(t, 0.8)) + 0.004;
    const double outline = std::max({ std::abs(q.y) - half, -q.x, q.x - length });
    const double veins = std::abs(std::sin(55.0 * (q.x - 0.6 * std::abs(q.y))));
    const double fold = 0.35 * std::abs(q.y) + 0.25 * q.x * q.x * 3.0 -
      0.006 * veins * this->Detail + 0.008 * std::exp(-q.y * q.y / 0.00004);
    return 0.6 * std::max(outline, std::abs(q.z - fold) - 0.012);
  }

  double Detail;
};

//------------------------------------------------------------------------------
// The largest z at which a body is met; NaN if there is none.
template <class Body>
float Trace(const Body& body, double x, double y, double front, double back)
{
  double z = front;
  double before = front;
  for (int step = 0; step < 400 && z > back; ++step)
  {
    const double d = body.Distance({ x, y, z });
    if (d < 5e-5)
    {
      // Carved surfaces may have been overrun.
      double inside = z;
      double outside = before;
      for (int n = 0; n < 24 && d < 0.0; ++n)
      {
        const double middle = 0.5 * (inside + outside);
        (body.Distance({ x, y, middle }) < 0.0 ? inside : outside) = middle;
      }
      return static_cast<float>(d < 0.0 ? outside : z);
    }
    before = z;
    z -= std::max(0.6 * d, 1e-4);
  }
  return std::numeric_limits<float>::quiet_NaN();
}
}

//------------------------------------------------------------------------------
HeightImage CarveOwl(int size, double detail)
{
  HeightImage image;
  image.columns = std::max(size, 1);
  image.rows = std::max(static_cast<int>(std::lround(1.2 * image.columns)), 1);
  image.spacing = 2.0 / image.columns;
  image.heights.resize(static_cast<std::size_t>(image.columns) * image.rows);
  const Owl owl(detail);
  for (int j = 0; j < image.rows; ++j)
  {
    for (int i = 0; i < image.columns; ++i)
    {
      const double x = (i + 0.5) * image.spacing - 1.0;
      const double y = (j + 0.5 - 0.5 * image.rows) * image.spacing - 0.12;
      image.heights[image.At(i, j)] = Trace(owl, x, y, 0.7, -0.5);
    }
  }
  return image;
}

//------------------------------------------------------------------------------
HeightImage StrikeRosette(int size)
{
  HeightImage image;
  image.columns = std::max(size, 1);
  image.rows = image.columns;
  image.spacing = 2.0 / image.columns;
  image.heights.resize(static_cast<std::size_t>(image.columns) * image.rows);
  const auto bump = [](double x, double width) { return std::exp(-x * x / (width * width)); };
  // A petal that points outward: a leaf with a keel and a rolled edge.
  const auto petal = [&](double r, double angle, double from, double to, double half)
  {
    const double t = (r - from) / (to - from);
    const double width =
      half * std::sqrt(std::max(std::sin(Pi * std::clamp(t, 0.0, 1.0)), 0.0)) * (0.55 + 0.6 * t);
    const double side = width > 1e-6 ? std::abs(angle) * r / width : 2.0;
    return t < 0.0 || t > 1.0 || side > 1.0
      ? 0.0
      : (0.55 + 0.45 * t) * (0.7 + 0.3 * side * side) * Smooth(1.0, 0.86, side) +
        0.12 * bump(side, 0.12);
  };
  for (int j = 0; j < image.rows; ++j)
  {
    for (int i = 0; i < image.columns; ++i)
    {
      const double x = (i + 0.5) * image.spacing - 1.0;
      const double y = (j + 0.5) * image.spacing - 1.0;
      const double r = std::hypot(x, y);
      const double angle = std::atan2(y, x);
      float& height = image.heights[image.At(i, j)];
      if (r > 0.98)
      {
        height = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const auto fold = [angle](double count, double shift)
      {
        const double a = angle * count / (2.0 * Pi) + shift;
        return (a - std::round(a)) * 2.0 * Pi / count;
      };
      double z = 0.02 * (1.0 - r * r);
      z += 0.16 * Smooth(0.86, 0.90, r) * Smooth(0.985, 0.95, r);
      z += 0.06 * bump(r - 0.72, 0.012);
      const double bead = std::hypot(r - 0.79, fold(64.0, 0.0) * 0.79);
      z += std::sqrt(std::max(0.033 * 0.033 - bead * bead, 0.0));
      z = std::max(z, 0.17 * petal(r, fold(12.0, 0.5), 0.12, 0.68, 0.16));
      z = std::max(z, 0.30 * petal(r, fold(12.0, 0.0), 0.10, 0.56, 0.13));
      z = std::max(z, 0.40 * petal(r, fold(12.0, 0.5), 0.04, 0.36, 0.085));
      if (r < 0.12)
      {
        const double seeds = 0.012 * std::cos(90.0 * r) * std::cos(12.0 * angle);
        z = std::max(z, 0.30 + 0.16 * (1.0 - r * r / 0.0144) + seeds);
      }
      height = static_cast<float>(z);
    }
  }
  return image;
}

}
