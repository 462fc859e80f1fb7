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
/// so results do not depend on which samples are asked for together; where a request names its
/// columns, packets are made of these in turn. Fields without bounds, or of more than 2^31 samples,
/// are traced ray by ray.
void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count);

/// Illuminates the rows of a tile as TracePackets() does. Where its rays run nearly the same way,
/// all of them step through the field together, as far as they are in the same few rows of cells.
/// A tile is SweepThickness::TileWidth samples wide and TileHeight high, or as much of it as is in
/// the image, and is anchored to multiples of these.
void TracePacketTile(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>* requests, int rows, RayCount& count);

}

#endif
