// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepContact_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepContact_inl_h
#undef SweepContact_inl_h
#else
#define SweepContact_inl_h
#endif

#include "SweepBeyond-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// What a light and a medium are to all contacts.
class Contacts
{
public:
  explicit Contacts(const SweepThickness::Plan& plan)
    : Tangent(plan.medium.offset == f32::RELIEF_TANGENT_PLANE)
    , UseFloor(plan.medium.useFloor)
    , Floor(plan.medium.floorHeight)
    , AlongX(std::abs(plan.dx))
    , AlongY(std::abs(plan.dy))
    , AlongZ(plan.dz)
    , AcrossX(0.5f / static_cast<float>(plan.field->GetField().heights.spacingX))
    , AcrossY(0.5f / static_cast<float>(plan.field->GetField().heights.spacingY))
  {
  }

  // How far below its sample a point lies that is sunk by a unit.
  HWY_INLINE Vector SinkOf(Tag tag, Vector west, Vector east, Vector south, Vector north) const
  {
    const Vector one = hn::Set(tag, 1.0f);
    return this->Tangent
      ? lanes::reliefTangentSink(one, hn::Mul(hn::Sub(east, west), hn::Set(tag, this->AcrossX)),
          hn::Mul(hn::Sub(north, south), hn::Set(tag, this->AcrossY)))
      : one;
  }

  // d of rays from that far below the plane through their samples and the two neighbors between
  // which they leave these: what reliefContact() finds where there are data all about.
  HWY_INLINE Vector WithPlane(
    Tag tag, Vector base, Vector besideX, Vector besideY, Vector sink) const
  {
    const Vector zero = hn::Zero(tag);
    const Vector one = hn::Set(tag, 1.0f);
    const Vector rise = hn::Set(tag, this->AlongZ);
    const Vector climb = hn::Add(hn::Mul(hn::Sub(besideX, base), hn::Set(tag, this->AlongX)),
      hn::Mul(hn::Sub(besideY, base), hn::Set(tag, this->AlongY)));
    const Vector fall = hn::Sub(rise, climb);
    Vector thickness = hn::Div(sink, fall);
    Mask covered = hn::Lt(one, zero);
    if (this->UseFloor)
    {
      // A floor above the sample lies above all that is near; one as high hides what is below.
      const Vector floor = hn::Set(tag, this->Floor);
      const Mask level = hn::Eq(floor, base);
      covered = this->AlongZ > 0.0f ? hn::Gt(floor, base) : hn::Ge(floor, base);
      thickness = hn::Sub(thickness, hn::IfThenElseZero(level, hn::Div(sink, rise)));
    }
    const Vector open = hn::IfThenElse(hn::Gt(thickness, one), hn::Div(one, thickness), one);
    return hn::IfThenElse(covered, one, hn::IfThenElse(hn::Le(fall, zero), zero, open));
  }

private:
  bool Tangent;
  bool UseFloor;
  float Floor;
  float AlongX; // samples for a unit of length
  float AlongY;
  float AlongZ;
  float AcrossX; // slope for what two neighbors differ by
  float AcrossY;
};

// d of single samples beside the border and holes, where the ground goes on one way or the
// other.
void IlluminateBare(
  const SweepThickness::Plan& plan, int x, int y, const float* base, Mask bare, float* d)
{
  const Tag tag;
  const Field<float>& field = plan.field->GetField();
  const glm::vec3 normal(0.0f, 0.0f, 1.0f);
  const glm::vec3 light(plan.dx * static_cast<float>(field.heights.spacingX),
    plan.dy * static_cast<float>(field.heights.spacingY), plan.dz);
  HWY_ALIGN float chosen[MaxLanes];
  hn::Store(hn::IfThenElseZero(bare, hn::Set(tag, 1.0f)), tag, chosen);
  for (int k = 0; k < static_cast<int>(hn::Lanes(tag)); ++k)
  {
    if (chosen[k] != 0.0f)
    {
      const f32::ReliefRay ray = RayFrom(plan, x + k, y, base[k], 0.0f);
      d[k] = f32::reliefContact(field, plan.medium, ray, normal, light);
    }
  }
}

// d of a tile at depth 0 by the reciprocal attenuation: its limit where a ray meets nothing, which
// is known by the heights next to the sample, and 0 behind any thickness at all.
void IlluminateContacts(
  const SweepThickness::Plan& plan, int x0, int y0, const float* thickness, float* d)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Vector zero = hn::Zero(tag);
  const Rows rows = RowsOf(plan);
  const Contacts contacts(plan);
  const bool westward = plan.dx < 0.0f;
  const bool southward = plan.dy < 0.0f;
  for (int at = 0; at < SweepThickness::TileSize; at += lanes)
  {
    const int x = x0 + at % SweepThickness::TileWidth;
    const int y = y0 + at / SweepThickness::TileWidth;
    const float* own = rows(y) + x;
    const Vector base = hn::LoadU(tag, own);
    const Mask lit = hn::AndNot(hn::IsNaN(base), hn::Eq(hn::Load(tag, thickness + at), zero));
    if (hn::AllFalse(tag, lit))
    {
      hn::StoreU(zero, tag, d + at);
      continue;
    }
    const float* southRow = rows(y - 1) + x;
    const float* northRow = rows(y + 1) + x;
    const Vector west = hn::LoadU(tag, own - 1);
    const Vector east = hn::LoadU(tag, own + 1);
    const Vector south = hn::LoadU(tag, southRow);
    const Vector north = hn::LoadU(tag, northRow);
    const Vector contact = contacts.WithPlane(tag, base, westward ? west : east,
      southward ? south : north, contacts.SinkOf(tag, west, east, south, north));
    hn::StoreU(hn::IfThenElseZero(lit, contact), tag, d + at);

    const Vector corner = hn::LoadU(tag, (southward ? southRow : northRow) + (westward ? -1 : 1));
    const Vector sum = hn::Add(hn::Add(hn::Add(west, east), corner), hn::Add(south, north));
    const Mask bare = hn::And(lit, hn::IsNaN(sum));
    if (HWY_UNLIKELY(!hn::AllFalse(tag, bare)))
    {
      IlluminateBare(plan, x, y, own, bare, d + at);
    }
  }
}

}
}
HWY_AFTER_NAMESPACE();

#endif
