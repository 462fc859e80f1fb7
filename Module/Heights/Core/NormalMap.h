// SPDX-License-Identifier: BSD-3-Clause
#ifndef NormalMap_h
#define NormalMap_h

#include "ParallelFor.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace relief
{

/// How the components of a normal are stored.
enum class NormalEncoding
{
  Automatic, ///< unsigned integers Unsigned, signed ones Signed, fractions by what they hold
  Unsigned,  ///< n = (c - zero) / (largest / 2)
  Signed     ///< n = c / largest
};

/// Where the second component of a normal points to.
enum class GreenAxis
{
  Automatic,
  Up,
  Down
};

/// Stored normals, row by row from the lowest.
template <class T>
struct NormalSource
{
  const T* data = nullptr;
  int columns = 0;
  int rows = 0;
  int components = 3; ///< 3, or 4: the fourth is 0 where there is no data
  NormalEncoding encoding = NormalEncoding::Automatic;
  double zeroCode = -1.0;                 ///< of Unsigned; below 0: half of the largest
  std::function<bool(int, int)> hasData;  ///< may be empty
  std::function<double(int, int)> weight; ///< may be empty; above 0, or the normal is not used
};

/// What sees the surface. Pixels are counted from the middle of the lowest, leftmost one.
struct NormalCamera
{
  bool perspective = false;
  double focalX = 0.0; ///< in pixels
  double focalY = 0.0;
  double centerX = 0.0; ///< where the axis of view meets the image
  double centerY = 0.0;
};

/// Normals of unit length in the frame of the image: x to the right, y up, z to the viewer.
struct NormalMap
{
  int columns = 0;
  int rows = 0;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  std::vector<unsigned char> used;                  ///< 0: no data, or a normal of no use
  std::vector<double> weight;                       ///< empty, or of each sample, the largest 1
  NormalEncoding encoding = NormalEncoding::Signed; ///< as it was read

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->columns + i; }
  std::size_t GetSize() const { return static_cast<std::size_t>(this->columns) * this->rows; }
};

/// The least cosine of the angle between a normal and the ray to the viewer: those seen flatter are
/// of no use, as their slopes are next to infinite.
constexpr double LeastNormalCosine = 1e-3;

/// How much less than the largest a weight may be before it counts as this share of it.
constexpr double LeastNormalWeight = 1e-9;

/// Reads normals, which need not be of unit length. Those that are zero, not finite, without data
/// or weight, or that do not face the viewer of an orthographic view (z at most LeastNormalCosine)
/// are not used. A perspective view leaves the last to FaceCamera().
template <class T>
NormalMap ReadNormals(
  const NormalSource<T>& source, const NormalCamera& camera, const ParallelFor& parallelFor);

/// The cosine's numerator of a normal and the ray to the viewer, in units of the normal's length: z
/// for an orthographic view, z - x a - y b for a perspective one whose ray is (a, b, -1).
double FacingNormal(const NormalMap& map, const NormalCamera& camera, int i, int j);

/// Turns the second component around, if green points down.
void TurnGreen(NormalMap& map);

/// Takes normals out of use that do not face the camera.
void FaceCamera(NormalMap& map, const NormalCamera& camera, const ParallelFor& parallelFor);

/// Which sign of green makes the normals those of a surface: its field of slopes has no curl, the
/// other sign's has twice the mixed derivative. (On integrability: B. K. P. Horn and M. J. Brooks,
/// "The variational approach to shape from shading", CVGIP 33, 1986.) Automatic if
/// the curls are too like each other, as for a plane or for waves along an axis. A spacing is the
/// distance between columns and between rows.
GreenAxis FindGreenAxis(const NormalMap& map, const NormalCamera& camera, const double spacing[2],
  const ParallelFor& parallelFor);

}

#endif
