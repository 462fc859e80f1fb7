// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepCrossings_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepCrossings_inl_h
#undef SweepCrossings_inl_h
#else
#define SweepCrossings_inl_h
#endif

#include "PackedLanes.h"
#include "SweepTile-inl.h"

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Moves the lanes of a mask to the front, in their order; anything is behind them. Highway's
// Compress() copies its table at each call where there is no such instruction.
class Packer
{
public:
  Packer(Tag tag, Mask mask)
    : Chosen(mask)
  {
#if HWY_TARGET > HWY_AVX3
    const hn::Rebind<std::uint8_t, Tag> bytes;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    this->Places = hn::IndicesFromVec(
      tag, hn::PromoteTo(IntTag(), hn::LoadU(bytes, Packed.lanes[bits[0]].data())));
#else
    (void)tag;
#endif
  }

  HWY_INLINE Vector operator()(Vector numbers) const
  {
#if HWY_TARGET > HWY_AVX3
    return hn::TableLookupLanes(numbers, this->Places);
#else
    return hn::Compress(numbers, this->Chosen);
#endif
  }

private:
  Mask Chosen;
#if HWY_TARGET > HWY_AVX3
  decltype(hn::IndicesFromVec(Tag(), hn::Zero(IntTag()))) Places;
#endif
};

// Crossings of the surface that are still to be measured, as InsideShare() takes them, and whose
// they are. Of a vector's rays only few cross in the same cell: here they stand side by side.
struct Waiting
{
  static constexpr int Enough = SweepThickness::TileSize; // to be measured
  static constexpr int Most = Enough + SweepThickness::TileSize * Crossings::GroupSize + MaxLanes;
  int count = 0;
  HWY_ALIGN float a[Most];
  HWY_ALIGN float b[Most];
  HWY_ALIGN float c[Most];
  HWY_ALIGN float marginIn[Most];
  HWY_ALIGN float margin[Most];
  HWY_ALIGN float length[Most]; // of the ray in the cell
  HWY_ALIGN float at[Most];

  // Adds those of the lanes of a mask; the first lane's sample is `first`. The margins differ if
  // rays are sunk by more than t.
  template <bool Deeper>
  HWY_INLINE void Add(Tag tag, Mask crosses, int first, Vector in, Vector out, Vector bend,
    Vector inMargin, Vector outMargin, Vector whole)
  {
    const Packer pack(tag, crosses);
    auto keep = [&](Vector numbers, float* to) { hn::StoreU(numbers, tag, to + this->count); };
    keep(pack(in), this->a);
    keep(pack(out), this->b);
    keep(pack(bend), this->c);
    keep(Deeper ? pack(inMargin) : inMargin, this->marginIn);
    keep(Deeper ? pack(outMargin) : outMargin, this->margin);
    keep(whole, this->length);
    keep(pack(hn::Iota(tag, static_cast<float>(first))), this->at);
    this->count += static_cast<int>(hn::CountTrue(tag, crosses));
  }

  // Measures all of them.
  void AddTo(float* thickness)
  {
    const Tag tag;
    const int lanes = static_cast<int>(hn::Lanes(tag));
    // The last vector may hold less.
    for (float* numbers : { this->a, this->b, this->c, this->marginIn, this->margin, this->length })
    {
      hn::StoreU(hn::Zero(tag), tag, numbers + this->count);
    }
    for (int k = 0; k < this->count; k += lanes)
    {
      const Vector share = InsideShare(tag, hn::Load(tag, this->a + k), hn::Load(tag, this->b + k),
        hn::Load(tag, this->c + k), hn::Load(tag, this->marginIn + k),
        hn::Load(tag, this->margin + k));
      hn::Store(hn::Mul(share, hn::Load(tag, this->length + k)), tag, this->length + k);
    }
    for (int k = 0; k < this->count; ++k)
    {
      thickness[static_cast<int>(this->at[k])] += this->length[k];
    }
    this->count = 0;
  }
};

}
}
HWY_AFTER_NAMESPACE();

#endif
