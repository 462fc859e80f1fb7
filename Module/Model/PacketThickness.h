// SPDX-License-Identifier: BSD-3-Clause
#ifndef PacketThickness_h
#define PacketThickness_h

#include "RayThickness.h"

namespace relief
{

/// Illuminates samples as TraceRow() does, neighbouring rays together, each in a lane of a vector:
/// for positional lights, points sunk along the normal, and floors, where rays differ from sample
/// to sample.
///
/// Every ray steps through its own cells; stretches that the bounds show to lie above or below all
/// rays of a packet are taken at once. A packet is anchored to multiples of its width in the row,
/// so results do not depend on which samples are asked for together. Fields without bounds, or of
/// more than 2^31 samples, are traced ray by ray.
void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count);

}

#endif
