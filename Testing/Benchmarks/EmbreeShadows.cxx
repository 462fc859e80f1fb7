// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeShadows.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>

namespace bench
{

class EmbreeShadows::Internals
{
public:
  const Relief* Heights = nullptr;
  RTCDevice Device = nullptr;
  RTCScene Scene = nullptr;
};

EmbreeShadows::EmbreeShadows(const Relief& relief, Surface surface)
  : Internal(new Internals)
{
  this->Internal->Heights = &relief;
  this->Internal->Device = rtcNewDevice("threads=1");
  if (!this->Internal->Device)
  {
    std::cerr << "Embree gives no device, error " << rtcGetDeviceError(nullptr) << "\n";
    std::exit(EXIT_FAILURE);
  }
  this->Internal->Scene = rtcNewScene(this->Internal->Device);
  RTCGeometry geometry = rtcNewGeometry(
    this->Internal->Device, surface == Grid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto columns = static_cast<std::size_t>(relief.columns);
  const auto rows = static_cast<std::size_t>(relief.rows);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), columns * rows));
  for (std::size_t at = 0; at < columns * rows; ++at)
  {
    vertices[3 * at] = static_cast<float>(static_cast<double>(at % columns) * relief.spacing);
    vertices[3 * at + 1] = static_cast<float>(static_cast<double>(at / columns) * relief.spacing);
    vertices[3 * at + 2] = relief.heights[at];
  }
  if (surface == Grid)
  {
    auto* grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
    grid->startVertexID = 0;
    grid->stride = static_cast<unsigned int>(columns);
    grid->width = static_cast<unsigned short>(columns);
    grid->height = static_cast<unsigned short>(rows);
  }
  else
  {
    auto* triangle =
      static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
        RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), 2 * (columns - 1) * (rows - 1)));
    for (std::size_t j = 0; j + 1 < rows; ++j)
    {
      for (std::size_t i = 0; i + 1 < columns; ++i)
      {
        const auto corner = static_cast<std::uint32_t>(j * columns + i);
        const auto above = static_cast<std::uint32_t>(corner + columns);
        const std::uint32_t both[] = { corner, corner + 1, above, corner + 1, above + 1, above };
        triangle = std::copy(both, both + 6, triangle);
      }
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Internal->Scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->Internal->Scene);
}

EmbreeShadows::~EmbreeShadows()
{
  rtcReleaseScene(this->Internal->Scene);
  rtcReleaseDevice(this->Internal->Device);
}

void EmbreeShadows::Run(const relief::Light& sun, unsigned char* lit) const
{
  constexpr int side = 4;
  const Relief& relief = *this->Internal->Heights;
  // Off the surface, so that rounding does not let a ray meet the cell that it starts on.
  const float lift = static_cast<float>(1.0e-3 * relief.spacing);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRay16 rays;
  alignas(64) int valid[16];
  for (int k = 0; k < 16; ++k)
  {
    rays.dir_x[k] = static_cast<float>(sun.vector.x);
    rays.dir_y[k] = static_cast<float>(sun.vector.y);
    rays.dir_z[k] = static_cast<float>(sun.vector.z);
    rays.time[k] = 0.0f;
    rays.mask[k] = 0xffffffffu;
    rays.flags[k] = 0;
  }
  for (int y = 0; y < relief.rows; y += side)
  {
    for (int x = 0; x < relief.columns; x += side)
    {
      for (int k = 0; k < 16; ++k)
      {
        const int i = x + k % side;
        const int j = y + k / side;
        const bool inside = i < relief.columns && j < relief.rows;
        valid[k] = inside ? -1 : 0;
        const std::size_t at = inside ? static_cast<std::size_t>(j) * relief.columns + i : 0;
        rays.org_x[k] = static_cast<float>(i * relief.spacing);
        rays.org_y[k] = static_cast<float>(j * relief.spacing);
        rays.org_z[k] = relief.heights[at] + lift;
        rays.tnear[k] = 0.0f;
        rays.tfar[k] = std::numeric_limits<float>::infinity();
        rays.id[k] = static_cast<unsigned int>(k);
      }
      rtcOccluded16(valid, this->Internal->Scene, &context, &rays);
      for (int k = 0; k < 16; ++k)
      {
        if (valid[k])
        {
          lit[static_cast<std::size_t>(y + k / side) * relief.columns + x + k % side] =
            rays.tfar[k] >= 0.0f ? 1 : 0;
        }
      }
    }
  }
}

}
